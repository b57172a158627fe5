// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <shared_mutex>
#include <utility>

#include "orbslam/map/map_data.h"

namespace orbslam {

/// The map that threads share. Look at it through `map.Read()->...`, change it through `map.Write()->...`; a
/// guard held in a variable spans several calls. Rules: no pointer into the map outlives its guard, and no
/// guard is held across extraction, matching, solving or waiting: gather, compute, then apply and look every
/// id up again.
class Map {
 public:
  class ReadGuard {
   public:
    const MapData* operator->() const { return data_; }
    const MapData& operator*() const { return *data_; }

   private:
    friend class Map;
    explicit ReadGuard(const Map& map) : lock_(map.mutex_), data_(&map.data_) {}
    std::shared_lock<std::shared_mutex> lock_;
    const MapData* data_;
  };
  class WriteGuard {
   public:
    MapData* operator->() const { return data_; }
    MapData& operator*() const { return *data_; }

   private:
    friend class Map;
    explicit WriteGuard(Map& map) : lock_(map.mutex_), data_(&map.data_) {}
    std::unique_lock<std::shared_mutex> lock_;
    MapData* data_;
  };

  explicit Map(MapData data) : data_(std::move(data)) {}

  [[nodiscard]] ReadGuard Read() const { return ReadGuard(*this); }
  [[nodiscard]] WriteGuard Write() { return WriteGuard(*this); }

 private:
  mutable std::shared_mutex mutex_;
  MapData data_;
};

}  // namespace orbslam
