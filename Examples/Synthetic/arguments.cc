// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

namespace orbslam {
namespace {

struct Texts {
  std::string motion = "xyz", script = "walking";
  int width = 640;
};

std::vector<std::string> MotionNames() {
  std::vector<std::string> names;
  for (const Motion motion : AllMotions()) names.emplace_back(MotionName(motion));
  return names;
}

std::vector<std::string> ScriptNames() {
  std::vector<std::string> names;
  for (const ScriptKind script : AllScripts()) names.emplace_back(ScriptName(script));
  return names;
}

void AddSensorSwitches(CLI::App* app, SensorEffects* effects) {
  const auto add = [&](const char* flags, bool* effect, const char* help) {
    app->add_flag(flags, *effect, help)->group("The sensor's effects");
  };
  add("--depth-noise,!--no-depth-noise", &effects->depth_noise, "Noise of depth, steps of disparity (on)");
  add("--depth-range,!--no-depth-range", &effects->depth_range, "Depth from 0.5 to 8 m only (on)");
  add("--depth-edges,!--no-depth-edges", &effects->depth_edges, "Ragged silhouettes with holes (on)");
  add("--depth-absorption,!--no-depth-absorption", &effects->depth_absorption,
      "No depth on dark, shiny and grazing surfaces (on)");
  add("--projector-shadow,!--no-projector-shadow", &effects->projector_shadow,
      "No depth beside near things (on)");
  add("--image-noise,!--no-image-noise", &effects->image_noise, "Noise of colour (on)");
  add("--image-blur,!--no-image-blur", &effects->image_blur, "The lens is a little soft (on)");
  add("--exposure,!--no-exposure", &effects->exposure, "Automatic, drifting exposure (on)");
  add("--separate-clocks,!--no-separate-clocks", &effects->separate_clocks,
      "Depth some 10 ms after colour (on)");
  add("--motion-blur,!--no-motion-blur", &effects->motion_blur,
      "An exposure of 1/60 s (off; five times the work)");
  add("--light-switch,!--no-light-switch", &effects->light_switch, "Lamps go off and on again (off)");
  app->add_flag_callback(
         "--no-sensor", [effects] { *effects = SensorEffects(); }, "None of these effects")
      ->trigger_on_parse()
      ->group("The sensor's effects");
}

void AddOptions(CLI::App* app, Arguments* arguments, Texts* texts) {
  app->add_option("--out", arguments->folder, "Folder to write; made if missing")->required();
  app->add_option("--motion", texts->motion, "How the camera moves")
      ->check(CLI::IsMember(MotionNames()))
      ->capture_default_str();
  app->add_option("--script", texts->script, "What happens in the room")
      ->check(CLI::IsMember(ScriptNames()))
      ->capture_default_str();
  app->add_option("--frames", arguments->options.num_frames, "Frames at 30 Hz; 0: the whole motion")
      ->check(CLI::Range(0, 100000));
  app->add_option("--seed", arguments->options.seed,
                  "Of the paint, the people, the hand's tremor and the noise")
      ->capture_default_str();
  app->add_option("--width", texts->width, "Image width, px; the height is three quarters of it")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  app->add_option("--contact-sheet", arguments->contact_sheet,
                  "PNG to write: twelve frames with masks and depth");
  app->add_option("--threads", arguments->num_threads, "Threads that make frames; the result is the same")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors");
  AddSensorSwitches(app, &arguments->options.sensor);
}

}  // namespace

ParsedArguments ParseArguments(int argc, char** argv) {
  CLI::App app(
      "Writes a synthetic RGB-D sequence with ground truth in the layout of the TUM RGB-D benchmark.");
  ParsedArguments parsed;
  Texts texts;
  Arguments& arguments = parsed.arguments;
  arguments.options.sensor = SensorEffects::Usual();
  AddOptions(&app, &arguments, &texts);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    parsed.exit_code = error.get_exit_code() == 0 ? app.exit(error) : kUsageError;  // 0: --help
    if (parsed.exit_code != 0) std::fprintf(stderr, "make_sequence: %s (see --help)\n", error.what());
    return parsed;
  }
  arguments.options.motion = *ParseMotion(texts.motion);
  arguments.options.script = *ParseScript(texts.script);
  arguments.options.camera = SyntheticCamera(texts.width);
  return parsed;
}

}  // namespace orbslam
