// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

std::size_t count_of(const Survey& survey, Lane lane) {
  if (lane == Lane::visibility_state) return 0;
  return lane == Lane::distance || lane == Lane::size ? survey.estimates.size() : survey.flight.size();
}

std::string formatted(const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

const LaneStyle& style_of(Lane lane) {
  static const std::array<LaneStyle, kLanes> kStyles{{
      {"Visibility", "what the camera sees of it", color::kGood, 1, Scaling::linear, std::nullopt},
      {"Distance", "from the camera", IM_COL32(120, 200, 255, 255), 1, Scaling::linear, std::nullopt},
      {"Size", "longer side of its outline, where the image shows some of it", color::kBox, 1, Scaling::logarithmic,
       std::nullopt},
      {"Speed", "over ground", IM_COL32(170, 220, 110, 255), 2, Scaling::linear, std::nullopt},
      {"Load factor", "1 in level flight; felt along the aircraft's own up axis", IM_COL32(240, 150, 205, 255), 0.2,
       Scaling::linear, 1.0},
      {"Climb rate", "up is positive", IM_COL32(160, 160, 255, 255), 2, Scaling::linear, 0.0},
  }};
  return kStyles[static_cast<std::size_t>(lane)];
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
    case Lane::visibility_state:
      break;
  }
  return 0;
}

LaneValues values_of(const Survey& survey, Lane lane) {
  LaneValues result;
  for (std::size_t i = 0; i < count_of(survey, lane); ++i) result.values.push_back(value_in(survey, lane, i));
  result.scale = scale_for(result.values, style_of(lane).min_span, style_of(lane).scaling);
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
      if (size >= 1e4) return formatted(size >= 1e5 ? "%.0f km" : "%.1f km", value / 1000);
      return formatted(size >= 100 ? "%.0f m" : size >= 10 ? "%.1f m" : "%.2f m", value);
    case Lane::size:
      return formatted(size >= 100 ? "%.0f px" : size >= 10 ? "%.1f px" : "%.2f px", value);
    case Lane::speed:
      return formatted(size >= 100 ? "%.0f m/s" : "%.1f m/s", value);
    case Lane::load:
      return formatted(size >= 100 ? "%.0f g" : "%.2f g", value);
    case Lane::climb:
      return formatted(size >= 100 ? "%+.0f m/s" : "%+.1f m/s", size < 0.05 ? 0.0 : value);
    case Lane::visibility_state:
      break;
  }
  return {};
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

ImU32 color_of(VisibilityState visibility_state) {
  switch (visibility_state) {
    case VisibilityState::in_view:
      return color::kGood;
    case VisibilityState::partly_occluded:
      return color::kPartly;
    case VisibilityState::occluded:
      return faded(color::kOwnBody, 1);
    case VisibilityState::out_of_view:
      return IM_COL32(84, 88, 98, 255);
  }
  return color::kQuiet;
}

}  // namespace sigs::editor
