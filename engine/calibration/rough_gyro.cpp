// SPDX-License-Identifier: MIT
#include "calibration/rough_motion.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "ego_motion/attitudes.h"
#include "ego_motion/gyro_fusion.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/time_offset.h"
#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr double kFirstFocal = 0.8;  // of the image's width
constexpr int kFirstRounds = 4;
constexpr double kMinCorrelation = 0.85;
constexpr double kSpan_s = 0.2;  // from the middle frame to either side
constexpr int kMiddles = 240;    // frames from which features are followed
constexpr int kParts = 12;
constexpr int kMinFeatures = 20;
constexpr std::size_t kFeaturesEach = 60;
constexpr int kRounds = 8;
constexpr double kMinScale_px = 0.05;
constexpr double kMinRelative = 0.008;  // the scale of cheap gyroscopes
constexpr double kStabilized_rad = 0.0017;
constexpr int kUnknowns = 6;  // ln focal, distortion, offset, turn of the gyroscope's axes

using Unknowns = Eigen::VectorXd;

// A feature in three frames.
struct Triple {
  std::array<Eigen::Vector2d, 3> pixel;  // before, middle, after
  std::array<double, 3> time_s;          // of the footage, of its row
  int part = 0;
};

double row_time_s(const TrackedFrame& frame, const Eigen::Vector2d& pixel, double height_px, double readout_s) {
  return frame.time_s + readout_s * (pixel.y() / std::max(1.0, height_px - 1) - 0.5);
}

// The frame nearest to a time in the same stretch; -1: none within half of the span.
int frame_near(const PixelTracks& tracks, int middle, double time_s) {
  const auto& frames = tracks.frames;
  const auto after = std::lower_bound(frames.begin(), frames.end(), time_s,
                                      [](const TrackedFrame& f, double t) { return f.time_s < t; });
  int best = -1;
  for (auto at = after - std::min<std::ptrdiff_t>(1, after - frames.begin()); at != frames.end() && at <= after; ++at)
    if (at->stretch == frames[static_cast<std::size_t>(middle)].stretch &&
        std::abs(at->time_s - time_s) < kSpan_s / 2 &&
        (best < 0 || std::abs(at->time_s - time_s) < std::abs(frames[static_cast<std::size_t>(best)].time_s - time_s)))
      best = static_cast<int>(at - frames.begin());
  return best == middle ? -1 : best;
}

const Feature* feature_of(const TrackedFrame& frame, int id) {
  const auto at = std::lower_bound(frame.features.begin(), frame.features.end(), id,
                                   [](const Feature& f, int wanted) { return f.id < wanted; });
  return at != frame.features.end() && at->id == id ? &*at : nullptr;
}

Eigen::Vector2d place_of(const Feature& feature) {
  return {feature.pixel_px.x, feature.pixel_px.y};
}

std::vector<Triple> triples_of(const PixelTracks& tracks, double readout_s) {
  std::vector<Triple> triples;
  const int count = static_cast<int>(tracks.frames.size());
  const int every = std::max(1, count / kMiddles);
  for (int m = 0; m < count; m += every) {
    const TrackedFrame& middle = tracks.frames[static_cast<std::size_t>(m)];
    const int b = frame_near(tracks, m, middle.time_s - kSpan_s);
    const int a = frame_near(tracks, m, middle.time_s + kSpan_s);
    if (b < 0 || a < 0 || middle.is_repeated) continue;
    const TrackedFrame& before = tracks.frames[static_cast<std::size_t>(b)];
    const TrackedFrame& after = tracks.frames[static_cast<std::size_t>(a)];
    if (before.is_repeated || after.is_repeated) continue;
    const std::size_t stride = middle.features.size() / kFeaturesEach + 1;
    for (std::size_t f = 0; f < middle.features.size(); f += stride) {
      const Feature& feature = middle.features[f];
      const Feature* const first = feature_of(before, feature.id);
      const Feature* const last = feature_of(after, feature.id);
      if (first == nullptr || last == nullptr) continue;
      if (!(place_of(*first) + place_of(feature) + place_of(*last)).allFinite()) continue;
      Triple triple{.pixel = {place_of(*first), place_of(feature), place_of(*last)}, .part = m * kParts / count};
      triple.time_s = {row_time_s(before, triple.pixel[0], tracks.size_px.height, readout_s),
                       row_time_s(middle, triple.pixel[1], tracks.size_px.height, readout_s),
                       row_time_s(after, triple.pixel[2], tracks.size_px.height, readout_s)};
      triples.push_back(triple);
    }
  }
  return triples;
}

