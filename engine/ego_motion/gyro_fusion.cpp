// SPDX-License-Identifier: MIT
#include "ego_motion/attitudes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "base/least_squares.h"
#include "base/pose.h"
#include "base/statistics.h"

namespace sigs {

namespace {

constexpr double kBiasSd_radps = 0.03;  // of consumer gyroscopes at the start
constexpr double kBiasWalk = 5e-5;      // rad/s in the square root of a second
constexpr double kMinTurn_rad = 1e-5;   // standard deviation of a recorded turn between frames
constexpr double kUnknown_rad = 3.14;

// Recorded less seen, of frames k - 1 to k, in the axes of the start.
glm::dvec3 difference(const FrameRotation& before, const FrameRotation& after, const RecordedTurn& recorded) {
  const glm::dquat seen = glm::conjugate(before.start_from_camera) * after.start_from_camera;
  return after.start_from_camera * vector_of(glm::conjugate(seen) * recorded.before_from_after);
}

// Variance of a recorded turn: that of the differences, less what the images add.
double gyro_variance(std::span<const FrameRotation> seen, std::span<const RecordedTurn> recorded) {
  std::vector<double> sizes;
  double of_images = 0;
  for (std::size_t k = 1; k < seen.size(); ++k) {
    if (!recorded[k].is_known || !seen[k].is_linked) continue;
    const glm::dvec3 d = difference(seen[k - 1], seen[k], recorded[k]);
    for (int axis = 0; axis < 3; ++axis) sizes.push_back(std::abs(d[axis]));
    of_images += mean_variance(seen[k].own_covariance) + mean_variance(seen[k - 1].own_covariance);
  }
  if (sizes.empty()) return kUnknown_rad * kUnknown_rad;
  of_images /= static_cast<double>(sizes.size()) / 3;
  const double sigma = 1.4826 * median(std::move(sizes));
  return std::max({sigma * sigma - of_images, 0.05 * sigma * sigma, kMinTurn_rad * kMinTurn_rad});
}

// What the rotation sought is less the one seen (3), how far the images have drifted (3), both in the axes of the
// start, and the gyroscope's bias in its own axes (3).
using State = cv::Vec<double, 9>;
using Spread = cv::Matx<double, 9, 9>;

// Adds to the three variances from `first` on.
void widen(Spread& spread, int first, double variance) {
  for (int i = first; i < first + 3; ++i) spread(i, i) += variance;
}

struct FilterState {
  State mean;
  Spread spread;
};

// (e, d, b).
//   between frames  e += difference - R b dt, R the camera's attitude;  d and b walk
//   at a frame      0 = e + d + noise
class Smoother {
 public:
  explicit Smoother(double bias_sd) {
    FilterState first;
    widen(first.spread, 6, bias_sd * bias_sd);
    filtered_ = {first};
    predicted_ = {first};
    turns_ = {glm::dmat3(0)};
  }

  struct Step {
    double length_s = 0;
    glm::dmat3 start_from_camera;
    glm::dvec3 difference_rad;
    double turn_variance = 0, drift_variance = 0, seen_variance = 0;
  };

  void add(const Step& step) {
    turns_.emplace_back(-step.length_s * step.start_from_camera);
    const Spread transition = transition_of(turns_.back());
    FilterState next{.mean = transition * filtered_.back().mean,
                     .spread = transition * filtered_.back().spread * transition.t()};
    for (int i = 0; i < 3; ++i) next.mean[i] += step.difference_rad[i];
    widen(next.spread, 0, step.turn_variance);
    widen(next.spread, 3, step.drift_variance);
    widen(next.spread, 6, kBiasWalk * kBiasWalk * step.length_s);
    predicted_.push_back(next);
    const auto across = next.spread.get_minor<9, 3>(0, 0) + next.spread.get_minor<9, 3>(0, 3);
    const cv::Matx33d seen =
        across.get_minor<3, 3>(0, 0) + across.get_minor<3, 3>(3, 0) + step.seen_variance * cv::Matx33d::eye();
    const auto gain = across * cv::Matx33d(NormalEquations(cv::Mat_<double>(seen)).inverse());
    next.mean -= gain * (next.mean.get_minor<3, 1>(0, 0) + next.mean.get_minor<3, 1>(3, 0));
    next.spread -= gain * across.t();
    next.spread = 0.5 * (next.spread + next.spread.t());
    filtered_.push_back(next);
  }

  [[nodiscard]] std::vector<FilterState> smoothed() const {
    std::vector<FilterState> out = filtered_;
    for (std::size_t k = out.size() - 1; k-- > 0;) {
      NormalEquations ahead{cv::Mat_<double>(predicted_[k + 1].spread)};
      ahead.damp(0, 1e-18);
      const Spread gain = filtered_[k].spread * transition_of(turns_[k + 1]).t() * Spread(ahead.inverse());
      out[k].mean += gain * (out[k + 1].mean - predicted_[k + 1].mean);
      out[k].spread += gain * (out[k + 1].spread - predicted_[k + 1].spread) * gain.t();
    }
    return out;
  }

 private:
  static Spread transition_of(const glm::dmat3& by_bias) {
    Spread transition = Spread::eye();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) transition(i, 6 + j) = by_bias[j][i];
    return transition;
  }

