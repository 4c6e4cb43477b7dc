// SPDX-License-Identifier: MIT
#include "autocalibration/lens_by_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "base/least_squares.h"
#include "base/pose.h"
#include "ego_motion/rotation_fit.h"

namespace sigs {

namespace {

constexpr std::array<int, 4> kGaps{6, 18, 54, 120};  // frames
constexpr int kStarts = 96;                          // frames from which pairs begin
constexpr int kTurnParts = 12;                       // of the time in which the image moves
constexpr std::size_t kPairsEach = 4;                // of a part
constexpr std::size_t kMinParts = 4;
constexpr std::size_t kMinCommon = 30;      // features
constexpr double kMinMotion = 0.03;         // of the image's width
constexpr double kTurnLeastScale_px = 0.1;  // of the reduced image
constexpr int kFields = 14;                 // first values tried
constexpr double kFirstField_rad = 0.12;
constexpr double kLastField_rad = 2.6;
constexpr int kTurnRounds = 12;
constexpr double kTurnLeastRelative = 0.01;  // the lens is not quite of this model, its centre not quite the image's
constexpr double kFreer = 1.3;               // a homography that misses by so much less is another motion
constexpr double kLargestMiss_px = 0.8;      // of the reduced image; larger misses are no rotation
constexpr double kTooOpen = 0.2;             // uncertainty of the focal length

struct Pair {
  std::vector<PixelPair> features;
  int part = 0;  // of the footage; first the frame in the middle
  double motion_px = 0;
  glm::dquat after_from_before{1, 0, 0, 0};
};

// All pairs with enough motion, by time of their first frames.
std::vector<Pair> all_moving_pairs(const PixelTracks& tracks) {
  std::vector<Pair> pairs;
  const int count = static_cast<int>(tracks.frames.size());
  const int stride = std::max(1, count / kStarts);
  for (int first = 0; first < count; first += stride)
    for (const int gap : kGaps) {
      if (first + gap >= count) break;
      const TrackedFrame& before = tracks.frames[static_cast<std::size_t>(first)];
      const TrackedFrame& after = tracks.frames[static_cast<std::size_t>(first + gap)];
      if (before.stretch != after.stretch) break;
      Pair pair{.features = common_pixels(before, after), .part = first + gap / 2};
      if (pair.features.size() < kMinCommon) break;
      pair.motion_px = median_motion_px(pair.features);
      if (pair.motion_px > kMinMotion * tracks.size_px.width) pairs.push_back(std::move(pair));
    }
  return pairs;
}

// Those with the most motion of each part of the time in which there is motion.
std::vector<Pair> moving_pairs(const PixelTracks& tracks) {
  std::vector<Pair> all = all_moving_pairs(tracks);
  if (all.empty()) return all;
  const auto by_time = [](const Pair& a, const Pair& b) { return a.part < b.part; };
  const int first = std::min_element(all.begin(), all.end(), by_time)->part;
  const int length = std::max_element(all.begin(), all.end(), by_time)->part - first + 1;
  std::stable_sort(all.begin(), all.end(), [](const Pair& a, const Pair& b) { return a.motion_px > b.motion_px; });
  std::array<std::size_t, kTurnParts> taken{};
  std::vector<Pair> pairs;
  for (Pair& pair : all) {
    pair.part = (pair.part - first) * kTurnParts / length;
    if (taken[static_cast<std::size_t>(pair.part)]++ < kPairsEach) pairs.push_back(std::move(pair));
  }
  return pairs;
}

// Unknowns common to all pairs: (width / focal)^2, in which errors of features are even, and the distortion.
using Common = std::vector<double>;
constexpr int kOfTurn = 3;  // unknowns of a pair, before the common ones in its equations

class TurnFit {
 public:
  TurnFit(const PixelTracks& tracks, std::vector<Pair> pairs, const DistortionPrior& prior)
      : size_px_(tracks.size_px), step_px_(tracks.step_px), prior_(prior), pairs_(std::move(pairs)) {}

  [[nodiscard]] DivisionLens lens_of(std::span<const double> u) const {
    constexpr double kLeast = 1e-4;
    return {.size_px = size_px_,
            .focal_px = size_px_.width / std::sqrt(std::max(kLeast, u[0])),
            .distortion = std::clamp(u[1], -0.95, 0.95)};
  }

  // First values by trying fields of view, then least squares. False where no rotation fits.
  bool solve() {
    double best = 1e300;
    Common start{0, 0};
    for (int i = 0; i < kFields; ++i) {
      const double field_rad = kFirstField_rad * std::pow(kLastField_rad / kFirstField_rad, i / (kFields - 1.0));
      const auto lens = division_lens_of_field(size_px_, field_rad, prior_.mean);
      if (!lens) continue;
      const double cost = cost_of(*lens);
      if (cost >= best) continue;
      best = cost;
      start = {std::pow(size_px_.width / lens->focal_px, 2), lens->distortion};
    }
    if (!(start[0] > 0)) return false;
    values_ = start;
    if (!turn_pairs(lens_of(values_))) return false;
    for (int round = 0; round < kTurnRounds; ++round) step(round + 1 < kTurnRounds);
    return std::isfinite(values_[0]) && std::isfinite(values_[1]);
  }

