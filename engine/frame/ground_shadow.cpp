// SPDX-License-Identifier: MIT
#include "frame/ground_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "compositor/blur.h"
#include "frame/look.h"
#include "frame/panorama.h"

namespace sigs {

namespace {

constexpr double kSun_rad = 0.0093;   // the sun's disc across
constexpr int kFine = 4;              // samples of a pixel across and down
constexpr int kLargest_px = 4096;     // of a shadow that is drawn so finely
constexpr double kFar_px = 1e5;       // beyond which no corner is drawn
constexpr double kMaxSigma_px = 300;  // what is softer is no longer seen

// Corners on the ground as pixels; none where a corner has no image.
class SeenGround {
 public:
  SeenGround(const SceneMoment& moment, const Lens& lens)
      : camera_from_world_(glm::conjugate(moment.world_from_camera.rotation)),
        camera_m_(moment.world_from_camera.translation_m),
        lens_(lens) {}

  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& ground_m) const {
    const std::optional<glm::dvec2> at = lens_.pixel(camera_from_world_ * (ground_m - camera_m_));
    if (!at || !(std::abs(at->x) < kFar_px) || !(std::abs(at->y) < kFar_px)) return std::nullopt;
    return at;
  }

  // Whether two corners lie on different sides of where the lens' columns repeat.
  [[nodiscard]] bool is_torn(const glm::dvec2& a, const glm::dvec2& b) const {
    return lens_.period_px() > 0 && std::abs(a.x - b.x) > lens_.period_px() / 2;
  }

  // Pixels in a metre of the ground, the mean of both directions by area.
  [[nodiscard]] double pixels_per_m(const glm::dvec3& ground_m) const {
    const auto here = pixel(ground_m), along = pixel(ground_m + glm::dvec3(1, 0, 0)),
               across = pixel(ground_m + glm::dvec3(0, 1, 0));
    if (!here || !along || !across) return 0;
    const glm::dvec2 a = *along - *here, b = *across - *here;
    return std::sqrt(std::abs(a.x * b.y - a.y * b.x));
  }

 private:
  glm::dquat camera_from_world_;
  glm::dvec3 camera_m_;
  const Lens& lens_;
};

using Corners = std::array<glm::dvec2, 3>;

// The shadows of the mesh's triangles in the image.
std::vector<Corners> seen_triangles(const Mesh& mesh, const Pose<frame::World, frame::Body>& world_from_body,
                                    const glm::dvec3& to_sun, const SeenGround& ground) {
  std::vector<std::optional<glm::dvec2>> pixels;
  pixels.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    const std::optional<glm::dvec3> on_ground = shadow_of(world_from_body * glm::dvec3(vertex.position_m), to_sun);
    pixels.push_back(on_ground ? ground.pixel(*on_ground) : std::nullopt);
  }
  std::vector<Corners> triangles;
  for (const MeshPart& part : mesh.parts) {
    const Material& material = mesh.materials[static_cast<std::size_t>(part.material)];
    if (material.rotor) continue;  // which hardly darkens the ground
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
      const auto &a = pixels[mesh.indices[i]], &b = pixels[mesh.indices[i + 1]], &c = pixels[mesh.indices[i + 2]];
      if (a && b && c && !ground.is_torn(*a, *b) && !ground.is_torn(*b, *c) && !ground.is_torn(*c, *a))
        triangles.push_back({*a, *b, *c});
    }
  }
  return triangles;
}

// Sets the samples whose middles lie in a triangle.
void fill(cv::Mat& samples, const Corners& corners) {
  const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const int begin = std::max(0, static_cast<int>(std::ceil(low)));
  const int end = std::min(samples.rows - 1, static_cast<int>(std::floor(high)));
  for (int y = begin; y <= end; ++y) {
    double left = kFar_px * kFine, right = -left;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 &from = corners[i], &to = corners[(i + 1) % 3];
      if (std::min(from.y, to.y) > y || std::max(from.y, to.y) < y) continue;
      const double share = from.y == to.y ? 0 : (y - from.y) / (to.y - from.y);
      const double x = std::lerp(from.x, to.x, share);
      left = std::min({left, x, from.y == to.y ? to.x : x});
      right = std::max({right, x, from.y == to.y ? to.x : x});
    }
    const int first = std::max(0, static_cast<int>(std::ceil(left)));
    const int last = std::min(samples.cols - 1, static_cast<int>(std::floor(right)));
    if (first <= last) samples.row(y).colRange(first, last + 1).setTo(255);
  }
}

