// SPDX-License-Identifier: GPL-3.0-or-later
#include "icp.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "depth_noise.h"
#include "orbslam/geometry/so3.h"
#include "wide_vectors.h"

namespace orbslam {
namespace {

using Matrix6f = Eigen::Matrix<float, 6, 6>;
using Vector6f = Eigen::Matrix<float, 6, 1>;

struct Sums {
  // J^T W (J, residual, 0): the Hessian's rows and, in column 6, the gradient. Eight columns make a vector.
  static constexpr int kGradient = 6, kColumns = 8;
  float rows[6][kColumns] = {};
  int num_pairs = 0, num_fitting = 0;

  void Add(const float (&j)[kColumns], float weight) {
    for (int a = 0; a < 6; ++a) {
      const float wa = weight * j[a];
      for (int b = 0; b < kColumns; ++b) rows[a][b] += wa * j[b];
    }
  }
};

/// Adds the pairs of all source points with one target, at the given pose. The perturbation (rotation w,
/// translation v) acts in the source frame: x -> x + w x x + v.
void AddPairs(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
              const IcpTarget& target, const Rigid3d& target_from_source, const IcpOptions& options,
              int stride, Sums* sums) {
  const Eigen::Matrix3f r = target_from_source.RotationMatrix().cast<float>();
  const Eigen::Vector3f t = target_from_source.translation.cast<float>();
  const float *target_depth_m = target.frame->depth_m[0], *normal_x = target.frame->normal_x[0],
              *normal_y = target.frame->normal_y[0], *normal_z = target.frame->normal_z[0];
  const uint8_t* ignored = target.ignored != nullptr ? (*target.ignored)[0] : nullptr;
  const float inverse_fx = 1 / camera.fx, inverse_fy = 1 / camera.fy;
  const float inverse_gate2 = 1 / (options.gate_sigma * options.gate_sigma);
  for (int v = stride / 2; v < camera.height; v += stride) {
    const float* depth = source.depth_m[v];
    const float b = (static_cast<float>(v) - camera.cy) * inverse_fy;
    for (int u = stride / 2; u < camera.width; u += stride) {
      const float z = depth[u];
      if (!(z > 0) || (ignored_source != nullptr && (*ignored_source)(v, u) != 0)) continue;
      const float x = (static_cast<float>(u) - camera.cx) * inverse_fx * z, y = b * z;
      const float qz = r(2, 0) * x + r(2, 1) * y + r(2, 2) * z + t.z();
      if (qz < 0.1f) continue;
      const float qx = r(0, 0) * x + r(0, 1) * y + r(0, 2) * z + t.x();
      const float qy = r(1, 0) * x + r(1, 1) * y + r(1, 2) * z + t.y();
      const float inverse_qz = 1 / qz;
      const float pu = qx * inverse_qz * camera.fx + camera.cx + 0.5f;
      const float pv = qy * inverse_qz * camera.fy + camera.cy + 0.5f;
      if (pu < 0 || pv < 0 || pu >= static_cast<float>(camera.width) ||
          pv >= static_cast<float>(camera.height))
        continue;
      const int tu = static_cast<int>(pu), tv = static_cast<int>(pv), at = tv * camera.width + tu;
      const float nz = normal_z[at], tz = target_depth_m[at];
      if (nz == 0 || (ignored != nullptr && ignored[at] != 0)) continue;
      const float nx = normal_x[at], ny = normal_y[at];
      const float tx = (static_cast<float>(tu) - camera.cx) * inverse_fx * tz;
      const float ty = (static_cast<float>(tv) - camera.cy) * inverse_fy * tz;
      const float residual = nx * (qx - tx) + ny * (qy - ty) + nz * (qz - tz);
      if (std::abs(residual) > options.max_distance_m) continue;
      const float sigma = std::abs(nz) * (DepthSigmaM(z) + DepthSigmaM(tz)) * 0.7071f + 0.001f;
      const float information = 1 / (sigma * sigma);
      const float share2 = residual * residual * information * inverse_gate2;
      ++sums->num_pairs;
      if (share2 < 1) ++sums->num_fitting;
      const float outer = share2 * 0.25f;  // Tukey's biweight, redescending at twice the gate
      if (outer >= 1) continue;
      const float weight = (1 - outer) * (1 - outer) * information;
      const float mx = r(0, 0) * nx + r(1, 0) * ny + r(2, 0) * nz;  // the normal in the source frame
      const float my = r(0, 1) * nx + r(1, 1) * ny + r(2, 1) * nz;
      const float mz = r(0, 2) * nx + r(1, 2) * ny + r(2, 2) * nz;
      sums->Add({y * mz - z * my, z * mx - x * mz, x * my - y * mx, mx, my, mz, residual, 0}, weight);
    }
  }
}

ORBSLAM_WIDE_VECTORS void AddPairsWide(const GridCamera& camera, const WorkingFrame& source,
                                       const cv::Mat1b* ignored_source, const IcpTarget& target,
                                       const Rigid3d& target_from_source, const IcpOptions& options,
                                       int stride, Sums* sums) {
  AddPairs(camera, source, ignored_source, target, target_from_source, options, stride, sums);
}

/// One Gauss-Newton step with the prior; the pose's perturbation.
Vector6f Step(const Sums& sums, float weight, const Rigid3d& prior_from_source,
              const Matrix6f& prior_information) {
  Matrix6f hessian;
  Vector6f gradient;
  for (int a = 0; a < 6; ++a) {
    gradient[a] = weight * sums.rows[a][Sums::kGradient];
    for (int b = a; b < 6; ++b) hessian(a, b) = hessian(b, a) = weight * sums.rows[a][b];
  }
  Vector6f from_prior;
  from_prior << So3Log(prior_from_source.rotation).cast<float>(), prior_from_source.translation.cast<float>();
  hessian += prior_information;
  gradient += prior_information * from_prior;
  return -hessian.ldlt().solve(gradient);
}

}  // namespace

Eigen::Matrix<double, 6, 6> IsotropicInformation(double sigma_rotation_rad, double sigma_translation_m) {
  Eigen::Matrix<double, 6, 1> sigma;
  sigma << Eigen::Vector3d::Constant(sigma_rotation_rad), Eigen::Vector3d::Constant(sigma_translation_m);
  return sigma.array().square().inverse().matrix().asDiagonal();
}

IcpResult AlignDepth(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
                     std::span<const IcpTarget> targets, const Rigid3d& base_from_source_prior,
                     const Eigen::Matrix<double, 6, 6>& prior_information, const IcpOptions& options) {
  const auto add_pairs = HasWideVectors() ? AddPairsWide : AddPairs;
  IcpResult result;
  result.base_from_source = base_from_source_prior;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    Sums sums;
    const int stride = iteration < 2 && options.iterations > 3 ? 2 * options.stride : options.stride;
    for (const IcpTarget& target : targets)
      add_pairs(camera, source, ignored_source, target, target.target_from_base * result.base_from_source,
               options, stride, &sums);
    result.num_pairs = sums.num_pairs, result.num_fitting = sums.num_fitting;
    const Rigid3d prior_from_source = Inverse(base_from_source_prior) * result.base_from_source;
    const Eigen::Matrix<double, 6, 1> step = Step(sums, static_cast<float>(options.independent_share),
                                                  prior_from_source, prior_information.cast<float>())
                                                 .cast<double>();
    result.base_from_source = result.base_from_source * Rigid3d{So3Exp(step.head<3>()), step.tail<3>()};
    if (stride == options.stride && step.head<3>().norm() < 1e-5 && step.tail<3>().norm() < 2e-5) break;
  }
  return result;
}

}  // namespace orbslam
