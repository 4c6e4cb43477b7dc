// SPDX-License-Identifier: MIT
#include "dataset/flight_quantities.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/text.h"

namespace sigs {

namespace {

constexpr double kMaxDistance_m = 1e7;
constexpr double kMaxSpeed_mps = 1e4;
constexpr double kMaxTime_s = 1e6;
constexpr double kMaxRecordedTime_s = 1e7;
constexpr double kMaxPlace_percent = 1000;

constexpr FlightQuantity place(std::string_view name, double standard, std::string_view help) {
  return {name, -kMaxPlace_percent, kMaxPlace_percent, standard, false, help};
}

constexpr FlightQuantity kSpeed{
    "speed_mps",   0,
    kMaxSpeed_mps, std::nullopt,
    false,         "the intruder's own speed over ground; none: what takes it from place to place in the video's time"};

constexpr FlightQuantity distance(std::string_view name, double standard, std::string_view help) {
  return {name, 0.02, kMaxDistance_m, standard, false, help};
}

constexpr FlightQuantity kNose{
    "nose_deg",   -180,  180,
    std::nullopt, false, "of a helicopter, drone or balloon: its nose to the right of where it flies; none: along it"};

// The distances, the places between which it flies, and what else flights of the paper's Table 1 have.
template <class... Distances>
constexpr auto between_places(double from_x, double to_x, const Distances&... distances) {
  return std::array{
      distances...,
      kSpeed,
      place("from_x_percent", from_x,
            "where it is in the first frame, from the image's left edge (0) to the right (100)"),
      place("to_x_percent", to_x, "the same in the last frame"),
      place("from_y_percent", 40, "the same from the upper edge (0) to the lower (100), in the first frame"),
      place("to_y_percent", 40, "and in the last frame"),
      kNose};
}

constexpr auto across(double from_x, double to_x) {
  return between_places(from_x, to_x, distance("distance_m", 150, "distance where it crosses the middle of its way"));
}

constexpr auto along_the_view(double from_m, double to_m) {
  return between_places(50, 50, distance("from_distance_m", from_m, "distance in the first frame"),
                        distance("to_distance_m", to_m, "distance in the last frame"));
}

constexpr std::array kLeftRight = across(5, 95);
constexpr std::array kRightLeft = across(95, 5);
constexpr std::array kApproaching = along_the_view(400, 60);
constexpr std::array kMovingAway = along_the_view(60, 400);

constexpr std::array kEncounter{
    FlightQuantity{"miss_distance_m", 0, kMaxDistance_m, std::nullopt, true,
                   "distance at the closest point of approach"},
    FlightQuantity{"miss_angle_deg", -360, 360, 0.0, false,
                   "where it passes, seen by who looks to where it comes from: 0 right, 90 above, 180 left, -90 below"},
    FlightQuantity{"bearing_deg", -360, 360, 0.0, false,
                   "of where it comes from, to the right of the camera's direction of flight"},
    FlightQuantity{"elevation_deg", -90, 90, 0.0, false, "of where it comes from, above the horizontal"},
    FlightQuantity{"closing_speed_mps", 0, kMaxSpeed_mps, std::nullopt, false,
                   "speed of the relative motion: the rate at which the distance falls far out"},
    FlightQuantity{"time_of_closest_approach_s", -kMaxTime_s, kMaxTime_s, std::nullopt, false,
                   "after the video's first frame; none: the last frame's, where range_m does not say it"},
    FlightQuantity{"range_m", 0, kMaxDistance_m, std::nullopt, false, "distance in the first frame"},
    kNose};

constexpr FlightQuantity kHmd{
    "hmd_m",
    -kMaxDistance_m,
    kMaxDistance_m,
    std::nullopt,
    true,
    "horizontal distance at the closest approach; to who looks where it comes from it passes on the "
    "right, negative: on the left"};
constexpr FlightQuantity kVmd{"vmd_m", -kMaxDistance_m, kMaxDistance_m,
                              0.0,     false,           "the intruder's height above the camera at that time"};
constexpr FlightQuantity kTrackBearing{
    "bearing_deg", -360,  360,
    0.0,           false, "of where it comes from at that time, to the right of the camera's direction of flight"};
constexpr FlightQuantity kTrackTime{"time_of_closest_approach_s",
                                    0,
                                    kMaxTime_s,
                                    std::nullopt,
                                    false,
                                    "after the video's first frame, within the video; none: the last frame's"};

constexpr std::array kEncounterModel{kHmd, kVmd, kTrackBearing, kTrackTime};
constexpr std::array kRecorded{
    kHmd,
    kVmd,
    kTrackBearing,
    kTrackTime,
    FlightQuantity{"recorded_time_s", 0, kMaxRecordedTime_s, std::nullopt, false,
                   "time in the recording, from its first point, of the closest approach; none: sampled evenly"},
    FlightQuantity{"smoothing_s", 0, 120, 2.0, false,
                   "the path is the mean over so many seconds; noise and steps of the recorded heights need more"}};
constexpr std::array kImagePosition{
    FlightQuantity{"x_percent", 0, 100, 50.0, false,
                   "where its reference point is at the time, from the image's left edge (0) to the right (100)"},
    FlightQuantity{"y_percent", 0, 100, 50.0, false, "the same from the upper edge (0) to the lower (100)"},
    FlightQuantity{"size_px", 1, 1e5, std::nullopt, false, "longer side of its whole silhouette's box at that time"},
    FlightQuantity{"distance_m", 0.02, kMaxDistance_m, std::nullopt, false, "in place of size_px: how far it is then"},
    FlightQuantity{"time_s", 0, kMaxTime_s, std::nullopt, false,
                   "the time, after the video's first frame, taken at the nearest frame; none: the middle frame's"},
    FlightQuantity{"relative_speed_mps", 0, kMaxSpeed_mps, 30.0, false,
                   "speed of the relative motion: the intruder's velocity less the camera's"},
    FlightQuantity{"direction_deg", -360, 360, 0.0, false,
                   "where it moves in the image at that time: 0 right, 90 up, 180 left, -90 down"},
    FlightQuantity{"approach_angle_deg", -90, 90, 0.0, false,
                   "of the relative motion: 0 it is nearest at that time, 90 it comes straight to the camera, -90 it "
                   "leaves straight"},
    FlightQuantity{
        "course_deg", -360, 360, std::nullopt, false,
        "in place of these two angles: where it moves over ground, to the right of where the camera looks: 0 "
        "away, 90 to the right, 180 towards"},
    FlightQuantity{"climb_deg", -90, 90, 0.0, false, "with course_deg: how steeply it climbs"},
    kNose};

struct KindOfFlight {
  std::string_view name;
  std::span<const FlightQuantity> quantities;
};

constexpr std::array<KindOfFlight, 8> kKinds{{{"left_right", kLeftRight},
                                              {"right_left", kRightLeft},
                                              {"approaching", kApproaching},
                                              {"moving_away", kMovingAway},
                                              {"encounter", kEncounter},
                                              {"encounter_model", kEncounterModel},
                                              {"recorded", kRecorded},
                                              {"image_position", kImagePosition}}};  // by FlightKind

}  // namespace

std::string_view name_of(FlightKind kind) {
  return kKinds.at(static_cast<std::size_t>(kind)).name;
}

std::optional<FlightKind> flight_kind_of(std::string_view name) {
  const auto found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const KindOfFlight& kind) { return kind.name == name; });
  return found == kKinds.end() ? std::nullopt : std::optional(static_cast<FlightKind>(found - kKinds.begin()));
}

std::string flight_kind_names() {
  std::vector<std::string_view> names;
  for (const KindOfFlight& kind : kKinds) names.push_back(kind.name);
  return listed(names);
}

std::span<const FlightQuantity> quantities_of(FlightKind kind) {
  return kKinds.at(static_cast<std::size_t>(kind)).quantities;
}

}  // namespace sigs
