// SPDX-License-Identifier: MIT
#include "labels/label_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "base/pose.h"
#include "base/text.h"

namespace sigs {

int frame_count(const FootageTruth& footage) {
  return footage.last_frame - footage.first_frame + 1;
}

double rate_hz(const FootageTruth& footage) {
  return static_cast<double>(footage.frame_rate_num) / footage.frame_rate_den;
}

std::string rate_text(const FootageTruth& footage) {
  return fmt::format("{}/{}", footage.frame_rate_num, footage.frame_rate_den);
}

int whole_rate_hz(const FootageTruth& footage) {
  return std::max(1, static_cast<int>(std::lround(rate_hz(footage))));
}

std::string line_name(std::string_view text) {
  const std::string line = line_text(text);
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return "unnamed";
  return line.substr(first, line.find_last_not_of(' ') - first + 1);
}

std::string word_name(std::string_view text) {
  std::string word = line_name(text);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

// A double-quoted scalar of YAML has JSON's escapes, except for surrogate pairs of \u, which YAML does not join. So
// other characters are written as they are, except for those that YAML forbids: what XML forbids, DEL, the C1 controls.
std::string yaml_text(std::string_view text) {
  const std::string quoted = json_string(xml_text(text));
  std::string out;
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    const auto byte = static_cast<unsigned char>(quoted[i]);
    const bool is_c1 = byte == 0xC2 && static_cast<unsigned char>(quoted[i + 1]) < 0xA0;
    const unsigned code = is_c1 ? static_cast<unsigned char>(quoted[++i]) : byte;
    if (is_c1 || code == 0x7F)
      out += fmt::format("\\x{:02x}", code);
    else
      out += quoted[i];
  }
  return out;
}

std::string json_string(std::string_view text) {
  return json_line(nlohmann::ordered_json(text));
}

std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void add_element(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_child(name).text() = xml_text(text).c_str();
}

void add_element(pugi::xml_node node, const char* name, int number) {
  add_element(node, name, std::to_string(number));
}

namespace {

std::string number(double value, int decimals = kLabelDecimals) {
  return number_text(value, decimals);
}

std::string joined(const glm::dvec3& v, const char* separator) {
  return number(v.x) + separator + number(v.y) + separator + number(v.z);
}

glm::dvec3 degrees(const glm::dquat& rotation) {
  const Attitude attitude = attitude_of(rotation);
  return {deg_of_rad(attitude.roll_rad), deg_of_rad(attitude.pitch_rad), deg_of_rad(attitude.yaw_rad)};
}

std::string source_text(const std::string& source) {
  return source.empty() ? "project" : line_text(source);
}

LabelNumbers numbers_of(const std::optional<cv::Rect>& whole_pixels, int pixels) {
  if (!whole_pixels) return {};
  const cv::Rect2d box = *whole_pixels;
  return {{"x", box.x},
          {"y", box.y},
          {"width", box.width},
          {"height", box.height},
          {"pixels", static_cast<double>(pixels)}};
}

}  // namespace

std::optional<glm::dvec3> attitude_sd_deg(const CameraTruth& camera) {
  if (!camera.attitude_sd_rad) return std::nullopt;
  glm::dvec3 sd_deg;
  for (int axis = 0; axis < 3; ++axis) {
    const double deg = deg_of_rad((*camera.attitude_sd_rad)[axis]);
    sd_deg[axis] = deg < 180 ? std::max(deg, 0.0) : 180;  // not a number counts as unknown
  }
  return sd_deg;
}

LabelNumbers position_numbers(const glm::dvec3& position_m) {
  return {{"x_m", position_m.x}, {"y_m", position_m.y}, {"z_m", position_m.z}};
}

LabelNumbers attitude_numbers(const glm::dquat& world_from_body) {
  const glm::dvec3 deg = degrees(world_from_body);
  return {{"roll_deg", deg.x}, {"pitch_deg", deg.y}, {"yaw_deg", deg.z}};
}

LabelNumbers deviation_numbers(const CameraTruth& camera) {
  const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(camera);
  if (!sd_deg) return {};
  return {{"sd_x_deg", sd_deg->x}, {"sd_y_deg", sd_deg->y}, {"sd_z_deg", sd_deg->z}};
}

LabelNumbers place_numbers(const GeodeticPosition& place) {
  return {{"latitude_deg", place.latitude_deg, kLabelPlaceDecimals},
          {"longitude_deg", place.longitude_deg, kLabelPlaceDecimals},
          {"height_m", place.height_m}};
}

LabelNumbers box_numbers(const IntruderTruth& truth) {
  return numbers_of(truth.visible_box, truth.visible_pixels);
}

LabelNumbers other_box_numbers(const IntruderTruth& truth) {
  return numbers_of(truth.other_box, truth.other_pixels);
}

LabelNumbers silhouette_numbers(const IntruderTruth& truth) {
  if (!truth.amodal_box) return {};
  const Box& box = *truth.amodal_box;
  return {{"x", box.x, kLabelPixelDecimals},
          {"y", box.y, kLabelPixelDecimals},
          {"width", box.width, kLabelPixelDecimals},
          {"height", box.height, kLabelPixelDecimals}};
}

LabelNumbers appearance_numbers(const IntruderTruth& truth) {
  if (!truth.detectability) return {};
  LabelNumbers numbers{{"weber_contrast", truth.detectability->weber_contrast},
                       {"rms_contrast", truth.detectability->rms_contrast},
                       {"signal_to_noise", truth.detectability->signal_to_noise},
                       {"blur_px", truth.image_formation.blur_px},
                       {"motion_blur_px", truth.image_formation.motion_blur_px}};
  if (truth.image_formation.visibility_m) numbers.push_back({"visibility_m", *truth.image_formation.visibility_m});
  return numbers;
}

LabelNumbers light_numbers(const LampTruth& lamp) {
  return {{"x", lamp.pixel.x}, {"y", lamp.pixel.y}, {"share", lamp.share}, {"brightest", lamp.brightest}};
}

LabelNumbers cloud_numbers(const IntruderTruth& truth) {
  if (!truth.clouds) return {};
  return {{"hidden", truth.clouds->hidden}, {"assumed_distance_m", truth.clouds->assumed_distance_m}};
}

LabelNumbers encounter_numbers(const EncounterTruth& now) {
  return {{"range_rate_mps", now.range_rate_mps},
          {"closing_speed_mps", now.closing_speed_mps},
          {"bearing_deg", deg_of_rad(now.bearing_rad)},
          {"elevation_deg", deg_of_rad(now.elevation_rad)},
          {"hmd_m", now.hmd_m},
          {"vmd_m", now.vmd_m},
          {"time_to_closest_approach_s", now.time_to_closest_approach_s},
          {"time_to_coaltitude_s", now.time_to_coaltitude_s}};
}

bool has_source(const CameraTruth& camera) {
  return !camera.position_source.empty() || !camera.attitude_source.empty() || camera.attitude_sd_rad || camera.place;
}

std::string place_fields(const std::optional<GeodeticPosition>& place) {
  if (!place) return ",,";
  return number(place->latitude_deg, kLabelPlaceDecimals) + "," + number(place->longitude_deg, kLabelPlaceDecimals) +
         "," + number(place->height_m);
}

std::string camera_source_fields(const CameraTruth& camera) {
  const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(camera);
  return csv_field(source_text(camera.position_source)) + "," + csv_field(source_text(camera.attitude_source)) + "," +
         (sd_deg ? joined(*sd_deg, ",") : ",,") + "," + place_fields(camera.place);
}

std::string camera_csv_row(const FrameTruth& frame) {
  return fmt::format("{},{},{},{},{}\n", frame.index, number(frame.time_s), joined(frame.camera_position_m, ","),
                     joined(degrees(frame.world_from_camera), ","), camera_source_fields(frame.camera));
}

std::string camera_json(const FrameTruth& frame) {
  const CameraTruth& camera = frame.camera;
  std::string text =
      fmt::format(R"({{"position_m": [{}], "attitude_deg": [{}], "position_source": {}, )"
                  R"("attitude_source": {})",
                  joined(frame.camera_position_m, ", "), joined(degrees(frame.world_from_camera), ", "),
                  json_string(source_text(camera.position_source)), json_string(source_text(camera.attitude_source)));
  if (const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(camera))
    text += fmt::format(R"(, "attitude_sd_deg": [{}])", joined(*sd_deg, ", "));
  if (camera.place)
    text += fmt::format(R"(, "place": [{}, {}, {}])", number(camera.place->latitude_deg, kLabelPlaceDecimals),
                        number(camera.place->longitude_deg, kLabelPlaceDecimals), number(camera.place->height_m));
  return text + "}";
}

std::string kitti_pose_row(const FrameTruth& frame) {
  const glm::dquat& world_from_camera = frame.world_from_camera;
  std::array<glm::dvec3, 3> columns;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit(0);
    unit[axis] = 1;
    columns[static_cast<std::size_t>(axis)] = optical_of(world_from_camera * camera_of(unit));
  }
  const glm::dvec3 origin_m = optical_of(frame.camera_position_m);
  std::string text;
  for (int row = 0; row < 3; ++row)
    text += fmt::format("{}{} {} {} {}", row == 0 ? "" : " ", number(columns[0][row], 9), number(columns[1][row], 9),
                        number(columns[2][row], 9), number(origin_m[row]));
  return text + "\n";
}

}  // namespace sigs
