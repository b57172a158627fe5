// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "orbslam/util/resource_usage.h"
#include "version.h"

namespace orbslam {
namespace {

using Json = nlohmann::ordered_json;

Json TimingsJson(const System& system) {
  Json json = Json::object();
  for (const auto& [name, s] : system.Timings()) {
    json[name] = {{"count", s.count}, {"mean_s", s.mean_s}, {"median_s", s.median_s},
                  {"p90_s", s.p90_s}, {"p99_s", s.p99_s},   {"max_s", s.max_s}};
  }
  return json;
}

/// In world coordinates if the frame's pose is known, else null there.
Json ObjectsJson(const FrameReport& frame) {
  Json json = Json::array();
  const auto vector_json = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  for (const DynamicObject& object : frame.moving.objects) {
    Json entry = {{"id", object.id}, {"centroid_world_m", nullptr}, {"velocity_world_mps", nullptr}};
    if (frame.world_from_camera) {
      entry["centroid_world_m"] = vector_json(*frame.world_from_camera * object.centroid_m);
      entry["velocity_world_mps"] = vector_json(frame.world_from_camera->rotation * object.velocity_mps);
    }
    entry["line_integral_ratio"] = object.line_integral_ratio;
    entry["log_odds"] = object.log_odds;
    entry["num_pixels"] = object.num_pixels;
    json.push_back(entry);
  }
  return json;
}

/// One array a column, one entry a processed frame.
Json FramesJson(const std::vector<FrameReport>& frames) {
  Json json;
  for (const char* column :
       {"timestamp_s", "state", "keypoints", "matches", "tracking_s", "tracking_cpu_s", "masked_share",
        "keypoints_dropped", "detector_latency_s", "fail_open", "objects"}) {
    json[column] = Json::array();
  }
  for (const FrameReport& frame : frames) {
    json["timestamp_s"].push_back(frame.timestamp_s);
    json["state"].push_back(Name(frame.state));
    json["keypoints"].push_back(frame.num_keypoints);
    json["matches"].push_back(frame.num_matches);
    json["tracking_s"].push_back(frame.tracking_s);
    json["tracking_cpu_s"].push_back(frame.tracking_cpu_s);
    json["masked_share"].push_back(frame.masked_share);
    json["keypoints_dropped"].push_back(frame.num_dropped_keypoints);
    json["detector_latency_s"].push_back(frame.moving.latency_s);
    json["fail_open"].push_back(frame.moving.fail_open_reason);
    json["objects"].push_back(ObjectsJson(frame));
  }
  return json;
}

/// `text` is a JSON object that ends in "\n}"; the long columns join it a line each.
std::string WithFrames(std::string text, const std::vector<FrameReport>& frames) {
  text.resize(text.size() - 2);
  text += ",\n  \"per_frame\": {";
  const char* separator = "\n";
  const Json columns = FramesJson(frames);
  for (const auto& [column, values] : columns.items()) {
    text += fmt::format("{}    \"{}\": {}", std::exchange(separator, ",\n"), column, values.dump());
  }
  return text + "\n  }\n}\n";
}

}  // namespace

std::string FormatRunReport(const std::vector<std::string>& command_line, const Settings& settings,
                            const std::vector<std::string>& warnings, const RunSummary& summary,
                            const System& system) {
  const System::Counts counts = system.counts();
  Json json;
  json["version"] = kVersion;
  json["command_line"] = command_line;
  json["settings"] = Json::object();
  for (const auto& [key, value] : EffectiveSettings(settings)) {
    std::visit([&](const auto& v) { json["settings"][key] = v; }, value);
  }
  json["warnings"] = warnings;
  json["interrupted"] = summary.was_interrupted;
  json["frames"] = {{"listed", summary.frames_listed},
                    {"skipped", summary.frames_skipped},
                    {"processed", summary.frames_processed},
                    {"tracked", counts.tracked},
                    {"lost", summary.frames_lost}};
  json["coverage"] =
      summary.frames_listed > 0 ? static_cast<double>(counts.tracked) / summary.frames_listed : 0.0;
  json["maps"] = counts.maps;
  json["map"] = {
      {"keyframes", counts.keyframes}, {"points", counts.map_points}, {"loops_closed", counts.loops}};
  json["timings"] = TimingsJson(system);
  json["startup_s"] = summary.startup_s;
  json["wall_s"] = summary.wall_s;
  json["cpu_s"] = ProcessCpuSeconds();
  json["peak_memory_mb"] = PeakMemoryMb();
  // A path or a line of a list need not be UTF-8, which JSON is.
  return WithFrames(json.dump(2, ' ', false, Json::error_handler_t::replace), summary.frames);
}

std::string FormatTrackingTimes(const std::vector<FrameReport>& frames) {
  if (frames.empty()) return "no frame was tracked\n";
  std::vector<double> tracking_s;
  std::ranges::transform(frames, std::back_inserter(tracking_s), &FrameReport::tracking_s);
  std::ranges::sort(tracking_s);
  const double mean_s =
      std::accumulate(tracking_s.begin(), tracking_s.end(), 0.0) / static_cast<double>(tracking_s.size());
  return fmt::format("median tracking time: {:.6f}\nmean tracking time: {:.6f}\n",
                     tracking_s[tracking_s.size() / 2], mean_s);
}

}  // namespace orbslam
