// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/tum_sequence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "orbslam/util/text.h"
#include "tum_list.h"

namespace orbslam {
namespace {

constexpr double kMaxDifferenceS = 0.02;  // the benchmark's; less than a frame at 30 Hz
constexpr double kMaxDelayS = 0.1;        // further apart, the times are of two clocks

std::string InFolder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

RgbdEntry MakeEntry(const std::string& folder, const TumListRow& rgb, double depth_s,
                    const std::string& depth_name) {
  return {rgb.timestamp_s, rgb.fields[0], InFolder(folder, rgb.fields[1]), InFolder(folder, depth_name),
          depth_s - rgb.timestamp_s};
}

std::vector<double> Times(const TumList& list) {
  std::vector<double> times;
  for (const TumListRow& row : list.rows) times.push_back(row.timestamp_s);
  return times;
}

/// Times of two clocks tell no delay.
void ForgetImpossibleDelays(const std::string& path, TumSequence* sequence) {
  int num_forgotten = 0;
  for (RgbdEntry& entry : sequence->entries) {
    if (std::abs(entry.depth_delay_s) <= kMaxDelayS) continue;
    entry.depth_delay_s = 0;
    ++num_forgotten;
  }
  if (num_forgotten == 0) return;
  sequence->warnings.push_back(path + ": " + std::to_string(num_forgotten) +
                               " depth images are more than 0.1 s away from their colour images by the times "
                               "given; taken to be of the same instant");
}

Result<TumSequence> ReadAssociations(const std::string& folder, const std::string& path) {
  const Result<TumList> list = ReadTumList(path, kAssociations);
  if (!list) return list.error();
  TumSequence sequence{{}, list->warnings};
  for (const TumListRow& row : list->rows)
    sequence.entries.push_back(MakeEntry(folder, row, *ParseDouble(row.fields[2]), row.fields[3]));
  ForgetImpossibleDelays(path, &sequence);
  return sequence;
}

Result<TumSequence> AssociateLists(const std::string& folder) {
  const Result<TumList> rgb = ReadTumList(InFolder(folder, "rgb.txt"), kImageList);
  if (!rgb) return rgb.error();
  const Result<TumList> depth = ReadTumList(InFolder(folder, "depth.txt"), kImageList);
  if (!depth) return depth.error();

  TumSequence sequence{{}, rgb->warnings};
  sequence.warnings.insert(sequence.warnings.end(), depth->warnings.begin(), depth->warnings.end());
  for (const auto& [i, j] : AssociateByTime(Times(*rgb), Times(*depth), kMaxDifferenceS)) {
    sequence.entries.push_back(
        MakeEntry(folder, rgb->rows[i], depth->rows[j].timestamp_s, depth->rows[j].fields[1]));
  }
  if (!sequence.entries.empty()) return sequence;
  return Error{folder + ": no time in rgb.txt is within 0.02 s of one in depth.txt"};
}

}  // namespace

Result<TumSequence> ReadTumSequence(const std::string& folder, const std::string& associations_path) {
  return associations_path.empty() ? AssociateLists(folder) : ReadAssociations(folder, associations_path);
}

std::vector<std::pair<int, int>> AssociateByTime(std::span<const double> a_s, std::span<const double> b_s,
                                                 double max_difference_s) {
  std::vector<std::tuple<double, int, int>> candidates;
  size_t window_begin = 0;  // no b before it can match this a or a later one
  for (size_t i = 0; i < a_s.size(); ++i) {
    while (window_begin < b_s.size() && b_s[window_begin] <= a_s[i] - 2 * max_difference_s) ++window_begin;
    for (size_t j = window_begin; j < b_s.size() && b_s[j] < a_s[i] + 2 * max_difference_s; ++j) {
      const double difference_s = std::abs(a_s[i] - b_s[j]);
      if (difference_s < max_difference_s) {
        candidates.emplace_back(difference_s, static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());

  std::vector<bool> a_used(a_s.size()), b_used(b_s.size());
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [difference_s, i, j] : candidates) {
    if (a_used[i] || b_used[j]) continue;
    a_used[i] = b_used[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace orbslam
