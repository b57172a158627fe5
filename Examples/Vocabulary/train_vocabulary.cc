// SPDX-License-Identifier: GPL-3.0-or-later
// Trains a vocabulary on all PNG and JPEG pictures below some folders. Same pictures and options, same file.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "orbslam/io/image_file.h"
#include "orbslam/vocabulary/trainer.h"
#include "orbslam/vocabulary/training_images.h"
#include "orbslam/vocabulary/vocabulary_file.h"
#include "picture_files.h"

namespace {

struct Arguments {
  std::string out;
  std::vector<std::string> folders;
  orbslam::TrainerOptions trainer;
  orbslam::TrainingImageOptions images;
};

/// One line that grows on a terminal; elsewhere a line for every tenth of the work.
class Progress {
 public:
  explicit Progress(size_t total) : total_(total), is_terminal_(isatty(STDERR_FILENO) == 1) {}

  void Show(size_t done) {
    const size_t percent = 100 * done / total_;
    if (percent == shown_percent_) return;
    if (is_terminal_) {
      const std::string bar(percent / 2, '#');
      std::fprintf(stderr, "\r[%-50s] %3zu %%  %zu of %zu pictures%s", bar.c_str(), percent, done, total_,
                   done == total_ ? "\n" : "");
    } else if (percent / 10 != shown_percent_ / 10) {
      std::fprintf(stderr, "%zu of %zu pictures described\n", done, total_);
    }
    shown_percent_ = percent;
  }

 private:
  size_t total_;
  bool is_terminal_;
  size_t shown_percent_ = 0;
};

int Fail(const std::string& message) {
  std::fprintf(stderr, "train_vocabulary: %s\n", message.c_str());
  return 1;
}

int Train(Arguments& arguments) {
  const std::vector<std::string> files = orbslam::FindPictures(arguments.folders);
  if (files.empty()) return Fail("no PNG or JPEG pictures below the given folders");
  Progress progress(files.size());
  const orbslam::TrainingImages images = orbslam::DescribeTrainingImages(
      files, orbslam::ReadGray, arguments.images, [&](size_t done) { progress.Show(done); });
  for (const std::string& problem : images.unreadable)
    std::fprintf(stderr, "left out: %s\n", problem.c_str());

  size_t num_descriptors = 0;
  for (const auto& tile : images.descriptors) num_descriptors += tile.size();
  std::fprintf(stderr, "%zu tiles, %zu descriptors\n", images.descriptors.size(), num_descriptors);
  arguments.trainer.on_level = [&](int level, int nodes) {
    std::fprintf(stderr, "level %d of %d: %d nodes\n", level, arguments.trainer.depth, nodes);
  };
  const auto vocabulary = orbslam::TrainVocabulary(images.descriptors, arguments.trainer);
  if (!vocabulary) return Fail(vocabulary.error().message);
  const orbslam::Status written = orbslam::WriteVocabulary(*vocabulary, arguments.out);
  if (!written) return Fail(written.error().message);
  std::printf("%s: %d words\n", arguments.out.c_str(), vocabulary->num_words());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  int num_threads = static_cast<int>(std::thread::hardware_concurrency());
  CLI::App app{"Train a vocabulary on all PNG and JPEG pictures below some folders, cut into VGA tiles"};
  app.add_option("--out", arguments.out, "vocabulary to write, binary")->required();
  app.add_option("-k,--branching", arguments.trainer.branching, "children of a node")
      ->check(CLI::Range(2, 255))
      ->capture_default_str();
  app.add_option("-L,--depth", arguments.trainer.depth, "levels")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  app.add_option("--seed", arguments.trainer.seed, "of the clustering")->capture_default_str();
  app.add_option("--features", arguments.images.extractor.num_features, "wanted of a tile")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--threads", num_threads, "the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("IMAGES_DIR", arguments.folders, "folders with pictures")
      ->required()
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  arguments.trainer.num_threads = num_threads;
  arguments.images.num_threads = num_threads;
  arguments.images.min_features =
      std::min(arguments.images.min_features, arguments.images.extractor.num_features / 5);
  return Train(arguments);
}
