// SPDX-License-Identifier: MIT
#include "ego_motion/gyro_fusion.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "ego_motion/rotation_fit.h"
#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr double kBiasSd_radps = 0.03;   // of consumer gyroscopes at the start
constexpr double kBiasWalk = 2e-4;       // rad/s in the square root of a second
constexpr double kLeastTurn_rad = 1e-5;  // standard deviation of a recorded turn between frames
constexpr double kUnknown_rad = 3.14;

// Recorded less seen, of frames k - 1 to k, in the axes of the start.
Eigen::Vector3d difference(const FrameRotation& before, const FrameRotation& after, const RecordedTurn& recorded) {
  const Eigen::Quaterniond seen = before.start_from_camera.conjugate() * after.start_from_camera;
  return after.start_from_camera * vector_of(seen.conjugate() * recorded.before_from_after);
}

double variance_of(const Eigen::Matrix3d& covariance) {
  return covariance.trace() / 3;
}

// Variance of a recorded turn: that of the differences, less what the images add.
double gyro_variance(std::span<const FrameRotation> seen, std::span<const RecordedTurn> recorded) {
  std::vector<double> sizes;
  double of_images = 0;
  for (std::size_t k = 1; k < seen.size(); ++k) {
    if (!recorded[k].is_known || !seen[k].is_linked) continue;
    const Eigen::Vector3d d = difference(seen[k - 1], seen[k], recorded[k]);
    for (int axis = 0; axis < 3; ++axis) sizes.push_back(std::abs(d(axis)));
    of_images += variance_of(seen[k].own_covariance) + variance_of(seen[k - 1].own_covariance);
  }
  if (sizes.empty()) return kUnknown_rad * kUnknown_rad;
  of_images /= static_cast<double>(sizes.size()) / 3;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double sigma = 1.4826 * *middle;
  return std::max({sigma * sigma - of_images, 0.05 * sigma * sigma, kLeastTurn_rad * kLeastTurn_rad});
}

using State =
    Eigen::Vector3d;  // what the images are off by (rotation sought less rotation seen), minus their own drift...
using Spread = Eigen::Matrix3d;

struct Estimate {
  State mean = State::Zero();
  Spread spread = Spread::Zero();
};

// One axis: (e, d, b). e: the rotation sought less the one seen; d: how far the images have drifted; b: bias.
//   between frames  e += difference - b dt;  d walks
//   at a frame      0 = e + d + noise
class AxisSmoother {
 public:
  void begin(double bias_sd) {
    Estimate first;
    first.spread(2, 2) = bias_sd * bias_sd;
    filtered_ = {first};
    predicted_ = {first};
    transitions_ = {Spread::Identity()};
  }

  void add(double step_s, double difference_rad, double turn_variance, double drift_variance, double seen_variance) {
    Spread transition = Spread::Identity();
    transition(0, 2) = -step_s;
    Estimate next;
    next.mean = transition * filtered_.back().mean;
    next.mean(0) += difference_rad;
    next.spread = transition * filtered_.back().spread * transition.transpose();
    next.spread(0, 0) += turn_variance;
    next.spread(1, 1) += drift_variance;
    next.spread(2, 2) += kBiasWalk * kBiasWalk * step_s;
    transitions_.push_back(transition);
    predicted_.push_back(next);
    const State h(1, 1, 0);
    const State gain = next.spread * h / (h.dot(next.spread * h) + seen_variance);
    next.mean -= gain * h.dot(next.mean);
    next.spread = (next.spread - gain * h.transpose() * next.spread).eval();
    next.spread = (0.5 * (next.spread + next.spread.transpose())).eval();
    filtered_.push_back(next);
  }

  [[nodiscard]] std::vector<Estimate> smoothed() const {
    std::vector<Estimate> out = filtered_;
    for (std::size_t k = out.size() - 1; k-- > 0;) {
      Spread inverse_of = predicted_[k + 1].spread;
      inverse_of.diagonal().array() += 1e-18;
      const Spread gain = filtered_[k].spread * transitions_[k + 1].transpose() * inverse_of.inverse();
      out[k].mean += gain * (out[k + 1].mean - predicted_[k + 1].mean);
      out[k].spread += gain * (out[k + 1].spread - predicted_[k + 1].spread) * gain.transpose();
    }
    return out;
  }

