// SPDX-License-Identifier: MIT
#include "ego_motion/gyro_fusion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ego_motion/rotation_fit.h"
#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr double kBiasSd_radps = 0.03;  // of consumer gyroscopes at the start
constexpr double kBiasWalk = 5e-5;      // rad/s in the square root of a second
constexpr double kMinTurn_rad = 1e-5;   // standard deviation of a recorded turn between frames
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
  return std::max({sigma * sigma - of_images, 0.05 * sigma * sigma, kMinTurn_rad * kMinTurn_rad});
}

// What the rotation sought is less the one seen (3), how far the images have drifted (3), both in the axes of the
// start, and the gyroscope's bias in its own axes (3).
using State = Eigen::Matrix<double, 9, 1>;
using Spread = Eigen::Matrix<double, 9, 9>;

struct FilterState {
  State mean = State::Zero();
  Spread spread = Spread::Zero();
};

// (e, d, b).
//   between frames  e += difference - R b dt, R the camera's attitude;  d and b walk
//   at a frame      0 = e + d + noise
class Smoother {
 public:
  explicit Smoother(double bias_sd) {
    FilterState first;
    first.spread.diagonal().tail<3>().setConstant(bias_sd * bias_sd);
    filtered_ = {first};
    predicted_ = {first};
    turns_ = {Eigen::Matrix3d::Zero()};
  }

  struct Step {
    double length_s = 0;
    Eigen::Matrix3d start_from_camera;
    Eigen::Vector3d difference_rad;
    double turn_variance = 0, drift_variance = 0, seen_variance = 0;
  };

  void add(const Step& step) {
    turns_.emplace_back(-step.length_s * step.start_from_camera);
    const Spread transition = transition_of(turns_.back());
    FilterState next;
    next.mean = transition * filtered_.back().mean;
    next.mean.head<3>() += step.difference_rad;
    next.spread = transition * filtered_.back().spread * transition.transpose();
    next.spread.diagonal().head<3>().array() += step.turn_variance;
    next.spread.diagonal().segment<3>(3).array() += step.drift_variance;
    next.spread.diagonal().tail<3>().array() += kBiasWalk * kBiasWalk * step.length_s;
    predicted_.push_back(next);
    const Eigen::Matrix<double, 9, 3> across = next.spread.leftCols<3>() + next.spread.middleCols<3>(3);
    const Eigen::Matrix3d seen =
        across.topRows<3>() + across.middleRows<3>(3) + Eigen::Matrix3d::Identity() * step.seen_variance;
    const Eigen::Matrix<double, 9, 3> gain = across * seen.inverse();
    next.mean -= gain * (next.mean.head<3>() + next.mean.segment<3>(3)).eval();
    next.spread -= gain * across.transpose();
    next.spread = (0.5 * (next.spread + next.spread.transpose())).eval();
    filtered_.push_back(next);
  }

  [[nodiscard]] std::vector<FilterState> smoothed() const {
    std::vector<FilterState> out = filtered_;
    for (std::size_t k = out.size() - 1; k-- > 0;) {
      Spread ahead = predicted_[k + 1].spread;
      ahead.diagonal().array() += 1e-18;
      const Spread gain = filtered_[k].spread * transition_of(turns_[k + 1]).transpose() * ahead.inverse();
      out[k].mean += gain * (out[k + 1].mean - predicted_[k + 1].mean);
      out[k].spread += gain * (out[k + 1].spread - predicted_[k + 1].spread) * gain.transpose();
    }
    return out;
  }

 private:
  static Spread transition_of(const Eigen::Matrix3d& by_bias) {
    Spread transition = Spread::Identity();
    transition.block<3, 3>(0, 6) = by_bias;
    return transition;
  }

  std::vector<FilterState> filtered_;
  std::vector<FilterState> predicted_;
  std::vector<Eigen::Matrix3d> turns_;
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
  Smoother smoother(kBiasSd_radps);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const bool known = recorded[k].is_known;
    const double grown = variance_of(seen[k].covariance - seen[k].own_covariance) -
                         variance_of(seen[k - 1].covariance - seen[k - 1].own_covariance);
    Smoother::Step step{.length_s = times_s[k] - times_s[k - 1],
                        .start_from_camera = seen[k].start_from_camera.toRotationMatrix(),
                        .difference_rad = Eigen::Vector3d::Zero(),
                        .turn_variance = known ? turn_variance : unknown,
                        .drift_variance = seen[k].is_linked ? std::max(grown, 1e-14) : unknown,
                        .seen_variance = variance_of(seen[k].own_covariance) + 1e-14};
    if (known) step.difference_rad = difference(seen[k - 1], seen[k], recorded[k]);
    smoother.add(step);
  }
  const std::vector<FilterState> smoothed = smoother.smoothed();
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Eigen::Vector3d change = smoothed[k].mean.head<3>();
    Eigen::Matrix3d covariance = smoothed[k].spread.topLeftCorner<3, 3>();
    covariance.diagonal() = covariance.diagonal().cwiseMax(0.0);
    out[k].start_from_camera = (turn_of(change) * seen[k].start_from_camera).normalized();
    const Eigen::Matrix3d camera_from_start = out[k].start_from_camera.conjugate().toRotationMatrix();
    out[k].covariance = camera_from_start * covariance * camera_from_start.transpose();
    if (k > 0 && recorded[k].is_known) out[k].is_linked = true;
  }
  return out;
}

}  // namespace sigs
