// SPDX-License-Identifier: MIT
#include "ego_motion/bundle.h"

#include <algorithm>
#include <cmath>

#include "base/least_squares.h"
#include "base/pose.h"
#include "base/statistics.h"

namespace sigs {

namespace {

constexpr int kOwn = 3;                     // unknowns of a landmark
constexpr int kOfFrame = 6;                 // and of a frame
constexpr double kMinInverseDepth = -0.02;  // a little below 0, lest noise about 0 become a mean above it
constexpr double kLargestInverseDepth = 50;

// The normal equations with the landmarks eliminated.
class Adjustment {
 public:
  Adjustment(Bundle& bundle, const BundleSettings& settings) : bundle_(bundle), settings_(settings) {
    first_.assign(bundle.landmarks.size() + 1, 0);
    for (const BundleObservation& o : bundle.observations) ++first_[static_cast<std::size_t>(o.landmark) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    projections_.resize(bundle.observations.size());
    span_ = glm::length(bundle.frames.back().position - bundle.frames.front().position);
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
  void project() {
    std::vector<double> lengths;
    lengths.reserve(projections_.size());
    for (std::size_t i = 0; i < projections_.size(); ++i) {
      const BundleObservation& o = bundle_.observations[i];
      const Landmark& landmark = bundle_.landmarks[static_cast<std::size_t>(o.landmark)];
      projections_[i] = projection(bundle_.frames[static_cast<std::size_t>(o.frame)], landmark, o.ray);
      if (landmark.weight > 0.1 && landmark.trust > 0.5) lengths.push_back(glm::length(projections_[i].residual));
    }
    // Three unknowns of each landmark and six of each frame take up part of the errors.
    const double all = 2 * static_cast<double>(projections_.size());
    const double unknown =
        3 * static_cast<double>(bundle_.landmarks.size()) + 6 * static_cast<double>(bundle_.frames.size());
    const double share = std::sqrt(std::max(0.2, 1 - unknown / std::max(1.0, all)));
    const double by_median = lengths.empty() ? 0 : median(std::move(lengths)) * kSigmaOfMedianLength;
    sigma_ = std::max(settings_.min_sigma_rad, std::max(min_sigma(), by_median) / share);
  }

  // Sigma if the best three tenths of all trusted observations were the best of normal errors: the median over those
  // that keep their weight can shrink with them, this cannot.
  [[nodiscard]] double min_sigma() const {
    constexpr double kShare = 0.3;
    std::vector<double> lengths;
    for (std::size_t i = 0; i < projections_.size(); ++i)
      if (bundle_.landmarks[static_cast<std::size_t>(bundle_.observations[i].landmark)].trust > 0.5)
        lengths.push_back(glm::length(projections_[i].residual));
    if (lengths.empty()) return 0;
    return quantile(std::move(lengths), kShare) / std::sqrt(-2 * std::log(1 - kShare));
  }

  void weigh(double scale) {
    scale = std::max(scale, settings_.min_scale_rad);
    constexpr double kObservation = 3;  // sigmas at which an observation has a quarter of its weight
    constexpr double kLandmark = 1.5;   // the same of a landmark's root mean square
    weights_.resize(projections_.size());
    for (std::size_t l = 0; l < bundle_.landmarks.size(); ++l) {
      double sum = 0;
      for (std::size_t i = first_[l]; i < first_[l + 1]; ++i) sum += squared_length(projections_[i].residual) / 2;
      const auto count = static_cast<double>(first_[l + 1] - first_[l]);
      const double freedom = std::max(0.5, count - 1.5) / std::max(count, 1.0);
      const double mean = count > 0 ? sum / count / freedom : 0;
      const double weight = geman_mcclure(mean, kLandmark * kLandmark * scale * scale);
      bundle_.landmarks[l].weight = weight;
      for (std::size_t i = first_[l]; i < first_[l + 1]; ++i)
        weights_[i] =
            weight * bundle_.landmarks[l].trust *
            geman_mcclure(squared_length(projections_[i].residual), 2 * kObservation * kObservation * scale * scale);
    }
  }

  void build() {
    normal_ = NormalEquations(kOfFrame * (static_cast<int>(bundle_.frames.size()) - 1));
    for (std::size_t l = 0; l < bundle_.landmarks.size(); ++l) eliminate(l);
    add_smoothness();
    add_scale();
  }

  // A landmark's equations with what is expected of its inverse depth.
  [[nodiscard]] NormalEquations expected(std::size_t l, int unknowns) const {
    const double prior = sigma_ * sigma_ / (settings_.inverse_depth_sd * settings_.inverse_depth_sd);
    NormalEquations own(unknowns);
    for (int i = 0; i < kOwn; ++i) own.add_known(i, 1e-9);
    own.add_known(kOwn - 1, prior, -bundle_.landmarks[l].inverse_depth);
    return own;
  }

  // Adds what the landmark's observations tell of the frames.
  void eliminate(std::size_t l) {
    const auto count = static_cast<int>(first_[l + 1] - first_[l]);
    NormalEquations equations = expected(l, kOwn + kOfFrame * count);
    std::array<int, kOwn + kOfFrame> places{0, 1, 2};
    std::vector<int> in_all;
    for (std::size_t i = first_[l]; i < first_[l + 1]; ++i) {
      const Projection& p = projections_[i];
      const int at = row_of(bundle_.observations[i].frame);
      for (int k = 0; k < kOfFrame; ++k) {
        places[static_cast<std::size_t>(kOwn + k)] = kOwn + static_cast<int>(in_all.size());
        in_all.push_back(at < 0 ? -1 : at + k);
      }
      for (int axis = 0; axis < 2; ++axis)
        equations.add(places, p.slopes[static_cast<std::size_t>(axis)], p.residual[axis], weights_[i]);
    }
    equations.eliminate(kOwn);
    normal_.add(equations, in_all);
  }

  // The velocity changes little from one pair of frames to the next.
  void add_smoothness() {
    for (std::size_t k = 1; k + 1 < bundle_.frames.size(); ++k) {
      const double before_s = bundle_.frames[k].time_s - bundle_.frames[k - 1].time_s;
      const double after_s = bundle_.frames[k + 1].time_s - bundle_.frames[k].time_s;
      const std::array<double, 3> factors{1 / before_s, -1 / before_s - 1 / after_s, 1 / after_s};
      glm::dvec3 change(0);
      for (std::size_t i = 0; i < 3; ++i) change += factors[i] * bundle_.frames[k - 1 + i].position;
      const double sd = settings_.acceleration_sd * std::sqrt((before_s + after_s) / 2);
      const std::size_t held = k == 1 ? 1 : 0;  // the first frame
      for (int axis = 0; axis < 3; ++axis) {
        std::array<int, 3> places{};
        for (std::size_t i = 0; i < 3; ++i) places[i] = row_of(static_cast<int>(k - 1 + i)) + 3 + axis;
        normal_.add(std::span(places).subspan(held), std::span(factors).subspan(held), -change[axis],
                    sigma_ * sigma_ / (sd * sd));
      }
    }
  }

  // The distance from the first frame to the last is held: it sets the unit of length.
  void add_scale() {
    const glm::dvec3 way = bundle_.frames.back().position - bundle_.frames.front().position;
    const double length = glm::length(way);
    if (!(length > 1e-9)) return;
    const int at = row_of(static_cast<int>(bundle_.frames.size()) - 1) + 3;
    const std::array<double, 3> along{way.x / length, way.y / length, way.z / length};
    normal_.add(std::array{at, at + 1, at + 2}, along, span_ - length, sigma_ * sigma_ / (1e-4 * span_ * span_));
  }

  // Row of the normal equations at which a frame begins; negative for the first, which is held.
  [[nodiscard]] static int row_of(int frame) { return kOfFrame * (frame - 1); }

  void step() {
    NormalEquations damped = normal_;
    damped.damp(1e-6, 1e-9);
    const std::vector<double> change = damped.solved();
    if (!std::all_of(change.begin(), change.end(), [](double c) { return std::isfinite(c); })) return;
    for (std::size_t l = 0; l < bundle_.landmarks.size(); ++l) move_landmark(l, change);
    for (std::size_t k = 1; k < bundle_.frames.size(); ++k) {
      BundleFrame& frame = bundle_.frames[k];
      const double* const d = change.data() + row_of(static_cast<int>(k));
      frame.world_from_camera = glm::normalize(frame.world_from_camera * turn_of({d[0], d[1], d[2]}));
      frame.position += glm::dvec3(d[3], d[4], d[5]);
    }
  }

  // By its own equations, in which the frames have moved.
  void move_landmark(std::size_t l, std::span<const double> change) {
    NormalEquations equations = expected(l, kOwn);
    for (std::size_t i = first_[l]; i < first_[l + 1]; ++i) {
      const int at = row_of(bundle_.observations[i].frame);
      for (int axis = 0; axis < 2; ++axis) {
        const std::span<const double> slopes = projections_[i].slopes[static_cast<std::size_t>(axis)];
        double residual = projections_[i].residual[axis];
        for (int k = 0; k < kOfFrame && at >= 0; ++k)
          residual -= slopes[static_cast<std::size_t>(kOwn + k)] * change[static_cast<std::size_t>(at + k)];
        equations.add(slopes.first(kOwn), residual, weights_[i]);
      }
    }
    const std::vector<double> d = equations.solved();
    Landmark& landmark = bundle_.landmarks[l];
    landmark.direction = glm::normalize(landmark.direction + tangents_of(landmark.direction) * glm::dvec2(d[0], d[1]));
    landmark.inverse_depth = std::clamp(landmark.inverse_depth + d[2], kMinInverseDepth, kLargestInverseDepth);
  }

  [[nodiscard]] BundleFit fit() const {
    NormalEquations damped = normal_;
    damped.damp(0, 1e-12);
    const cv::Mat_<double> inverse = damped.inverse();
    BundleFit fit{.covariances = {glm::dmat3(0)}, .sigma_rad = sigma_};
    for (int at = 0; at < inverse.rows; at += kOfFrame)
      fit.covariances.push_back(sigma_ * sigma_ * block_of(inverse, at));
    return fit;
  }

  Bundle& bundle_;
  const BundleSettings& settings_;
  double span_ = 0;
  double sigma_ = 0;
  std::vector<std::size_t> first_;  // of each landmark's observations
  std::vector<Projection> projections_;
  std::vector<double> weights_;
  NormalEquations normal_;
};

constexpr double kSkyTrust = 0.02;
constexpr double kHills_rad = 0.052;
constexpr double kSky_rad = 0.105;
constexpr double kNear = 0.015;  // inverse depth, per unit of length; some 70 seconds of flight away
constexpr std::size_t kMinNear = 15;
constexpr double kRough = 0.3;  // of the median inverse depth: what hills make it differ by

}  // namespace

Projection projection(const BundleFrame& frame, const Landmark& landmark, const glm::dvec3& ray) {
  const glm::dmat3 world_from_camera = glm::mat3_cast(frame.world_from_camera);
  const glm::dvec3 way = frame.position - landmark.reference;
  const glm::dvec3 v = (landmark.direction - landmark.inverse_depth * way) * world_from_camera;  // by the transpose
  const double length = std::max(glm::length(v), 1e-9);
  const glm::dvec3 there = v / length;
  const glm::dmat2x3 onto = tangents_of(ray);
  const glm::dmat2x3 of_landmark = tangents_of(landmark.direction);
  Projection p{.residual = -(there * onto)};
  if (glm::dot(there, ray) < 0) p.residual *= 1e3;  // behind the camera
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec3 by_v = (onto[axis] - glm::dot(onto[axis], there) * there) / length;
    const glm::dvec3 by_place = world_from_camera * by_v;
    const glm::dvec3 by_turn = glm::cross(by_v, v);
    const double depth = -landmark.inverse_depth;
    p.slopes[static_cast<std::size_t>(axis)] = {glm::dot(by_place, of_landmark[0]),
                                                glm::dot(by_place, of_landmark[1]),
                                                -glm::dot(by_place, way),
                                                by_turn.x,
                                                by_turn.y,
                                                by_turn.z,
                                                depth * by_place.x,
                                                depth * by_place.y,
                                                depth * by_place.z};
  }
  return p;
}

BundleFit adjust(Bundle& bundle, const BundleSettings& settings, CancelFlag cancel) {
  if (bundle.frames.size() < 2) return {.covariances = std::vector<glm::dmat3>(bundle.frames.size(), glm::dmat3(0))};
  return Adjustment(bundle, settings).run(cancel);
}

std::optional<glm::dvec3> ground_of(std::span<const Landmark> landmarks) {
  std::vector<const Landmark*> near;
  std::vector<double> depths;
  for (const Landmark& landmark : landmarks)
    if (landmark.weight > 0.2 && landmark.trust > 0.5 && landmark.inverse_depth > kNear) {
      near.push_back(&landmark);
      depths.push_back(landmark.inverse_depth);
    }
  if (near.size() < kMinNear) return std::nullopt;
  const double scale = kRough * median(std::move(depths));
  glm::dvec3 ground(0);
  for (int round = 0; round < 8; ++round) {
    NormalEquations equations(3);
    for (int i = 0; i < 3; ++i) equations.add_known(i, 1e-6);
    for (const Landmark* landmark : near) {
      const double miss = landmark->inverse_depth - glm::dot(ground, landmark->direction);
      const glm::dvec3& d = landmark->direction;
      equations.add(std::array{d.x, d.y, d.z}, landmark->inverse_depth,
                    round == 0 ? 1 : geman_mcclure(miss * miss, scale * scale));
    }
    const std::vector<double> found = equations.solved();
    ground = {found[0], found[1], found[2]};
  }
  if (!is_finite(ground) || !(glm::length(ground) > kNear)) return std::nullopt;
  return ground;
}

double trust_of(const std::optional<glm::dvec3>& ground, const glm::dvec3& direction) {
  if (!ground) return 1;
  const double above_rad = std::asin(std::clamp(-glm::dot(glm::normalize(*ground), direction), -1.0, 1.0));
  const double share = std::clamp((above_rad - kHills_rad) / (kSky_rad - kHills_rad), 0.0, 1.0);
  return 1 - share * (1 - kSkyTrust);
}

}  // namespace sigs
