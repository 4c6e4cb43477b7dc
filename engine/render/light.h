// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "base/pose.h"
#include "render/gl_objects.h"
#include "render/shadow_map.h"

namespace sigs {

// What lights a body: an omnidirectional point light (paper section 3.1.2) with ambient light; or the sun with the
// light of sky and ground. Colours are linear; 1: a white surface that the light falls on squarely becomes white.
struct Light {
  enum class Kind { point, sun };

  glm::dvec3 p_in_camera{0, 0, 0};  // of the point light: metres, camera frame
  glm::dvec3 color{1, 1, 1};        // of the point light or of the sun
  double ambient = 0.35;            // of the point light, 0..1: share that comes from everywhere

  Kind kind = Kind::point;
  glm::dvec3 to_sun{0, 0, -1};       // direction, camera frame; of any length but 0
  glm::dvec3 up{0, 0, -1};           // direction of the world's zenith, camera frame; of any length but 0
  glm::dvec3 sky_color{0, 0, 0};     // what the whole sky gives a surface that looks up
  glm::dvec3 ground_color{0, 0, 0};  // what the ground gives a surface that looks down
  double exposure = 1;               // factor of sun, sky and ground
};

// Sets the uniforms of a program for a body; the program is in use afterwards. The second for programs with SUN, which
// need the map of the body's shadows bound too.
void set_point_light(const Program& program, const Light& light, const Pose<frame::View, frame::Body>& view_from_body,
                     const Pose<frame::View, frame::Camera>& view_from_camera);
void set_sun_light(const Program& program, const Light& light, const Pose<frame::View, frame::Body>& view_from_body,
                   const Pose<frame::View, frame::Camera>& view_from_camera, const SunView& sun);

// Unit vector towards the sun in the body's axes.
[[nodiscard]] glm::dvec3 to_sun_in_body(const Light& light, const Pose<frame::Camera, frame::Body>& camera_from_body);

}  // namespace sigs
