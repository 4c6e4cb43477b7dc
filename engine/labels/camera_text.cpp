// SPDX-License-Identifier: MIT
#include "labels/camera_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/csv.h"
#include "base/pose.h"
#include "base/text.h"
#include "labels/label_text.h"

namespace sigs {

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
