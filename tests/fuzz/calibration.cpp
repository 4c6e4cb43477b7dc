// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <optional>

#include "base/ensure.h"
#include "camera/camera.h"
#include "camera/rig_calibration.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

namespace {

// Pixels in and beyond the image have a ray that leads back to them, or none.
void check_camera(const Camera& camera) {
  ENSURE(camera.size_px.width >= 0 && camera.size_px.height >= 0);
  ENSURE(camera.lens.valid_angle_rad() >= 0);
  for (const double share : {-0.5, 0.0, 0.3, 1.0}) {
    const glm::dvec2 pixel{share * camera.size_px.width, (1 - share) * camera.size_px.height};
    const std::optional<glm::dvec3> ray = camera.lens.ray(pixel);
    if (!ray) continue;
    ENSURE(std::isfinite(ray->x) && std::isfinite(ray->y) && std::isfinite(ray->z));
    if (const std::optional<glm::dvec2> back = camera.lens.pixel(*ray))
      ENSURE(std::isfinite(back->x) && std::isfinite(back->y));
  }
}

}  // namespace

void try_calibration(const FuzzInput& input) {
  const std::filesystem::path path = input.file("lens");
  const std::array<std::optional<cv::Size>, 2> sizes_px{std::nullopt, cv::Size(640, 480)};
  for (const std::optional<cv::Size>& size_px : sizes_px)
    for (int i = -1; i < static_cast<int>(lens_models().size()); ++i) {
      const std::optional<LensModel> model = i < 0 ? std::nullopt : std::optional(static_cast<LensModel>(i));
      const Result<Camera> camera = read_calibration(path, size_px, model);
      if (!camera) {
        check_message(camera.error());
        continue;
      }
      check_messages(camera->warnings);
      check_camera(*camera);
    }
  const Result<RigCalibration> rig = read_rig_calibration(path, {.size_px = cv::Size(640, 480)});
  if (!rig) return check_message(rig.error());
  check_messages(rig->warnings);
  for (const CalibratedCamera& one : rig->cameras) {
    ENSURE(std::abs(glm::length(one.first_from_camera.rotation) - 1) < 1e-9);
    check_camera(one.camera);
  }
}

}  // namespace sigs::fuzz
