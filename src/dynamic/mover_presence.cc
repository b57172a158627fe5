// SPDX-License-Identifier: GPL-3.0-or-later
#include "mover_presence.h"

#include <utility>

namespace orbslam {

bool MoverPresence::Update(std::span<const DynamicObject> objects, int num_image_pixels, double timestamp_s) {
  if (!options_.use_presence) return true;
  std::map<int, double> first_seen_s;
  for (const DynamicObject& object : objects) {
    const auto before = first_seen_s_.find(object.id);
    const double since_s = before == first_seen_s_.end() ? timestamp_s : before->second;
    first_seen_s.emplace(object.id, since_s);
    const bool is_large = object.num_pixels >= options_.min_share * num_image_pixels;
    const bool is_sure = object.log_odds >= options_.min_log_odds;
    if (is_large || is_sure || timestamp_s - since_s >= options_.min_age_s) believed_s_ = timestamp_s;
  }
  first_seen_s_ = std::move(first_seen_s);
  return timestamp_s - believed_s_ <= options_.memory_s;
}

}  // namespace orbslam
