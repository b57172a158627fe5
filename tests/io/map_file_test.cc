// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/map_file.h"

#include <chrono>
#include <cstdio>

#include "map/random_map.h"
#include "map/same_map.h"
#include "map_codec.h"
#include "orbslam/util/file.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// As of an image of 640 x 480.
std::shared_ptr<const FrameFeatures> FeaturesOnImage(int count, Rng* rng) {
  FrameFeatures features = *RandomFeatures(count, rng);
  for (int i = 0; i < count; ++i) {
    features.pixels[i] = {static_cast<float>(rng->Uniform(0, 640)), static_cast<float>(rng->Uniform(0, 480))};
    features.angles_deg[i] = static_cast<float>(rng->Uniform(0, 360));
    features.depths_m[i] = static_cast<float>(rng->Uniform(1, 5));
    features.right_u[i] = features.pixels[i].x - 40 / features.depths_m[i];
  }
  features.grid = FeatureGrid(features.pixels, {-10, -8, 650, 488});
  return std::make_shared<const FrameFeatures>(std::move(features));
}

MapData EditedMap(uint64_t seed, int num_edits, int num_keypoints) {
  Rng rng(seed);
  MapData map(ScalePyramid(8, 1.2));
  RandomMap edits(&map, &rng);
  for (int i = 0; i < num_edits; ++i) edits.EditOnce();
  const KeyFrameId parent = edits.RandomKeyFrame();
  const KeyFrameId last =
      map.AddKeyFrame(FrameId(7), 8.5, RandomMotion(&rng), FeaturesOnImage(num_keypoints, &rng));
  for (int i = 0; i < num_keypoints; ++i) map.AddObservation(edits.RandomPoint(), last, i);
  map.ConnectToSpanningTree(last, parent);
  for (int i = 0; i < 20; ++i) map.RefreshMapPoint(edits.RandomPoint());
  map.BumpEpoch();
  return map;
}

class MapFileTest : public testing::Test {
 protected:
  std::string WrittenBytes(const MapData& map) {
    EXPECT_TRUE(WriteMap(dir_.Path("written"), map).ok());
    return ReadFile(dir_.Path("written")).value();
  }
  /// What reading a file with this content says; it must be one line that begins with the path.
  std::string Refusal(const std::string& content) {
    const std::string path = dir_.Write("refused", content);
    const Result<MapData> map = ReadMap(path);
    if (map) return "accepted";
    EXPECT_THAT(map.error().message, StartsWith(path + ": "));
    EXPECT_THAT(map.error().message, Not(HasSubstr("\n")));
    return map.error().message;
  }

  TempDir dir_;
};

TEST_F(MapFileTest, RoundTripKeepsEverything) {
  for (const uint64_t seed : {1, 2, 3}) {
    const MapData written = EditedMap(seed, 2000, 300);
    const std::string bytes = WrittenBytes(written);
    const Result<MapData> read = ReadMap(dir_.Path("written"));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_THAT(FindBrokenInvariants(*read), IsEmpty());
    ExpectSame(written, *read);
    EXPECT_EQ(WrittenBytes(*read), bytes);
  }
  EXPECT_EQ(dir_.NumFiles(), 1);
}

TEST_F(MapFileTest, NewIdsFollowTheOldOnes) {
  MapData map = EditedMap(4, 1000, 10);
  const MapPointId last = map.AddMapPoint({1, 2, 3}, map.last_keyframe_id());
  map.EraseMapPoint(last);
  WrittenBytes(map);
  MapData read = ReadMap(dir_.Path("written")).value();
  Rng rng(1);
  EXPECT_EQ(read.AddKeyFrame(FrameId(9), 9, {}, RandomFeatures(3, &rng)).value,
            map.last_keyframe_id().value + 1);
  EXPECT_EQ(read.AddMapPoint({1, 2, 3}, KeyFrameId(0)).value, last.value + 1);
}

TEST_F(MapFileTest, AnEmptyMapIsAMap) {
  const MapData empty(ScalePyramid(1, 1.5));
  WrittenBytes(empty);
  ExpectSame(empty, ReadMap(dir_.Path("written")).value());
}

TEST_F(MapFileTest, TruncationsAreRefused) {
  const std::string bytes = WrittenBytes(EditedMap(5, 20, 10));
  ASSERT_LT(bytes.size(), 20000u);
  for (size_t length = 0; length < bytes.size();
       length += length < 100 || length + 100 > bytes.size() ? 1 : 13) {
    EXPECT_THAT(Refusal(bytes.substr(0, length)), HasSubstr(length < 8 ? "not a map" : "truncated map"))
        << length;
  }
  EXPECT_THAT(Refusal(bytes + '\0'), HasSubstr("damaged map"));
}

