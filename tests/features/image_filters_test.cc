// SPDX-License-Identifier: GPL-3.0-or-later
// Our filters against OpenCV's, bit for bit.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "shrink.h"
#include "smooth.h"
#include "test_images.h"

namespace orbslam {
namespace {

int CountDifferent(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() ? cv::countNonZero(a != b) : -1;
}

TEST(Shrinker, EqualsOpenCvsExactResize) {
  const cv::Size sizes[] = {{640, 480}, {533, 400}, {39, 41}, {17, 9}, {5, 5}};
  Shrinker shrinker;
  for (const cv::Size size : sizes) {
    for (const double factor : {1.0, 1.1, 1.2, 1.5, 1.9, 2.0, 2.7}) {
      const cv::Mat image = NoiseImage(size, 1);
      const cv::Size smaller(cvRound(size.width / factor), cvRound(size.height / factor));
      cv::Mat ours, theirs;
      shrinker.Shrink(image, smaller, &ours);
      cv::resize(image, theirs, smaller, 0, 0, cv::INTER_LINEAR_EXACT);
      EXPECT_EQ(CountDifferent(ours, theirs), 0) << size << " by " << factor;
    }
  }
}

TEST(Smoother, EqualsOpenCvsFilterOnAPartOfAnImage) {
  Smoother smoother;
  for (const cv::Size size :
       {cv::Size(640, 480), cv::Size(179, 134), cv::Size(39, 39), cv::Size(16, 4), cv::Size(7, 50)}) {
    for (const cv::Mat& image : {NoiseImage(size, 2), ShapesImage(size, 2)}) {
      cv::Mat padded, ours, theirs;
      cv::copyMakeBorder(image, padded, 10, 10, 10, 10, cv::BORDER_REFLECT_101);
      cv::GaussianBlur(padded(cv::Rect(10, 10, size.width, size.height)), theirs, {7, 7}, 2, 2,
                       cv::BORDER_REFLECT_101);
      smoother.Smooth(image, &ours);
      EXPECT_EQ(CountDifferent(ours, theirs), 0) << size;
    }
  }
}

TEST(Smoother, KeepsPlainImagesPlain) {
  for (const int grey : {0, 1, 77, 255}) {
    const cv::Mat plain(60, 50, CV_8UC1, cv::Scalar(grey));
    cv::Mat smooth;
    Smoother().Smooth(plain, &smooth);
    EXPECT_EQ(CountDifferent(plain, smooth), 0);
  }
}

}  // namespace
}  // namespace orbslam