 private:
  std::vector<Estimate> filtered_;
  std::vector<Estimate> predicted_;
  std::vector<Spread> transitions_;
};

}  // namespace

std::vector<RecordedTurn> recorded_turns(std::span<const double> times_s, const RateIntegral& rates,
                                         const TimeOffset& offset, const Eigen::Quaterniond& camera_from_gyro,
                                         std::span<const Eigen::Quaterniond> camera_from_image) {
  constexpr double kPart_s = 0.005;  // short enough that rotation vectors add up
  std::vector<RecordedTurn> turns(times_s.size());
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    const double from_s = offset.log_time_s(times_s[k - 1]);
    const double to_s = offset.log_time_s(times_s[k]);
    if (!rates.covers(from_s, to_s) || !(to_s > from_s)) continue;
    turns[k].is_known = true;
    const int parts = static_cast<int>(std::clamp(std::ceil((to_s - from_s) / kPart_s), 1.0, 1000.0));
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    for (int i = 0; i < parts; ++i)
      turn = turn * turn_of(camera_from_gyro * rates.between(from_s + (to_s - from_s) * i / parts,
                                                             from_s + (to_s - from_s) * (i + 1) / parts));
    if (!camera_from_image.empty()) turn = camera_from_image[k - 1].conjugate() * turn * camera_from_image[k];
    turns[k].before_from_after = turn.normalized();
  }
  return turns;
}

Eigen::Quaterniond gyro_alignment(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                  const TimeOffset& offset) {
  std::vector<RayPair> pairs;
  Eigen::Vector3d mean_seen = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_recorded = Eigen::Vector3d::Zero();
  for (const SeenTurn& turn : turns) {
    const double from_s = offset.log_time_s(turn.from_s);
    const double to_s = offset.log_time_s(turn.to_s);
    if (!rates.covers(from_s, to_s)) continue;
    pairs.push_back({rates.between(from_s, to_s), turn.turn_rad});
    mean_recorded += pairs.back().before;
    mean_seen += pairs.back().after;
  }
  if (pairs.size() < 2) return Eigen::Quaterniond::Identity();
  double noise = 0;
  for (RayPair& pair : pairs) {
    pair.before -= mean_recorded / static_cast<double>(pairs.size());
    pair.after -= mean_seen / static_cast<double>(pairs.size());
    noise += (pair.after - pair.before).squaredNorm();
  }
  // Three more pairs say that the axes agree, as strongly as some noisy turns by chance could say the opposite.
  std::vector<double> weights(pairs.size(), 1);
  for (int axis = 0; axis < 3; ++axis) {
    pairs.push_back({Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Unit(axis)});
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
  std::array<AxisSmoother, 3> axes;
  for (AxisSmoother& axis : axes) axis.begin(kBiasSd_radps);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const bool known = recorded[k].is_known;
    const Eigen::Vector3d d =
        known ? difference(seen[k - 1], seen[k], recorded[k]) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const double grown = variance_of(seen[k].covariance - seen[k].own_covariance) -
                         variance_of(seen[k - 1].covariance - seen[k - 1].own_covariance);
    const double drift = seen[k].is_linked ? std::max(grown, 1e-14) : unknown;
    for (int axis = 0; axis < 3; ++axis)
      axes[static_cast<std::size_t>(axis)].add(times_s[k] - times_s[k - 1], d(axis), known ? turn_variance : unknown,
                                               drift, variance_of(seen[k].own_covariance) + 1e-14);
  }
  const std::array<std::vector<Estimate>, 3> smoothed{axes[0].smoothed(), axes[1].smoothed(), axes[2].smoothed()};
  for (std::size_t k = 0; k < out.size(); ++k) {
    Eigen::Vector3d change;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      change(static_cast<Eigen::Index>(axis)) = smoothed[axis][k].mean(0);
      covariance(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(axis)) =
          std::max(0.0, smoothed[axis][k].spread(0, 0));
    }
    out[k].start_from_camera = (turn_of(change) * seen[k].start_from_camera).normalized();
    const Eigen::Matrix3d camera_from_start = out[k].start_from_camera.conjugate().toRotationMatrix();
    out[k].covariance = camera_from_start * covariance * camera_from_start.transpose();
    if (k > 0 && recorded[k].is_known) out[k].is_linked = true;
  }
  return out;
}

}  // namespace sigs
