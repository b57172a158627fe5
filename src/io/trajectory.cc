// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/trajectory.h"

#include <array>
#include <cmath>

#include "orbslam/util/file.h"
#include "orbslam/util/text.h"

namespace orbslam {
namespace {

constexpr int kDecimals = 9;
constexpr double kMaxNormError = 0.01;

std::string FormatPose(const StampedPose& pose) {
  const Eigen::Vector3d& t = pose.world_from_camera.translation;
  Eigen::Quaterniond q = pose.world_from_camera.rotation;
  if (std::signbit(q.w())) q.coeffs() = -q.coeffs();
  std::string line = pose.timestamp_text;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    line += ' ' + FormatFixed(value, kDecimals);
  }
  return line + '\n';
}

bool IsFinite(const Rigid3d& pose) {
  return pose.translation.allFinite() && pose.rotation.coeffs().allFinite();
}

Result<StampedPose> ParsePose(const std::vector<std::string_view>& fields) {
  std::array<double, 8> values{};
  if (fields.size() != values.size()) {
    return Error{"expected 8 fields (timestamp tx ty tz qx qy qz qw), found " +
                 std::to_string(fields.size())};
  }
  for (size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = ParseDouble(fields[i]);
    if (!value) return Error{"expected a finite number, found '" + std::string(fields[i]) + "'"};
    values[i] = *value;
  }
  const Eigen::Quaterniond rotation(values[7], values[4], values[5], values[6]);
  if (std::abs(rotation.norm() - 1.0) > kMaxNormError) {
    return Error{"expected a unit quaternion, found one of length " + FormatDouble(rotation.norm())};
  }
  return StampedPose{std::string(fields[0]), {rotation.normalized(), {values[1], values[2], values[3]}}};
}

}  // namespace

Status WriteTrajectory(const std::string& path, std::span<const StampedPose> trajectory) {
  std::string content;
  for (const StampedPose& pose : trajectory) {
    if (!IsFinite(pose.world_from_camera)) {
      return Error{path + ": not written: the pose at time " + pose.timestamp_text + " is not finite"};
    }
    content += FormatPose(pose);
  }
  return WriteFileAtomically(path, content);
}

Result<std::vector<StampedPose>> ReadTrajectory(const std::string& path) {
  const Result<std::string> content = ReadFile(path);
  if (!content) return content.error();
  std::vector<StampedPose> trajectory;
  for (const TextLine& line : SplitLines(*content)) {
    const std::vector<std::string_view> fields = SplitFields(line.text);
    if (fields.empty() || fields[0].starts_with('#')) continue;
    const Result<StampedPose> pose = ParsePose(fields);
    if (!pose) return Error{path + ":" + std::to_string(line.number) + ": " + pose.error().message};
    trajectory.push_back(*pose);
  }
  return trajectory;
}

}  // namespace orbslam
