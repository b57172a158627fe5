// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "orbslam/vocabulary/trainer.h"
#include "support/synthetic_view.h"

namespace orbslam::test {

/// A vocabulary that tells these landmarks apart.
inline std::shared_ptr<const Vocabulary> TrainOn(const std::vector<Landmark>& landmarks) {
  std::vector<std::vector<Descriptor>> images;
  for (const Landmark& landmark : landmarks) images.push_back({landmark.descriptor});
  return std::make_shared<const Vocabulary>(TrainVocabulary(images, TrainerOptions()).value());
}

}  // namespace orbslam::test
