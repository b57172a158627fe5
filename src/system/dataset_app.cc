// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/dataset_app.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <thread>

#include "orbslam/system/mask_files.h"
#include "orbslam/system/run_report.h"
#include "orbslam/util/file.h"
#include "orbslam/util/text.h"
#include "orbslam/vocabulary/vocabulary_file.h"
#include "version.h"

namespace orbslam {
namespace {

/// Logs what failed, a line for each line of the message.
bool Succeeded(const Status& status) {
  if (status) return true;
  for (const TextLine& line : SplitLines(status.error().message)) spdlog::error("{}", line.text);
  return false;
}

Status CheckSequenceFolder(const std::string& folder) {
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return OkStatus();
  return Error{fmt::format("{}: {}; the folder of a sequence is expected", folder,
                           error ? error.message() : "not a folder")};
}

/// An earlier run into the same folder may have made more maps than this one will: their trajectories must
/// not stay beside this run's.
void RemoveFurtherTrajectories(const std::string& folder) {
  for (const char* name : {"CameraTrajectory", "KeyFrameTrajectory"}) {
    std::error_code error;
    for (int map = 2; std::filesystem::remove(fmt::format("{}/{}_{}.txt", folder, name, map), error); ++map) {
    }
  }
}

/// Found out before the run and not after it: that results can be written at all.
Status PrepareOutputFolder(const std::string& folder, const Settings& settings) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Error{fmt::format("{}: cannot make the output folder: {}", folder, error.message())};
  RemoveFurtherTrajectories(folder);
  return WriteFileAtomically(folder + "/settings.yaml", EffectiveSettingsYaml(settings));
}

/// nullptr for "-".
Result<std::shared_ptr<const Vocabulary>> OpenVocabulary(const std::string& path) {
  if (path == "-") return std::shared_ptr<const Vocabulary>();
  Result<Vocabulary> vocabulary = ReadVocabulary(path);
  if (!vocabulary) return vocabulary.error();
  return std::make_shared<const Vocabulary>(*std::move(vocabulary));
}

/// What a run reads before it begins.
struct Inputs {
  Settings settings;
  TumSequence sequence;
  std::shared_ptr<const Vocabulary> vocabulary;
  UserMask masks;  // no function if no folder is named
  std::vector<std::string> warnings;
};

/// Warnings are logged as soon as they are known: they may explain the error that follows.
void Warn(const std::vector<std::string>& warnings, Inputs* inputs) {
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  inputs->warnings.insert(inputs->warnings.end(), warnings.begin(), warnings.end());
}

Result<Inputs> OpenInputs(const DatasetJob& job) {
  Inputs inputs;
  std::vector<std::string> warnings;
  Result<Settings> settings = ReadSettings(job.settings_path, &warnings);
  if (!settings) return settings.error();
  inputs.settings = *std::move(settings);
  Warn(warnings, &inputs);
  const Status folder = CheckSequenceFolder(job.sequence_folder);
  if (!folder) return folder.error();
  Result<TumSequence> sequence = ReadTumSequence(job.sequence_folder, job.associations_path);
  if (!sequence) return sequence.error();
  inputs.sequence = *std::move(sequence);
  Warn(inputs.sequence.warnings, &inputs);
  auto vocabulary = OpenVocabulary(job.vocabulary_path);
  if (!vocabulary) return vocabulary.error();
  inputs.vocabulary = *std::move(vocabulary);
  if (job.mask_folder.empty()) return inputs;
  Result<UserMask> masks = MasksFromFolder(job.mask_folder, inputs.sequence, inputs.settings.camera);
  if (!masks) return masks.error();
  inputs.masks = *std::move(masks);
  return inputs;
}

/// Takes seconds where a map is large; whoever interrupts does not want to wait for that.
void AdjustMapsUnlessInterrupted(const std::atomic<bool>& is_interrupted, System* system) {
  std::stop_source stop;
  const std::jthread watcher([&](const std::stop_token& is_done) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any done;  // by is_done alone: a signal's handler can notify nobody
    while (!is_done.stop_requested() && !is_interrupted)
      done.wait_for(lock, is_done, std::chrono::milliseconds(50), [&] { return is_interrupted.load(); });
    stop.request_stop();
  });
  if (!is_interrupted) system->AdjustMaps(stop.get_token());
}

