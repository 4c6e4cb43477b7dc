// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "base/image.h"
#include "base/pose.h"
#include "camera/virtual_camera.h"
#include "mesh/mesh.h"
#include "render/renderer.h"

namespace sigs::test {

// One renderer for the thread that runs the tests: making one takes longer than most tests.
[[nodiscard]] Renderer& renderer();

// Material of one colour (display code values).
[[nodiscard]] Material paint(const glm::vec3& diffuse, float opacity = 1);

inline const Material kWhite{.diffuse = {1, 1, 1}};

// Adds a rectangle: corner, and two edges whose cross product points to the side from which it is seen. uv runs from
// (0, 0) at the corner along the edges.
void add_quad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v, int material);

// Sets bounds and radius. Call it when all is added.
[[nodiscard]] Mesh measured(Mesh mesh);

// A rectangle across X, at x, which looks back along X at an eye behind it, as wide (Y) and high (Z) as given.
[[nodiscard]] Mesh facing_quad(const glm::dvec2& low_m, const glm::dvec2& high_m, const Material& material,
                               float x_m = 0);

// A box around the origin with the given half sides.
[[nodiscard]] Mesh box(const glm::vec3& half_m, const Material& material);

// A view straight along the camera's axis.
[[nodiscard]] VirtualCamera view_of(const cv::Size& size_px, double focal_px);

[[nodiscard]] Pose<frame::Camera, frame::Body> at(const glm::dvec3& p_in_camera);

// Ambient light alone.
[[nodiscard]] Light ambient_only(double ambient = 1);

// Renders a copy of the mesh, which stays alive, with the shared renderer. An error fails the test.
[[nodiscard]] Layer drawn(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                          const Light& light, const VirtualCamera& view);

[[nodiscard]] bool same_bytes(const cv::Mat& a, const cv::Mat& b);

// No NaN and no infinity; opacity and coverage within 0..1; no colour where there is no opacity; nothing covered less
// than it is opaque.
[[nodiscard]] bool is_valid(const Layer& layer);

}  // namespace sigs::test
