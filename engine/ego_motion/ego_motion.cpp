// SPDX-License-Identifier: MIT
#include "ego_motion/ego_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pose.h"
#include "base/threads.h"
#include "ego_motion/attitudes.h"
#include "ego_motion/features.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/time_offset.h"
#include "horizon/horizon.h"

namespace sigs {

namespace {

constexpr int kHorizonEvery = 10;           // frames
constexpr double kMinCorrelation = 0.7;     // below it log and footage are not of the same flight
constexpr double kFocalLimits = 0.2;        // width of the limits that a focal length by gyroscope is taken within
constexpr double kStabilized_rad = 0.0017;  // 0.1 degrees turned by the camera itself
// The share of the work that is done when all features are followed, and when the log is compared.
constexpr double kFollowed = 0.8;
constexpr double kCompared = 0.85;

// What one pass over the footage gives.
struct Seen {
  std::vector<FrameRays> rays;
  std::vector<bool> repeated;
  std::vector<int> damaged;
  std::vector<HorizonLine> lines;
  double pixel_rad = 1e-3;  // of the reduced image
};

class Estimate {
 public:
  Estimate(FrameSource& footage, const Camera& camera, const cv::Mat& own_body, const Track* telemetry,
           const EgoMotionSettings& settings, const EgoMotionControl& control)
      : footage_(footage),
        camera_(camera),
        own_body_(own_body),
        telemetry_(telemetry),
        settings_(settings),
        control_(control),
        path_(footage.info().path.string()),
        times_s_(footage.info().times_s) {}

  Result<EgoMotion> run() {
    if (const Result<void> good = check(); !good) return fail(good.error());
    if (const Result<void> passed = pass(); !passed) return fail(passed.error());
    const double readout_s =
        settings_.readout_s.value_or(telemetry_ != nullptr && telemetry_->readout_s ? *telemetry_->readout_s : 0.0);
    compare_with_lens();
    if (is_cancelled(control_.cancel)) return fail(interrupted());
    compare_with_gyro(readout_s);
    if (is_cancelled(control_.cancel)) return fail(interrupted());
    std::vector<FrameRotation> rotations = seen_rotations(readout_s);
    if (is_cancelled(control_.cancel)) return fail(interrupted());
    scale_deviations(rotations);
    const std::vector<FrameRotation> of_images = rotations;
    if (motion_.gyro && motion_.gyro->is_fused) rotations = fused(rotations, times_s_, recorded_);
    fill(of_images, rotations);
    add_low_confidence_frames(motion_, path_);
    report(1);
    return std::move(motion_);
  }

 private:
  [[nodiscard]] static Error interrupted() { return {"", "interrupted; nothing was written", ErrorKind::interrupted}; }

  // share  of the whole work
  void report(double share) const {
    const int total = footage_.info().frame_count();
    if (control_.progress) control_.progress(std::clamp(static_cast<int>(share * total), 1, total), total);
  }

  // The control of a step that is the part of the work between two shares.
  [[nodiscard]] StepControl step(double from, double to) const {
    return {.cancel = control_.cancel,
            .progress = [this, from, to](double share) { report(from + share * (to - from)); }};
  }

  [[nodiscard]] Result<void> check() const {
    const VideoInfo& info = footage_.info();
    if (info.frame_count() < 2) return fail(path_, "has 1 frame; at least 2 are needed to see how the camera turns");
    if (camera_.size_px != info.size_px)
      return fail(path_, fmt::format("has frames of {}x{} px, the calibration is of {}x{}", info.size_px.width,
                                     info.size_px.height, camera_.size_px.width, camera_.size_px.height));
    if (!own_body_.empty() && (own_body_.type() != CV_8UC1 || own_body_.size() != info.size_px))
      return fail(path_, "the own body's mask is not an 8-bit grey image of the footage's size");
    const EgoMotionSettings& s = settings_;
    if (s.features < 20 || s.max_width_px < 64 || s.key_every < 2 || s.min_features < 4 || s.window_overlap < 2 ||
        s.window_keys < 2 * s.window_overlap || !(s.sd_factor > 0) || !(s.sd_growth >= 0) || !(s.sd_walk_px >= 0) ||
        (s.readout_s && !(*s.readout_s >= 0 && *s.readout_s <= 1)))
      return fail(path_, "a setting of the estimation is out of its range", ErrorKind::usage);
    return {};
  }

