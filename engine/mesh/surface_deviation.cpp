// SPDX-License-Identifier: MIT
#include "mesh/surface_deviation.h"

#include <algorithm>

namespace sigs {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

// Metres on the surface that a step in the texture stands for.
double meters_of_uv(const Corners& t, const glm::dvec2& step) {
  const glm::dvec2 u1(t[1]->uv - t[0]->uv);
  const glm::dvec2 u2(t[2]->uv - t[0]->uv);
  const double area = u1.x * u2.y - u1.y * u2.x;
  if (step == glm::dvec2(0)) return 0;
  if (area == 0) return kNowhere;
  const double along_1 = (step.x * u2.y - step.y * u2.x) / area;
  const double along_2 = (u1.x * step.y - u1.y * step.x) / area;
  return glm::length(along_1 * glm::dvec3(t[1]->position_m - t[0]->position_m) +
                     along_2 * glm::dvec3(t[2]->position_m - t[0]->position_m));
}

bool is_turned(const Vertex& vertex, const Corners& t, const glm::dvec3& share, double max_sine) {
  const glm::dvec3 there =
      share.x * glm::dvec3(t[0]->normal) + share.y * glm::dvec3(t[1]->normal) + share.z * glm::dvec3(t[2]->normal);
  const glm::dvec3 here(vertex.normal);
  const glm::dvec3 across = glm::cross(here, there);
  const double cosine = glm::dot(here, there);
  return cosine < 0 || glm::dot(across, across) > max_sine * max_sine * (cosine * cosine + glm::dot(across, across));
}

}  // namespace

glm::dvec3 closest_point_weights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double d1 = glm::dot(ab, p - a);
  const double d2 = glm::dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = glm::dot(ab, p - b);
  const double d4 = glm::dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = glm::dot(ab, p - c);
  const double d6 = glm::dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double share = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - share, share};
  }
  const double sum = va + vb + vc;
  return {1 - (vb + vc) / sum, vb / sum, vc / sum};
}

double offset_m(const Vertex& vertex, const Corners& t, bool is_textured, double limit_m, double max_sine) {
  const glm::dvec3 p(vertex.position_m);
  const glm::dvec3 a(t[0]->position_m);
  const glm::dvec3 b(t[1]->position_m);
  const glm::dvec3 c(t[2]->position_m);
  const glm::dvec3 share = closest_point_weights(p, a, b, c);
  const double off_m = glm::distance(p, share.x * a + share.y * b + share.z * c);
  if (!(off_m <= limit_m)) return kNowhere;
  if (max_sine < 1 && is_turned(vertex, t, share, max_sine)) return kNowhere;
  if (!is_textured) return off_m;
  const glm::dvec2 uv =
      share.x * glm::dvec2(t[0]->uv) + share.y * glm::dvec2(t[1]->uv) + share.z * glm::dvec2(t[2]->uv);
  const double max_m = std::max(off_m, meters_of_uv(t, glm::dvec2(vertex.uv) - uv));
  return max_m <= limit_m ? max_m : kNowhere;
}

}  // namespace sigs
