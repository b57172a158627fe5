// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/figure.h"

#include <array>
#include <utility>

#include "figure_body.h"
#include "figure_mesh.h"

namespace orbslam {
namespace {

constexpr uint64_t kBodyPurpose = 0x626F6479, kWardrobePurpose = 0x77617264;

double DrawHeight(uint64_t seed, int outfit) {
  Rng rng(seed, static_cast<uint64_t>(outfit), kBodyPurpose);
  return rng.Uniform(1.62, 1.88);
}

struct Wardrobe {
  Cloth shirt, trousers;
};

/// The seed shuffles the shirts; each outfit takes the next.
Wardrobe Choose(uint64_t seed, int outfit) {
  std::array<Cloth, 4> shirts = {Cloth::kChecks, Cloth::kPrint, Cloth::kStripes, Cloth::kKnit};
  Rng rng(seed, 0, kWardrobePurpose);
  for (uint32_t i = 3; i > 0; --i) std::swap(shirts[i], shirts[rng.Below(i + 1)]);
  const Cloth shirt = shirts[static_cast<size_t>(outfit) % shirts.size()];
  if (outfit % 2 == 0) return {shirt, Cloth::kJeans};
  return {shirt, shirt == Cloth::kPrint ? Cloth::kChecks : Cloth::kPrint};
}

struct Complexion {
  cv::Scalar skin_bgr, hair_bgr;
};

Complexion DrawComplexion(Rng* rng) {
  static const std::array<cv::Scalar, 3> kSkins = {cv::Scalar(150, 176, 222), cv::Scalar(120, 150, 200),
                                                   cv::Scalar(75, 102, 150)};
  static const std::array<cv::Scalar, 3> kHairs = {cv::Scalar(22, 24, 28), cv::Scalar(26, 36, 50),
                                                   cv::Scalar(16, 16, 18)};
  return {kSkins[rng->Below(3)], kHairs[rng->Below(3)]};
}

}  // namespace

Figure::Figure(uint64_t seed, int outfit, std::optional<double> height_m)
    : size_(height_m.value_or(DrawHeight(seed, outfit))) {
  const Wardrobe wardrobe = Choose(seed, outfit);
  Rng rng(seed, static_cast<uint64_t>(outfit), kWardrobePurpose + 1);
  const Complexion complexion = DrawComplexion(&rng);
  const BodyMeshes meshes(size_);
  Rng shirt_rng = rng;  // sleeves are cut from the shirt's cloth
  const auto tile = [](Cloth cloth, Rng* dice) {
    return std::make_shared<const cv::Mat>(PaintCloth(cloth, dice));
  };
  const Material cloth{tile(wardrobe.shirt, &shirt_rng), {1, 1, 1}};
  const Material shirt{PaintShirt(wardrobe.shirt, meshes.ShirtAroundM(), meshes.ShirtHeightM(), &rng)};
  const Material trousers{tile(wardrobe.trousers, &rng), {1, 1, 1}};
  const Material face{
      PaintFace(BodyMeshes::Rows(), complexion.skin_bgr, complexion.hair_bgr, &rng), {1, 1, 1}, 0.1f};
  const Material skin{PaintSkin(complexion.skin_bgr, &rng), {1, 1, 1}, 0.1f};
  // Black hair gives nothing back to a structured-light camera.
  const Material hair{PaintHair(complexion.hair_bgr, &rng), {1, 1, 1}, 0.2f, 0, 0.06f};
  const double grey = rng.Uniform(35, 190);
  const Material shoes{PaintSkin({grey, grey, grey}, &rng), {1, 1, 1}, 0.2f, 0, 0.5f};

  const auto wear = [this](int part, Mesh mesh, const Material& material) {
    garments_.push_back(
        {static_cast<BodyPart>(part), std::make_shared<const Mesh>(std::move(mesh)), material});
  };
  const auto wear_pair = [&](int left_part, Mesh mesh, const Material& material) {
    wear(left_part, mesh, material);
    MirrorY(&mesh);
    wear(left_part + 1, std::move(mesh), material);
  };
  wear(kPelvis, meshes.Hips(), trousers);
  wear(kTorso, meshes.Shirt(), shirt);
  wear(kHead, meshes.Neck(), skin);
  wear(kHead, meshes.Face(), face);
  wear(kHead, meshes.Ears(), skin);
  wear(kHead, meshes.Hair(), hair);
  wear_pair(kUpperArmLeft, meshes.UpperArm(), cloth);
  wear_pair(kForearmLeft, meshes.Forearm(), cloth);
  wear_pair(kHandLeft, meshes.Hand(), skin);
  wear_pair(kThighLeft, meshes.Thigh(), trousers);
  wear_pair(kShinLeft, meshes.Shin(), trousers);
  wear_pair(kFootLeft, meshes.Shoe(), shoes);
  wear_pair(kToesLeft, meshes.ShoeTip(), shoes);
}

std::vector<SceneObject> Figure::ObjectsAt(const BodyPose& pose, uint8_t label) const {
  std::vector<SceneObject> objects;
  objects.reserve(garments_.size());
  for (const Garment& garment : garments_) {
    objects.push_back({garment.mesh, garment.material, pose[garment.part], label, false});
  }
  return objects;
}

}  // namespace orbslam