  Result<void> pass() {
    const int count = footage_.info().frame_count();
    FeatureTracker tracker(footage_.info().size_px, own_body_, settings_);
    seen_.pixel_rad = tracker.scale() / std::max(1e-9, camera_.lens.pixels_per_radian({1, 0, 0}));
    LumaStream stream(footage_, {.first = 0, .every = 1, .count = count});
    for (int n = 0; n < count; ++n) {
      if (is_cancelled(control_.cancel)) return fail(interrupted());
      const std::optional<Result<LumaFrame>> frame = stream.next();
      if (!frame) break;
      if (!*frame) return fail(frame->error());
      add(n, **frame, tracker);
      report(kFollowed * (n + 1) / count);
    }
    if (seen_.rays.size() != times_s_.size()) return fail(path_, "ended before its last frame");
    return {};
  }

  void add(int n, const LumaFrame& frame, FeatureTracker& tracker) {
    FrameRays rays;
    const double height = std::max(1, camera_.size_px.height - 1);
    for (const Feature& feature : tracker.next(frame.luma)) {
      const glm::dvec2 pixel(feature.pixel_px.x, feature.pixel_px.y);
      if (const auto ray = camera_.lens.ray(pixel)) rays.push_back({feature.id, *ray, pixel.y / height - 0.5});
    }
    seen_.rays.push_back(std::move(rays));
    seen_.repeated.push_back(tracker.is_repeated());
    if (frame.damaged) seen_.damaged.push_back(n);
    if (settings_.use_horizon && n % kHorizonEvery == 0)
      if (const auto line = horizon_in(tracker.reduced(), tracker.scale(), camera_, own_body_, n))
        seen_.lines.push_back(*line);
  }

  // Turns from frame to frame, those of repeated frames left out.
  [[nodiscard]] std::vector<SeenTurn> seen_turns() const {
    std::vector<SeenTurn> turns;
    for (std::size_t k = 1; k < steps_.size(); ++k)
      if (steps_[k] && !seen_.repeated[k] && times_s_[k] > times_s_[k - 1])
        turns.push_back({times_s_[k - 1], times_s_[k], -vector_of(steps_[k]->after_from_before)});
    return turns;
  }

  void compare_with_gyro(double readout_s) {
    if (telemetry_ == nullptr) return;
    read_stabilization();
    if (!settings_.use_gyro || telemetry_->camera_rate_radps.empty()) return;
    steps_ = steps_between(seen_.rays, seen_.pixel_rad, settings_, control_.cancel);
    rates_.emplace(telemetry_->camera_rate_radps);
    if (!link_gyro(step(kFollowed, kCompared))) {
      warn("the gyroscope's log cannot be compared with the images: too few frames with features in common with it");
      return;
    }
    if (settings_.fits_focal_length && camera_.lens.is_pinhole() && stabilization_.empty()) fit_focal_length_by_gyro();
    const auto fitting = focal_scale_by_gyro(seen_turns(), *rates_, offset_, camera_from_gyro_);
    if (const std::string what = disagreement_with_gyro(*motion_.gyro, fitting, camera_);
        !what.empty() && !(motion_.gyro->is_fused && !stabilization_.empty()))
      warn(what);
    if (readout_s > 0 && motion_.gyro->is_fused && stabilization_.empty()) unroll_by_gyro(readout_s);
    recorded_ = recorded_turns(times_s_, *rates_, offset_, camera_from_gyro_, stabilization_);
  }

  // Offset, drift and axes of the gyroscope by the turns seen. False where they cannot be compared.
  bool link_gyro(const StepControl& control) {
    const RateIntegral& rates = *rates_;
    const std::vector<SeenTurn> turns = seen_turns();
    constexpr double kSameAxis_s = 1;
    constexpr double kOtherAxis_s = 10;
    const auto offset = time_offset(turns, rates, telemetry_->on_footage_time ? kSameAxis_s : kOtherAxis_s, control);
    if (!offset) return false;
    motion_.gyro = GyroLink{.offset_s = offset->offset_s,
                            .offset_sd_s = offset->offset_sd_s,
                            .drift = offset->drift,
                            .drift_sd = offset->drift_sd,
                            .correlation = offset->correlation,
                            .slope = offset->slope,
                            .is_fused = offset->correlation >= kMinCorrelation};
    offset_ = *offset;
    camera_from_gyro_ = gyro_alignment(turns, rates, offset_);
    return true;
  }