  std::vector<FilterState> filtered_;
  std::vector<FilterState> predicted_;
  std::vector<glm::dmat3> turns_;
};

}  // namespace

std::vector<RecordedTurn> recorded_turns(std::span<const double> times_s, const RateIntegral& rates,
                                         const TimeOffset& offset, const glm::dquat& camera_from_gyro,
                                         std::span<const glm::dquat> camera_from_image) {
  constexpr double kPart_s = 0.005;  // short enough that rotation vectors add up
  std::vector<RecordedTurn> turns(times_s.size());
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    const double from_s = offset.log_time_s(times_s[k - 1]);
    const double to_s = offset.log_time_s(times_s[k]);
    if (!rates.covers(from_s, to_s) || !(to_s > from_s)) continue;
    turns[k].is_known = true;
    const int parts = static_cast<int>(std::clamp(std::ceil((to_s - from_s) / kPart_s), 1.0, 1000.0));
    glm::dquat turn(1, 0, 0, 0);
    for (int i = 0; i < parts; ++i)
      turn = turn * turn_of(camera_from_gyro * rates.between(from_s + (to_s - from_s) * i / parts,
                                                             from_s + (to_s - from_s) * (i + 1) / parts));
    if (!camera_from_image.empty()) turn = glm::conjugate(camera_from_image[k - 1]) * turn * camera_from_image[k];
    turns[k].before_from_after = glm::normalize(turn);
  }
  return turns;
}

std::vector<RayPair> turns_about_mean(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                      const TimeOffset& offset, const glm::dquat& camera_from_gyro) {
  std::vector<RayPair> pairs;
  RayPair sum{glm::dvec3(0), glm::dvec3(0)};
  for (const SeenTurn& turn : turns) {
    const double from_s = offset.log_time_s(turn.from_s), to_s = offset.log_time_s(turn.to_s);
    if (!rates.covers(from_s, to_s)) continue;
    pairs.push_back({camera_from_gyro * rates.between(from_s, to_s), turn.turn_rad});
    sum.before += pairs.back().before;
    sum.after += pairs.back().after;
  }
  const auto count = static_cast<double>(pairs.size());
  for (RayPair& pair : pairs) {
    pair.before -= sum.before / count;
    pair.after -= sum.after / count;
  }
  return pairs;
}

glm::dquat gyro_alignment(std::span<const SeenTurn> turns, const RateIntegral& rates, const TimeOffset& offset) {
  const glm::dquat no_turn(1, 0, 0, 0);
  std::vector<RayPair> pairs = turns_about_mean(turns, rates, offset, no_turn);
  if (pairs.size() < 2) return no_turn;
  double noise = 0;
  for (const RayPair& pair : pairs) noise += squared_length(pair.after - pair.before);
  // Three more pairs say that the axes agree, as strongly as some noisy turns by chance could say the opposite.
  std::vector<double> weights(pairs.size(), 1);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 along(0);
    along[axis] = 1;
    pairs.push_back({along, along});
    weights.push_back(noise);
  }
  return best_rotation(pairs, weights);
}

std::vector<FrameRotation> fused(std::span<const FrameRotation> seen, std::span<const double> times_s,
                                 std::span<const RecordedTurn> recorded) {
  std::vector<FrameRotation> out(seen.begin(), seen.end());
  if (seen.size() < 2) return out;
  const double turn_variance = gyro_variance(seen, recorded);
  const double unknown = kUnknown_rad * kUnknown_rad;
  Smoother smoother(kBiasSd_radps);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const bool known = recorded[k].is_known;
    const double grown = mean_variance(seen[k].covariance - seen[k].own_covariance) -
                         mean_variance(seen[k - 1].covariance - seen[k - 1].own_covariance);
    Smoother::Step step{.length_s = times_s[k] - times_s[k - 1],
                        .start_from_camera = glm::mat3_cast(seen[k].start_from_camera),
                        .difference_rad = glm::dvec3(0),
                        .turn_variance = known ? turn_variance : unknown,
                        .drift_variance = seen[k].is_linked ? std::max(grown, 1e-14) : unknown,
                        .seen_variance = mean_variance(seen[k].own_covariance) + 1e-14};
    if (known) step.difference_rad = difference(seen[k - 1], seen[k], recorded[k]);
    smoother.add(step);
  }
  const std::vector<FilterState> smoothed = smoother.smoothed();
  for (std::size_t k = 0; k < out.size(); ++k) {
    const State& mean = smoothed[k].mean;
    glm::dmat3 covariance = block_of(cv::Mat_<double>(smoothed[k].spread), 0);
    for (int i = 0; i < 3; ++i) covariance[i][i] = std::max(0.0, covariance[i][i]);
    out[k].start_from_camera = glm::normalize(turn_of({mean[0], mean[1], mean[2]}) * seen[k].start_from_camera);
    const glm::dmat3 camera_from_start = glm::mat3_cast(glm::conjugate(out[k].start_from_camera));
    out[k].covariance = camera_from_start * covariance * glm::transpose(camera_from_start);
    if (k > 0 && recorded[k].is_known) out[k].is_linked = true;
  }
  return out;
}

}  // namespace sigs
