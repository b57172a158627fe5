// SPDX-License-Identifier: GPL-3.0-or-later
#include "icp_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "depth_noise.h"
#include "wide_vectors.h"

namespace orbslam {
namespace {

constexpr int kBlock = 64;  // points that go through each step together

/// Points of a row: where they are and where they meet the target. Structure of arrays, for vectors.
struct SourceBlock {
  int size = 0, padded = 0;                  // points, and with those to fill a vector
  float x[kBlock], y[kBlock], z[kBlock];     // source frame, m
  float qx[kBlock], qy[kBlock], qz[kBlock];  // target frame, m
  float u[kBlock], v[kBlock];                // cell of the target there
  int index[kBlock];                         // the same as an index, -1: none
};

/// The points that met a surface; x and q as above, t: the surface's point, n: its normal.
struct PairBlock {
  float x[kBlock], y[kBlock], z[kBlock], qx[kBlock], qy[kBlock], qz[kBlock];
  float tx[kBlock], ty[kBlock], tz[kBlock], nx[kBlock], ny[kBlock], nz[kBlock];
};

/// Without branches, as all loops here but Meet, so that the compiler vectorises it.
void Project(const GridCamera& camera, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& translation,
             SourceBlock* block) {
  const float r00 = rotation(0, 0), r01 = rotation(0, 1), r02 = rotation(0, 2), r10 = rotation(1, 0),
              r11 = rotation(1, 1), r12 = rotation(1, 2), r20 = rotation(2, 0), r21 = rotation(2, 1),
              r22 = rotation(2, 2), t0 = translation.x(), t1 = translation.y(), t2 = translation.z();
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const float fx = camera.fx, fy = camera.fy, cx = camera.cx + 0.5f, cy = camera.cy + 0.5f;
  const int columns = camera.width;
  constexpr float kNearestM = 0.1f;
  for (int k = 0; k < block->padded; ++k) {
    const float x = block->x[k], y = block->y[k], z = block->z[k];
    const float qz = r20 * x + r21 * y + r22 * z + t2;
    const float qx = r00 * x + r01 * y + r02 * z + t0;
    const float qy = r10 * x + r11 * y + r12 * z + t1;
    const float inverse = 1 / std::max(qz, kNearestM);
    const float pu = qx * inverse * fx + cx, pv = qy * inverse * fy + cy;
    const float column = std::min(std::max(pu, 0.f), width), line = std::min(std::max(pv, 0.f), height);
    const bool inside =
        (z > 0) & (qz > kNearestM) & (column == pu) & (line == pv) & (pu != width) & (pv != height);
    const int u = static_cast<int>(column), v = static_cast<int>(line);
    block->qx[k] = qx, block->qy[k] = qy, block->qz[k] = qz;
    block->u[k] = static_cast<float>(u), block->v[k] = static_cast<float>(v);
    block->index[k] = inside ? v * columns + u : -1;
  }
}

/// Gathers what the target holds where the points fall; the number of pairs. ahead: to where about the next
/// row of points will fall, for the target has long left the caches. Not inlined: it needs all registers.
[[gnu::noinline]] int Meet(const GridCamera& camera, const SourceBlock& block, const IcpTarget& target,
                           int ahead, PairBlock* pairs) {
  const float *depth_m = target.frame->depth_m[0], *normal_x = target.frame->normal_x[0],
              *normal_y = target.frame->normal_y[0], *normal_z = target.frame->normal_z[0];
  const uint8_t nothing = 0, *ignored = target.ignored != nullptr ? (*target.ignored)[0] : &nothing;
  const int ignored_mask = target.ignored != nullptr ? -1 : 0;
  const float inverse_fx = 1 / camera.fx, inverse_fy = 1 / camera.fy;
  const int last = camera.width * camera.height - 1;
  int met[kBlock], count = 0;
  for (int k = 0; k < block.size; ++k) {
    const int at = block.index[k], there = std::max(at, 0), next = std::min(there + ahead, last);
    __builtin_prefetch(normal_x + next), __builtin_prefetch(normal_y + next);
    __builtin_prefetch(normal_z + next), __builtin_prefetch(depth_m + next);
    met[count] = k;  // without a branch, which nobody could predict
    count += (at >= 0) & (normal_z[there] != 0) & (ignored[there & ignored_mask] == 0);
  }
  for (int i = 0; i < count; ++i) {
    const int k = met[i], at = block.index[k];
    const float tz = depth_m[at];
    pairs->x[i] = block.x[k], pairs->y[i] = block.y[k], pairs->z[i] = block.z[k];
    pairs->qx[i] = block.qx[k], pairs->qy[i] = block.qy[k], pairs->qz[i] = block.qz[k];
    pairs->tx[i] = (block.u[k] - camera.cx) * inverse_fx * tz;
    pairs->ty[i] = (block.v[k] - camera.cy) * inverse_fy * tz;
    pairs->tz[i] = tz;
    pairs->nx[i] = normal_x[at], pairs->ny[i] = normal_y[at], pairs->nz[i] = normal_z[at];
  }
  return count;
}

/// The pairs' rows of the Jacobian, with the residual last, and their weights.
struct Equations {
  float column[PairSums::kColumns][kBlock], weight[kBlock];
};

/// Pairs that are too far apart get no weight and are not counted.
void Linearize(const PairBlock& pairs, int count, const Eigen::Matrix3f& rotation, const IcpOptions& options,
               Equations* equations, PairSums* sums) {
  const float r00 = rotation(0, 0), r01 = rotation(0, 1), r02 = rotation(0, 2), r10 = rotation(1, 0),
              r11 = rotation(1, 1), r12 = rotation(1, 2), r20 = rotation(2, 0), r21 = rotation(2, 1),
              r22 = rotation(2, 2);
  const float max_distance_m = options.max_distance_m;
  const float inverse_gate2 = 1 / (options.gate_sigma * options.gate_sigma);
  int num_pairs = 0, num_fitting = 0;
  for (int k = 0; k < count; ++k) {
    const float x = pairs.x[k], y = pairs.y[k], z = pairs.z[k];
    const float nx = pairs.nx[k], ny = pairs.ny[k], nz = pairs.nz[k];
    const float residual = nx * (pairs.qx[k] - pairs.tx[k]) + ny * (pairs.qy[k] - pairs.ty[k]) +
                           nz * (pairs.qz[k] - pairs.tz[k]);
    const float sigma = std::abs(nz) * (DepthSigmaM(z) + DepthSigmaM(pairs.tz[k])) * 0.7071f + 0.001f;
    const float information = 1 / (sigma * sigma);
    const float share2 = residual * residual * information * inverse_gate2;
    const bool is_near = std::abs(residual) <= max_distance_m;
    num_pairs += is_near, num_fitting += is_near & (share2 < 1);
    const float inner =
        1 - std::min(share2 * 0.25f, 1.f);  // Tukey's biweight, redescending at twice the gate
    equations->weight[k] = is_near ? inner * inner * information : 0.f;
    const float mx = r00 * nx + r10 * ny + r20 * nz;  // the normal in the source frame
    const float my = r01 * nx + r11 * ny + r21 * nz;
    const float mz = r02 * nx + r12 * ny + r22 * nz;
    equations->column[0][k] = y * mz - z * my;
    equations->column[1][k] = z * mx - x * mz;
    equations->column[2][k] = x * my - y * mx;
    equations->column[3][k] = mx, equations->column[4][k] = my, equations->column[5][k] = mz;
    equations->column[6][k] = residual;
  }
  sums->num_pairs += num_pairs, sums->num_fitting += num_fitting;
}

void Add(Equations* equations, int count, PairSums* sums) {
  constexpr int kLanes = PairSums::kLanes;
  const int padded = (count + kLanes - 1) / kLanes * kLanes;
  for (int k = count; k < padded; ++k) {
    equations->weight[k] = 0;
    for (auto& column : equations->column) column[k] = 0;
  }
  for (int a = 0; a < 6; ++a) {
    float weighted[kBlock];
    for (int k = 0; k < padded; ++k) weighted[k] = equations->weight[k] * equations->column[a][k];
    for (int b = a; b < PairSums::kColumns; ++b) {
      const float* column = equations->column[b];
      float* lanes = sums->lanes[a][b];
      for (int k = 0; k < padded; k += kLanes)
        for (int i = 0; i < kLanes; ++i) lanes[i] += weighted[k + i] * column[k + i];
    }
  }
}

void AddAllPairs(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
                 const IcpTarget& target, const Rigid3d& target_from_source, const IcpOptions& options,
                 int stride, PairSums* sums) {
  const Eigen::Matrix3f rotation = target_from_source.RotationMatrix().cast<float>();
  const Eigen::Vector3f translation = target_from_source.translation.cast<float>();
  const float inverse_fx = 1 / camera.fx, inverse_fy = 1 / camera.fy;
  SourceBlock block{};
  PairBlock pairs;
  Equations equations;
  for (int v = stride / 2; v < camera.height; v += stride) {
    const float* depth_m = source.depth_m[v];
    const uint8_t* ignored = ignored_source != nullptr ? (*ignored_source)[v] : nullptr;
    const float b = (static_cast<float>(v) - camera.cy) * inverse_fy;
    for (int first = stride / 2; first < camera.width; first += kBlock * stride) {
      block.size = std::min(kBlock, (camera.width - first + stride - 1) / stride);
      block.padded = (block.size + PairSums::kLanes - 1) / PairSums::kLanes * PairSums::kLanes;
      for (int k = 0; k < block.size; ++k) {
        const int u = first + k * stride;
        const float z = ignored != nullptr && ignored[u] != 0 ? 0.f : depth_m[u];
        block.x[k] = (static_cast<float>(u) - camera.cx) * inverse_fx * z;
        block.y[k] = b * z, block.z[k] = z;
      }
      Project(camera, rotation, translation, &block);
      const int count = Meet(camera, block, target, stride * camera.width, &pairs);
      Linearize(pairs, count, rotation, options, &equations, sums);
      Add(&equations, count, sums);
    }
  }
}

ORBSLAM_WIDE_VECTORS void AddAllPairsWide(const GridCamera& camera, const WorkingFrame& source,
                                          const cv::Mat1b* ignored_source, const IcpTarget& target,
                                          const Rigid3d& target_from_source, const IcpOptions& options,
                                          int stride, PairSums* sums) {
  AddAllPairs(camera, source, ignored_source, target, target_from_source, options, stride, sums);
}

}  // namespace

float PairSums::operator()(int a, int b) const {
  return std::accumulate(lanes[a][b], lanes[a][b] + kLanes, 0.f);
}

void AddPairs(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
              const IcpTarget& target, const Rigid3d& target_from_source, const IcpOptions& options,
              int stride, PairSums* sums) {
  (HasWideVectors() ? AddAllPairsWide : AddAllPairs)(camera, source, ignored_source, target,
                                                     target_from_source, options, stride, sums);
}

}  // namespace orbslam