  // Twice, since turns that are seen with another lens are not exactly those with this one by a factor.
  void fit_focal_length_by_gyro() {
    for (int round = 0; round < 2 && !is_cancelled(control_.cancel); ++round) {
      const auto found = focal_scale_by_gyro(seen_turns(), *rates_, offset_, camera_from_gyro_);
      if (!found || found->largest - found->least > kFocalLimits * found->value) return;
      const double before = motion_.focal_factor;
      take_focal_length(found->value);
      motion_.focal_factor = before * found->value;
      motion_.focal_scale = FocalScale{.value = motion_.focal_factor,
                                       .least = before * found->least,
                                       .largest = before * found->largest,
                                       .by_gyro = true};
      steps_ = steps_between(seen_.rays, seen_.pixel_rad, settings_, control_.cancel);
      if (!link_gyro({.cancel = control_.cancel})) return;
    }
  }

  // A pinhole with another focal length sees the same pixels along other rays and a straight edge in another plane.
  void take_focal_length(double factor) {
    motion_.focal_factor = factor;
    for (FrameRays& frame : seen_.rays)
      for (RayObservation& o : frame) o.ray = glm::normalize(glm::dvec3(factor * o.ray.x, o.ray.y, o.ray.z));
    for (HorizonLine& line : seen_.lines) {
      line.up = glm::normalize(glm::dvec3(line.up.x / factor, line.up.y, line.up.z));
      for (double* angle_rad : {&line.sd_rad, &line.haze_rad, &line.hills_rad}) *angle_rad /= factor;
    }
    seen_.pixel_rad /= factor;
  }

  // Whether the image turns as the calibration has it.
  void compare_with_lens() {
    motion_.focal_scale = focal_scale(seen_.rays, seen_.pixel_rad, control_.cancel);
    if (!motion_.focal_scale) return;
    const FocalScale& found = *motion_.focal_scale;
    constexpr double kClose = 1.1;
    const bool fits = found.least < kClose && (found.largest == 0 || found.largest > 1 / kClose);
    if (fits || std::isnan(field_of_view_deg(camera_, 1))) return;
    if (settings_.fits_focal_length && camera_.lens.is_pinhole()) return take_focal_length(found.value);
    const std::string narrow =
        found.largest > 0 ? fmt::format("{:.0f} to", field_of_view_deg(camera_, found.largest)) : "at most";
    const std::string what = fmt::format(
        "the images turn as with a field of view of {} {:.0f} degrees across, the calibration has {:.0f}: zoomed, "
        "cropped, stabilized, or a guess? Attitudes are wrong by as much",
        narrow, field_of_view_deg(camera_, found.least), field_of_view_deg(camera_, 1));
    motion_.warnings.insert(motion_.warnings.begin(), {path_, what});
  }

  // What the camera turned its images by, at each frame.
  void read_stabilization() {
    const Channel<glm::dquat>& turns = telemetry_->camera_from_image;
    const std::size_t count = std::min(turns.times_s.size(), turns.values.size());
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i)
      largest = std::max(largest, glm::length(vector_of(glm::normalize(turns.values[i]))));
    if (!(largest > kStabilized_rad)) return;
    motion_.is_stabilized = true;
    warn(fmt::format(
        "the log says that the camera stabilized its images, by up to {:.1f} degrees: attitudes are those of "
        "the images",
        deg_of_rad(largest)));
    for (const double time_s : times_s_) {
      const auto after = std::lower_bound(turns.times_s.begin(),
                                          turns.times_s.begin() + static_cast<std::ptrdiff_t>(count), time_s - 1e-4);
      const auto i = std::min(count - 1, static_cast<std::size_t>(after - turns.times_s.begin()));
      stabilization_.push_back(glm::normalize(turns.values[i]));
    }
  }

