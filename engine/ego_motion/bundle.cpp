// SPDX-License-Identifier: MIT
#include "ego_motion/bundle.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ego_motion/turns.h"

namespace sigs {

namespace {

using Block63 = Eigen::Matrix<double, 6, 3>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kMinInverseDepth = -0.02;  // a little below 0, lest noise about 0 become a mean above it
constexpr double kLargestInverseDepth = 50;

double median_of(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double geman_mcclure(double squared, double scale_squared) {
  const double root = 1 / (1 + squared / scale_squared);
  return root * root;
}

// The normal equations with the landmarks eliminated, and what is needed to get the landmarks back.
class Adjustment {
 public:
  Adjustment(Bundle& bundle, const BundleSettings& settings) : bundle_(bundle), settings_(settings) {
    size_ = 6 * (static_cast<Eigen::Index>(bundle.frames.size()) - 1);
    first_.assign(bundle.landmarks.size() + 1, 0);
    for (const BundleObservation& o : bundle.observations) ++first_[static_cast<std::size_t>(o.landmark) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    projections_.resize(bundle.observations.size());
    span_ = (bundle.frames.back().position - bundle.frames.front().position).norm();
  }

  BundleFit run(CancelFlag cancel) {
    project();
    double scale = settings_.start_sigma_rad;
    for (int round = 0; round < settings_.rounds && !is_cancelled(cancel); ++round) {
      scale = std::max(sigma_, scale * 0.6);
      weigh(scale);
      build();
      step();
      project();
    }
    weigh(sigma_);
    build();
    return fit();
  }

 private:
  [[nodiscard]] std::span<const BundleObservation> observations_of(std::size_t landmark) const {
    return std::span(bundle_.observations).subspan(first_[landmark], first_[landmark + 1] - first_[landmark]);
  }

  void project() {
    std::vector<double> lengths;
    lengths.reserve(projections_.size());
    for (std::size_t i = 0; i < projections_.size(); ++i) {
      const BundleObservation& o = bundle_.observations[i];
      const Landmark& landmark = bundle_.landmarks[static_cast<std::size_t>(o.landmark)];
      projections_[i] = projection(bundle_.frames[static_cast<std::size_t>(o.frame)], landmark, o.ray);
      if (landmark.weight > 0.1 && landmark.trust > 0.5) lengths.push_back(projections_[i].residual.norm());
    }
    constexpr double kSigmaOfMedian = 0.8493218;  // 1 / sqrt(2 ln 2), lengths of normal errors in two directions
    // Three unknowns of each landmark and six of each frame take up part of the errors.
    const double all = 2 * static_cast<double>(projections_.size());
    const double unknown =
        3 * static_cast<double>(bundle_.landmarks.size()) + 6 * static_cast<double>(bundle_.frames.size());
    const double share = std::sqrt(std::max(0.2, 1 - unknown / std::max(1.0, all)));
    sigma_ = std::max(settings_.min_sigma_rad, std::max(min_sigma(), median_of(lengths) * kSigmaOfMedian) / share);
  }

  // Sigma if the best three tenths of all trusted observations were the best of normal errors: the median over those
  // that keep their weight can shrink with them, this cannot.
  [[nodiscard]] double min_sigma() const {
    constexpr double kShare = 0.3;
    std::vector<double> lengths;
    for (std::size_t i = 0; i < projections_.size(); ++i)
      if (bundle_.landmarks[static_cast<std::size_t>(bundle_.observations[i].landmark)].trust > 0.5)
        lengths.push_back(projections_[i].residual.norm());
    if (lengths.empty()) return 0;
    const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(lengths.size()));
    std::nth_element(lengths.begin(), at, lengths.end());
    return *at / std::sqrt(-2 * std::log(1 - kShare));
  }

  void weigh(double scale) {
    scale = std::max(scale, settings_.min_scale_rad);
    constexpr double kObservation = 3;  // sigmas at which an observation has a quarter of its weight
    constexpr double kLandmark = 1.5;   // the same of a landmark's root mean square
    weights_.resize(projections_.size());
    for (std::size_t l = 0; l < bundle_.landmarks.size(); ++l) {
      double sum = 0;
      for (std::size_t i = first_[l]; i < first_[l + 1]; ++i) sum += projections_[i].residual.squaredNorm() / 2;
      const auto count = static_cast<double>(first_[l + 1] - first_[l]);
      const double freedom = std::max(0.5, count - 1.5) / std::max(count, 1.0);
      const double mean = count > 0 ? sum / count / freedom : 0;
      const double weight = geman_mcclure(mean, kLandmark * kLandmark * scale * scale);
      bundle_.landmarks[l].weight = weight;
      for (std::size_t i = first_[l]; i < first_[l + 1]; ++i)
        weights_[i] =
            weight * bundle_.landmarks[l].trust *
            geman_mcclure(projections_[i].residual.squaredNorm(), 2 * kObservation * kObservation * scale * scale);
    }
  }

  void build() {
    normal_ = Eigen::MatrixXd::Zero(size_, size_);
    right_ = Eigen::VectorXd::Zero(size_);
    inverses_.resize(bundle_.landmarks.size());
    rights_.resize(bundle_.landmarks.size());
    for (std::size_t l = 0; l < bundle_.landmarks.size(); ++l) eliminate(l);
    add_smoothness();
    add_scale();
    normal_.triangularView<Eigen::StrictlyUpper>() = normal_.transpose();
  }

  // Adds what the landmark's observations tell of the frames. Only the lower triangle is filled.
  void eliminate(std::size_t l) {
    const double prior = sigma_ * sigma_ / (settings_.inverse_depth_sd * settings_.inverse_depth_sd);
    Eigen::Matrix3d own = Eigen::Matrix3d::Identity() * 1e-9;
    own(2, 2) += prior;
    Eigen::Vector3d right(0, 0, -prior * bundle_.landmarks[l].inverse_depth);
    mixed_.clear();
    for (std::size_t i = first_[l]; i < first_[l + 1]; ++i) {
      const Projection& p = projections_[i];
      const double w = weights_[i];
      own += w * p.by_landmark.transpose() * p.by_landmark;
      right += w * p.by_landmark.transpose() * p.residual;
      const Eigen::Index at = 6 * (static_cast<Eigen::Index>(bundle_.observations[i].frame) - 1);
      if (at < 0) continue;
      normal_.block<6, 6>(at, at) += w * p.by_frame.transpose() * p.by_frame;
      right_.segment<6>(at) += w * p.by_frame.transpose() * p.residual;
      mixed_.emplace_back(at, w * p.by_frame.transpose() * p.by_landmark);
    }
    inverses_[l] = own.inverse();
    rights_[l] = right;
    for (const auto& [at, mixed] : mixed_) {
      const Block63 reduced = mixed * inverses_[l];
      right_.segment<6>(at) -= reduced * right;
      for (const auto& [other_at, other] : mixed_)
        if (other_at <= at) normal_.block<6, 6>(at, other_at) -= reduced * other.transpose();
    }
  }

  // The velocity changes little from one pair of frames to the next.
  void add_smoothness() {
    for (std::size_t k = 1; k + 1 < bundle_.frames.size(); ++k) {
      const double before_s = bundle_.frames[k].time_s - bundle_.frames[k - 1].time_s;
      const double after_s = bundle_.frames[k + 1].time_s - bundle_.frames[k].time_s;
      const std::array<double, 3> factors{1 / before_s, -1 / before_s - 1 / after_s, 1 / after_s};
      Eigen::Vector3d change = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 3; ++i) change += factors[i] * bundle_.frames[k - 1 + i].position;
      const double sd = settings_.acceleration_sd * std::sqrt((before_s + after_s) / 2);
      const double weight = sigma_ * sigma_ / (sd * sd);
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Index at = place(k - 1 + i);
        if (at < 0) continue;
        right_.segment<3>(at) -= weight * factors[i] * change;
        for (std::size_t j = 0; j <= i; ++j)
          if (const Eigen::Index to = place(k - 1 + j); to >= 0)
            normal_.block<3, 3>(at, to) += weight * factors[i] * factors[j] * Eigen::Matrix3d::Identity();
      }
    }
  }

