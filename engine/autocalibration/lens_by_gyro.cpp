// SPDX-License-Identifier: MIT
#include "autocalibration/lens_by_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/least_squares.h"
#include "ego_motion/attitudes.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/time_offset.h"

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

using Unknowns = std::vector<double>;

// A feature in three frames.
struct Triple {
  std::array<glm::dvec2, 3> pixel;  // before, middle, after
  std::array<double, 3> time_s;     // of the footage, of its row
  int part = 0;
};

double row_time_s(const TrackedFrame& frame, const glm::dvec2& pixel, double height_px, double readout_s) {
  return frame.time_s + readout_s * (pixel.y / std::max(1.0, height_px - 1) - 0.5);
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

glm::dvec2 place_of(const Feature& feature) {
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
      if (!is_finite((place_of(*first) + place_of(feature) + place_of(*last)))) continue;
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
          const glm::dquat& camera_from_gyro, double readout_s, const DistortionPrior& prior)
      : size_px_(tracks.size_px),
        rates_(rates),
        offset_(offset),
        camera_from_gyro_(camera_from_gyro),
        prior_(prior),
        triples_(triples_of(tracks, readout_s)) {}

  [[nodiscard]] DivisionLens lens_of(std::span<const double> u) const {
    return {.size_px = size_px_, .focal_px = std::exp(u[0]), .distortion = std::max(u[1], -0.95)};
  }

  [[nodiscard]] std::size_t triples() const { return triples_.size(); }

  // The best values, and the equations of the parts at them.
  struct Solution {
    Unknowns values;
    std::vector<NormalEquations> parts;
    double residual_px = 0;
  };
  [[nodiscard]] Solution solved(double focal_px, CancelFlag cancel) const {
    Solution solution{.values = {std::log(focal_px), prior_.mean, 0, 0, 0, 0}};
    for (int round = 0; round < kRounds && (round == 0 || !is_cancelled(cancel)); ++round) {
      fill(solution);
      NormalEquations all = known(solution.values);
      for (const NormalEquations& part : solution.parts) all.add(part);
      std::vector<double> step = all.solved();
      step[0] = std::clamp(step[0], -0.3, 0.3);
      step[1] = std::clamp(step[1], -0.2, 0.2);
      for (std::size_t i = 0; i < step.size() && round + 1 < kRounds; ++i) solution.values[i] += step[i];
    }
    return solution;
  }

  [[nodiscard]] NormalEquations known(const Unknowns& u) const {
    NormalEquations equations(kUnknowns);
    equations.add_known(1, 1 / (prior_.sd * prior_.sd), prior_.mean - u[1]);
    equations.add_known(2, 1e2);                                          // s^-2
    for (int axis = 3; axis < 6; ++axis) equations.add_known(axis, 1e2);  // rad^-2: within some degrees
    return equations;
  }

 private:
  [[nodiscard]] std::optional<glm::dvec2> predicted(const DivisionLens& lens, const Unknowns& u, const Triple& t,
                                                    std::size_t to) const {
    const double from_s = offset_.log_time_s(t.time_s[1]) + u[2];
    const double to_s = offset_.log_time_s(t.time_s[to]) + u[2];
    if (!rates_.covers(std::min(from_s, to_s), std::max(from_s, to_s))) return std::nullopt;
    const glm::dquat axes = turn_of({u[3], u[4], u[5]}) * camera_from_gyro_;
    return lens.pixel(turn_of(-(axes * rates_.between(from_s, to_s))) * lens.ray(t.pixel[1]));
  }

  // Sum of what both predictions miss.
  [[nodiscard]] std::optional<glm::dvec2> miss(const DivisionLens& lens, const Unknowns& u, const Triple& t) const {
    const auto before = predicted(lens, u, t, 0);
    const auto after = predicted(lens, u, t, 2);
    if (!before || !after) return std::nullopt;
    return t.pixel[0] + t.pixel[2] - *before - *after;
  }

  // The equations of the parts at the solution's values, with weights that give misses the variance 1.
  void fill(Solution& solution) const {
    constexpr double kChange = 1e-4;
    std::array<Unknowns, kUnknowns> moved;
    std::vector<DivisionLens> lenses;
    for (std::size_t k = 0; k < moved.size(); ++k) {
      moved[k] = solution.values;
      moved[k][k] += kChange;
      lenses.push_back(lens_of(moved[k]));
    }
    const DivisionLens lens = lens_of(solution.values);
    std::vector<std::optional<glm::dvec2>> misses;
    std::vector<double> lengths;
    for (const Triple& t : triples_) {
      misses.push_back(miss(lens, solution.values, t));
      if (misses.back()) lengths.push_back(glm::length(*misses.back()));
    }
    const double scale = scale_of(std::move(lengths), kMinScale_px);
    solution.residual_px = scale;
    solution.parts.assign(kParts, NormalEquations(kUnknowns));
    for (std::size_t i = 0; i < triples_.size(); ++i) {
      if (!misses[i]) continue;
      std::array<std::array<double, kUnknowns>, 2> slopes{};
      bool whole = true;
      for (std::size_t k = 0; k < moved.size() && whole; ++k) {
        const auto there = miss(lenses[k], moved[k], triples_[i]);
        whole = there.has_value();
        for (int axis = 0; axis < 2 && whole; ++axis)
          slopes[static_cast<std::size_t>(axis)][k] = ((*misses[i])[axis] - (*there)[axis]) / kChange;
      }
      if (!whole) continue;
      const double weight = geman_mcclure(squared_length(*misses[i]), 4 * scale * scale) / (scale * scale);
      for (int axis = 0; axis < 2; ++axis)
        solution.parts[static_cast<std::size_t>(triples_[i].part)].add(slopes[static_cast<std::size_t>(axis)],
                                                                       (*misses[i])[axis], weight);
    }
  }

  cv::Size size_px_;
  const RateIntegral& rates_;
  TimeOffset offset_;
  glm::dquat camera_from_gyro_;
  DistortionPrior prior_;
  std::vector<Triple> triples_;
};

// Turns seen by a lens, dated as the frames are.
std::vector<SeenTurn> turns_by(const DivisionLens& lens, const PixelTracks& tracks, CancelFlag cancel) {
  std::vector<FrameRays> rays;
  for (const TrackedFrame& frame : tracks.frames) {
    FrameRays seen;
    for (const Feature& feature : frame.features)
      seen.push_back({feature.id, glm::normalize(lens.ray(place_of(feature))), 0});
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
    largest = std::max(largest, glm::length(vector_of(glm::normalize(turn))));
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
  DivisionLens lens{.size_px = tracks.size_px, .focal_px = kFirstFocal * tracks.size_px.width, .distortion = 0};
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
  if (!std::ranges::all_of(solution.values, [](double v) { return std::isfinite(v); }))
    return refused(found, "the fit to the gyroscope does not converge");
  found.offset_s += solution.values[2];
  found.answer.fit = fit_of([&fit](std::span<const double> u) { return fit.lens_of(u); }, solution.values,
                            clustered_covariance(solution.parts, fit.known(solution.values)), kParts, kMinRelative);
  found.answer.fit->residual_px = solution.residual_px;
  return found;
}

}  // namespace sigs
