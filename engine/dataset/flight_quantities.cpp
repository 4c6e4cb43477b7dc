// SPDX-License-Identifier: MIT
#include "dataset/flight_quantities.h"

#include <algorithm>
#include <array>

namespace sigs {

namespace {

constexpr double kMaxDistance_m = 1e7;
constexpr double kMaxSpeed_mps = 1e4;
constexpr double kMaxTime_s = 1e6;
constexpr double kMaxRecordedTime_s = 1e7;
constexpr double kMaxPlace_percent = 1000;

constexpr std::array<FlightKind, 8> kKinds{
    FlightKind::left_right, FlightKind::right_left,      FlightKind::approaching, FlightKind::moving_away,
    FlightKind::encounter,  FlightKind::encounter_model, FlightKind::recorded,    FlightKind::image_position};

constexpr FlightQuantity place(std::string_view name, double standard, std::string_view help) {
  return {name, -kMaxPlace_percent, kMaxPlace_percent, standard, false, help};
}

constexpr FlightQuantity kSpeed{
    "speed_mps",   0,
    kMaxSpeed_mps, std::nullopt,
    false,         "the intruder's own speed over ground; none: what takes it from place to place in the video's time"};
constexpr std::string_view kFromX = "where it is in the first frame, from the image's left edge (0) to the right (100)";
constexpr std::string_view kToX = "the same in the last frame";
constexpr std::string_view kFromY = "the same from the upper edge (0) to the lower (100), in the first frame";
constexpr std::string_view kToY = "and in the last frame";

constexpr FlightQuantity distance(std::string_view name, double standard, std::string_view help) {
  return {name, 0.02, kMaxDistance_m, standard, false, help};
}

constexpr FlightQuantity kNose{
    "nose_deg",   -180,  180,
    std::nullopt, false, "of a helicopter, drone or balloon: its nose to the right of where it flies; none: along it"};
constexpr std::string_view kClosestHelp = "distance where it crosses the middle of its way";

constexpr std::array kLeftRight{distance("distance_m", 150, kClosestHelp),
                                kSpeed,
                                place("from_x_percent", 5, kFromX),
                                place("to_x_percent", 95, kToX),
                                place("from_y_percent", 40, kFromY),
                                place("to_y_percent", 40, kToY),
                                kNose};
constexpr std::array kRightLeft{distance("distance_m", 150, kClosestHelp),
                                kSpeed,
                                place("from_x_percent", 95, kFromX),
                                place("to_x_percent", 5, kToX),
                                place("from_y_percent", 40, kFromY),
                                place("to_y_percent", 40, kToY),
                                kNose};
constexpr std::array kApproaching{distance("from_distance_m", 400, "distance in the first frame"),
                                  distance("to_distance_m", 60, "distance in the last frame"),
                                  kSpeed,
                                  place("from_x_percent", 50, kFromX),
                                  place("to_x_percent", 50, kToX),
                                  place("from_y_percent", 40, kFromY),
                                  place("to_y_percent", 40, kToY),
                                  kNose};
constexpr std::array kMovingAway{distance("from_distance_m", 60, "distance in the first frame"),
                                 distance("to_distance_m", 400, "distance in the last frame"),
                                 kSpeed,
                                 place("from_x_percent", 50, kFromX),
                                 place("to_x_percent", 50, kToX),
                                 place("from_y_percent", 40, kFromY),
                                 place("to_y_percent", 40, kToY),
                                 kNose};
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

}  // namespace

std::string_view name_of(FlightKind kind) {
  constexpr std::array<std::string_view, 8> kNames{"left_right", "right_left",      "approaching", "moving_away",
                                                   "encounter",  "encounter_model", "recorded",    "image_position"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::optional<FlightKind> flight_kind_of(std::string_view name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(), [&](FlightKind kind) { return name_of(kind) == name; });
  return found == kKinds.end() ? std::nullopt : std::optional(*found);
}

std::span<const FlightKind> all_flight_kinds() {
  return kKinds;
}

std::span<const FlightQuantity> quantities_of(FlightKind kind) {
  switch (kind) {
    case FlightKind::left_right:
      return kLeftRight;
    case FlightKind::right_left:
      return kRightLeft;
    case FlightKind::approaching:
      return kApproaching;
    case FlightKind::moving_away:
      return kMovingAway;
    case FlightKind::encounter:
      return kEncounter;
    case FlightKind::encounter_model:
      return kEncounterModel;
    case FlightKind::recorded:
      return kRecorded;
    case FlightKind::image_position:
      return kImagePosition;
  }
  return {};
}

}  // namespace sigs
