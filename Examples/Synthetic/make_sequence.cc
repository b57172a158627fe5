// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a synthetic RGB-D sequence with ground truth in the layout of the TUM RGB-D benchmark.
#include <atomic>
#include <cstdio>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "arguments.h"
#include "contact_sheet.h"
#include "orbslam/io/image_file.h"
#include "orbslam/synthetic/synthetic_sequence.h"
#include "orbslam/system/progress.h"
#include "sequence_writer.h"

namespace orbslam {
namespace {

int NumFigures(const SyntheticSequence& sequence) {
  std::set<int> labels;
  for (const SceneObject& object : sequence.SceneAt(0)) labels.insert(object.label);
  labels.erase(0);
  return static_cast<int>(labels.size());
}

/// Makes and writes all frames; threads take the next frame each, so that one draws while others write.
class FrameFactory {
 public:
  FrameFactory(const SyntheticSequence& sequence, SequenceWriter* writer, ContactSheet* sheet,
               Progress* progress)
      : sequence_(sequence), writer_(writer), sheet_(sheet), progress_(progress) {}

  Status Run(int num_threads) {
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < num_threads; ++i) threads.emplace_back([this] { Work(); });
    }
    return failure_;
  }

 private:
  void Work() {
    while (true) {
      const int index = next_++;
      if (index >= sequence_.size() || has_failed_) return;
      const SyntheticFrame frame = sequence_.Frame(index);
      const Status status = writer_->WriteFrame(index, frame);
      if (const int cell = sheet_->CellOf(index); cell >= 0) sheet_->Draw(cell, frame);
      const std::lock_guard lock(mutex_);
      if (!status) failure_ = status, has_failed_ = true;
      progress_->Update(++num_done_, "");
    }
  }

  const SyntheticSequence& sequence_;
  SequenceWriter* writer_;
  ContactSheet* sheet_;
  std::atomic<int> next_ = 0;
  std::atomic<bool> has_failed_ = false;

  std::mutex mutex_;  // guards the next three
  Progress* progress_;
  int num_done_ = 0;
  Status failure_ = OkStatus();
};

Status WriteSequence(const Arguments& arguments) {
  if (const Status status = arguments.options.Check(); !status) return status;
  SequenceWriter writer(arguments.folder, arguments.options.NumFrames());
  if (const Status status = writer.MakeFolders(); !status) return status;
  const SyntheticSequence sequence(arguments.options);
  ContactSheet sheet(sequence.size());
  Progress progress(stderr, sequence.size(),
                    arguments.quiet ? Progress::Mode::kQuiet : Progress::Mode::kAutomatic);
  if (const Status status = FrameFactory(sequence, &writer, &sheet, &progress).Run(arguments.num_threads);
      !status) {
    return status;
  }
  progress.Finish();
  if (const Status status = writer.WriteLists(arguments.options, NumFigures(sequence)); !status)
    return status;
  if (!arguments.contact_sheet.empty()) {
    if (const Status status = WritePng(arguments.contact_sheet, sheet.image()); !status) return status;
  }
  if (!arguments.quiet) std::printf("%s: %d frames\n", arguments.folder.c_str(), sequence.size());
  return OkStatus();
}

int Main(int argc, char** argv) {
  const ParsedArguments parsed = ParseArguments(argc, argv);
  if (parsed.exit_code) return *parsed.exit_code;
  if (const Status status = WriteSequence(parsed.arguments); !status) {
    std::fprintf(stderr, "make_sequence: %s\n", status.error().message.c_str());
    return kUsageError;
  }
  return 0;
}

}  // namespace
}  // namespace orbslam

int main(int argc, char** argv) { return orbslam::Main(argc, argv); }
