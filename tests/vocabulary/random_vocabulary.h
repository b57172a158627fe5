// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "orbslam/util/random.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

inline Descriptor RandomDescriptor(Rng* rng) { return {{(*rng)(), (*rng)(), (*rng)(), (*rng)()}}; }

inline std::vector<Descriptor> RandomDescriptors(int count, Rng* rng) {
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < count; ++i) descriptors.push_back(RandomDescriptor(rng));
  return descriptors;
}

/// A copy with each of `flips` random bits flipped (some perhaps twice).
inline Descriptor Perturbed(const Descriptor& original, int flips, Rng* rng) {
  Descriptor descriptor = original;
  for (int i = 0; i < flips; ++i) descriptor.words[rng->Below(4)] ^= uint64_t{1} << rng->Below(64);
  return descriptor;
}

/// A tree with random descriptors and weights; nodes above the last level have 0 or 2 to k children, the root
/// has k.
inline VocabularyTree RandomTree(int branching, int depth, Rng* rng) {
  VocabularyTree tree{branching, depth, {}, {}, {}};
  size_t level_begin = 0, level_end = 1;
  for (int level = 0; level <= depth; ++level) {
    size_t children = 0;
    for (size_t node = level_begin; node < level_end; ++node) {
      uint8_t count = static_cast<uint8_t>(2 + rng->Below(static_cast<uint32_t>(branching) - 1));
      if (level == 0) count = static_cast<uint8_t>(branching);
      if (level == depth || (level > 0 && rng->Below(4) == 0)) count = 0;
      tree.descriptors.push_back(RandomDescriptor(rng));
      tree.child_counts.push_back(count);
      if (count == 0) tree.word_weights.push_back(static_cast<float>(rng->Uniform(0.1, 8)));
      children += count;
    }
    level_begin = level_end;
    level_end += children;
  }
  return tree;
}

inline Vocabulary RandomVocabulary(int branching, int depth, uint64_t seed) {
  Rng rng(seed);
  return Vocabulary::Create(RandomTree(branching, depth, &rng)).value();
}

/// A path in a folder of the test's own, removed at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : folder_(std::filesystem::temp_directory_path() /
                ("orbslam_" + name + "_" + std::to_string(Rng(Now())()))) {
    std::filesystem::create_directories(folder_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(folder_); }

  std::string operator/(const std::string& name) const { return (folder_ / name).string(); }
  const std::filesystem::path& path() const { return folder_; }

 private:
  static uint64_t Now() {
    return static_cast<uint64_t>(std::filesystem::file_time_type::clock::now().time_since_epoch().count());
  }
  std::filesystem::path folder_;
};

}  // namespace orbslam