class GyroFit {
 public:
  GyroFit(const PixelTracks& tracks, const RateIntegral& rates, const TimeOffset& offset,
          const Eigen::Quaterniond& camera_from_gyro, double readout_s, const DistortionPrior& prior)
      : size_px_(tracks.size_px),
        rates_(rates),
        offset_(offset),
        camera_from_gyro_(camera_from_gyro),
        prior_(prior),
        triples_(triples_of(tracks, readout_s)) {}

  [[nodiscard]] RoughLens lens_of(const Unknowns& u) const {
    return {.size_px = size_px_, .focal_px = std::exp(u(0)), .distortion = std::max(u(1), -0.95)};
  }

  [[nodiscard]] std::size_t triples() const { return triples_.size(); }

  // The best values, and the sums of the parts at them.
  struct Solution {
    Unknowns values;
    std::vector<PartSums> parts;
    double residual_px = 0;
  };
  [[nodiscard]] Solution solved(double focal_px, CancelFlag cancel) const {
    Solution solution{.values = Unknowns::Zero(kUnknowns)};
    solution.values(0) = std::log(focal_px);
    solution.values(1) = prior_.mean;
    for (int round = 0; round < kRounds && (round == 0 || !is_cancelled(cancel)); ++round) {
      fill(solution);
      Eigen::MatrixXd normal = known();
      Eigen::VectorXd right = Eigen::VectorXd::Zero(kUnknowns);
      right(1) = (prior_.mean - solution.values(1)) * known()(1, 1);
      for (const PartSums& part : solution.parts) {
        normal += part.normal;
        right += part.right;
      }
      Eigen::VectorXd step = normal.ldlt().solve(right);
      step(0) = std::clamp(step(0), -0.3, 0.3);
      step(1) = std::clamp(step(1), -0.2, 0.2);
      if (round + 1 < kRounds) solution.values += step;
    }
    return solution;
  }

  [[nodiscard]] Eigen::MatrixXd known() const {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
    normal(1, 1) = 1 / (prior_.sd * prior_.sd);
    normal.diagonal().tail<3>().setConstant(1e2);  // rad^-2: axes are within some degrees of the first values
    normal(2, 2) = 1e2;                            // s^-2
    return normal;
  }

 private:
  [[nodiscard]] std::optional<Eigen::Vector2d> predicted(const RoughLens& lens, const Unknowns& u, const Triple& t,
                                                         std::size_t to) const {
    const double from_s = offset_.log_time_s(t.time_s[1]) + u(2);
    const double to_s = offset_.log_time_s(t.time_s[to]) + u(2);
    if (!rates_.covers(std::min(from_s, to_s), std::max(from_s, to_s))) return std::nullopt;
    const Eigen::Quaterniond axes = turn_of(Eigen::Vector3d(u.tail<3>())) * camera_from_gyro_;
    return lens.pixel(turn_of(-(axes * rates_.between(from_s, to_s))) * lens.ray(t.pixel[1]));
  }

  // Sum of what both predictions miss.
  [[nodiscard]] std::optional<Eigen::Vector2d> miss(const RoughLens& lens, const Unknowns& u, const Triple& t) const {
    const auto before = predicted(lens, u, t, 0);
    const auto after = predicted(lens, u, t, 2);
    if (!before || !after) return std::nullopt;
    return Eigen::Vector2d(t.pixel[0] + t.pixel[2] - *before - *after);
  }

  // The sums of the parts at the solution's values. A part's weights are scaled so that its misses have the variance 1.
  void fill(Solution& solution) const {
    constexpr std::array<double, kUnknowns> kSteps{1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4};
    const RoughLens lens = lens_of(solution.values);
    std::vector<std::optional<Eigen::Vector2d>> misses;
    std::vector<double> lengths;
    for (const Triple& t : triples_) {
      misses.push_back(miss(lens, solution.values, t));
      if (misses.back()) lengths.push_back(misses.back()->norm());
    }
    const double scale = scale_of(lengths, kMinScale_px);
    solution.residual_px = scale;
    solution.parts.assign(kParts, {Eigen::MatrixXd::Zero(kUnknowns, kUnknowns), Eigen::VectorXd::Zero(kUnknowns)});
    for (std::size_t i = 0; i < triples_.size(); ++i) {
      if (!misses[i]) continue;
      Eigen::Matrix<double, 2, kUnknowns> slope;
      bool whole = true;
      for (int k = 0; k < kUnknowns && whole; ++k) {
        Unknowns moved = solution.values;
        moved(k) += kSteps[static_cast<std::size_t>(k)];
        const auto there = miss(lens_of(moved), moved, triples_[i]);
        whole = there.has_value();
        if (whole) slope.col(k) = (*misses[i] - *there) / kSteps[static_cast<std::size_t>(k)];
      }
      if (!whole) continue;
      const double weight = weight_of(misses[i]->squaredNorm(), 2 * scale) / (scale * scale);
      PartSums& part = solution.parts[static_cast<std::size_t>(triples_[i].part)];
      part.normal += weight * slope.transpose() * slope;
      part.right += weight * slope.transpose() * *misses[i];
    }
  }

