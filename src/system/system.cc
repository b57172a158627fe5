// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/system.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "orbslam/io/map_file.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

/// "a/b.txt" -> "a/b_2.txt".
std::string Numbered(const std::string& path, int number) {
  if (number == 1) return path;
  const std::filesystem::path p(path);
  return (p.parent_path() / (p.stem().string() + "_" + std::to_string(number) + p.extension().string()))
      .string();
}

Settings WithDoubts(Settings settings, const SystemOptions& options) {
  settings.tracking.doubt_near_points =
      DoubtsNearPoints(settings, options.use_detector, options.user_mask != nullptr);
  return settings;
}

}  // namespace

System::System(const Settings& settings, SystemOptions options)
    : settings_(WithDoubts(settings, options)),
      options_(std::move(options)),
      sensor_(settings.camera, settings.depth, settings.orb, settings.fps) {
  StartMasks();
  StartSession(MapData(sensor_.pyramid));
}

void System::StartMasks() {
  masks_ =
      std::make_unique<MaskSupplier>(settings_, options_.use_detector, options_.mode, options_.user_mask);
}

System::~System() { Shutdown(); }

void System::StartSession(MapData map) {
  last_tracked_s_.reset();
  sessions_.push_back(
      std::make_unique<MapSession>(sensor_, settings_, options_.mode, options_.vocabulary, std::move(map)));
  sessions_.back()->SetLocalizationMode(is_localizing_);
}

FrameReport System::TrackRgbd(RgbdImage image) {
  const cv::Size size(settings_.camera.width, settings_.camera.height);
  ORBSLAM_CHECK(image.gray.type() == CV_8UC1 && image.gray.size() == size);
  ORBSLAM_CHECK(image.depth_m.type() == CV_32FC1 && image.depth_m.size() == size);
  image.id = FrameId(num_frames_++);
  const auto shared = std::make_shared<const RgbdImage>(std::move(image));
  MaskOfFrame mask_of_frame;
  if (masks_->HasSource()) {
    masks_->Begin(shared);
    mask_of_frame = [this](const Rigid3d& now_from_last) { return masks_->Take(now_from_last); };
  }
  const FrameReport report = sessions_.back()->Track(*shared, mask_of_frame);
  StartNewMapIfLost(report);
  return report;
}

void System::StartNewMapIfLost(const FrameReport& report) {
  if (report.state != TrackingState::kLost || !last_tracked_s_) {
    last_tracked_s_ = report.timestamp_s;
    return;
  }
  const double lost_s = report.timestamp_s - *last_tracked_s_;
  const bool is_young = map().Read()->num_keyframes() <= options_.young_map_keyframes;
  if (!is_young || is_localizing_ || lost_s < options_.max_lost_s) return;
  spdlog::warn("lost for {:.1f} s in a young map: starting map {}", lost_s, sessions_.size() + 1);
  sessions_.back()->Stop();
  StartSession(MapData(sensor_.pyramid));
}

void System::Shutdown() {
  masks_->Stop();
  sessions_.back()->Stop();
}

void System::AdjustMaps(std::stop_token stop) {
  for (const auto& session : sessions_) session->AdjustWholeMap(stop);
}

void System::Reset() {
  sessions_.clear();
  num_frames_ = 0;
  StartMasks();
  StartSession(MapData(sensor_.pyramid));
}

void System::ActivateLocalizationMode() {
  is_localizing_ = true;
  sessions_.back()->SetLocalizationMode(true);
}

void System::DeactivateLocalizationMode() {
  is_localizing_ = false;
  sessions_.back()->SetLocalizationMode(false);
}

std::vector<const MapSession*> System::SessionsLargestFirst() const {
  std::vector<const MapSession*> sorted;
  for (const auto& session : sessions_) sorted.push_back(session.get());
  std::ranges::stable_sort(sorted, std::ranges::greater{},
                           [](const MapSession* session) { return session->trajectory().num_poses(); });
  // A map in which nothing was tracked has no trajectory, unless it is the only one.
  std::erase_if(sorted, [&](const MapSession* session) {
    return session != sorted.front() && session->trajectory().num_poses() == 0;
  });
  return sorted;
}

template <class PosesOf>
Status System::SaveAll(const std::string& path, PosesOf poses_of) const {
  int number = 0;
  for (const MapSession* session : SessionsLargestFirst()) {
    const Status status = WriteTrajectory(Numbered(path, ++number), poses_of(*session));
    if (!status) return status;
  }
  return OkStatus();
}

Status System::SaveTrajectory(const std::string& path) const {
  return SaveAll(path, [](const MapSession& s) { return s.trajectory().Camera(s.map()); });
}

Status System::SaveKeyFrameTrajectory(const std::string& path) const {
  return SaveAll(path, [](const MapSession& s) { return s.trajectory().KeyFrames(s.map()); });
}

Status System::SaveMap(const std::string& path) const {
  sessions_.back()->WaitUntilIdle();
  return WriteMap(path, *map().Read());
}

Status System::LoadMap(const std::string& path) {
  Result<MapData> loaded = ReadMap(path);
  if (!loaded) return loaded.error();
  if (loaded->pyramid() != sensor_.pyramid) {
    return Error{
        path +
        ": was made with another ORBextractor.nLevels or ORBextractor.scaleFactor; use those settings"};
  }
  sessions_.clear();
  StartSession(*std::move(loaded));
  return OkStatus();
}

System::Counts System::counts() const {
  Counts counts{.frames = static_cast<int>(num_frames_), .maps = static_cast<int>(sessions_.size())};
  for (const auto& session : sessions_) {
    counts.tracked += session->trajectory().num_poses();
    counts.loops += session->num_loops();
  }
  const auto guard = map().Read();
  counts.keyframes = guard->num_keyframes();
  counts.map_points = guard->num_points();
  return counts;
}

std::map<std::string, StageTimer::Statistics> System::Timings() const {
  auto timings = sessions_.back()->Timings();
  timings.merge(masks_->Timings());
  return timings;
}

std::optional<Error> System::failure() const {
  if (auto failure = masks_->failure()) return failure;
  return sessions_.back()->failure();
}

}  // namespace orbslam
