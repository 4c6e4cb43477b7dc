// SPDX-License-Identifier: MIT
#include "see_intruder.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "camera/aimed_view.h"
#include "compositor/blur.h"
#include "compositor/hide.h"

namespace sigs {

namespace {

constexpr int kLargestView_px = 4096;  // some 300 MB; a larger picture of a nearer intruder is drawn coarser
constexpr double kRounding = 1e-6;     // of sums of floats: a visible share below it is none
constexpr int kWholeAreaSteps = 256;   // pixels across in which a silhouette beyond the picture's edge is measured

cv::Rect picture_of(const Scene& scene) {
  return {{0, 0}, scene.footage.size_px};
}

std::array<glm::dvec3, 8> corners_in_camera(const Mesh& mesh,
                                            const Pose<frame::Camera, frame::Body>& camera_from_body) {
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) ? mesh.high_m.x : mesh.low_m.x, (i & 2) ? mesh.high_m.y : mesh.low_m.y,
                            (i & 4) ? mesh.high_m.z : mesh.low_m.z);
    corners[i] = camera_from_body * corner;
  }
  return corners;
}

// Pixels that the intruder can reach, blur counted in. Where a part of it has no image, its faces may still span the
// picture: then all of it.
cv::Rect reach_of(const std::optional<Silhouette>& silhouette, double distance_m, double radius_m, int blur_px,
                  const cv::Rect& picture) {
  const cv::Rect grown(picture.x - blur_px, picture.y - blur_px, picture.width + 2 * blur_px,
                       picture.height + 2 * blur_px);
  const bool around_camera = distance_m <= radius_m;
  if (!silhouette) return around_camera ? grown : cv::Rect();
  if (!silhouette->all_have_image || around_camera) return grown;
  return pixels_touched(silhouette->box, 1, grown);
}

Result<std::vector<DrawnView>> drawn_views(const std::vector<VirtualView>& views, const Mesh& mesh,
                                           const PlacedIntruder& placed, const Light& light, Renderer& renderer) {
  std::vector<DrawnView> drawn;
  for (const VirtualView& view : views) {
    Result<Layer> layer = renderer.draw(mesh, placed.camera_from_body, light, view);
    if (!layer) return fail(layer.error());
    drawn.push_back({view, std::move(*layer)});
  }
  return drawn;
}

// Where the silhouette reaches beyond the pixels that were bent, its whole area is measured on a coarser grid through
// the same lens, in views of their own.
Result<double> whole_area_px(const SeenIntruder& seen, const Camera& camera, const std::array<glm::dvec3, 8>& corners,
                             const Mesh& mesh, const Light& light, Renderer& renderer) {
  const cv::Rect everywhere(-1'000'000, -1'000'000, 2'000'000, 2'000'000);
  const Box& box = seen.silhouette->box;
  const cv::Rect whole = pixels_touched(box, 1, everywhere);
  if ((whole & seen.sharp.rect) == whole) return area_px(seen.sharp.coverage);
  // By the box itself, not by its clamped pixels: near the plane of a pinhole's lens it can be 1e9 px wide.
  const double step = std::max({1.0, box.width / kWholeAreaSteps, box.height / kWholeAreaSteps});
  LensParameters coarse = camera.lens.parameters();
  coarse.fx /= step;
  coarse.fy /= step;
  coarse.cx = (coarse.cx + 0.5) / step - 0.5;
  coarse.cy = (coarse.cy + 0.5) / step - 0.5;
  const Camera coarse_camera{*Lens::make(coarse), camera.size_px};
  const Result<std::vector<DrawnView>> drawn = drawn_views(
      aimed_views(coarse_camera, corners, std::nullopt, 2, 4 * kWholeAreaSteps), mesh, seen.placed, light, renderer);
  if (!drawn) return fail(drawn.error());
  if (drawn->empty()) return 0;
  const Box coarse_box{(box.x + 0.5) / step - 0.5, (box.y + 0.5) / step - 0.5, box.width / step, box.height / step};
  return area_px(bent(*drawn, coarse_camera, pixels_touched(coarse_box, 1, everywhere)).coverage) * step * step;
}

}  // namespace

