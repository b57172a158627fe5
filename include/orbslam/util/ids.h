// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>

namespace orbslam {

/// An integer that names one kind of thing and cannot be mistaken for another kind's. Ids are given in
/// ascending order and never reused, so that ordered iteration is reproducible. Default: names nothing.
template <class Tag>
struct StrongId {
  static constexpr uint32_t kInvalid = std::numeric_limits<uint32_t>::max();
  uint32_t value = kInvalid;

  constexpr StrongId() = default;
  constexpr explicit StrongId(uint32_t v) : value(v) {}
  constexpr bool IsValid() const { return value != kInvalid; }
  friend constexpr auto operator<=>(StrongId, StrongId) = default;
};

using FrameId = StrongId<struct FrameTag>;
using KeyFrameId = StrongId<struct KeyFrameTag>;
using MapPointId = StrongId<struct MapPointTag>;

}  // namespace orbslam

template <class Tag>
struct std::hash<orbslam::StrongId<Tag>> {
  size_t operator()(orbslam::StrongId<Tag> id) const noexcept { return std::hash<uint32_t>{}(id.value); }
};
