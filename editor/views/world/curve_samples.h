// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sigs::editor {

// A curve as a polyline: points at parameters that grow.
struct CurveSamples {
  std::vector<double> at;
  std::vector<glm::dvec3> points_m;

  // On the polyline, between its ends; the ends beyond them. Needs a point at least.
  [[nodiscard]] glm::dvec3 point_at(double parameter) const;
};

// Samples a curve where it bends: pieces are halved, the one whose middle lies farthest off the middle of its chord
// first, until none lies farther than tolerance_m or `maximum` points are there (at least 2). Parameters of `through`
// that lie within first
// .. last get a point of their own, up to half of `maximum`. last <= first: a single point.
[[nodiscard]] CurveSamples sampled_curve(const std::function<glm::dvec3(double)>& curve, double first, double last,
                                         std::span<const double> through, double tolerance_m, std::size_t maximum);

// The stretch of a polyline between two parameters, with its ends; nothing where they leave no stretch.
[[nodiscard]] std::vector<glm::dvec3> stretch(const CurveSamples& samples, double from, double to);

}  // namespace sigs::editor