  [[nodiscard]] const Common& values() const { return values_; }
  [[nodiscard]] double residual_px() const { return scale_px_; }
  [[nodiscard]] std::vector<NormalEquations> used_parts() const {
    std::vector<NormalEquations> used;
    for (const NormalEquations& part : parts_)
      if (part.matrix()(0, 0) > 0) used.push_back(part);
    return used;
  }
  [[nodiscard]] NormalEquations known() const {
    NormalEquations equations(2);
    equations.add_known(1, 1 / (prior_.sd * prior_.sd), prior_.mean - values_[1]);
    return equations;
  }

  // Median over the pairs of the median miss, px: of the rotations, and of a homography for each pair.
  struct Misses {
    double turned_px = 0;
    double free_px = 0;
  };
  [[nodiscard]] Misses misses() const {
    const DivisionLens lens = lens_of(values_);
    std::vector<double> turned;
    std::vector<double> free;
    for (const Pair& pair : pairs_) {
      std::vector<double> lengths;
      std::vector<cv::Point2d> before;
      std::vector<cv::Point2d> after;
      for (const PixelPair& f : pair.features) {
        lengths.push_back(glm::length(miss(lens, pair.after_from_before, f)));
        const glm::dvec3 a = lens.ray(f.before);
        const glm::dvec3 b = lens.ray(f.after);
        before.emplace_back(a.y / a.x * lens.focal_px, a.z / a.x * lens.focal_px);
        after.emplace_back(b.y / b.x * lens.focal_px, b.z / b.x * lens.focal_px);
      }
      turned.push_back(scale_of(lengths, 0));
      free.push_back(free_miss_px(before, after));
    }
    return {scale_of(turned, 0), scale_of(free, 0)};
  }

 private:
  [[nodiscard]] static glm::dvec2 miss(const DivisionLens& lens, const glm::dquat& turn, const PixelPair& feature) {
    const auto there = lens.pixel(turn * lens.ray(feature.before));
    return there ? feature.after - *there : glm::dvec2(1e3, 1e3);
  }

  [[nodiscard]] static double free_miss_px(const std::vector<cv::Point2d>& before,
                                           const std::vector<cv::Point2d>& after) {
    const cv::Mat found = cv::findHomography(before, after, cv::LMEDS);
    if (found.empty()) return INFINITY;
    std::vector<cv::Point2d> moved;
    cv::perspectiveTransform(before, moved, found);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < moved.size(); ++i) lengths.push_back(cv::norm(moved[i] - after[i]));
    return scale_of(lengths, 0);
  }

  [[nodiscard]] std::optional<glm::dquat> turn_of_pair(const DivisionLens& lens, const Pair& pair) const {
    std::vector<RayPair> rays;
    for (const PixelPair& f : pair.features)
      rays.push_back({glm::normalize(lens.ray(f.before)), glm::normalize(lens.ray(f.after))});
    constexpr double kInlier_px = 3;
    const auto fit = fitted_rotation(rays, {.inlier_rad = kInlier_px * step_px_ / lens.focal_px});
    if (!fit) return std::nullopt;
    return fit->after_from_before;
  }

  // Mean robust miss of every third pair, 0 to 1.
  [[nodiscard]] double cost_of(const DivisionLens& lens) const {
    double sum = 0;
    double count = 0;
    const double scale_px = 0.7 * step_px_;
    for (std::size_t i = 0; i < pairs_.size(); i += 3) {
      const auto turn = turn_of_pair(lens, pairs_[i]);
      for (const PixelPair& f : pairs_[i].features) {
        const double share = turn ? squared_length(miss(lens, *turn, f)) / (scale_px * scale_px) : INFINITY;
        sum += std::isfinite(share) ? share / (1 + share) : 1;
        ++count;
      }
    }
    return count > 0 ? sum / count : 1;
  }

  // Rotations of all pairs by a lens; pairs without one are left out. False where too few are left.
  bool turn_pairs(const DivisionLens& lens) {
    std::erase_if(pairs_, [&](Pair& pair) {
      const auto turn = turn_of_pair(lens, pair);
      if (turn) pair.after_from_before = *turn;
      return !turn;
    });
    return pairs_.size() >= kMinParts;
  }