// How much of each pixel of rect the triangles cover together: CV_32FC1, 0..1.
cv::Mat covered(const std::vector<Corners>& triangles, const cv::Rect& rect) {
  const int fine = std::max(rect.width, rect.height) <= kLargest_px ? kFine : 1;
  cv::Mat samples = cv::Mat::zeros(rect.height * fine, rect.width * fine, CV_8UC1);
  for (Corners corners : triangles) {
    for (glm::dvec2& corner : corners) corner = (corner - glm::dvec2(rect.x, rect.y) + 0.5) * double(fine) - 0.5;
    fill(samples, corners);
  }
  cv::Mat share, small;
  cv::resize(samples, small, rect.size(), 0, 0, cv::INTER_AREA);
  small.convertTo(share, CV_32F, 1.0 / 255);
  return share;
}

cv::Rect bounds_of(const std::vector<Corners>& triangles, const cv::Rect& within) {
  glm::dvec2 low(kFar_px), high(-kFar_px);
  for (const Corners& corners : triangles)
    for (const glm::dvec2& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
  if (triangles.empty()) return {};
  return pixels_touched({low.x, low.y, high.x - low.x, high.y - low.y}, 1, within);
}

}  // namespace

std::optional<glm::dvec3> shadow_of(const glm::dvec3& point_m, const glm::dvec3& to_sun) {
  if (!(point_m.z < 0) || !(to_sun.z < 0)) return std::nullopt;
  const glm::dvec3 at = point_m - to_sun * (point_m.z / to_sun.z);
  if (!std::isfinite(at.x) || !std::isfinite(at.y)) return std::nullopt;
  return glm::dvec3(at.x, at.y, 0);
}

GroundShadow ground_shadow(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                           const Lens& camera_lens, double sigma_px, const cv::Rect& image) {
  const SceneLight& light = scene.light;
  if (light.ground_shadow <= 0 || light.kind != LightKind::sun) return {};
  if (!(moment.world_from_camera.translation_m.z < 0)) return {};
  const glm::dvec3 to_sun = moment.world_from_camera.rotation * moment.to_sun_in_camera;
  const Pose<frame::World, frame::Body> world_from_body{
      placed.world_from_body, moment.world_from_camera * placed.camera_from_body.translation_m};
  const std::optional<glm::dvec3> middle = shadow_of(world_from_body.translation_m, to_sun);
  if (!middle) return {};
  const Lens lens = camera_lens.around(inverse(moment.world_from_camera) * *middle);
  const std::optional<glm::dvec2> middle_px = lens.pixel(inverse(moment.world_from_camera) * *middle);
  const cv::Rect bounds = middle_px && lens.period_px() > 0 ? window_around(middle_px->x, lens, image.size()) : image;
  const SeenGround ground(moment, lens);
  const double penumbra_m = kSun_rad * glm::length(*middle - world_from_body.translation_m);
  const double soft_px = std::hypot(sigma_px, penumbra_m / 4 * ground.pixels_per_m(*middle));
  if (soft_px > kMaxSigma_px) return {};
  const Mesh& mesh = scene.intruders[static_cast<std::size_t>(placed.id)].model->mesh;
  const std::vector<Corners> triangles = seen_triangles(mesh, world_from_body, to_sun, ground);
  const cv::Rect rect = bounds_of(triangles, grown(bounds, blur_margin_px(soft_px)));
  if (rect.empty()) return {};
  const double distance_m = glm::length(*middle - moment.world_from_camera.translation_m);
  const double left = light_through_haze(scene, distance_m);
  Layer layer{.rect = rect, .color = cv::Mat(rect.size(), CV_32FC4, cv::Scalar::all(0))};
  cv::insertChannel(covered(triangles, rect) * (light.ground_shadow * moment.sun_visible_share * left), layer.color, 3);
  layer.coverage = cv::Mat::zeros(rect.size(), CV_32FC1);
  return {.layer = blurred_through(lens, layer, soft_px, bounds), .distance_m = distance_m};
}

}  // namespace sigs