  // The distance from the first frame to the last is held: it sets the unit of length.
  void add_scale() {
    const Eigen::Vector3d way = bundle_.frames.back().position - bundle_.frames.front().position;
    if (!(way.norm() > 1e-9)) return;
    const Eigen::Vector3d along = way.normalized();
    const double weight = sigma_ * sigma_ / (1e-4 * span_ * span_);
    const Eigen::Index at = place(bundle_.frames.size() - 1);
    normal_.block<3, 3>(at, at) += weight * along * along.transpose();
    right_.segment<3>(at) += weight * (span_ - way.norm()) * along;
  }

  // Row of the normal equations at which the position of frame k begins; negative for the first, which is held.
  [[nodiscard]] static Eigen::Index place(std::size_t k) {
    return k == 0 ? -1 : 6 * (static_cast<Eigen::Index>(k) - 1) + 3;
  }

  void step() {
    Eigen::MatrixXd damped = normal_;
    damped.diagonal().array() += 1e-9 + 1e-6 * normal_.diagonal().array();
    const Eigen::VectorXd change = damped.ldlt().solve(right_);
    if (!change.allFinite()) return;
    for (std::size_t l = 0; l < bundle_.landmarks.size(); ++l) move_landmark(l, change);
    for (std::size_t k = 1; k < bundle_.frames.size(); ++k) {
      BundleFrame& frame = bundle_.frames[k];
      const Vector6 d = change.segment<6>(6 * (static_cast<Eigen::Index>(k) - 1));
      frame.world_from_camera = (frame.world_from_camera * turn_of(d.head<3>())).normalized();
      frame.position += d.tail<3>();
    }
  }

