// SPDX-License-Identifier: MIT
#include "ego_motion/focal_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include "base/threads.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/sequence.h"

namespace sigs {

namespace {

constexpr int kScales = 27;
constexpr double kFirstScale = 0.35;
constexpr double kScaleRatio = 1.14;                    // to the next one; 0.35 to 10
constexpr std::array<std::size_t, 3> kGaps{6, 18, 54};  // frames
constexpr std::size_t kStarts = 40;                     // frames from which pairs begin, spread over the footage
constexpr std::size_t kPairs = 18;                      // of frames, those with the most motion
constexpr std::size_t kMinPairs = 6;
constexpr std::size_t kMinCommon = 24;  // features
constexpr double kMinMotion_px = 3;
constexpr double kAgree_px = 0.5;  // features that miss by this have a quarter of the weight
constexpr double kInlier_px = 2;
constexpr double kLargestCost = 0.58;  // beyond it the motion is not a rotation

using Costs = std::array<double, kScales>;

double scale_at(double index) {
  return kFirstScale * std::pow(kScaleRatio, index);
}

// The ray as a camera with another focal length has it.
Eigen::Vector3d scaled(const Eigen::Vector3d& ray, double scale) {
  return Eigen::Vector3d(ray.x() * scale, ray.y(), ray.z()).normalized();
}

double median_motion_rad(const std::vector<RayPair>& pairs) {
  std::vector<double> motions;
  for (const RayPair& pair : pairs) motions.push_back((pair.after - pair.before).norm());
  const auto middle = motions.begin() + static_cast<std::ptrdiff_t>(motions.size() / 2);
  std::nth_element(motions.begin(), middle, motions.end());
  return *middle;
}

// Pairs of frames with the most motion between them.
std::vector<std::vector<RayPair>> moving_pairs(std::span<const FrameRays> frames, double pixel_rad) {
  struct Candidate {
    double motion_rad;
    std::vector<RayPair> rays;
  };
  std::vector<Candidate> candidates;
  const std::size_t stride = std::max<std::size_t>(1, frames.size() / kStarts);
  for (std::size_t first = 0; first < frames.size(); first += stride)
    for (const std::size_t gap : kGaps) {
      if (first + gap >= frames.size()) break;
      std::vector<RayPair> rays = common_rays(frames[first], frames[first + gap]);
      std::erase_if(rays, [](const RayPair& r) { return !(r.before.x() > 0 && r.after.x() > 0); });
      if (rays.size() < kMinCommon) continue;
      const double motion_rad = median_motion_rad(rays);
      if (motion_rad > kMinMotion_px * pixel_rad) candidates.push_back({motion_rad, std::move(rays)});
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.motion_rad > b.motion_rad; });
  std::vector<std::vector<RayPair>> pairs;
  for (std::size_t i = 0; i < std::min(kPairs, candidates.size()); ++i) pairs.push_back(std::move(candidates[i].rays));
  return pairs;
}

// Mean over the features of what a rotation leaves, 0 to 1: 1 where nothing agrees.
double cost_of(const std::vector<RayPair>& rays, double scale, double pixel_rad) {
  std::vector<RayPair> pairs;
  for (const RayPair& ray : rays) pairs.push_back({scaled(ray.before, scale), scaled(ray.after, scale)});
  // Off the axis a pixel spans less.
  const auto width_rad = [&](const Eigen::Vector3d& ray) { return pixel_rad / scale * ray.x(); };
  const auto fit = fitted_rotation(pairs, {.inlier_rad = kInlier_px * pixel_rad / scale});
  if (!fit) return 1;
  double sum = 0;
  for (const RayPair& pair : pairs) {
    const double miss_px =
        (fit->after_from_before * pair.before - pair.after).norm() / (kAgree_px * width_rad(pair.after));
    sum += miss_px * miss_px / (1 + miss_px * miss_px);
  }
  return sum / static_cast<double>(pairs.size());
}

// Where the sum of costs is least, as an index with a fraction.
double least_at(const Costs& costs) {
  const auto i = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  if (i == 0 || i + 1 == costs.size()) return static_cast<double>(i);
  const double bend = costs[i - 1] - 2 * costs[i] + costs[i + 1];
  const double shift = bend > 0 ? 0.5 * (costs[i - 1] - costs[i + 1]) / bend : 0;
  return static_cast<double>(i) + std::clamp(shift, -0.5, 0.5);
}

}  // namespace

std::optional<FocalScale> focal_scale(std::span<const FrameRays> frames, double pixel_rad, CancelFlag cancel) {
  const std::vector<std::vector<RayPair>> pairs = moving_pairs(frames, pixel_rad);
  if (pairs.size() < kMinPairs) return std::nullopt;
  std::vector<Costs> costs(pairs.size());
  parallel_for(static_cast<int>(pairs.size()), static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    for (int s = 0; s < kScales && !is_cancelled(cancel); ++s)
      costs[k][static_cast<std::size_t>(s)] = cost_of(pairs[k], scale_at(s), pixel_rad);
  });
  if (is_cancelled(cancel)) return std::nullopt;
  const auto sum_of = [&](auto&& pick) {
    Costs sum{};
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const Costs& one = costs[pick(i)];
      for (std::size_t s = 0; s < sum.size(); ++s) sum[s] += one[s];
    }
    return sum;
  };
  const Costs all = sum_of([](std::size_t i) { return i; });
  const double at = least_at(all);
  if (*std::min_element(all.begin(), all.end()) > kLargestCost * static_cast<double>(pairs.size())) return std::nullopt;
  constexpr int kDraws = 200;
  Sequence chance;
  std::vector<double> drawn;
  for (int draw = 0; draw < kDraws; ++draw)
    drawn.push_back(least_at(sum_of([&](std::size_t) { return chance.below(costs.size()); })));
  std::sort(drawn.begin(), drawn.end());
  const double low = drawn[kDraws / 40];
  const double high = drawn[kDraws - 1 - kDraws / 40];
  constexpr double kStep = 0.5;  // the grid's own error
  FocalScale found{.value = scale_at(at), .least = scale_at(low - kStep), .largest = scale_at(high + kStep)};
  if (high > kScales - 2) found.largest = 0;
  return found;
}

}  // namespace sigs
