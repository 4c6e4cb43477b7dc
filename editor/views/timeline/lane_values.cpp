// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/ensure.h"
#include "base/pose.h"

namespace sigs::editor {

namespace {

constexpr double kFinestColumn_px = 2;
constexpr float kTolerance_px = 0.33F;
constexpr double kNearZero = 0.4;  // of the highest value

// Drops points that lie on the line between those that stay. Points ascend in x.
Polyline simplified(const Polyline& points) {
  if (points.size() < 3) return points;
  constexpr float kSteep = std::numeric_limits<float>::max();
  Polyline kept{points.front()};
  float lowest = -kSteep;  // slopes from the last kept point that pass by all points since
  float highest = kSteep;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto slope_to = [&](float dy) {
      return (points[i].y + dy - kept.back().y) / std::max(1e-4F, points[i].x - kept.back().x);
    };
    if (slope_to(0) < lowest || slope_to(0) > highest) {
      kept.push_back(points[i - 1]);
      lowest = -kSteep;
      highest = kSteep;
    }
    lowest = std::max(lowest, slope_to(-kTolerance_px));
    highest = std::min(highest, slope_to(kTolerance_px));
  }
  kept.push_back(points.back());
  return kept;
}

// Collects points, and starts another line after a gap.
class Lines {
 public:
  void add(double x, double y) { line_.emplace_back(static_cast<float>(x), static_cast<float>(y)); }
  void gap() {
    if (!line_.empty()) lines_.push_back(simplified(line_));
    line_.clear();
  }
  [[nodiscard]] std::vector<Polyline> taken() {
    gap();
    return std::move(lines_);
  }

