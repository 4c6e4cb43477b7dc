// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/exact_lens.h"
#include "reference/fine_grid.h"
#include "reference/reference.h"
#include "reference/shading.h"
#include "reference/traced_body.h"

namespace sigs::truth {

// The result of one ray: premultiplied linear light with opacity, and whether it hits the body.
struct RayHit {
  glm::dvec4 color{0, 0, 0, 0};
  bool hits = false;
};

// Box around pixels' places.
struct Outline {
  glm::dvec2 low_px{0, 0};
  glm::dvec2 high_px{0, 0};
  bool is_empty = true;
  // False: part of the body has no image, the camera is within its radius, or the image goes round, so that the body
  // may cover a pole.
  bool is_whole = true;

  void add(const glm::dvec2& pixel);
};

class RayTracer {
 public:
  explicit RayTracer(const Setup& setup);

  // One row of the grid, left to right.
  [[nodiscard]] std::vector<RayHit> row(const FineGrid& grid, int j) const;

  // Around the images of all triangles' edges, which are followed every two pixels.
  [[nodiscard]] Outline outline() const;

 private:
  [[nodiscard]] RayHit ray_hit_along(const glm::dvec3& ray_in_camera, std::vector<Crossing>& scratch) const;
  [[nodiscard]] glm::dvec4 color_at(const Crossing& crossing, const glm::dvec3& ray_in_body) const;
  // Whether the body keeps the sun from a place on the surface, which is on a triangle.
  [[nodiscard]] bool is_in_shadow(const SurfacePoint& point, std::uint32_t triangle) const;
  [[nodiscard]] std::optional<glm::dvec2> image_of(const glm::dvec3& p_in_body) const;
  void add_edge(Outline& outline, std::uint32_t from, std::uint32_t to,
                const std::vector<std::optional<glm::dvec2>>& images) const;

  const Mesh* mesh_;
  Pose<frame::Camera, frame::Body> camera_from_body_;
  glm::dvec3 eye_in_body_m_;
  ExactLens<double> lens_;
  bool goes_round_;
  TracedBody body_;
  Lighting lighting_;
  Shader shader_;
};

}  // namespace sigs::truth
