// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/mask_supplier.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "orbslam/pipeline/mask_warp.h"
#include "orbslam/util/check.h"
#include "orbslam/util/resource_usage.h"

namespace orbslam {
namespace {

constexpr size_t kMaxWaitingFrames = 1;
constexpr double kPatienceFrames = 0.6;  // the rest of a frame's time is for its pose
constexpr std::chrono::hours kForever(24);

cv::Mat United(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty()) return b;
  return b.empty() ? a : cv::Mat(a | b);
}

/// Corners on somebody's silhouette move with him, and so does half of what describes a corner beside it. The
/// detector's own masks reach that far already.
cv::Mat Widened(const cv::Mat& mask, int margin_px) {
  if (mask.empty() || margin_px == 0) return mask;
  const int side = 2 * margin_px + 1;
  cv::Mat widened;
  cv::dilate(mask, widened, cv::Mat::ones(side, side, CV_8U));
  return widened;
}

}  // namespace

MaskSupplier::MaskSupplier(const Settings& settings, bool use_detector, RunMode mode, UserMask user_mask)
    : camera_(settings.camera),
      mode_(mode),
      patience_s_(kPatienceFrames / settings.fps),
      user_mask_(std::move(user_mask)),
      user_mask_margin_px_(settings.user_mask_margin_px),
      stage_(
          "detector", kMaxWaitingFrames, [this](const Job& job) { Detect(job); }, mode.OfStages()) {
  if (!use_detector || !settings.detects_motion) return;
  detector_.emplace(settings.camera, settings.depth, settings.detector);
  stage_.Start();
}

MaskSupplier::~MaskSupplier() { Stop(); }

void MaskSupplier::Stop() { stage_.CloseAndJoin(); }

void MaskSupplier::Begin(std::shared_ptr<const RgbdImage> image) {
  now_ = {std::move(image), Clock::now()};
  if (!detector_) return;
  Job job = now_;
  if (mode_.is_live) {
    stage_.TryPush(job);
  } else {
    stage_.Push(std::move(job));
  }
}

void MaskSupplier::Detect(const Job& job) {
  try {
    const CpuStopwatch stopwatch;
    Masked result{job.image, detector_->Process(*job.image)};
    timer_.Add("detect", stopwatch.WallSeconds());
    timer_.Add("detect_cpu", stopwatch.CpuSeconds());
    result.mask.latency_s = std::chrono::duration<double>(Clock::now() - job.begun).count();
    mailbox_.Put(std::move(result));
  } catch (...) {
    mailbox_.Close();  // so that nobody waits for what will not come
    throw;
  }
}

DynamicMask MaskSupplier::Take(const Rigid3d& now_from_last) {
  DynamicMask result = detector_ ? TakeDetected(now_from_last) : DynamicMask();
  result.frame_id = now_.image->id;
  if (!user_mask_) return result;
  const cv::Mat users = user_mask_(*now_.image);
  ORBSLAM_CHECK(users.empty() || (users.type() == CV_8UC1 && users.size() == now_.image->gray.size()));
  result.mask = United(result.mask, Widened(users, user_mask_margin_px_));
  return result;
}

DynamicMask MaskSupplier::TakeDetected(const Rigid3d& now_from_last) {
  const auto patience =
      mode_.is_live && !mode_.is_sequential
          ? std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s_))
          : Clock::duration(kForever);
  while (std::optional<Masked> masked = mailbox_.TakeUntil(now_.begun + patience)) {
    last_ = *std::move(masked);
    if (last_.image == now_.image) return last_.mask;
  }
  return WarpLast(now_from_last);
}

DynamicMask MaskSupplier::WarpLast(const Rigid3d& now_from_last) const {
  DynamicMask result;
  result.fail_open_reason = mailbox_.IsClosed() ? "the detector has failed" : "the mask is late";
  result.latency_s = std::chrono::duration<double>(Clock::now() - now_.begun).count();
  if (!last_.image || mailbox_.IsClosed()) return result;
  Rigid3d now_from_masked;  // the predicted motion is that of one frame
  for (uint32_t i = last_.image->id.value; i < now_.image->id.value; ++i)
    now_from_masked = now_from_masked * now_from_last;
  result.objects = last_.mask.objects;
  result.mask = WarpMask(last_.mask, *last_.image, now_from_masked,
                         now_.image->timestamp_s - last_.image->timestamp_s, camera_);
  return result;
}

}  // namespace orbslam
