// SPDX-License-Identifier: GPL-3.0-or-later
// Tracks a sequence in the layout of the TUM RGB-D benchmark. Called as ORB-SLAM2's program of this name.
#include <fcntl.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "orbslam/system/dataset_app.h"

namespace {

std::atomic<bool> is_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void AddArguments(CLI::App* app, orbslam::DatasetJob* job, std::string* log_level, bool* is_quiet) {
  app->add_option("VOCABULARY", job->vocabulary_path, "visual vocabulary, or - for none")->required();
  app->add_option("SETTINGS", job->settings_path, "camera settings, such as config/TUM1.yaml")->required();
  app->add_option("SEQUENCE", job->sequence_folder, "folder with rgb/, depth/, rgb.txt and depth.txt")
      ->required();
  app->add_option("ASSOCIATIONS", job->associations_path,
                  "file of 't rgb t depth' lines; default: rgb.txt and depth.txt, paired within 0.02 s");
  app->add_option("--output-dir", job->output_folder, "where the results go")->capture_default_str();
  app->add_option("--load-map", job->load_map_path, "start in a map saved before");
  app->add_option("--save-map", job->save_map_path, "save the map at the end");
  app->add_flag("--localization", job->localize_only, "only localise: leave the loaded map as it is")
      ->needs("--load-map");
  app->add_flag("--sequential", job->sequential, "one thread, exactly repeatable");
  app->add_flag("--realtime", job->run.realtime, "pace by time stamps; default: as fast as possible");
  app->add_flag_callback(
      "--no-detector", [job] { job->use_detector = false; }, "do not look for moving objects");
  app->add_option("--mask-dir", job->mask_folder,
                  "ready-made masks, PNGs with the colour images' names, non-zero: may move; united with the "
                  "detector's");
  app->add_option("--save-masks", job->save_masks_folder, "write the masks that were used into this folder");
  app->add_option("--max-frames", job->run.max_frames, "stop after so many; 0: all")
      ->check(CLI::Range(0, std::numeric_limits<int>::max(), "COUNT"))
      ->capture_default_str();
  app->add_option("--log-level", *log_level, "what to log to stderr")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->capture_default_str();
  app->add_flag("--quiet", *is_quiet, "no progress and no summary; warnings and errors only");
}

/// Who closes a standard stream must not have its number given to a result file, and the log written there.
void FillClosedStandardStreams() {
  int descriptor = ::open("/dev/null", O_RDWR);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = ::dup(descriptor);
  if (descriptor > STDERR_FILENO) ::close(descriptor);
}

/// Help and version go to stdout; what is wrong with the arguments is one line on stderr.
int ExplainArguments(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::fprintf(stderr, "%s: %s; see --help\n", app.get_name().c_str(), error.what());
  return orbslam::kExitError;
}

}  // namespace

int main(int argc, char** argv) {
  FillClosedStandardStreams();
  CLI::App app("RGB-D SLAM on a sequence of the TUM RGB-D benchmark's layout", "rgbd_tum");
  orbslam::DatasetJob job{.command_line = {argv, argv + argc}};
  std::string log_level = "info";
  bool is_quiet = false;
  AddArguments(&app, &job, &log_level, &is_quiet);
  app.set_version_flag("--version", std::string("rgbd_tum ") + orbslam::Version());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ExplainArguments(app, error);
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("rgbd_tum"));
  spdlog::set_pattern("%n: %^%l%$: %v");
  spdlog::set_level(spdlog::level::from_str(log_level));
  if (is_quiet) job.run.progress = orbslam::Progress::Mode::kQuiet;
  cv::setNumThreads(1);  // our own threads share the cores better than a pool inside every filter would
  std::signal(SIGINT, [](int) { is_interrupted = true; });
  return orbslam::RunDataset(job, is_interrupted);
}
