// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "base/ensure.h"
#include "base/pose.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

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
    if (!std::all_of(column.begin(), column.end(), [](double v) { return std::isfinite(v); })) {
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

namespace {

// From the top to the bottom.
constexpr std::array kLaneStyles{
    LaneStyle{.lane = Lane::visibility,
              .kind = LaneKind::strip,
              .shown_by_default = true,
              .title = "Visibility",
              .help = "what the camera sees of it"},
    LaneStyle{.lane = Lane::distance,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Distance",
              .help = "from the camera",
              .color = IM_COL32(120, 200, 255, 255)},
    LaneStyle{.lane = Lane::size,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Size",
              .help = "longer side of its outline, where the image shows some of it",
              .color = color::kBox,
              .scaling = Scaling::logarithmic},
    LaneStyle{.lane = Lane::speed,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Speed",
              .help = "over ground",
              .color = IM_COL32(170, 220, 110, 255),
              .min_span = 2},
    LaneStyle{.lane = Lane::load,
              .kind = LaneKind::curve,
              .shown_by_default = false,
              .title = "Load factor",
              .help = "1 in level flight; felt along the aircraft's own up axis",
              .color = IM_COL32(240, 150, 205, 255),
              .min_span = 0.2,
              .reference = 1.0},
    LaneStyle{.lane = Lane::climb,
              .kind = LaneKind::curve,
              .shown_by_default = false,
              .title = "Climb rate",
              .help = "up is positive",
              .color = IM_COL32(160, 160, 255, 255),
              .min_span = 2,
              .reference = 0.0},
    LaneStyle{.lane = Lane::roll,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Camera roll",
              .help = "of the camera: right side down is positive. Alt + drag shifts the log in time",
              .color = IM_COL32(236, 140, 130, 255),
              .min_span = 4,
              .reference = 0.0},
    LaneStyle{.lane = Lane::pitch,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Camera pitch",
              .help = "of the camera: up is positive. Alt + drag shifts the log in time",
              .color = IM_COL32(140, 212, 130, 255),
              .min_span = 4,
              .reference = 0.0},
    LaneStyle{.lane = Lane::yaw,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Camera yaw",
              .help =
                  "of the camera, from world X to the right, without jumps at 180 degrees. Alt + drag shifts the log "
                  "in time",
              .color = IM_COL32(136, 176, 255, 255),
              .min_span = 4,
              .reference = 0.0},
};

constexpr bool has_one_style(Lane lane) {
  return std::count_if(kLaneStyles.begin(), kLaneStyles.end(),
                       [&](const LaneStyle& style) { return style.lane == lane; }) == 1;
}

// No lane is listed twice or left out, in whatever order. The last one of the enum is not missed here if it has no
// style; it is not shown then.
constexpr bool each_lane_has_one_style() {
  for (std::size_t i = 0; i < kLaneStyles.size(); ++i)
    if (!has_one_style(static_cast<Lane>(i))) return false;
  return true;
}
static_assert(each_lane_has_one_style());

// How many frames of a lane are known.
std::size_t count_of(const Survey& survey, Lane lane) {
  switch (lane) {
    case Lane::visibility:
    case Lane::distance:
    case Lane::size:
      return survey.estimates.size();
    case Lane::speed:
    case Lane::load:
    case Lane::climb:
      return survey.flight.size();
    case Lane::roll:
    case Lane::pitch:
    case Lane::yaw:
      return survey.camera.size();
  }
  return 0;
}

}  // namespace

std::span<const LaneStyle> lane_styles() {
  return kLaneStyles;
}

const LaneStyle& style_of(Lane lane) {
  const auto* const style = std::find_if(kLaneStyles.begin(), kLaneStyles.end(),
                                         [&](const LaneStyle& candidate) { return candidate.lane == lane; });
  ENSURE(style != kLaneStyles.end());
  return *style;
}

namespace {

// In degrees, of a lane of the camera.
double angle_deg(const Attitude& attitude, Lane lane) {
  if (lane == Lane::roll) return deg_of_rad(attitude.roll_rad);
  return deg_of_rad(lane == Lane::pitch ? attitude.pitch_rad : attitude.yaw_rad);
}

}  // namespace

double deviation_in(const Survey& survey, Lane lane, std::size_t i) {
  if (!is_of_camera(lane) || !survey.camera[i].sd) return std::numeric_limits<double>::quiet_NaN();
  return angle_deg(*survey.camera[i].sd, lane);
}

double value_in(const Survey& survey, Lane lane, std::size_t i) {
  switch (lane) {
    case Lane::distance:
      return survey.estimates[i].distance_m;
    case Lane::size:
      // Behind a wide lens an outline would be as large as the way around the image.
      if (survey.estimates[i].visibility_state == VisibilityState::out_of_view)
        return std::numeric_limits<double>::quiet_NaN();
      return survey.estimates[i].size_px;
    case Lane::speed:
      return survey.flight[i].speed_mps;
    case Lane::load:
      return survey.flight[i].load_factor;
    case Lane::climb:
      return survey.flight[i].climb_rate_mps;
    case Lane::roll:
    case Lane::pitch:
    case Lane::yaw:
      return angle_deg(survey.camera[i].attitude, lane);
    case Lane::visibility:
      break;
  }
  return 0;
}

LaneValues values_of(const Survey& survey, Lane lane) {
  LaneValues result;
  const LaneStyle& style = style_of(lane);
  if (style.kind == LaneKind::strip) return result;
  for (std::size_t i = 0; i < count_of(survey, lane); ++i) result.values.push_back(value_in(survey, lane, i));
  if (is_of_camera(lane))
    for (std::size_t i = 0; i < result.values.size(); ++i) result.deviations.push_back(deviation_in(survey, lane, i));
  if (std::none_of(result.deviations.begin(), result.deviations.end(), [](double sd) { return std::isfinite(sd); }))
    result.deviations.clear();
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

namespace {

std::string angle_text(double angle_deg) {
  return fmt::format("{:.1f}\u00b0", std::abs(angle_deg) < 0.05 ? 0.0 : angle_deg);
}

}  // namespace

std::string value_text(Lane lane, double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  switch (lane) {
    case Lane::distance:
      if (size >= 1e4) return fmt::format("{:.{}f} km", value / 1000, size >= 1e5 ? 0 : 1);
      return fmt::format("{:.{}f} m", value, size >= 100 ? 0 : size >= 10 ? 1 : 2);
    case Lane::size:
      return pixels_text(value);
    case Lane::speed:
      return fmt::format("{:.{}f} m/s", value, size >= 100 ? 0 : 1);
    case Lane::load:
      return fmt::format("{:.{}f} g", value, size >= 100 ? 0 : 2);
    case Lane::climb:
      return fmt::format("{:+.{}f} m/s", size < 0.05 ? 0.0 : value, size >= 100 ? 0 : 1);
    case Lane::roll:
    case Lane::pitch:
    case Lane::yaw:
      return angle_text(value);
    case Lane::visibility:
      break;
  }
  return {};
}

std::string text_in(const Survey& survey, Lane lane, std::size_t i) {
  if (i >= count_of(survey, lane)) return "-";
  if (lane == Lane::visibility) return name_of(survey.estimates[i].visibility_state);
  const double value = value_in(survey, lane, i);
  const std::string text = value_text(lane, lane == Lane::yaw ? std::remainder(value, 360) : value);
  const double deviation = deviation_in(survey, lane, i);
  return std::isfinite(deviation) ? fmt::format("{} \u00b1{:.2g}\u00b0", text, deviation) : text;
}

bool belongs_to(FlightFault fault, Lane lane) {
  switch (fault) {
    case FlightFault::speed:
      return lane == Lane::speed;
    case FlightFault::climb:
      return lane == Lane::climb;
    case FlightFault::load:
      return lane == Lane::load;
    case FlightFault::underground:
      return false;
  }
  return false;
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