/// Writes all that there is, even if one file fails.
bool WriteResults(const DatasetJob& job, const std::string& report, const System& system) {
  const std::string folder = job.output_folder + "/";
  const bool camera_done = Succeeded(system.SaveTrajectory(folder + "CameraTrajectory.txt"));
  const bool keyframes_done = Succeeded(system.SaveKeyFrameTrajectory(folder + "KeyFrameTrajectory.txt"));
  const bool map_done = job.save_map_path.empty() || Succeeded(system.SaveMap(job.save_map_path));
  const bool report_done = Succeeded(WriteFileAtomically(folder + "run.json", report));
  return camera_done && keyframes_done && map_done && report_done;
}

/// What a run without a single pose must have been given; nullptr: there are poses.
const char* ExplainFailure(const DatasetJob& job, const RunSummary& summary, int num_tracked) {
  if (num_tracked > 0) return nullptr;
  if (summary.frames_processed == 0) return "no frame of the sequence could be read";
  if (!job.load_map_path.empty()) {
    return "no camera pose could be computed: no image shows a place of the loaded map";
  }
  return "no camera pose could be computed: the images show too few corners with depth (dark, white or "
         "without depth?)";
}

void PrintSummary(const DatasetJob& job, const RunSummary& summary, const System& system) {
  const System::Counts counts = system.counts();
  const std::string text =
      FormatTrackingTimes(summary.frames) +
      fmt::format("tracked {} of {} frames ({} lost, {} skipped), {} keyframes, {} map points\n",
                  counts.tracked, summary.frames_listed, summary.frames_lost, summary.frames_skipped,
                  counts.keyframes, counts.map_points) +
      fmt::format("results are in {}\n",
                  std::filesystem::absolute(job.output_folder).lexically_normal().string());
  std::fputs(text.c_str(), stdout);  // unlike fmt::print, no exception if nobody can read it
}

}  // namespace

const char* Version() { return kVersion; }

int RunDataset(const DatasetJob& job, const std::atomic<bool>& is_interrupted) {
  const Result<Inputs> inputs = OpenInputs(job);
  if (!inputs) return Succeeded(inputs.error()), kExitError;
  const Settings& settings = inputs->settings;
  if (!Succeeded(PrepareOutputFolder(job.output_folder, settings))) return kExitError;
  Result<MaskWriter> opened = MaskWriter::Open(job.save_masks_folder, settings.camera);
  if (!opened) return Succeeded(opened.error()), kExitError;
  MaskWriter mask_writer = *std::move(opened);

  System system(settings, {.mode = {.is_sequential = job.sequential, .is_live = job.run.realtime},
                           .vocabulary = inputs->vocabulary,
                           .use_detector = job.use_detector,
                           .user_mask = inputs->masks});
  if (!job.load_map_path.empty() && !Succeeded(system.LoadMap(job.load_map_path))) return kExitError;
  if (job.localize_only) system.ActivateLocalizationMode();
  const FrameObserver write_mask = [&](const RgbdEntry& entry, const FrameReport& report) {
    mask_writer.Write(entry, report.moving.mask);
  };
  const RunSummary summary =
      RunSequence(inputs->sequence, settings, job.run, is_interrupted, write_mask, &system);
  system.Shutdown();
  if (settings.mapping.adjust_at_end) AdjustMapsUnlessInterrupted(is_interrupted, &system);

  const std::string report = FormatRunReport(job.command_line, settings, inputs->warnings, summary, system);
  const bool are_results_written = WriteResults(job, report, system);
  const bool are_masks_written = Succeeded(mask_writer.status());
  if (job.run.progress != Progress::Mode::kQuiet) PrintSummary(job, summary, system);
  if (const auto failure = system.failure()) {
    spdlog::error("internal error, results are incomplete: {}", failure->message);
    return kExitError;
  }
  if (summary.was_interrupted) return kExitInterrupted;
  if (const char* reason = ExplainFailure(job, summary, system.counts().tracked)) {
    spdlog::error("{}: {}", job.sequence_folder, reason);
    return kExitError;
  }
  return are_results_written && are_masks_written ? kExitOk : kExitError;
}

}  // namespace orbslam
