// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "truth/annotation.h"

namespace pugi {
class xml_node;
}

namespace sigs {

// Names, numbers and rates as the text of label files. Names of files, projects and intruders come from users and may
// contain any bytes.

// Digits after the point of metres, degrees, seconds and fractions in text formats, and of an amodal box in pixels.
inline constexpr int kLabelDecimals = 6;
inline constexpr int kLabelPixelDecimals = 4;

// How many frames the footage's range has, and its nominal rate in frames a second: as a number, as a ratio
// "30000/1001", and as the nearest whole number above 0, which is all that some readers accept.
[[nodiscard]] int frame_count(const FootageTruth& footage);
[[nodiscard]] double rate_hz(const FootageTruth& footage);
[[nodiscard]] std::string rate_text(const FootageTruth& footage);
[[nodiscard]] int whole_rate_hz(const FootageTruth& footage);

// A name on one line without blanks at its ends, since readers of lists drop them. "unnamed" where nothing is left.
// It can be the name of a folder where `text` can.
[[nodiscard]] std::string line_name(std::string_view text);

// The same with underscores for blanks, for columns separated by blanks: "light aircraft" becomes light_aircraft.
[[nodiscard]] std::string word_name(std::string_view text);

// A text as a double-quoted scalar of YAML 1.2, with its quotes. Characters that XML forbids become U+FFFD, as in
// xml_text.
[[nodiscard]] std::string yaml_text(std::string_view text);

// A text as a JSON string (RFC 8259), with its quotes, and a JSON value; both on one line. Bytes that are not UTF-8
// become U+FFFD.
[[nodiscard]] std::string json_string(std::string_view text);
[[nodiscard]] std::string json_line(const nlohmann::ordered_json& json);

// Appends <name>text</name> to the children of a node; the text goes through xml_text.
void add_element(pugi::xml_node node, const char* name, const std::string& text);
void add_element(pugi::xml_node node, const char* name, int number);

// What label files say of the camera beyond its pose: where the pose comes from, how sure it is, where on the Earth.

// Digits after the point of latitude and longitude: 0.1 mm. Heights have kLabelDecimals.
inline constexpr int kLabelPlaceDecimals = 9;

// The standard deviation of the attitude in degrees, small turns about the camera's X, Y and Z; none where the pose's
// source states none. 180 where nothing is known of the attitude in this frame.
[[nodiscard]] std::optional<glm::dvec3> attitude_sd_deg(const CameraTruth& camera);

// Whether there is anything to say: a project without log and without a place on the Earth says nothing.
[[nodiscard]] bool has_source(const CameraTruth& camera);

// A number of the truth under the name that the SIGS annotation file, JSON Lines and, in this order, CSV have for it.
struct LabelNumber {
  const char* name;
  double value = 0;
  int decimals = kLabelDecimals;
};
using LabelNumbers = std::vector<LabelNumber>;

[[nodiscard]] LabelNumbers position_numbers(const glm::dvec3& position_m);
[[nodiscard]] LabelNumbers attitude_numbers(const glm::dquat& world_from_body);
[[nodiscard]] LabelNumbers deviation_numbers(const CameraTruth& camera);  // empty: attitude_sd_deg() has none
[[nodiscard]] LabelNumbers place_numbers(const GeodeticPosition& place);
[[nodiscard]] LabelNumbers box_numbers(const IntruderTruth& truth);        // visible, with pixels; empty: there is none
[[nodiscard]] LabelNumbers other_box_numbers(const IntruderTruth& truth);  // likewise of IntruderTruth::other_box
[[nodiscard]] LabelNumbers silhouette_numbers(const IntruderTruth& truth);  // amodal box; empty: there is none
// Also of COCO and Python's truth; CSV has those of its columns. Empty: no pixel shows it.
[[nodiscard]] LabelNumbers appearance_numbers(const IntruderTruth& truth);
[[nodiscard]] LabelNumbers light_numbers(const LampTruth& lamp);
[[nodiscard]] LabelNumbers cloud_numbers(const IntruderTruth& truth);     // empty: the project's clouds hide nothing
[[nodiscard]] LabelNumbers encounter_numbers(const EncounterTruth& now);  // the last may be infinite

// The columns of one frame, and their values: position and attitude in the world, sources, deviation and place. Those
// not known are empty.
inline constexpr std::string_view kCameraCsvHeader =
    "frame,time_s,camera_x_m,camera_y_m,camera_z_m,camera_roll_deg,camera_pitch_deg,camera_yaw_deg,"
    "camera_position_source,camera_attitude_source,camera_sd_x_deg,camera_sd_y_deg,camera_sd_z_deg,"
    "camera_latitude_deg,camera_longitude_deg,camera_height_m";
[[nodiscard]] std::string camera_csv_row(const FrameTruth& frame);

// The second half of that row, from camera_position_source on.
[[nodiscard]] std::string camera_source_fields(const CameraTruth& camera);

// "latitude,longitude,height", or two commas.
[[nodiscard]] std::string place_fields(const std::optional<GeodeticPosition>& place);

// As a JSON object on one line: position_m, attitude_deg, position_source, attitude_source, and where known
// attitude_sd_deg and place.
[[nodiscard]] std::string camera_json(const FrameTruth& frame);

// A row of KITTI's odometry poses: the twelve numbers of [R | t], row by row, that take a point from the camera's
// optical frame to that of a camera at the world's origin without attitude.
[[nodiscard]] std::string kitti_pose_row(const FrameTruth& frame);

}  // namespace sigs