 private:
  Polyline line_;
  std::vector<Polyline> lines_;
};

// With fewer digits where they are many.
std::string rounded_text(double value, int digits, const char* unit) {
  return fmt::format("{:.{}f} {}", value, std::abs(value) >= 100 ? 0 : digits, unit);
}

std::string length_text(double metres) {
  const double size = std::abs(metres);
  if (size >= 1e4) return fmt::format("{:.{}f} km", metres / 1000, size >= 1e5 ? 0 : 1);
  return rounded_text(metres, size >= 10 ? 1 : 2, "m");
}

std::string climb_text(double mps) {
  const double size = std::abs(mps);
  return fmt::format("{:+.{}f} m/s", size < 0.05 ? 0.0 : mps, size >= 100 ? 0 : 1);
}

std::string angle_text(double angle_deg) {
  return fmt::format("{:.1f}\u00b0", std::abs(angle_deg) < 0.05 ? 0.0 : angle_deg);
}

// Behind a wide lens an outline would be as large as the way around the image.
double size_px(const Survey& survey, std::size_t i) {
  const VisibilityEstimate& estimate = survey.estimates[i];
  return estimate.visibility_state == VisibilityState::out_of_view ? std::numeric_limits<double>::quiet_NaN()
                                                                   : estimate.size_px;
}

// From the top to the bottom.
constexpr std::array kLaneStyles{
    LaneStyle{.lane = Lane::visibility,
              .source = LaneSource::estimates,
              .title = "Visibility",
              .help = "what the camera sees of it"},
    LaneStyle{.lane = Lane::clear,
              .source = LaneSource::encounter,
              .title = "Well clear",
              .help = "of the camera and it, for the volumes of export.encounter, else small-uas: green, and red while "
                      "it is lost. A click on an entry, an exit or the closest approach goes there"},
    LaneStyle{.lane = Lane::distance,
              .source = LaneSource::estimates,
              .title = "Distance",
              .help = "from the camera",
              .color = IM_COL32(120, 200, 255, 255),
              .value = [](const Survey& s, std::size_t i) { return s.estimates[i].distance_m; },
              .text = length_text},
    LaneStyle{.lane = Lane::beside,
              .source = LaneSource::encounter,
              .shown_by_default = false,
              .title = "Horizontal range",
              .help = "from the camera, over ground; the line is the first volume's DMOD, red where well clear is lost",
              .color = IM_COL32(110, 215, 215, 255),
              .value = [](const Survey& s, std::size_t i) { return s.encounter->horizontal_range_m[i]; },
              .text = length_text},
    LaneStyle{.lane = Lane::tau,
              .source = LaneSource::encounter,
              .shown_by_default = false,
              .title = "Modified tau",
              .help = "time until the first volume's DMOD is reached, by the present rate; 0 within, a gap where the "
                      "distance does not fall. Short times take more room than long ones",
              .color = IM_COL32(245, 170, 110, 255),
              .value = [](const Survey& s, std::size_t i) { return s.encounter->tau_mod_s[i]; },
              .text = [](double s) { return rounded_text(s, 1, "s"); },
              .scaling = Scaling::logarithmic},
    LaneStyle{.lane = Lane::size,
              .source = LaneSource::estimates,
              .title = "Size",
              .help = "longer side of its outline, where the image shows some of it",
              .color = color::kBox,
              .value = size_px,
              .text = pixels_text,
              .scaling = Scaling::logarithmic},
    LaneStyle{.lane = Lane::speed,
              .source = LaneSource::flight,
              .title = "Speed",
              .help = "over ground",
              .color = IM_COL32(170, 220, 110, 255),
              .value = [](const Survey& s, std::size_t i) { return s.flight[i].speed_mps; },
              .text = [](double mps) { return rounded_text(mps, 1, "m/s"); },
              .min_span = 2,
              .fault = FlightFault::speed},
    LaneStyle{.lane = Lane::load,
              .source = LaneSource::flight,
              .shown_by_default = false,
              .title = "Load factor",
              .help = "1 in level flight; felt along the aircraft's own up axis",
              .color = IM_COL32(240, 150, 205, 255),
              .value = [](const Survey& s, std::size_t i) { return s.flight[i].load_factor; },
              .text = [](double g) { return rounded_text(g, 2, "g"); },
              .min_span = 0.2,
              .reference = 1.0,
              .fault = FlightFault::load},
    LaneStyle{.lane = Lane::climb,
              .source = LaneSource::flight,
              .shown_by_default = false,
              .title = "Climb rate",
              .help = "up is positive",
              .color = IM_COL32(160, 160, 255, 255),
              .value = [](const Survey& s, std::size_t i) { return s.flight[i].climb_rate_mps; },
              .text = climb_text,
              .min_span = 2,
              .reference = 0.0,
              .fault = FlightFault::climb},
    LaneStyle{.lane = Lane::roll,
              .source = LaneSource::camera,
              .title = "Camera roll",
              .help = "of the camera: right side down is positive. Alt + drag shifts the log in time",
              .color = IM_COL32(236, 140, 130, 255),
              .angle_rad = &Attitude::roll_rad,
              .text = angle_text,
              .min_span = 4,
              .reference = 0.0},
    LaneStyle{.lane = Lane::pitch,
              .source = LaneSource::camera,
              .title = "Camera pitch",
              .help = "of the camera: up is positive. Alt + drag shifts the log in time",
              .color = IM_COL32(140, 212, 130, 255),
              .angle_rad = &Attitude::pitch_rad,
              .text = angle_text,
              .min_span = 4,
              .reference = 0.0},
    LaneStyle{.lane = Lane::yaw,
              .source = LaneSource::camera,
              .title = "Camera yaw",
              .help =
                  "of the camera, from world X to the right, without jumps at 180 degrees. Alt + drag shifts the log "
                  "in time",
              .color = IM_COL32(136, 176, 255, 255),
              .angle_rad = &Attitude::yaw_rad,
              .text = angle_text,
              .min_span = 4,
              .reference = 0.0},
};

// How many frames of a lane are known.
std::size_t count_of(const Survey& survey, LaneSource source) {
  switch (source) {
    case LaneSource::estimates:
      return survey.estimates.size();
    case LaneSource::encounter:
      return survey.encounter ? survey.encounter->horizontal_range_m.size() : 0;
    case LaneSource::flight:
      return survey.flight.size();
    case LaneSource::camera:
      return survey.camera.size();
  }
  return 0;
}

double value_in(const Survey& survey, const LaneStyle& style, std::size_t i) {
  return style.angle_rad != nullptr ? deg_of_rad(survey.camera[i].attitude.*style.angle_rad) : style.value(survey, i);
}

// Standard deviation of a value of a curve; NaN: not known.
double deviation_in(const Survey& survey, const LaneStyle& style, std::size_t i) {
  const bool is_known = style.angle_rad != nullptr && survey.camera[i].sd;
  return is_known ? deg_of_rad(*survey.camera[i].sd.*style.angle_rad) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double LaneScale::share_of(double value) const {
  const auto shaped = [&](double v) { return scaling == Scaling::logarithmic ? std::log1p(std::max(0.0, v)) : v; };
  const double span = shaped(high) - shaped(low);
  return span > 0 ? std::clamp((shaped(value) - shaped(low)) / span, 0.0, 1.0) : 0.5;
}

LaneScale scale_for(std::span<const double> values, double min_span, Scaling scaling) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return {.low = 0, .high = min_span, .scaling = scaling};
  if (low >= 0 && low < kNearZero * high) low = 0;
  const double span = std::max(high - low, min_span);
  const double middle = std::midpoint(low, high);
  const double margin = 0.06 * span;
  if (low == 0 && high >= 0) return {.low = 0, .high = std::max(high + margin, min_span), .scaling = scaling};
  return {.low = middle - span / 2 - margin, .high = middle + span / 2 + margin, .scaling = scaling};
}

std::vector<Polyline> curve_of(std::span<const double> values, int first_frame, const TimeRuler& ruler,
                               const LaneScale& scale, const LaneBox& box) {
  if (values.empty() || !(ruler.width > 0) || !(ruler.count > 0)) return {};
  const auto size = static_cast<double>(values.size());
  const double from = std::clamp(std::floor(ruler.first) - 1 - first_frame, 0.0, size);
  const double to = std::clamp(std::ceil(ruler.first + ruler.count) + 1 - first_frame, 0.0, size);
  const auto y_of = [&](double value) { return box.top_y + (1 - scale.share_of(value)) * box.height; };
  const auto x_of = [&](std::size_t i) { return ruler.x_of(first_frame + static_cast<double>(i) + 0.5); };
  // Columns of whole frames, the same ones however the strip is panned, or the curve would crawl.
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(kFinestColumn_px * ruler.count / ruler.width)));
  Lines lines;
  for (std::size_t i = static_cast<std::size_t>(from) / stride * stride; i < static_cast<std::size_t>(to);
       i += stride) {
    const auto column = values.subspan(i, std::min(stride, values.size() - i));
    if (!std::ranges::all_of(column, [](double v) { return std::isfinite(v); })) {
      lines.gap();
      continue;
    }
    const auto [low, high] = std::minmax_element(column.begin(), column.end());
    const auto first = std::min(low, high);
    const auto second = std::max(low, high);
    lines.add(x_of(i + static_cast<std::size_t>(first - column.begin())), y_of(*first));
    if (first != second) lines.add(x_of(i + static_cast<std::size_t>(second - column.begin())), y_of(*second));
  }
  return lines.taken();
}

