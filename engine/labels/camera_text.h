// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "truth/annotation.h"

namespace sigs {

// What label files say of the camera beyond its pose: where the pose comes from, how sure it is, where on the Earth.

// Digits after the point of latitude and longitude: 0.1 mm. Heights have kLabelDecimals.
inline constexpr int kLabelPlaceDecimals = 9;

// The standard deviation of the attitude in degrees, small turns about the camera's X, Y and Z; none where the pose's
// source states none. 180 where nothing is known of the attitude in this frame.
[[nodiscard]] std::optional<glm::dvec3> attitude_sd_deg(const CameraTruth& camera);

// Whether there is anything to say: a project without log and without a place on the Earth says nothing.
[[nodiscard]] bool has_source(const CameraTruth& camera);

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