  void move_landmark(std::size_t l, const Eigen::VectorXd& change) {
    Eigen::Vector3d right = rights_[l];
    for (std::size_t i = first_[l]; i < first_[l + 1]; ++i) {
      const Eigen::Index at = 6 * (static_cast<Eigen::Index>(bundle_.observations[i].frame) - 1);
      if (at < 0) continue;
      const Projection& p = projections_[i];
      right -= weights_[i] * p.by_landmark.transpose() * (p.by_frame * change.segment<6>(at));
    }
    const Eigen::Vector3d d = inverses_[l] * right;
    Landmark& landmark = bundle_.landmarks[l];
    landmark.direction = (landmark.direction + tangents_of(landmark.direction) * d.head<2>()).normalized();
    landmark.inverse_depth = std::clamp(landmark.inverse_depth + d(2), kMinInverseDepth, kLargestInverseDepth);
  }

  [[nodiscard]] BundleFit fit() const {
    Eigen::MatrixXd damped = normal_;
    damped.diagonal().array() += 1e-12;
    const Eigen::MatrixXd inverse = damped.ldlt().solve(Eigen::MatrixXd::Identity(size_, size_));
    BundleFit fit{.covariances = {Eigen::Matrix3d::Zero()}, .sigma_rad = sigma_};
    for (Eigen::Index at = 0; at < size_; at += 6)
      fit.covariances.emplace_back(sigma_ * sigma_ * inverse.block<3, 3>(at, at));
    return fit;
  }

