// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <thread>

#include "map/random_map.h"
#include "orbslam/map/map.h"

namespace orbslam::test {
namespace {

bool IsBroken(const MapData& map, int least_epoch) {
  return !FindBrokenInvariants(map).empty() || map.epoch() < static_cast<uint64_t>(least_epoch);
}

TEST(MapThreads, ReadersSeeASoundMapWhileAWriterEditsIt) {
  Map map(MapData(ScalePyramid(8, 1.2)));
  constexpr int kNumEdits = 1000;
  std::atomic<int> num_edits = 0, num_looks = 0, num_broken = 0;
  const auto read = [&] {
    // One look after news each, since readers that never pause would keep the writer out.
    for (int seen = 0; seen < kNumEdits;) {
      num_edits.wait(seen);
      seen = num_edits;
      num_broken += IsBroken(*map.Read(), seen);
      ++num_looks;
      num_looks.notify_all();
    }
  };
  const auto write = [&] {
    Rng rng(16);
    for (int i = 0; i < kNumEdits; ++i) {
      const int looks_before = num_looks;
      {
        const auto guard = map.Write();
        RandomMap(&*guard, &rng).EditOnce();
        guard->BumpEpoch();
      }
      ++num_edits;
      num_edits.notify_all();
      num_looks.wait(looks_before);  // one reader has looked; the others may still be at it
    }
  };
  {
    std::jthread writer(write);
    const std::jthread readers[] = {std::jthread(read), std::jthread(read), std::jthread(read)};
  }
  EXPECT_EQ(num_broken, 0);
  EXPECT_GE(num_looks, kNumEdits);
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
