// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <thread>

#include "map/random_map.h"
#include "orbslam/map/map.h"

namespace orbslam::test {
namespace {

TEST(MapThreads, ReadersSeeASoundMapWhileAWriterEditsIt) {
  Map map(MapData(ScalePyramid(8, 1.2)));
  std::atomic<bool> is_done = false;
  std::atomic<int> num_looks = 0, num_broken = 0;
  const auto read = [&] {
    uint64_t last_epoch = 0;
    while (!is_done) {
      const auto guard = map.Read();
      num_broken += !FindBrokenInvariants(*guard).empty() || guard->epoch() < last_epoch;
      last_epoch = guard->epoch();
      ++num_looks;
    }
  };
  const auto write = [&] {
    Rng rng(16);
    for (int i = 0; i < 1500 || num_looks < 10; ++i) {
      const auto guard = map.Write();
      RandomMap(&*guard, &rng).EditOnce();
      guard->BumpEpoch();
    }
    is_done = true;
  };
  {
    std::jthread writer(write);
    const std::jthread readers[] = {std::jthread(read), std::jthread(read), std::jthread(read)};
  }
  EXPECT_EQ(num_broken, 0);
  EXPECT_GE(map.Read()->epoch(), 1500u);
}

TEST(MapThreads, PayloadOutlivesItsKeyFrame) {
  Map map(MapData(ScalePyramid(8, 1.2)));
  Rng rng(17);
  KeyFrameId root, child;
  {
    const auto guard = map.Write();
    RandomMap edits(&*guard, &rng);
    root = edits.AddKeyFrame();
    child = edits.AddKeyFrame();
  }
  const std::shared_ptr<const FrameFeatures> features = map.Read()->Find(child)->features;
  const Descriptor before = features->descriptors.back();
  std::jthread([&] { EXPECT_TRUE(map.Write()->EraseKeyFrame(child)); }).join();
  EXPECT_EQ(map.Read()->Find(child), nullptr);
  EXPECT_EQ(features->descriptors.back(), before);
}

}  // namespace
}  // namespace orbslam::test