  Bundle& bundle_;
  const BundleSettings& settings_;
  Eigen::Index size_ = 0;
  double span_ = 0;
  double sigma_ = 0;
  std::vector<std::size_t> first_;  // of each landmark's observations
  std::vector<Projection> projections_;
  std::vector<double> weights_;
  std::vector<std::pair<Eigen::Index, Block63>> mixed_;
  std::vector<Eigen::Matrix3d> inverses_;
  std::vector<Eigen::Vector3d> rights_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_;
};

}  // namespace

Projection projection(const BundleFrame& frame, const Landmark& landmark, const Eigen::Vector3d& ray) {
  const Eigen::Matrix3d camera_from_world = frame.world_from_camera.toRotationMatrix().transpose();
  const Eigen::Vector3d way = frame.position - landmark.reference;
  const Eigen::Vector3d v = camera_from_world * (landmark.direction - landmark.inverse_depth * way);
  const double length = std::max(v.norm(), 1e-9);
  const Eigen::Vector3d there = v / length;
  const Eigen::Matrix<double, 2, 3> onto = tangents_of(ray).transpose();
  const Eigen::Matrix<double, 2, 3> by_v = onto * (Eigen::Matrix3d::Identity() - there * there.transpose()) / length;
  Projection p;
  p.residual = -(onto * there);
  if (there.dot(ray) < 0) p.residual *= 1e3;  // behind the camera
  p.by_frame.leftCols<3>() = by_v * cross_matrix(v);
  p.by_frame.rightCols<3>() = -landmark.inverse_depth * by_v * camera_from_world;
  p.by_landmark.leftCols<2>() = by_v * (camera_from_world * tangents_of(landmark.direction));
  p.by_landmark.col(2) = -by_v * (camera_from_world * way);
  return p;
}

BundleFit adjust(Bundle& bundle, const BundleSettings& settings, CancelFlag cancel) {
  if (bundle.frames.size() < 2)
    return {.covariances = std::vector<Eigen::Matrix3d>(bundle.frames.size(), Eigen::Matrix3d::Zero())};
  return Adjustment(bundle, settings).run(cancel);
}

namespace {

constexpr double kSkyTrust = 0.02;
constexpr double kHills_rad = 0.052;
constexpr double kSky_rad = 0.105;
constexpr double kNear = 0.015;  // inverse depth, per unit of length; some 70 seconds of flight away
constexpr std::size_t kMinNear = 15;
constexpr double kRough = 0.3;  // of the median inverse depth: what hills make it differ by

}  // namespace

std::optional<Eigen::Vector3d> ground_of(std::span<const Landmark> landmarks) {
  std::vector<const Landmark*> near;
  std::vector<double> depths;
  for (const Landmark& landmark : landmarks)
    if (landmark.weight > 0.2 && landmark.trust > 0.5 && landmark.inverse_depth > kNear) {
      near.push_back(&landmark);
      depths.push_back(landmark.inverse_depth);
    }
  if (near.size() < kMinNear) return std::nullopt;
  const double scale = kRough * median_of(depths);
  Eigen::Vector3d ground = Eigen::Vector3d::Zero();
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-6;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Landmark* landmark : near) {
      const double miss = round == 0 ? 0 : (landmark->inverse_depth - ground.dot(landmark->direction)) / scale;
      const double root = 1 / (1 + miss * miss);
      normal += root * root * landmark->direction * landmark->direction.transpose();
      right += root * root * landmark->inverse_depth * landmark->direction;
    }
    ground = normal.ldlt().solve(right);
  }
  if (!ground.allFinite() || !(ground.norm() > kNear)) return std::nullopt;
  return ground;
}

double trust_of(const std::optional<Eigen::Vector3d>& ground, const Eigen::Vector3d& direction) {
  if (!ground) return 1;
  const double above_rad = std::asin(std::clamp(-ground->normalized().dot(direction), -1.0, 1.0));
  const double share = std::clamp((above_rad - kHills_rad) / (kSky_rad - kHills_rad), 0.0, 1.0);
  return 1 - share * (1 - kSkyTrust);
}

}  // namespace sigs
