// SPDX-License-Identifier: GPL-3.0-or-later
#include "shaders.h"

#include <cstdio>
#include <string>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

// All vectors are in the camera frame: x right, y down, z forward.
constexpr char kVertexShader[] = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in float light;
uniform mat4 camera_from_mesh;
uniform mat4 clip_from_camera;
out vec3 x;
out vec3 n;
out vec2 texel;
out float arriving;
void main() {
  x = (camera_from_mesh * vec4(position, 1)).xyz;
  n = mat3(camera_from_mesh) * normal;
  texel = uv;
  arriving = light;
  gl_Position = clip_from_camera * vec4(x, 1);
}
)";

// The highlight is Blinn's (SIGGRAPH 1977). A panel's light falls with the cosine at both ends and the
// distance squared; the constant keeps it finite nearby.
constexpr char kColorShader[] = R"(
in vec3 x;
in vec3 n;
in vec2 texel;
in float arriving;
uniform sampler2D picture;
uniform vec3 color;
uniform float shininess;
uniform float emission;
uniform vec3 up;
uniform vec3 from_above;
uniform vec3 from_below;
uniform int num_lamps;
uniform vec3 lamp_position[6];
uniform vec3 lamp_direction[6];
uniform vec3 lamp_power[6];
out vec4 result;
void main() {
  vec3 normal = normalize(n);
  vec3 base = texture(picture, texel).rgb * color;
  vec3 light = mix(from_below, from_above, 0.5 + 0.5 * dot(normal, up));
  vec3 highlight = vec3(0);
  vec3 to_eye = -normalize(x);
  for (int i = 0; i < num_lamps; ++i) {
    vec3 offset = lamp_position[i] - x;
    float squared = dot(offset, offset);
    vec3 to_lamp = offset * inversesqrt(squared);
    vec3 power = lamp_power[i] * max(-dot(lamp_direction[i], to_lamp), 0.0) / (squared + 0.2);
    light += power * max(dot(normal, to_lamp), 0.0);
    if (shininess > 0.0) highlight += power * pow(max(dot(normal, normalize(to_lamp + to_eye)), 0.0), 48.0);
  }
  vec3 linear = base * base * mix(light * arriving, vec3(1), emission) + shininess * arriving * highlight;
  result = vec4(sqrt(clamp(linear, 0.0, 1.0)), 1);
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

GLuint Link(const char* fragment_shader) {
  const GLuint program = glCreateProgram();
  for (const GLuint shader :
       {Compile(GL_VERTEX_SHADER, kVertexShader), Compile(GL_FRAGMENT_SHADER, fragment_shader)}) {
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

GLuint MakeColorProgram() { return Link(kColorShader); }
GLuint MakeGeometryProgram() { return Link(kGeometryShader); }

}  // namespace orbslam