std::span<const LaneStyle> lane_styles() {
  return kLaneStyles;
}

const LaneStyle& style_of(Lane lane) {
  const auto* const style = std::ranges::find(kLaneStyles, lane, &LaneStyle::lane);
  ENSURE(style != kLaneStyles.end());
  return *style;
}

LaneValues values_of(const Survey& survey, Lane lane) {
  LaneValues result;
  const LaneStyle& style = style_of(lane);
  if (style.is_strip()) return result;
  for (std::size_t i = 0; i < count_of(survey, style.source); ++i) {
    result.values.push_back(value_in(survey, style, i));
    result.deviations.push_back(deviation_in(survey, style, i));
  }
  if (std::ranges::none_of(result.deviations, [](double sd) { return std::isfinite(sd); })) result.deviations.clear();
  result.scale = scale_for(result.values, style.min_span, style.scaling);
  bool is_first = true;
  for (const double value : result.values) {
    if (!std::isfinite(value)) continue;
    result.minimum = is_first ? value : std::min(result.minimum, value);
    result.maximum = is_first ? value : std::max(result.maximum, value);
    is_first = false;
  }
  return result;
}

std::string value_text(Lane lane, double value) {
  return std::isfinite(value) ? style_of(lane).text(value) : "-";
}

std::string text_in(const Survey& survey, Lane lane, std::size_t i) {
  const LaneStyle& style = style_of(lane);
  if (i >= count_of(survey, style.source)) return "-";
  if (lane == Lane::visibility) return name_of(survey.estimates[i].visibility_state);
  if (lane == Lane::clear) return clear_text(*survey.encounter, survey.encounter->first_frame + static_cast<int>(i));
  const double value = value_in(survey, style, i);
  const std::string text = value_text(lane, lane == Lane::yaw ? std::remainder(value, 360) : value);
  const double deviation = deviation_in(survey, style, i);
  return std::isfinite(deviation) ? fmt::format("{} \u00b1{:.2g}\u00b0", text, deviation) : text;
}

const char* name_of(VisibilityState visibility_state) {
  switch (visibility_state) {
    case VisibilityState::in_view:
      return "in view";
    case VisibilityState::partly_occluded:
      return "partly hidden";
    case VisibilityState::occluded:
      return "hidden";
    case VisibilityState::out_of_view:
      return "out of view";
  }
  return "";
}

}  // namespace sigs::editor
