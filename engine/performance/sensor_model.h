// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/result.h"
#include "performance/performance.h"

namespace sigs {

// A sensor as numbers that a fast-time simulation can draw from: how likely a frame shows the intruder by range, side
// of the horizon and aspect, how alike frames that follow each other are, how late and how exact it is.
// docs/risk.md describes the file and the fit.

// What the camera sees, in its own axes; a camera that looks ahead and level.
struct FieldOfView {
  double left_rad = -std::numbers::pi;  // to the right of the axis
  double right_rad = std::numbers::pi;
  double down_rad = -std::numbers::pi / 2;  // above the axis
  double up_rad = std::numbers::pi / 2;

  [[nodiscard]] bool holds(const glm::dvec2& angles_rad) const {
    return angles_rad.x >= left_rad && angles_rad.x <= right_rad && angles_rad.y >= down_rad && angles_rad.y <= up_rad;
  }
};

// That of a lens: what the middles of the image's edges see. None where one of them has no ray.
[[nodiscard]] std::optional<FieldOfView> field_of_view_of(
    const std::function<std::optional<glm::dvec3>(double x_px, double y_px)>& ray_of_pixel, cv::Size size_px);

// How an intruder is seen, as the model distinguishes it.
struct ViewClass {
  int horizon = 0;  // 0 above or unknown, 1 on, 2 below
  int aspect = 0;   // 0 head-on or unknown, 1 from the side, 2 from behind
};
[[nodiscard]] ViewClass view_class_of(HorizonSide horizon, double aspect_rad);

struct SensorModel {
  std::string detector;
  int encounters = 0;  // that it was fitted to
  int frames = 0;
  double rate_hz = 10;
  int declare_hits = 3;
  int declare_window = 5;
  double latency_s = 0;
  FieldOfView field_of_view = {};
  bool is_field_known = false;  // else it is assumed to be all around

  // Places of P(detect), rising, at least one, and the normal quantile of P there, for an intruder above the horizon
  // that is seen head-on. Between them it is linear in the logarithm of the range; nearer than the first place it is
  // that of the first, farther than the last P is 0.
  std::vector<double> range_m;
  std::vector<double> quantiles;
  // Added to the quantile.
  double on_horizon = 0;
  double below_horizon = 0;
  double from_side = 0;
  double from_behind = 0;

  // A frame is detected where quantile + noise > 0, with standard normal noise that is made of three parts: one that an
  // encounter has throughout, one that fades within correlation_s, and the rest anew for each frame.
  double encounter_share = 0;  // of the variance
  double fading_share = 0;
  double correlation_s = 1;

  double bearing_bias_rad = 0, bearing_sd_rad = 0;
  double elevation_bias_rad = 0, elevation_sd_rad = 0;
  std::optional<double> range_sd = {};               // relative; none: it states no range
  std::optional<double> false_tracks_per_hour = {};  // none: not measured

  [[nodiscard]] double quantile_at(double range_m, HorizonSide horizon, double aspect_rad) const;
  [[nodiscard]] double probability(double range_m, HorizonSide horizon, double aspect_rad) const;
};

// Which terms cross-validation chose, and what each choice costs: minus the mean logarithm of the probability of what
// was seen, over frames of encounters that the fit did not have.
struct SensorFit {
  SensorModel model;
  struct Choice {
    std::string terms;
    double held_out_loss = 0;
  };
  std::vector<Choice> choices;
  std::string chosen;
};

// Fits a model to all encounters. Errors bad_data: there is no frame with an intruder in view, or fewer than two
// encounters.
[[nodiscard]] Result<SensorFit> fitted_sensor_model(const Performance& performance,
                                                    const std::optional<FieldOfView>& field_of_view);

// Declaration ranges that the model gives on encounters as they were flown, against those that the images gave: each
// encounter by a model that was fitted without its fifth of them. 0: never declared.
struct SensorModelCheck {
  std::vector<double> images_m;
  std::vector<double> model_m;  // several draws of each encounter
  DistributionDistance distance;
  double declared_images = 0;  // share of the encounters
  double declared_model = 0;
};
[[nodiscard]] SensorModelCheck checked_sensor_model(const Performance& performance);

// Draws what the sensor sees of one encounter, frame by frame.
class SensorDraw {
 public:
  SensorDraw(const SensorModel& model, Random& random);

  // Whether it detects in the next frame, so much later than the one before.
  //   quantile  SensorModel::quantile_at()
  [[nodiscard]] bool detects(double quantile, double step_s, Random& random);

  // Whether a track is declared after this frame: m of the last n were detected.
  [[nodiscard]] bool is_declared(bool is_detected);

 private:
  const SensorModel& model_;
  double encounter_;  // parts of the noise
  double fading_;
  std::uint64_t last_ = 0;  // detections of the last frames, a bit each
};

// A normal number by inversion: the same on every machine to the C library's last digits.
[[nodiscard]] double normal_number(Random& random);

[[nodiscard]] std::string sensor_model_json(const SensorModel& model);
// Errors cannot_read; bad_data that names file and member.
[[nodiscard]] Result<SensorModel> read_sensor_model(const std::filesystem::path& file);
// The same of a file's text.
[[nodiscard]] Result<SensorModel> sensor_model_of(const std::string& text, const std::string& file);

}  // namespace sigs