Camera seeing_camera(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera;
  const LensParameters& lens = scene.camera.lens.parameters();
  return {*Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}), scene.camera.size_px};
}

Result<SeenIntruder> see_intruder(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                  Bench& bench) {
  const Camera camera = seeing_camera(scene);
  const Model& model = *scene.intruders[static_cast<std::size_t>(placed.id)].model;
  SeenIntruder seen{.placed = placed};
  seen.silhouette = silhouette_of(model.points_m, placed.camera_from_body, camera.lens);
  if (scene.compositing.method != MethodChoice::plain)
    seen.sigma_px = scene.compositing.blur_px_per_m * placed.distance_m();

  const cv::Rect picture = picture_of(scene);
  const cv::Rect reach =
      reach_of(seen.silhouette, placed.distance_m(), model.mesh.radius_m, blur_reach_px(seen.sigma_px), picture);
  if (reach.empty()) return seen;
  const std::array<glm::dvec3, 8> corners = corners_in_camera(model.mesh, placed.camera_from_body);
  const std::vector<VirtualView> views =
      aimed_views(camera, corners, reach, scene.compositing.supersampling, kLargestView_px);
  if (views.empty()) return seen;

  const Result<Renderer*> renderer = bench.renderer();
  if (!renderer) return fail(renderer.error());
  const Light light{moment.light_in_camera, scene.light.color, scene.light.ambient};
  const auto start = std::chrono::steady_clock::now();
  Result<std::vector<DrawnView>> drawn = drawn_views(views, model.mesh, placed, light, **renderer);
  if (!drawn) return fail(drawn.error());
  seen.draw_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  seen.views = std::move(*drawn);
  seen.sharp = bent(seen.views, camera, reach);
  seen.soft = hidden_by_body(clipped(blurred(seen.sharp, seen.sigma_px), picture), scene.own_body);
  if (seen.silhouette) {
    const Result<double> area = whole_area_px(seen, camera, corners, model.mesh, light, **renderer);
    if (!area) return fail(area.error());
    seen.whole_area_px = *area;
  }
  return seen;
}

std::vector<IntruderTruth> measured(const Scene& scene, const std::vector<SeenIntruder>& far_to_near,
                                    const cv::Mat& mask) {
  std::vector<IntruderTruth> truths;
  for (std::size_t i = 0; i < far_to_near.size(); ++i) {
    const SeenIntruder& seen = far_to_near[i];
    const auto id = static_cast<std::size_t>(seen.placed.id);
    IntruderTruth truth{.id = seen.placed.id,
                        .name = scene.intruders[id].name,
                        .position_m = seen.placed.camera_from_body.translation_m,
                        .attitude = seen.placed.attitude};
    if (seen.silhouette) truth.silhouette = seen.silhouette->box;
    const Layer inside = clipped(seen.sharp, picture_of(scene));
    const double inside_px = area_px(inside.coverage);
    const double whole_px = std::max(seen.whole_area_px, inside_px);
    // By its own measure: a distant one may cover no pixel by more than a hundredth.
    const float least = kLeastShare * strongest(seen.sharp.coverage);
    truth.in_picture = covered_box(inside.coverage, inside.rect, least).has_value();
    if (truth.in_picture && !seen.soft.empty() && !mask.empty()) {
      cv::Mat visible = seen.soft.coverage.clone();
      visible.setTo(0, mask(seen.soft.rect) == 0);
      for (std::size_t j = i + 1; j < far_to_near.size(); ++j)
        hide_coverage(visible, seen.soft.rect, far_to_near[j].soft);
      truth.box = covered_box(visible, seen.soft.rect, std::max(least, kLeastVisible));
      const double visible_px = area_px(visible);
      truth.visible_fraction = visible_px < kRounding * inside_px ? 0.0 : std::min(visible_px / whole_px, 1.0);
    }
    truths.push_back(std::move(truth));
  }
  return truths;
}

}  // namespace sigs