  void step(bool moves) {
    const DivisionLens lens = lens_of(values_);
    std::vector<double> lengths;
    for (const Pair& pair : pairs_)
      for (const PixelPair& f : pair.features) lengths.push_back(glm::length(miss(lens, pair.after_from_before, f)));
    scale_px_ = scale_of(lengths, kTurnLeastScale_px * step_px_);
    parts_.assign(kTurnParts, NormalEquations(2));
    NormalEquations all = known();
    std::vector<NormalEquations> equations;
    for (const Pair& pair : pairs_) {
      equations.push_back(equations_of(lens, pair));
      equations.back().eliminate(kOfTurn);
      parts_[static_cast<std::size_t>(pair.part)].add(equations.back());
      all.add(equations.back());
    }
    if (!moves) return;
    std::vector<double> by = all.solved();
    by[0] = std::clamp(by[0], -0.4 * values_[0], 0.6 * values_[0]);
    by[1] = std::clamp(by[1], -0.1, 0.1);
    for (std::size_t i = 0; i < by.size(); ++i) values_[i] += by[i];
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const std::vector<double> turn = equations[i].eliminated(by);
      pairs_[i].after_from_before = glm::normalize(turn_of({turn[0], turn[1], turn[2]}) * pairs_[i].after_from_before);
    }
  }

  [[nodiscard]] NormalEquations equations_of(const DivisionLens& lens, const Pair& pair) const {
    constexpr double kChange = 1e-4;
    struct Moved {
      DivisionLens lens;
      glm::dquat turn;
      double change;
    };
    std::vector<Moved> moved;
    for (int k = 0; k < kOfTurn; ++k) {
      glm::dvec3 turn(0);
      turn[k] = kChange;
      moved.push_back({lens, turn_of(turn) * pair.after_from_before, kChange});
    }
    for (std::size_t k = 0; k < values_.size(); ++k) {
      Common there = values_;
      const double change = k == 0 ? kChange * values_[0] : kChange;
      there[k] += change;
      moved.push_back({lens_of(there), pair.after_from_before, change});
    }
    NormalEquations equations(kOfTurn + 2);
    for (int k = 0; k < kOfTurn; ++k) equations.add_known(k, 1e-9);
    for (const PixelPair& f : pair.features) {
      const glm::dvec2 at = miss(lens, pair.after_from_before, f);
      std::array<std::array<double, kOfTurn + 2>, 2> slopes{};
      double sum = 0;
      for (std::size_t k = 0; k < moved.size(); ++k) {
        const glm::dvec2 slope = (at - miss(moved[k].lens, moved[k].turn, f)) / moved[k].change;
        slopes[0][k] = slope.x;
        slopes[1][k] = slope.y;
        sum += slope.x + slope.y;
      }
      if (!std::isfinite(sum) || glm::length(at) > 900) continue;
      const double weight = geman_mcclure(squared_length(at), 4 * scale_px_ * scale_px_) / (scale_px_ * scale_px_);
      equations.add(slopes[0], at.x, weight);
      equations.add(slopes[1], at.y, weight);
    }
    return equations;
  }

  cv::Size size_px_;
  double step_px_ = 1;
  DistortionPrior prior_;
  std::vector<Pair> pairs_;
  Common values_{0, 0};
  double scale_px_ = 1;
  std::vector<NormalEquations> parts_;
};

std::size_t parts_in(const std::vector<Pair>& pairs) {
  std::array<bool, kTurnParts> has{};
  for (const Pair& pair : pairs) has[static_cast<std::size_t>(pair.part)] = true;
  return static_cast<std::size_t>(std::count(has.begin(), has.end(), true));
}

}  // namespace

LensAnswer lens_by_turn(const PixelTracks& tracks, const DistortionPrior& prior) {
  std::vector<Pair> pairs = moving_pairs(tracks);
  if (parts_in(pairs) < kMinParts)
    return {.fit = std::nullopt, .reason = "the image moves too little, or too few features can be followed"};
  TurnFit fit(tracks, std::move(pairs), prior);
  if (!fit.solve()) return {.fit = std::nullopt, .reason = "the image does not move as that of a turning camera"};
  const TurnFit::Misses misses = fit.misses();
  if (misses.turned_px > kLargestMiss_px * tracks.step_px)
    return {.fit = std::nullopt,
            .reason = fmt::format("the image does not move as that of a turning camera (rotations miss by {:.1f} px)",
                                  misses.turned_px)};
  if (misses.turned_px > kFreer * misses.free_px + kTurnLeastScale_px * tracks.step_px)
    return {
        .fit = std::nullopt,
        .reason = fmt::format("the camera travels past what it sees (rotations miss by {:.2f} px, planes by {:.2f})",
                              misses.turned_px, misses.free_px)};
  const std::vector<NormalEquations> parts = fit.used_parts();
  if (parts.size() < kMinParts) return {.fit = std::nullopt, .reason = "too little of the footage has a turn"};
  LensEstimate found =
      fit_of([&fit](std::span<const double> u) { return fit.lens_of(u); }, fit.values(),
             clustered_covariance(parts, fit.known()), static_cast<int>(parts.size()), kTurnLeastRelative);
  found.residual_px = fit.residual_px();
  if (!(found.relative_uncertainty() < kTooOpen))
    return {.fit = std::nullopt,
            .reason = fmt::format("the turns are too small: they fit fields of view from {:.0f} to {:.0f} degrees",
                                  deg_of_rad(found.field_low_rad), deg_of_rad(found.field_high_rad))};
  return {.fit = found, .reason = {}};
}

}  // namespace sigs