  // Rows that are exposed one after the other see the camera turned; the gyroscope tells by how much. Without one the
  // turns from frame to frame are a first value, of which the features themselves show what it misses.
  [[nodiscard]] std::vector<FrameRotation> seen_rotations(double readout_s) {
    if (!(readout_s > 0) || is_unrolled_)
      return rotations_of(seen_.rays, times_s_, seen_.pixel_rad, settings_, 0, step(kCompared, 1));
    const std::vector<FrameRays> rolled = seen_.rays;
    if (steps_.empty()) steps_ = steps_between(seen_.rays, seen_.pixel_rad, settings_, control_.cancel);
    std::vector<ReadoutTurn> turns;
    for (std::size_t k = 0; k < rolled.size(); ++k) turns.push_back({.rate_radps = rate_at(k)});
    for (int round = 0;; ++round) {
      for (std::size_t k = 0; k < rolled.size(); ++k) seen_.rays[k] = unrolled(rolled[k], turns[k], readout_s);
      constexpr double kHalf = (1 - kCompared) / 2;
      std::vector<FrameRotation> found = rotations_of(seen_.rays, times_s_, seen_.pixel_rad, settings_, readout_s,
                                                      step(kCompared + round * kHalf, kCompared + (round + 1) * kHalf));
      if (round == 1 || is_cancelled(control_.cancel)) return found;
      for (std::size_t k = 0; k < rolled.size(); ++k) turns[k] += found[k].readout_turn;
    }
  }

  // The turns seen, and the offset by them, are those of the rows in which most features lie, which need not be the
  // middle ones; so both are found once more by unrolled rays.
  void unroll_by_gyro(double readout_s) {
    const std::vector<FrameRays> rolled = seen_.rays;
    for (int round = 0;; ++round) {
      seen_.rays = rolled;
      for (std::size_t k = 0; k < rolled.size() && !is_cancelled(control_.cancel); ++k)
        unroll_by_gyro(seen_.rays[k], times_s_[k], readout_s);
      if (round == 2) break;
      steps_ = steps_between(seen_.rays, seen_.pixel_rad, settings_, control_.cancel);
      if (!link_gyro({.cancel = control_.cancel})) break;
    }
    is_unrolled_ = true;
  }

  void unroll_by_gyro(FrameRays& frame, double time_s, double readout_s) const {
    for (RayObservation& o : frame) {
      const double middle_s = offset_.log_time_s(time_s);
      const double row_s = offset_.log_time_s(time_s + readout_s * o.row);
      if (rates_->covers(std::min(middle_s, row_s), std::max(middle_s, row_s)))
        o.ray = turn_of(camera_from_gyro_ * rates_->between(middle_s, row_s)) * o.ray;
    }
  }

  // Mean of the turns to this frame and from it, per second.
  [[nodiscard]] glm::dvec3 rate_at(std::size_t k) const {
    glm::dvec3 turn_rad(0);
    double length_s = 0;
    for (std::size_t i = std::max<std::size_t>(k, 1); i <= k + 1 && i < steps_.size(); ++i) {
      if (!steps_[i]) continue;
      turn_rad -= vector_of(steps_[i]->after_from_before);
      length_s += times_s_[i] - times_s_[i - 1];
    }
    return length_s > 0 ? turn_rad / length_s : glm::dvec3(0);
  }

