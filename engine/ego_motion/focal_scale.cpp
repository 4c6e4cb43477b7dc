// SPDX-License-Identifier: MIT
#include "ego_motion/attitudes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <thread>
#include <vector>

#include "base/least_squares.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "base/threads.h"

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
glm::dvec3 scaled(const glm::dvec3& ray, double scale) {
  return glm::normalize(glm::dvec3(ray.x * scale, ray.y, ray.z));
}

double median_motion_rad(const std::vector<RayPair>& pairs) {
  std::vector<double> motions;
  for (const RayPair& pair : pairs) motions.push_back(glm::length(pair.after - pair.before));
  return median(std::move(motions));
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
      std::erase_if(rays, [](const RayPair& r) { return !(r.before.x > 0 && r.after.x > 0); });
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
  const auto width_rad = [&](const glm::dvec3& ray) { return pixel_rad / scale * ray.x; };
  const auto fit = fitted_rotation(pairs, {.inlier_rad = kInlier_px * pixel_rad / scale});
  if (!fit) return 1;
  double sum = 0;
  for (const RayPair& pair : pairs) {
    const double miss_px =
        glm::length(fit->after_from_before * pair.before - pair.after) / (kAgree_px * width_rad(pair.after));
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

constexpr std::size_t kSlopeParts = 10;      // of the footage
constexpr std::size_t kMinSlopeTurns = 100;  // frames
constexpr double kMinGyroCorrelation = 0.9;  // of seen and recorded turns; less where images were stabilized
constexpr double kMaxSlopeSd = 0.15;         // of the factor
constexpr double kMaxDisagreement = 0.05;    // of factors that ought to be equal, beside three standard deviations
constexpr double kUnknownSlopeSd = 0.15;     // of turns about the line of sight, which say nothing beyond it
constexpr double kMinRollShare = 0.05;       // of the squares of those across it

// Seen turns over recorded ones, and the recorded ones' sum of squares.
struct Slope {
  double value = 0, sd = 0, recorded = 0;
};

// Sums over a part of the footage.
struct SlopeSums {
  double recorded = 0, both = 0;
  [[nodiscard]] double slope() const { return recorded > 0 ? both / recorded : 0; }
};

// By least squares over some of the axes and of the turns.
template <class IsUsed>
Slope slope_of(std::span<const RayPair> pairs, std::initializer_list<int> axes, const IsUsed& is_used) {
  std::array<SlopeSums, kSlopeParts> parts{};
  SlopeSums all;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!is_used(pairs[i])) continue;
    for (const int axis : axes) {
      const double recorded = pairs[i].before[axis], seen = pairs[i].after[axis];
      for (SlopeSums* const sums : {&parts[i * kSlopeParts / pairs.size()], &all}) {
        sums->recorded += recorded * recorded;
        sums->both += recorded * seen;
      }
    }
  }
  double squares = 0;
  for (const SlopeSums& part : parts) {
    const SlopeSums rest{.recorded = all.recorded - part.recorded, .both = all.both - part.both};
    squares += std::pow(rest.slope() - all.slope(), 2);
  }
  return {all.slope(), std::sqrt(squares * (kSlopeParts - 1) / kSlopeParts), all.recorded};
}

bool agree(const Slope& a, const Slope& b) {
  return std::abs(a.value - b.value) < kMaxDisagreement + 3 * std::hypot(a.sd, b.sd);
}

double across(const RayPair& turn) {
  return std::hypot(turn.before.y, turn.before.z);
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
  const double low = quantile(drawn, 0.025);
  const double high = quantile(drawn, 0.975);
  constexpr double kStep = 0.5;  // the grid's own error
  FocalScale found{.value = scale_at(at), .least = scale_at(low - kStep), .largest = scale_at(high + kStep)};
  if (high > kScales - 2) found.largest = 0;
  return found;
}

std::optional<FocalScale> focal_scale_by_gyro(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                              const TimeOffset& offset, const glm::dquat& camera_from_gyro) {
  const std::vector<RayPair> pairs = turns_about_mean(turns, rates, offset, camera_from_gyro);
  if (pairs.size() < kMinSlopeTurns || !(offset.correlation >= kMinGyroCorrelation)) return std::nullopt;
  const Slope found = slope_of(pairs, {1, 2}, [](const RayPair&) { return true; });
  if (!(found.value > 0) || !(found.sd < kMaxSlopeSd * found.value)) return std::nullopt;
  std::vector<double> sizes;
  for (const RayPair& pair : pairs) sizes.push_back(across(pair));
  const double limit = quantile(std::move(sizes), 0.8);
  const Slope fast = slope_of(pairs, {1, 2}, [&](const RayPair& pair) { return across(pair) > limit; });
  const Slope slow = slope_of(pairs, {1, 2}, [&](const RayPair& pair) { return across(pair) <= limit; });
  const Slope roll = slope_of(pairs, {0}, [](const RayPair&) { return true; });
  // A gimbal leaves little of the turns about the line of sight but the gyroscope's noise.
  const bool rolls = roll.recorded > kMinRollShare * found.recorded && roll.sd < kUnknownSlopeSd;
  if (!agree(fast, slow) || (rolls && !agree(roll, {1, 0, 0}))) return std::nullopt;
  const double margin = 2 * std::hypot(found.sd, 0.01 * found.value);
  return FocalScale{.value = found.value, .least = found.value - margin, .largest = found.value + margin};
}

std::string disagreement_with_gyro(const GyroLink& gyro, const std::optional<FocalScale>& fitting,
                                   const Camera& camera) {
  constexpr double kSlope = 0.1;
  if (!gyro.is_fused)
    return fmt::format(
        "the images do not follow the gyroscope (correlation {:.2f}): stabilized in the camera, or the log "
        "of another flight? The images alone are used",
        gyro.correlation);
  if (std::abs(gyro.slope - 1) <= kSlope) return "";
  std::string why = "stabilized in the camera, or a wrong focal length?";
  if (const double now_deg = field_of_view_deg(camera, 1); fitting && !std::isnan(now_deg))
    why = fmt::format("a field of view of {:.0f} to {:.0f} degrees across explains it, the calibration has {:.0f}",
                      field_of_view_deg(camera, fitting->largest), field_of_view_deg(camera, fitting->least), now_deg);
  return fmt::format("the images turn {:.2f} times as fast as the gyroscope says: {}", gyro.slope, why);
}

double field_of_view_deg(const Camera& camera, double focal_factor) {
  const auto ray = camera.lens.ray({camera.size_px.width - 1.0, (camera.size_px.height - 1) / 2.0});
  if (!ray || !(ray->x > 0)) return std::numeric_limits<double>::quiet_NaN();
  return 2 * deg_of_rad(std::atan(std::tan(std::acos(std::clamp(ray->x, 0.0, 1.0))) / focal_factor));
}

}  // namespace sigs