  cv::Size size_px_;
  const RateIntegral& rates_;
  TimeOffset offset_;
  Eigen::Quaterniond camera_from_gyro_;
  DistortionPrior prior_;
  std::vector<Triple> triples_;
};

// Turns seen by a lens, dated as the frames are.
std::vector<SeenTurn> turns_by(const RoughLens& lens, const PixelTracks& tracks, CancelFlag cancel) {
  std::vector<FrameRays> rays;
  for (const TrackedFrame& frame : tracks.frames) {
    FrameRays seen;
    for (const Feature& feature : frame.features)
      seen.push_back({feature.id, lens.ray(place_of(feature)).normalized(), 0});
    rays.push_back(std::move(seen));
  }
  const auto steps = steps_between(rays, tracks.step_px / lens.focal_px, {}, cancel);
  std::vector<SeenTurn> turns;
  for (std::size_t k = 1; k < steps.size(); ++k)
    if (steps[k] && !tracks.frames[k].is_repeated && tracks.frames[k].time_s > tracks.frames[k - 1].time_s)
      turns.push_back({tracks.frames[k - 1].time_s, tracks.frames[k].time_s, -vector_of(steps[k]->after_from_before)});
  return turns;
}

// How far the camera turned its images itself, at most.
double stabilized_rad(const Track& log) {
  double largest = 0;
  for (const glm::dquat& turn : log.camera_from_image.values)
    largest = std::max(largest, vector_of(eigen_of(turn).normalized()).norm());
  return largest;
}

GyroAnswer refused(GyroAnswer answer, std::string reason) {
  answer.answer = {.fit = std::nullopt, .reason = std::move(reason)};
  return answer;
}

}  // namespace

GyroAnswer lens_by_gyro(const PixelTracks& tracks, const Track& log, const DistortionPrior& prior, CancelFlag cancel) {
  GyroAnswer found;
  const bool is_cameras = !log.camera_rate_radps.empty();
  const Channel<glm::dvec3>& channel = is_cameras ? log.camera_rate_radps : log.airframe_rate_radps;
  if (channel.empty()) return refused(found, "the log has no angular rates");
  found.source = channel.source;
  if (stabilized_rad(log) > kStabilized_rad) return refused(found, "the camera stabilised its images");
  const RateIntegral rates(channel);
  RoughLens lens{.size_px = tracks.size_px, .focal_px = kFirstFocal * tracks.size_px.width, .distortion = 0};
  std::vector<SeenTurn> turns;
  std::optional<TimeOffset> offset;
  for (int round = 0; round < kFirstRounds; ++round) {
    turns = turns_by(lens, tracks, cancel);
    offset = time_offset(turns, rates, log.on_footage_time ? 1 : 10, {.cancel = cancel});
    if (!offset) return refused(found, "too few of the footage's frames lie in the log's time");
    found.offset_s = offset->offset_s;
    found.offset_sd_s = offset->offset_sd_s;
    found.correlation = offset->correlation;
    if (offset->correlation < kMinCorrelation)
      return refused(found, fmt::format("the images do not follow the gyroscope (correlation {:.2f}): stabilised, on a "
                                        "gimbal, another flight, or hardly a turn",
                                        offset->correlation));
    lens.focal_px *= std::clamp(offset->slope, 0.3, 3.0);
    if (std::abs(offset->slope - 1) < 0.03) break;
  }
  const GyroFit fit(tracks, rates, *offset, gyro_alignment(turns, rates, *offset), log.readout_s.value_or(0), prior);
  if (fit.triples() < kMinFeatures * kParts) return refused(found, "too few features can be followed");
  const GyroFit::Solution solution = fit.solved(lens.focal_px, cancel);
  if (!solution.values.allFinite()) return refused(found, "the fit to the gyroscope does not converge");
  found.offset_s += solution.values(2);
  found.answer.fit = fit_of([&fit](const Eigen::VectorXd& u) { return fit.lens_of(u); }, solution.values,
                            clustered_covariance(solution.parts, fit.known()), kParts, kMinRelative);
  found.answer.fit->residual_px = solution.residual_px;
  return found;
}

}  // namespace sigs