  // From what the adjustment says to what is reported: no feature is exact, and the errors of one feature in successive
  // frames are not independent. That counts where features leave the image and others take over from them, which shows
  // as a deviation that grows beyond that of the first seconds. Without any ground in view even all features together
  // may drift (drift_deviations()); of that a warning tells where it comes to a pixel or more.
  void scale_deviations(std::vector<FrameRotation>& rotations) {
    const double factor = std::pow(settings_.sd_factor, 2);
    const double growth = std::pow(settings_.sd_growth, 2);
    constexpr double kFloor_px = 0.01;
    const glm::dmat3 floor(std::pow(kFloor_px * seen_.pixel_rad, 2));
    const auto slow = [](const FrameRotation& r) { return mean_variance(r.covariance - r.own_covariance); };
    const auto first_key = std::min(rotations.size() - 1, static_cast<std::size_t>(settings_.key_every));
    const double at_first = slow(rotations[first_key]);
    const std::vector<double> clouds_rad = drift_deviations(rotations, times_s_);
    std::vector<int> doubtful;
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      FrameRotation& r = rotations[k];
      if (k > 0 && clouds_rad[k] > clouds_rad[k - 1] && clouds_rad.back() > seen_.pixel_rad)
        doubtful.push_back(static_cast<int>(k));
      const double walk = std::pow(settings_.sd_walk_px * seen_.pixel_rad, 2) * (times_s_[k] - times_s_[0]);
      const double grown = std::max(0.0, slow(r) - at_first) / std::max(slow(r), 1e-18);
      r.covariance = factor * r.covariance + growth * grown * (r.covariance - r.own_covariance) + floor;
      r.covariance += glm::dmat3(1) * (walk + clouds_rad[k] * clouds_rad[k]);
      r.own_covariance = factor * r.own_covariance + floor;
    }
    if (!doubtful.empty())
      warn("nothing near moves by parallax, so that clouds which drift cannot be told from a turn of the camera: " +
           ranges_text(doubtful));
  }

  void fill(const std::vector<FrameRotation>& of_images, const std::vector<FrameRotation>& rotations) {
    glm::dquat level(1, 0, 0, 0);
    std::vector<glm::dquat> turns;
    for (const FrameRotation& r : rotations) turns.push_back(r.start_from_camera);
    if (const auto found = level_of(seen_.lines, turns)) {
      level = world_from_start(found->up_in_start);
      motion_.level_sd_rad = found->sd_rad;
    }
    bool known = true;
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      EgoFrame frame{.time_s = times_s_[k], .features = of_images[k].features_used, .is_repeated = seen_.repeated[k]};
      frame.is_lost = k > 0 && !rotations[k].is_linked;
      frame.is_cut = frame.is_lost && has_enough(k - 1) && has_enough(k);
      known = known && !frame.is_lost;
      frame.world_from_camera = glm::normalize(level * rotations[k].start_from_camera);
      for (int axis = 0; axis < 3; ++axis) {
        frame.sd_rad[axis] = known ? std::min(kUnknownRotation_rad, std::sqrt(rotations[k].covariance[axis][axis]))
                                   : kUnknownRotation_rad;
        frame.step_sd_rad[axis] = std::sqrt(of_images[k].own_covariance[axis][axis]);
      }
      motion_.frames.push_back(frame);
    }
    if (!seen_.damaged.empty())
      warn(fmt::format("{} damaged frames show another one's image: {}", seen_.damaged.size(),
                       ranges_text(seen_.damaged)));
  }

  [[nodiscard]] bool has_enough(std::size_t k) const {
    return static_cast<int>(seen_.rays[k].size()) >= 2 * settings_.min_features;
  }

  void warn(std::string what) { motion_.warnings.push_back({path_, std::move(what)}); }

  FrameSource& footage_;
  const Camera& camera_;
  const cv::Mat& own_body_;
  const Track* telemetry_;
  const EgoMotionSettings& settings_;
  const EgoMotionControl& control_;
  std::string path_;
  const std::vector<double>& times_s_;
  Seen seen_;
  std::vector<std::optional<RotationFit>> steps_;
  std::vector<glm::dquat> stabilization_;  // camera from image, at each frame; empty: none
  std::optional<RateIntegral> rates_;
  TimeOffset offset_;
  glm::dquat camera_from_gyro_{1, 0, 0, 0};
  std::vector<RecordedTurn> recorded_;
  bool is_unrolled_ = false;  // rays are as if all rows were exposed with the middle one
  EgoMotion motion_;
};

}  // namespace

Result<EgoMotion> estimate_ego_motion(FrameSource& footage, const Camera& camera, const cv::Mat& own_body,
                                      const Track* telemetry, const EgoMotionSettings& settings,
                                      const EgoMotionControl& control) {
  return guarded([&] { return Estimate(footage, camera, own_body, telemetry, settings, control).run(); },
                 footage.info().path.string());
}

}  // namespace sigs
