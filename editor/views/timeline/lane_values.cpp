// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/ensure.h"
#include "base/pose.h"
#include "editor/views/timeline/lane_marks.h"

namespace sigs::editor {

namespace {

// From the top to the bottom.
constexpr std::array kLaneStyles{
    LaneStyle{.lane = Lane::visibility,
              .kind = LaneKind::strip,
              .shown_by_default = true,
              .title = "Visibility",
              .help = "what the camera sees of it"},
    LaneStyle{.lane = Lane::clear,
              .kind = LaneKind::strip,
              .shown_by_default = true,
              .title = "Well clear",
              .help = "of the camera and it, for the volumes of export.encounter, else small-uas: green, and red while "
                      "it is lost. A click on an entry, an exit or the closest approach goes there"},
    LaneStyle{.lane = Lane::distance,
              .kind = LaneKind::curve,
              .shown_by_default = true,
              .title = "Distance",
              .help = "from the camera",
              .color = IM_COL32(120, 200, 255, 255)},
    LaneStyle{.lane = Lane::beside,
              .kind = LaneKind::curve,
              .shown_by_default = false,
              .title = "Horizontal range",
              .help = "from the camera, over ground; the line is the first volume's DMOD, red where well clear is lost",
              .color = IM_COL32(110, 215, 215, 255)},
    LaneStyle{.lane = Lane::tau,
              .kind = LaneKind::curve,
              .shown_by_default = false,
              .title = "Modified tau",
              .help = "time until the first volume's DMOD is reached, by the present rate; 0 within, a gap where the "
                      "distance does not fall. Short times take more room than long ones",
              .color = IM_COL32(245, 170, 110, 255),
              .scaling = Scaling::logarithmic},
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
    case Lane::clear:
    case Lane::beside:
    case Lane::tau:
      return survey.encounter ? survey.encounter->horizontal_range_m.size() : 0;
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

// In degrees, of a lane of the camera.
double angle_deg(const Attitude& attitude, Lane lane) {
  if (lane == Lane::roll) return deg_of_rad(attitude.roll_rad);
  return deg_of_rad(lane == Lane::pitch ? attitude.pitch_rad : attitude.yaw_rad);
}

std::string angle_text(double angle_deg) {
  return fmt::format("{:.1f}\u00b0", std::abs(angle_deg) < 0.05 ? 0.0 : angle_deg);
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
    case Lane::beside:
      return survey.encounter->horizontal_range_m[i];
    case Lane::tau:
      return survey.encounter->tau_mod_s[i];
    case Lane::visibility:
    case Lane::clear:
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

std::string value_text(Lane lane, double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  switch (lane) {
    case Lane::distance:
    case Lane::beside:
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
    case Lane::tau:
      return fmt::format("{:.{}f} s", value, size >= 100 ? 0 : 1);
    case Lane::visibility:
    case Lane::clear:
      break;
  }
  return {};
}

std::string text_in(const Survey& survey, Lane lane, std::size_t i) {
  if (i >= count_of(survey, lane)) return "-";
  if (lane == Lane::visibility) return name_of(survey.estimates[i].visibility_state);
  if (lane == Lane::clear) return clear_text(*survey.encounter, survey.encounter->first_frame + static_cast<int>(i));
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
