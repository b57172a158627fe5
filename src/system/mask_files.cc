// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/mask_files.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <unordered_map>

#include "orbslam/io/image_file.h"

namespace orbslam {
namespace {

namespace fs = std::filesystem;

std::string MaskPath(const std::string& folder, const RgbdEntry& entry) {
  return (fs::path(folder) / fs::path(entry.rgb_path).stem()).string() + ".png";
}

Result<cv::Mat> ReadMask(const std::string& path, const cv::Size& size) {
  Result<cv::Mat> mask = ReadGray(path);
  if (!mask || mask->size() == size) return mask;
  return Error{
      fmt::format("{}: the mask is {} x {} px, but the settings (Camera.width, Camera.height) say {} x {} px",
                  path, mask->cols, mask->rows, size.width, size.height)};
}

/// Warns of the first few.
class Warner {
 public:
  void Warn(const std::string& message) {
    constexpr int kMaxWarnings = 5;
    if (++count_ <= kMaxWarnings) spdlog::warn("no mask for a frame: {}", message);
    if (count_ == kMaxWarnings) spdlog::warn("further missing masks are not warned of");
  }

 private:
  int count_ = 0;
};

}  // namespace

Result<UserMask> MasksFromFolder(const std::string& folder, const TumSequence& sequence,
                                 const PinholeCamera& camera) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return Error{folder + ": not a folder; one with masks is expected"};
  auto paths = std::make_shared<std::unordered_map<std::string, std::string>>();  // by time stamp
  for (const RgbdEntry& entry : sequence.entries)
    paths->emplace(entry.timestamp_text, MaskPath(folder, entry));
  const auto exists = [&](const auto& item) { return fs::exists(item.second, error); };
  if (std::ranges::none_of(*paths, exists)) {
    return Error{folder + ": has no mask for any image of the sequence; expected is " +
                 MaskPath(folder, sequence.entries.front()) + " and so on"};
  }
  const cv::Size size(camera.width, camera.height);
  return UserMask([paths, size, warner = std::make_shared<Warner>()](const RgbdImage& image) {
    const Result<cv::Mat> mask = ReadMask(paths->at(image.timestamp_text), size);
    if (mask) return *mask;
    warner->Warn(mask.error().message);
    return cv::Mat();
  });
}

Result<MaskWriter> MaskWriter::Open(const std::string& folder, const PinholeCamera& camera) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) return Error{fmt::format("{}: cannot make the folder for masks: {}", folder, error.message())};
  return MaskWriter(folder, cv::Size(camera.width, camera.height));
}

void MaskWriter::Write(const RgbdEntry& entry, const cv::Mat& mask) {
  if (folder_.empty() || !status_) return;
  const cv::Mat image = mask.empty() ? cv::Mat::zeros(size_, CV_8UC1) : cv::Mat(mask != 0);
  constexpr int kFastest = 1;
  status_ = WritePng(MaskPath(folder_, entry), image, kFastest);
}

}  // namespace orbslam
