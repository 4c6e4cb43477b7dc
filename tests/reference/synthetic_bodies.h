// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"
#include "reference/reference.h"

namespace sigs::truth {

// Bodies of known shape, in body axes, and their positions. The camera looks along X; poses have no rotation.

[[nodiscard]] Material painted(const glm::vec3& diffuse, float opacity = 1);

// A square across X, seen from -X, with corners at y, z = middle +- side / 2.
void add_square(Mesh& mesh, const Material& material, double x_m, const glm::dvec2& middle_m, double side_m);
[[nodiscard]] Mesh square(const Material& material, double side_m);

[[nodiscard]] Mesh sphere(double radius_m);

// A band of a cylinder around X, seen from within.
[[nodiscard]] Mesh band(double radius_m, double first_x_m, double last_x_m);

// Pinhole in the middle of the image, light far behind the camera, body at (x, y, z) in front of it.
[[nodiscard]] Setup setup_for(const Mesh& mesh, const glm::dvec3& p_in_camera_m, double focal_px, cv::Size size_px);

}  // namespace sigs::truth
