// SPDX-License-Identifier: MIT
#include "truth.h"

#include <pybind11/pybind11.h>

#include <cmath>
#include <optional>
#include <string>

#include "base/pose.h"
#include "labels/camera_text.h"

namespace sigs::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

py::object class_of(const char* name) {
  return py::module_::import("sigs.truth").attr(name);
}

py::tuple tuple_of(const glm::dvec3& v) {
  return py::make_tuple(v.x, v.y, v.z);
}

py::object object_of(const Attitude& attitude) {
  return class_of("Attitude")(deg_of_rad(attitude.roll_rad), deg_of_rad(attitude.pitch_rad),
                              deg_of_rad(attitude.yaw_rad));
}

py::object object_of(const std::optional<GeodeticPosition>& place) {
  if (!place) return py::none();
  return class_of("Place")(place->latitude_deg, place->longitude_deg, place->height_m);
}

// The label file leaves out what is infinite: it does not come.
py::object finite(double number) {
  if (std::isfinite(number)) return py::float_(number);
  return py::none();
}

template <class T>
py::object or_none(const std::optional<T>& value) {
  if (value) return py::cast(*value);
  return py::none();
}

py::object appearance_of(const IntruderTruth& truth) {
  if (!truth.detectability) return py::none();
  return class_of("Appearance")(
      "weber_contrast"_a = truth.detectability->weber_contrast, "rms_contrast"_a = truth.detectability->rms_contrast,
      "signal_to_noise"_a = truth.detectability->signal_to_noise, "blur_px"_a = truth.image_formation.blur_px,
      "motion_blur_px"_a = truth.image_formation.motion_blur_px,
      "visibility_m"_a = or_none(truth.image_formation.visibility_m));
}

py::object encounter_of(const IntruderTruth& truth) {
  if (!truth.encounter) return py::none();
  const EncounterTruth& now = *truth.encounter;
  py::list volumes;
  for (const WellClearTruth& volume : now.of_volumes)
    volumes.append(class_of("WellClear")("volume"_a = volume.volume, "lost"_a = volume.is_lost,
                                         "tau_mod_s"_a = finite(volume.tau_mod_s), "severity"_a = volume.severity));
  return class_of("Encounter")(
      "range_rate_mps"_a = now.range_rate_mps, "closing_speed_mps"_a = now.closing_speed_mps,
      "bearing_deg"_a = deg_of_rad(now.bearing_rad), "elevation_deg"_a = deg_of_rad(now.elevation_rad),
      "hmd_m"_a = now.hmd_m, "vmd_m"_a = now.vmd_m, "time_to_closest_approach_s"_a = now.time_to_closest_approach_s,
      "time_to_coaltitude_s"_a = finite(now.time_to_coaltitude_s), "well_clear"_a = py::tuple(volumes));
}

py::object box_of(const std::optional<cv::Rect>& box) {
  if (!box) return py::none();
  return class_of("Box")(box->x, box->y, box->width, box->height);
}

py::object silhouette_of(const std::optional<Box>& box) {
  if (!box) return py::none();
  return class_of("Silhouette")(box->x, box->y, box->width, box->height);
}

py::object object_of(const IntruderTruth& truth) {
  return class_of("IntruderTruth")(
      "id"_a = truth.id, "name"_a = truth.name, "role"_a = truth.is_distractor ? "distractor" : "intruder",
      "in_picture"_a = truth.in_image, "visible_fraction"_a = truth.visible_fraction,
      "horizon"_a = std::string(name_of(truth.horizon)), "position_m"_a = tuple_of(truth.position_m),
      "distance_m"_a = glm::length(truth.position_m), "attitude_deg"_a = object_of(attitude_of(truth.world_from_body)),
      "place"_a = object_of(truth.place), "box"_a = box_of(truth.visible_box), "pixels"_a = truth.visible_pixels,
      "silhouette"_a = silhouette_of(truth.amodal_box), "appearance"_a = appearance_of(truth),
      "encounter"_a = encounter_of(truth));
}

py::object camera_object(const FrameTruth& truth) {
  const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(truth.camera);
  return class_of("CameraTruth")("position_m"_a = tuple_of(truth.camera_position_m),
                                 "attitude_deg"_a = object_of(attitude_of(truth.world_from_camera)),
                                 "position_source"_a = truth.camera.position_source,
                                 "attitude_source"_a = truth.camera.attitude_source,
                                 "attitude_sd_deg"_a = sd_deg ? py::object(tuple_of(*sd_deg)) : py::none(),
                                 "place"_a = object_of(truth.camera.place));
}

}  // namespace

py::object truth_object(const FrameTruth& truth) {
  py::list intruders;
  for (const IntruderTruth& intruder : truth.intruders) intruders.append(object_of(intruder));
  return class_of("FrameTruth")("index"_a = truth.index, "time_s"_a = truth.time_s, "substituted"_a = truth.substituted,
                                "camera"_a = camera_object(truth), "intruders"_a = py::tuple(intruders));
}

}  // namespace sigs::python
