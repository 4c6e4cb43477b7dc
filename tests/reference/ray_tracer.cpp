// SPDX-License-Identifier: MIT
#include "reference/ray_tracer.h"

#include <algorithm>
#include <cmath>

namespace sigs::truth {
namespace {

Lighting lighting_of(const Setup& setup) {
  const Pose<frame::Body, frame::Camera> body_from_camera = inverse(setup.camera_from_body);
  Lighting lighting{.lamp_m = body_from_camera * setup.light_in_camera,
                    .eye_m = body_from_camera.translation_m,
                    .color = setup.light_color,
                    .ambient = std::clamp(setup.ambient, 0.0, 1.0),
                    .time_s = setup.time_s,
                    .blades_seen_s = setup.blades_seen_s};
  if (!setup.in_sun) return lighting;
  lighting.is_sun = true;
  lighting.color *= setup.exposure;
  lighting.to_sun = body_from_camera.rotation * glm::normalize(setup.to_sun_in_camera);
  lighting.up = body_from_camera.rotation * glm::normalize(setup.up_in_camera);
  lighting.sky = setup.sky_color * setup.exposure;
  lighting.ground = setup.ground_color * setup.exposure;
  return lighting;
}

// Follows the lens' inverse from one ray to the next, which lies close by.
class LensWalk {
 public:
  explicit LensWalk(const ExactLens<double>& lens) : lens_(&lens) {}

  std::optional<glm::dvec3> ray(const glm::dvec2& pixel_px) {
    std::optional<glm::dvec2> point;
    if (is_on_) point = lens_->plane_point_near(pixel_px, last_ + step_);
    // Beyond the field the search is long and fails: once a pixel is enough.
    const glm::dvec2 place = glm::floor(pixel_px + 0.5);
    if (!point && place != searched_) {
      point = lens_->plane_point(pixel_px);
      searched_ = place;
    }
    step_ = point && is_on_ ? *point - last_ : glm::dvec2(0);
    is_on_ = point.has_value();
    if (!point) return std::nullopt;
    last_ = *point;
    return lens_->ray_of(*point);
  }

 private:
  const ExactLens<double>* lens_;
  bool is_on_ = false;
  glm::dvec2 last_{0, 0};
  glm::dvec2 step_{0, 0};
  glm::dvec2 searched_{std::nan(""), 0};
};

}  // namespace

void Outline::add(const glm::dvec2& pixel) {
  low_px = is_empty ? pixel : glm::min(low_px, pixel);
  high_px = is_empty ? pixel : glm::max(high_px, pixel);
  is_empty = false;
}

RayTracer::RayTracer(const Setup& setup)
    : mesh_(setup.mesh),
      camera_from_body_(setup.camera_from_body),
      eye_in_body_m_(inverse(setup.camera_from_body).translation_m),
      lens_(setup.lens),
      goes_round_(setup.lens.model == LensModel::equirectangular),
      body_(*setup.mesh),
      lighting_(lighting_of(setup)),
      shader_(*setup.mesh, lighting_) {}

std::vector<RayHit> RayTracer::row(const FineGrid& grid, int j) const {
  std::vector<RayHit> ray_hits(static_cast<std::size_t>(grid.count_x));
  std::vector<Crossing> scratch;
  LensWalk walk(lens_);
  for (int i = 0; i < grid.count_x; ++i)
    if (const std::optional<glm::dvec3> ray = walk.ray(grid.ray_px(i, j)))
      ray_hits[static_cast<std::size_t>(i)] = ray_hit_along(*ray, scratch);
  return ray_hits;
}

RayHit RayTracer::ray_hit_along(const glm::dvec3& ray_in_camera, std::vector<Crossing>& scratch) const {
  const glm::dvec3 ray_in_body = glm::conjugate(camera_from_body_.rotation) * ray_in_camera;
  body_.cross(eye_in_body_m_, ray_in_body, scratch);
  RayHit ray_hits;
  for (const Crossing& crossing : scratch) {
    const glm::dvec4 color = color_at(crossing, ray_in_body);
    if (color.a == 0) continue;
    ray_hits.hits = true;
    ray_hits.color += (1 - ray_hits.color.a) * color;
    if (color.a >= 1) break;
  }
  return ray_hits;
}

glm::dvec4 RayTracer::color_at(const Crossing& crossing, const glm::dvec3& ray_in_body) const {
  const Triangle& triangle = body_.triangle(crossing.triangle);
  SurfacePoint point{.p_m = glm::dvec3(0), .normal = glm::dvec3(0), .uv = glm::dvec2(0), .material = triangle.material};
  glm::dvec3 corners[3];
  for (int k = 0; k < 3; ++k) {
    const Vertex& vertex = mesh_->vertices[triangle.corners[k]];
    corners[k] = vertex.position_m;
    point.p_m += crossing.weights[k] * corners[k];
    point.normal += crossing.weights[k] * glm::dvec3(vertex.normal);
    point.uv += crossing.weights[k] * glm::dvec2(vertex.uv);
  }
  const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  point.is_front = glm::dot(across, ray_in_body) < 0;
  if (!lighting_.is_sun) return shader_.shade(point);
  point.facet = glm::normalize(point.is_front ? across : -across);
  point.is_in_shadow = is_in_shadow(point, crossing.triangle);
  return shader_.shade(point);
}

bool RayTracer::is_in_shadow(const SurfacePoint& point, std::uint32_t triangle) const {
  if (!(glm::dot(point.facet, lighting_.to_sun) > 0)) return true;
  const double step_m = 1e-5 * body_.radius_m();  // off the surface: Embree's rays begin at floats
  std::vector<Crossing> crossings;
  body_.cross(point.p_m + step_m * point.facet, lighting_.to_sun, crossings);
  return std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& one) {
    if (one.triangle == triangle) return false;
    const Triangle& hit = body_.triangle(one.triangle);
    glm::dvec2 uv(0);
    for (int k = 0; k < 3; ++k) uv += one.weights[k] * glm::dvec2(mesh_->vertices[hit.corners[k]].uv);
    return shader_.stops_sun(hit.material, uv);
  });
}

std::optional<glm::dvec2> RayTracer::image_of(const glm::dvec3& p_in_body) const {
  return lens_.pixel(camera_from_body_ * p_in_body);
}

void RayTracer::add_edge(Outline& outline, std::uint32_t from, std::uint32_t to,
                         const std::vector<std::optional<glm::dvec2>>& images) const {
  constexpr double kStep_px = 2;
  constexpr int kMaxSteps = 64;
  int steps = kMaxSteps;
  if (images[from] && images[to])
    steps = static_cast<int>(std::min(std::ceil(glm::distance(*images[from], *images[to]) / kStep_px), 64.0));
  else
    outline.is_whole = false;
  const glm::dvec3 a = mesh_->vertices[from].position_m;
  const glm::dvec3 b = mesh_->vertices[to].position_m;
  for (int i = 1; i < steps; ++i)
    if (const auto image = image_of(glm::mix(a, b, double(i) / steps))) outline.add(*image);
}

Outline RayTracer::outline() const {
  Outline outline;
  std::vector<std::optional<glm::dvec2>> images;
  for (const Vertex& vertex : mesh_->vertices) images.push_back(image_of(vertex.position_m));
  for (const Triangle& triangle : body_.triangles())
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t corner = triangle.corners[k];
      if (images[corner]) outline.add(*images[corner]);
      add_edge(outline, corner, triangle.corners[(k + 1) % 3], images);
    }
  if (glm::length(eye_in_body_m_) <= body_.radius_m() || goes_round_) outline.is_whole = false;
  return outline;
}

}  // namespace sigs::truth
