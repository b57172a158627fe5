// SPDX-License-Identifier: GPL-3.0-or-later
#include "sequence_writer.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "orbslam/camera/depth_model.h"
#include "orbslam/io/image_file.h"
#include "orbslam/io/trajectory.h"
#include "orbslam/util/file.h"
#include "orbslam/util/text.h"

namespace orbslam {
namespace {

constexpr int kCompression = 1;  // zlib's: more takes longer than all the rest

std::string CameraYaml(const PinholeCamera& camera) {
  const DepthModel depth;
  const double baseline_m = 40.0 / 535.4;  // of the virtual right camera; a Kinect's, as TUM3.yaml has it
  std::string text = "%YAML:1.0\n---\n";
  const auto add = [&](const std::string& key, double value) {
    text += key + ": " + FormatDouble(value) + '\n';
  };
  add("Camera.fx", camera.fx);
  add("Camera.fy", camera.fy);
  add("Camera.cx", camera.cx);
  add("Camera.cy", camera.cy);
  for (const char* key : {"Camera.k1", "Camera.k2", "Camera.p1", "Camera.p2", "Camera.k3"}) add(key, 0);
  add("Camera.width", camera.width);
  add("Camera.height", camera.height);
  add("Camera.fps", SyntheticSequence::kFramesPerSecond);
  add("Camera.bf", baseline_m * camera.fx);
  add("Camera.RGB", 1);
  add("ThDepth", depth.close_limit_baselines);
  add("DepthMapFactor", depth.units_per_metre);
  add("ORBextractor.nFeatures", 1000);
  add("ORBextractor.scaleFactor", 1.2);
  add("ORBextractor.nLevels", 8);
  add("ORBextractor.iniThFAST", 20);
  add("ORBextractor.minThFAST", 7);
  return text;
}

double ShareOf(const cv::Mat& mask) { return cv::countNonZero(mask) / static_cast<double>(mask.total()); }

std::string ImageLine(const std::string& folder, const std::string& time) {
  return time + ' ' + folder + '/' + time + ".png";
}

}  // namespace

Status SequenceWriter::MakeFolders() const {
  for (const char* part : {"/rgb", "/depth", "/mask", "/mask_moving"}) {
    std::error_code error;
    std::filesystem::create_directories(folder_ + part, error);
    if (error) return Error{folder_ + part + ": cannot make this folder: " + error.message()};
  }
  return OkStatus();
}

Status SequenceWriter::WriteFrame(int index, const SyntheticFrame& frame) {
  Line& line = lines_.at(index);
  line = {FormatFixed(frame.timestamp_s, 6), FormatFixed(frame.depth_timestamp_s, 6), frame.world_from_camera,
          ShareOf(frame.mask), ShareOf(frame.mask_moving)};
  cv::Mat raw_depth;
  frame.depth_m.convertTo(raw_depth, CV_16U, DepthModel().units_per_metre);
  const std::string color_name = line.color_time + ".png", depth_name = line.depth_time + ".png";
  const std::pair<std::string, const cv::Mat*> files[] = {{"/rgb/" + color_name, &frame.bgr},
                                                          {"/depth/" + depth_name, &raw_depth},
                                                          {"/mask/" + color_name, &frame.mask},
                                                          {"/mask_moving/" + color_name, &frame.mask_moving}};
  for (const auto& [name, image] : files) {
    if (const Status status = WritePng(folder_ + name, *image, kCompression); !status) return status;
  }
  return OkStatus();
}

std::string SequenceWriter::SequenceJson(const SyntheticSequenceOptions& options, int num_figures) const {
  nlohmann::ordered_json json;
  json["seed"] = options.seed;
  json["motion"] = MotionName(options.motion);
  json["script"] = ScriptName(options.script);
  json["frames"] = lines_.size();
  json["figures"] = num_figures;
  auto& movable = json["share_movable"] = nlohmann::ordered_json::array();
  auto& moving = json["share_moving"] = nlohmann::ordered_json::array();
  for (const Line& line : lines_) {
    movable.push_back(std::round(line.share_movable * 1e6) / 1e6);
    moving.push_back(std::round(line.share_moving * 1e6) / 1e6);
  }
  return json.dump(1) + '\n';
}

Status SequenceWriter::WriteLists(const SyntheticSequenceOptions& options, int num_figures) const {
  std::string colors = "# color images\n# timestamp filename\n",
              depths = "# depth maps\n# timestamp filename\n";
  std::string associations;
  std::vector<StampedPose> ground_truth;
  for (const Line& line : lines_) {
    const std::string color = ImageLine("rgb", line.color_time), depth = ImageLine("depth", line.depth_time);
    colors += color + '\n';
    depths += depth + '\n';
    associations += color + ' ' + depth + '\n';
    ground_truth.push_back({line.color_time, line.world_from_camera});
  }
  const std::pair<const char*, std::string> files[] = {
      {"/rgb.txt", colors},
      {"/depth.txt", depths},
      {"/associations.txt", associations},
      {"/camera.yaml", CameraYaml(options.camera)},
      {"/sequence.json", SequenceJson(options, num_figures)}};
  for (const auto& [name, text] : files) {
    if (const Status status = WriteFileAtomically(folder_ + name, text); !status) return status;
  }
  return WriteTrajectory(folder_ + "/groundtruth.txt", ground_truth);
}

}  // namespace orbslam
