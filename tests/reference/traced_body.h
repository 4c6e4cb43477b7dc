// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "mesh/mesh.h"

namespace sigs::truth {

// Where a ray meets a triangle.
struct Crossing {
  std::uint32_t triangle = 0;
  double t_m = 0;      // along the ray
  glm::dvec3 weights;  // of the triangle's three corners
};

struct Triangle {
  std::uint32_t corners[3];  // numbers of vertices
  int material = 0;
};

// A mesh that rays can be sent through, in body coordinates. Embree counts in floats: rays are moved to begin near the
// body, so that its numbers are of the body's size however far away the camera is.
class TracedBody {
 public:
  explicit TracedBody(const Mesh& mesh);
  ~TracedBody();
  TracedBody(const TracedBody&) = delete;
  TracedBody& operator=(const TracedBody&) = delete;

  // Crossings from near to far, up to the first with a material that lets no light through; those behind it may be
  // among them too. direction is a unit vector. Reuses the vector's memory.
  void cross(const glm::dvec3& origin_m, const glm::dvec3& direction, std::vector<Crossing>& crossings) const;

  [[nodiscard]] const Triangle& triangle(std::uint32_t number) const { return triangles_[number]; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }  // around the body's origin

 private:
  struct Embree;
  std::vector<Triangle> triangles_;
  std::vector<bool> is_opaque_;  // by triangle
  double radius_m_ = 0;
  std::unique_ptr<Embree> embree_;
};

}  // namespace sigs::truth