TEST_F(MapFileTest, FlippedBitsAreRefused) {
  const std::string bytes = WrittenBytes(EditedMap(6, 20, 10));
  Rng rng(3);
  for (size_t at = 0; at < bytes.size(); at += at < sizeof(MapHeader) ? 1 : 11) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << rng.Below(8)));
    EXPECT_NE(Refusal(damaged), "accepted") << "byte " << at;
  }
}

/// Makes the size and the checksum right again.
std::string Sealed(std::string bytes) {
  MapHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  header.num_bytes = bytes.size();
  header.checksum = MapChecksum(header, std::string_view(bytes).substr(sizeof(header)));
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

TEST_F(MapFileTest, WhatIsMadeUpIsRefusedOrAProperMap) {
  const std::string bytes = WrittenBytes(EditedMap(7, 60, 10));
  ASSERT_EQ(Refusal(Sealed(bytes)), "accepted");
  Rng rng(8);
  int num_refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string forged = bytes;
    const uint32_t end = static_cast<uint32_t>(i % 2 == 0 ? 100 : bytes.size() - 4);  // counts, or anything
    const uint32_t at = rng.Below(end) / 4 * 4;
    const uint32_t values[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffe, rng.Below(100)};
    std::memcpy(forged.data() + at, &values[rng.Below(7)], 4);
    if (i % 5 == 0) forged.resize(sizeof(MapHeader) + rng.Below(static_cast<uint32_t>(bytes.size())));
    const Result<MapData> map = ReadMap(dir_.Write("forged", Sealed(forged)));
    num_refused += !map.ok();
    ASSERT_TRUE(!map.ok() || FindBrokenInvariants(*map).empty()) << "offset " << at;
  }
  EXPECT_GT(num_refused, 500);
}

TEST_F(MapFileTest, ForeignFilesAreRefused) {
  EXPECT_THAT(Refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(Refusal("\x89PNG\r\n\x1a\n and so on"), HasSubstr("not a map"));
  EXPECT_THAT(Refusal(std::string(5000, '\0')), HasSubstr("not a map"));
  std::string later = WrittenBytes(EditedMap(9, 20, 10));
  later[8] = 2;
  EXPECT_THAT(Refusal(Sealed(later)), HasSubstr("map of version 2; this program reads version 1"));
  EXPECT_THAT(ReadMap(dir_.Path("missing")).error().message, HasSubstr("missing: cannot open"));
  EXPECT_THAT(ReadMap(dir_.Path("")).error().message,
              HasSubstr(dir_.Path("") + ": cannot read: Is a directory"));
  EXPECT_THAT(WriteMap(dir_.Path("none/map"), EditedMap(9, 20, 10)).error().message, HasSubstr("none/map"));
}

TEST_F(MapFileTest, AMapOf200KeyFramesOpensQuickly) {
  Rng rng(10);
  MapData map(ScalePyramid(8, 1.2));
  for (uint32_t k = 0; k < 200; ++k) {
    const KeyFrameId id = map.AddKeyFrame(FrameId(k), k, RandomMotion(&rng), FeaturesOnImage(1000, &rng));
    for (int i = 0; i < 1000; ++i) {  // every point is seen by ten keyframes in turn
      const MapPointId point(k / 10 * 1000 + i);
      if (k % 10 == 0) map.AddMapPoint(RandomVector(&rng, 3), id);
      map.AddObservation(point, id, i);
    }
    if (k > 0) map.ConnectToSpanningTree(id, KeyFrameId(k - 1));
  }
  const auto start = std::chrono::steady_clock::now();
  const std::string bytes = WrittenBytes(map);
  const auto written = std::chrono::steady_clock::now();
  const Result<MapData> read = ReadMap(dir_.Path("written"));
  const std::chrono::duration<double, std::milli> reading = std::chrono::steady_clock::now() - written;
  const std::chrono::duration<double, std::milli> writing = written - start;
  ASSERT_TRUE(read.ok());
  std::printf("%.1f MB written in %.0f ms, read in %.0f ms\n", static_cast<double>(bytes.size()) / 1e6,
              writing.count(), reading.count());
  EXPECT_LT(reading.count(), 5000);  // ten times what it should be, for sanitizers and busy machines
  EXPECT_LT(bytes.size(), 16u << 20);
}

}  // namespace
}  // namespace orbslam::test
