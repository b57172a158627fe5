// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a synthetic RGB-D sequence with ground truth in the layout of the TUM RGB-D benchmark.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "orbslam/camera/depth_model.h"
#include "orbslam/io/image_file.h"
#include "orbslam/io/trajectory.h"
#include "orbslam/synthetic/synthetic_sequence.h"
#include "orbslam/util/file.h"
#include "orbslam/util/text.h"

namespace orbslam {
namespace {

constexpr int kUsageError = 2;

struct Arguments {
  std::string folder;
  std::string motion = "xyz";
  SyntheticSequenceOptions options;
  int width = 640;
  bool noise = true;
  bool quiet = false;
};

/// The texts of the files that list the frames, grown frame by frame.
struct Lists {
  std::string rgb = "# color images\n# timestamp filename\n";
  std::string depth = "# depth maps\n# timestamp filename\n";
  std::string associations;
  std::vector<StampedPose> ground_truth;

  void Add(const std::string& timestamp, const Rigid3d& world_from_camera) {
    const std::string rgb_line = timestamp + " rgb/" + timestamp + ".png";
    const std::string depth_line = timestamp + " depth/" + timestamp + ".png";
    rgb += rgb_line + '\n';
    depth += depth_line + '\n';
    associations += rgb_line + ' ' + depth_line + '\n';
    ground_truth.push_back({timestamp, world_from_camera});
  }
};

std::string SettingsYaml(const PinholeCamera& camera) {
  const DepthModel depth;
  const double baseline_m = 40.0 / 535.4;  // of the virtual right camera; a Kinect's, as TUM3.yaml has it
  std::string text = "%YAML:1.0\n---\n";
  const auto add = [&](const std::string& key, double value) {
    text += key + ": " + FormatDouble(value) + '\n';
  };
  add("Camera.fx", camera.fx);
  add("Camera.fy", camera.fy);
  add("Camera.cx", camera.cx);
  add("Camera.cy", camera.cy);
  for (const char* key : {"Camera.k1", "Camera.k2", "Camera.p1", "Camera.p2", "Camera.k3"}) add(key, 0);
  add("Camera.width", camera.width);
  add("Camera.height", camera.height);
  add("Camera.fps", SyntheticSequence::kFramesPerSecond);
  add("Camera.bf", baseline_m * camera.fx);
  add("Camera.RGB", 1);
  add("ThDepth", depth.close_limit_baselines);
  add("DepthMapFactor", depth.units_per_metre);
  add("ORBextractor.nFeatures", 1000);
  add("ORBextractor.scaleFactor", 1.2);
  add("ORBextractor.nLevels", 8);
  add("ORBextractor.iniThFAST", 20);
  add("ORBextractor.minThFAST", 7);
  return text;
}

Status WriteFrame(const std::string& folder, const std::string& timestamp, const SyntheticFrame& frame) {
  constexpr int kCompression = 3;
  cv::Mat raw_depth;
  frame.depth_m.convertTo(raw_depth, CV_16U, DepthModel().units_per_metre);
  const Status rgb = WritePng(folder + "/rgb/" + timestamp + ".png", frame.bgr, kCompression);
  if (!rgb) return rgb;
  return WritePng(folder + "/depth/" + timestamp + ".png", raw_depth, kCompression);
}

Status WriteLists(const std::string& folder, const Lists& lists, const PinholeCamera& camera) {
  const std::pair<const char*, std::string> files[] = {{"/rgb.txt", lists.rgb},
                                                       {"/depth.txt", lists.depth},
                                                       {"/associations.txt", lists.associations},
                                                       {"/camera.yaml", SettingsYaml(camera)}};
  for (const auto& [name, text] : files) {
    if (const Status status = WriteFileAtomically(folder + name, text); !status) return status;
  }
  return WriteTrajectory(folder + "/groundtruth.txt", lists.ground_truth);
}

Status MakeFolders(const std::string& folder) {
  for (const char* part : {"/rgb", "/depth"}) {
    std::error_code error;
    std::filesystem::create_directories(folder + part, error);
    if (error) return Error{folder + part + ": cannot make this folder: " + error.message()};
  }
  return OkStatus();
}

Status WriteSequence(const Arguments& arguments) {
  if (const Status status = arguments.options.Check(); !status) return status;
  if (const Status status = MakeFolders(arguments.folder); !status) return status;
  const SyntheticSequence sequence(arguments.options);
  const bool show_progress = !arguments.quiet && isatty(STDERR_FILENO) != 0;
  Lists lists;
  for (int i = 0; i < sequence.size(); ++i) {
    const SyntheticFrame frame = sequence.Frame(i);
    const std::string timestamp = FormatFixed(frame.timestamp_s, 6);
    if (const Status status = WriteFrame(arguments.folder, timestamp, frame); !status) return status;
    lists.Add(timestamp, frame.world_from_camera);
    if (show_progress) std::fprintf(stderr, "\rframe %d of %d", i + 1, sequence.size());
  }
  if (show_progress) std::fprintf(stderr, "\r\033[K");
  if (const Status status = WriteLists(arguments.folder, lists, arguments.options.camera); !status)
    return status;
  if (!arguments.quiet) std::printf("%s: %d frames\n", arguments.folder.c_str(), sequence.size());
  return OkStatus();
}

void AddOptions(CLI::App* app, Arguments* arguments) {
  app->add_option("--out", arguments->folder, "Folder to write; made if missing")->required();
  app->add_option("--motion", arguments->motion, "How the camera moves")
      ->check(CLI::IsMember({"xyz", "rpy", "loop", "static"}))
      ->capture_default_str();
  app->add_option("--frames", arguments->options.num_frames, "Frames at 30 Hz; 0: the whole motion")
      ->check(CLI::Range(0, 100000));
  app->add_option("--seed", arguments->options.seed, "Of the paint, the hand's tremor and the noise")
      ->capture_default_str();
  app->add_option("--width", arguments->width, "Image width, px; the height is three quarters of it")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  app->add_flag("--noise,!--no-noise", arguments->noise,
                "A Kinect's noise in depth and grey (default: with)");
  app->add_flag("--quiet", arguments->quiet, "Print nothing but errors");
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Writes a synthetic RGB-D sequence with ground truth in the layout of the TUM RGB-D benchmark.");
  Arguments arguments;
  AddOptions(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    std::fprintf(stderr, "make_sequence: %s (see --help)\n", error.what());
    return kUsageError;
  }
  arguments.options.motion = *ParseMotion(arguments.motion);
  arguments.options.camera = SyntheticCamera(arguments.width);
  arguments.options.depth_noise = arguments.options.image_noise = arguments.noise;
  if (const Status status = WriteSequence(arguments); !status) {
    std::fprintf(stderr, "make_sequence: %s\n", status.error().message.c_str());
    return kUsageError;
  }
  return 0;
}

}  // namespace
}  // namespace orbslam

int main(int argc, char** argv) { return orbslam::Main(argc, argv); }
