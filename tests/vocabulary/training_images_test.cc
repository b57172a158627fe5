// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/training_images.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

cv::Mat Boxes(int width, int height, uint64_t seed) {
  Rng rng(seed);
  cv::Mat image(height, width, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < width * height / 1000; ++i) {
    const cv::Rect box(static_cast<int>(rng.Below(static_cast<uint32_t>(width))),
                       static_cast<int>(rng.Below(static_cast<uint32_t>(height))), 20, 15);
    cv::rectangle(image, box, cv::Scalar(rng.Below(256)), cv::FILLED);
  }
  return image;
}

TEST(TrainingImagesTest, TilesHaveTheirSizeAtEveryScale) {
  const std::vector<cv::Mat> tiles = CutTiles(Boxes(1920, 960, 1), {});
  ASSERT_EQ(tiles.size(), 3U * 2 + 2 + 1);  // 1920 x 960, 1280 x 640 (one row of two), 960 x 480
  for (const cv::Mat& tile : tiles) EXPECT_EQ(tile.size(), cv::Size(640, 480));
}

TEST(TrainingImagesTest, SmallPicturesAreOneTileOrNone) {
  ASSERT_EQ(CutTiles(Boxes(500, 800, 2), {}).size(), 1U);
  EXPECT_EQ(CutTiles(Boxes(500, 800, 2), {}).front().size(), cv::Size(500, 800));
  EXPECT_EQ(CutTiles(Boxes(640, 480, 2), {}).size(), 1U);
  EXPECT_TRUE(CutTiles(Boxes(500, 100, 2), {}).empty());
}

TEST(TrainingImagesTest, KeepsTheOrderOfTheFilesAndSaysWhatItLeftOut) {
  const auto read = [](const std::string& file) -> Result<cv::Mat> {
    if (file == "broken") return Error{"broken: unreadable"};
    if (file == "blank") return cv::Mat(480, 640, CV_8UC1, cv::Scalar(90));
    return Boxes(640, 480, file.size());
  };
  const std::vector<std::string> files{"a", "broken", "bc", "blank", "def"};
  TrainingImageOptions options;
  options.min_features = 50;
  size_t last_done = 0;
  const auto count = [&](size_t done) { EXPECT_EQ(done, ++last_done); };
  const TrainingImages alone = DescribeTrainingImages(files, read, options, count);
  EXPECT_EQ(last_done, files.size());
  EXPECT_EQ(alone.descriptors.size(), 3U);
  EXPECT_THAT(alone.unreadable, testing::ElementsAre("broken: unreadable"));
  options.num_threads = 3;
  EXPECT_EQ(DescribeTrainingImages(files, read, options, {}).descriptors, alone.descriptors);
}

}  // namespace
}  // namespace orbslam
