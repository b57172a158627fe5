// SPDX-License-Identifier: GPL-3.0-or-later
#include "shaders.h"

#include <cstdio>
#include <string>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

// All vectors are in the camera frame: x right, y down, z forward.

// Light is computed at the vertices: meshes are finely cut where light varies, and llvmpipe's time goes into
// pixels. The highlight is Blinn's (SIGGRAPH 1977). A panel's light falls with the cosine at both ends and
// the distance squared; the constant keeps it finite nearby.
constexpr char kColorVertexShader[] = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in float arriving;
uniform mat4 camera_from_mesh;
uniform mat4 clip_from_camera;
uniform float shininess;
uniform float emission;
uniform vec3 up;
uniform vec3 from_above;
uniform vec3 from_below;
uniform int num_lamps;
uniform vec3 lamp_position[6];
uniform vec3 lamp_direction[6];
uniform vec3 lamp_power[6];
out vec2 texel;
out vec3 diffuse;
out vec3 highlight;
void main() {
  vec3 x = (camera_from_mesh * vec4(position, 1)).xyz;
  vec3 n = normalize(mat3(camera_from_mesh) * normal);
  vec3 light = mix(from_below, from_above, 0.5 + 0.5 * dot(n, up));
  vec3 gloss = vec3(0);
  vec3 to_eye = -normalize(x);
  for (int i = 0; i < num_lamps; ++i) {
    vec3 offset = lamp_position[i] - x;
    float squared = dot(offset, offset);
    vec3 to_lamp = offset * inversesqrt(squared);
    vec3 power = lamp_power[i] * max(-dot(lamp_direction[i], to_lamp), 0.0) / (squared + 0.2);
    light += power * max(dot(n, to_lamp), 0.0);
    gloss += power * pow(max(dot(n, normalize(to_lamp + to_eye)), 0.0), 24.0);
  }
  texel = uv;
  diffuse = mix(light * arriving, vec3(1), emission);
  highlight = shininess * arriving * gloss;
  gl_Position = clip_from_camera * vec4(x, 1);
}
)";

constexpr char kColorShader[] = R"(
in vec2 texel;
in vec3 diffuse;
in vec3 highlight;
uniform sampler2D picture;
uniform vec3 color;
out vec4 result;
void main() {
  vec3 base = texture(picture, texel).rgb * color;
  result = vec4(sqrt(min(base * base * diffuse + highlight, 1.0)), 1);
}
)";

constexpr char kGeometryVertexShader[] = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 camera_from_mesh;
uniform mat4 clip_from_camera;
out vec3 x;
out vec3 n;
void main() {
  x = (camera_from_mesh * vec4(position, 1)).xyz;
  n = mat3(camera_from_mesh) * normal;
  gl_Position = clip_from_camera * vec4(x, 1);
}
)";

constexpr char kGeometryShader[] = R"(
in vec3 x;
in vec3 n;
uniform vec4 properties;  // label, moving, infrared, -
layout(location = 0) out float depth;
layout(location = 1) out vec4 surface;
void main() {
  depth = x.z;
  surface = vec4(properties.xyz, abs(dot(normalize(n), normalize(x))));
}
)";

GLuint Compile(GLenum kind, const char* body) {
  const std::string source = std::string("#version 330 core\n") + body;
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled != GL_TRUE) {
    char log[2000] = "";
    glGetShaderInfoLog(shader, sizeof(log), nullptr, log);
    std::fprintf(stderr, "%s\n", log);
  }
  ORBSLAM_CHECK(compiled == GL_TRUE);
  return shader;
}

GLuint Link(const char* vertex_shader, const char* fragment_shader) {
  const GLuint program = glCreateProgram();
  for (const GLuint shader :
       {Compile(GL_VERTEX_SHADER, vertex_shader), Compile(GL_FRAGMENT_SHADER, fragment_shader)}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);  // goes with the program
  }
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  ORBSLAM_CHECK(linked == GL_TRUE);
  return program;
}

}  // namespace

GLuint MakeColorProgram() { return Link(kColorVertexShader, kColorShader); }
GLuint MakeGeometryProgram() { return Link(kGeometryVertexShader, kGeometryShader); }

}  // namespace orbslam
