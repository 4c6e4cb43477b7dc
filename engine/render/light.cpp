// SPDX-License-Identifier: MIT
#include "render/light.h"

#include <algorithm>
#include <cmath>

namespace sigs {

namespace {

using ViewFromBody = Pose<frame::View, frame::Body>;

// A point p = scaled / scale, where the square of the length of `scaled` fits a float.
struct ScaledPoint {
  glm::vec3 scaled;
  float scale;
};

ScaledPoint scaled_point(const glm::dvec3& p) {
  constexpr double kFar_m = 1e6;
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double scale = largest > kFar_m ? kFar_m / largest : 1.0;
  return {p * scale, static_cast<float>(scale)};
}

// What lights of both kinds need.
void set_common(const Program& program, const glm::dvec3& color, const ViewFromBody& view_from_body) {
  program.use();
  const ScaledPoint eye = scaled_point(-view_from_body.translation_m);
  program.set("light_color", glm::vec3(color));
  program.set("eye_scaled", eye.scaled);
  program.set("eye_scale", eye.scale);
  program.set("view_from_body", glm::mat3(glm::mat3_cast(view_from_body.rotation)));
}

// Of any length that a double holds; straight up in the image where it has none.
glm::dvec3 unit(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0, 0, -1);
}

}  // namespace

void set_point_light(const Program& program, const Light& light, const ViewFromBody& view_from_body,
                     const Pose<frame::View, frame::Camera>& view_from_camera) {
  set_common(program, light.color, view_from_body);
  const ScaledPoint lamp = scaled_point(view_from_camera * light.p_in_camera - view_from_body.translation_m);
  program.set("ambient", static_cast<float>(std::clamp(light.ambient, 0.0, 1.0)));
  program.set("light_scaled", lamp.scaled);
  program.set("light_scale", lamp.scale);
}

void set_sun_light(const Program& program, const Light& light, const ViewFromBody& view_from_body,
                   const Pose<frame::View, frame::Camera>& view_from_camera, const SunView& sun) {
  set_common(program, light.color * light.exposure, view_from_body);
  program.set("to_sun", glm::vec3(view_from_camera.rotation * unit(light.to_sun)));
  program.set("up", glm::vec3(view_from_camera.rotation * unit(light.up)));
  program.set("sky_color", glm::vec3(light.sky_color * light.exposure));
  program.set("ground_color", glm::vec3(light.ground_color * light.exposure));
  const glm::dmat4 body_from_surface = glm::mat4_cast(glm::conjugate(view_from_body.rotation));
  program.set("texels_from_surface", glm::mat4(sun.texels_from_body * body_from_surface));
  program.set("sun_depth_range", static_cast<float>(sun.depth_texels));
  program.set("sun_depth", 1);
}

glm::dvec3 to_sun_in_body(const Light& light, const Pose<frame::Camera, frame::Body>& camera_from_body) {
  return glm::conjugate(camera_from_body.rotation) * unit(light.to_sun);
}

}  // namespace sigs
