// SPDX-License-Identifier: MIT
#include "see_intruder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "annotation/quick_silhouette.h"
#include "camera/aimed_view.h"
#include "camera/lens_table.h"
#include "coarse.h"
#include "compositor/blur.h"
#include "compositor/hide.h"
#include "far_blur.h"
#include "video/transfer_function.h"

namespace sigs {

namespace {

constexpr int kLargestView_px = 4096;  // some 300 MB; a larger picture of a nearer intruder is drawn coarser
constexpr double kRounding = 1e-6;     // of sums of floats: a visible share below it is none
constexpr int kWholeAreaSteps = 128;   // pixels across in which a silhouette beyond the picture's edge is measured

cv::Rect picture_of(const Scene& scene) {
  return {{0, 0}, scene.footage.size_px};
}

// A box around the intruder's image. None where it has no image in part: its faces may still span the picture.
std::optional<Box> bounds_of(const SeenIntruder& seen, double radius_m) {
  if (!seen.silhouette || !seen.silhouette->all_have_image || seen.placed.distance_m() <= radius_m) return std::nullopt;
  return seen.silhouette->box;
}

// Whether the box around a body may look so wide that it takes more than one view: what no pixel looks at is then worth
// being cut off. The box lies within sqrt(3) radii of its middle, and a view holds 50 degrees either way.
bool may_be_wide(const Sitter& sitter) {
  constexpr double kRadii = 2.3;  // sqrt(3) / sin(50 degrees)
  return sitter.placed.distance_m() < kRadii * sitter.mesh.radius_m;
}

// Pixels that the intruder can reach, blur counted in.
cv::Rect reach_of(const std::optional<Box>& bounds, int blur_px, const cv::Rect& picture) {
  const cv::Rect grown(picture.x - blur_px, picture.y - blur_px, picture.width + 2 * blur_px,
                       picture.height + 2 * blur_px);
  return bounds ? pixels_touched(*bounds, 1, grown) : grown;
}

// Draws the views, and adds the seconds that took.
Result<std::vector<DrawnView>> drawn_in_time(double& draw_s, const std::vector<VirtualView>& views,
                                             const Sitter& sitter, Renderer& renderer) {
  const auto start = std::chrono::steady_clock::now();
  Result<std::vector<DrawnView>> drawn = drawn_views(views, sitter, renderer);
  draw_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return drawn;
}

// The same lens before coarser pixels, for this one intruder.
LensTable coarse_lens(const LensTable& lens, double step) {
  return LensTable(coarse_camera(lens.camera(), step), lens.tolerance_px());
}

// Where the silhouette reaches beyond the pixels that were bent, its whole area is measured on a coarser grid through
// the same lens, in views of their own: means by area keep it, however coarse they are.
Result<double> whole_area_px(SeenIntruder& seen, const LensTable& lens, const Sitter& sitter, Renderer& renderer) {
  const Box& box = seen.silhouette->box;
  const cv::Rect whole = pixels_touched(box, 1, kEverywhere);
  if ((whole & seen.sharp.rect) == whole) return area_px(seen.sharp.coverage);
  // By the box itself, not by its clamped pixels: near the plane of a pinhole's lens it can be 1e9 px wide.
  const double step = std::max({1.0, box.width / kWholeAreaSteps, box.height / kWholeAreaSteps});
  LensTable coarse = coarse_lens(lens, step);
  const cv::Rect cells = pixels_touched(coarse_box(box, step), 1, kEverywhere);
  const std::vector<VirtualView> views = aimed_views(coarse, sitter.corners, cells, 1, 4 * kWholeAreaSteps);
  const Result<std::vector<DrawnView>> drawn = drawn_in_time(seen.draw_s, views, sitter, renderer);
  if (!drawn) return fail(drawn.error());
  if (drawn->empty()) return 0;
  const double area_cells = area_px(bent(*drawn, coarse, cells).coverage);
  seen.work.pixels_bent += cells.area();
  seen.work.lens_evaluations += coarse.evaluations();
  return area_cells * step * step;
}

// What is to be drawn of an intruder, and where it goes.
struct Sitting {
  cv::Rect reach;                 // of its sharp layer
  std::optional<CellGrid> cells;  // of its blurred one, where that is made in cells
  std::optional<LensTable> lens_of_cells;
  std::vector<VirtualView> views;
  std::vector<VirtualView> views_of_cells;  // empty: the sharp layer holds all that they need
};

Sitting sitting_for(const SeenIntruder& seen, LensTable& lens, const Sitter& sitter, const Scene& scene) {
  const bool is_far_blurred = seen.sigma_px > kSigmaOfCells_px;
  const double supersampling = scene.compositing.supersampling;
  const std::optional<Box> bounds = bounds_of(seen, sitter.mesh.radius_m);
  const cv::Rect picture = picture_of(scene);
  Sitting sitting{.reach = reach_of(bounds, is_far_blurred ? 0 : blur_reach_px(seen.sigma_px), picture)};
  if (is_far_blurred) sitting.cells = cell_grid(bounds, lens.camera(), picture, seen.sigma_px);
  const bool is_within = bounds && pixels_touched(*bounds, 1, kEverywhere) == sitting.reach;
  // Of a body that lies within there is nothing to cut off.
  const std::optional<cv::Rect> target =
      is_within && !may_be_wide(sitter) ? std::nullopt : std::optional(sitting.reach);
  if (!sitting.reach.empty()) sitting.views = aimed_views(lens, sitter.corners, target, supersampling, kLargestView_px);
  if (!sitting.cells) return sitting;
  sitting.lens_of_cells.emplace(coarse_lens(lens, sitting.cells->cell_px));
  if (sitting.views.empty() || !is_within)
    sitting.views_of_cells =
        views_of_cells(*sitting.cells, *sitting.lens_of_cells, sitter, supersampling, kLargestView_px);
  return sitting;
}

// The classic method blurs whole pictures of its own. Of a lone intruder's layer it needs the coverage, which blur
// leaves alone; only what a nearer intruder hides of a farther one is told by its blurred opacity.
bool needs_blur(const Scene& scene) {
  return scene.compositing.method != MethodChoice::classic || scene.intruders.size() > 1;
}

void count_bending(Work& work, const SeenIntruder& seen, const Sitting& sitting, const Scene& scene) {
  work.pixels_bent += seen.sharp.rect.area();
  if (sitting.cells) {
    work.lens_evaluations += sitting.lens_of_cells->evaluations();
    if (!sitting.views_of_cells.empty()) work.pixels_bent += sitting.cells->cells.area();
  }
  if (seen.sigma_px > 0 && (sitting.cells || needs_blur(scene))) work.pixels_blurred += seen.blurred.rect.area();
}

// Draws the views and makes the layers of them.
Result<void> sit(SeenIntruder& seen, Sitting& sitting, LensTable& lens, const Sitter& sitter, const Scene& scene,
                 const ColorInfo& footage, Renderer& renderer) {
  Result<std::vector<DrawnView>> drawn = drawn_in_time(seen.draw_s, sitting.views, sitter, renderer);
  if (!drawn) return fail(drawn.error());
  Result<std::vector<DrawnView>> drawn_for_cells = drawn_in_time(seen.draw_s, sitting.views_of_cells, sitter, renderer);
  if (!drawn_for_cells) return fail(drawn_for_cells.error());
  if (!drawn->empty()) seen.sharp = bent(*drawn, lens, sitting.reach);
  if (sitting.cells)
    seen.blurred = far_blurred(*sitting.cells, seen.sharp, *drawn_for_cells, *sitting.lens_of_cells, seen.sigma_px,
                               least_light(transfer_function_of(footage.transfer).value_or(TransferFunction::srgb)));
  else
    seen.blurred = clipped(blurred(seen.sharp, needs_blur(scene) ? seen.sigma_px : 0), picture_of(scene));
  seen.soft = hidden_by_body(seen.blurred, scene.own_body);
  seen.views = std::move(drawn->empty() ? *drawn_for_cells : *drawn);
  count_bending(seen.work, seen, sitting, scene);
  return {};
}

void count_drawing(Work& work, const RenderWork& before, const RenderWork& after) {
  work.pixels_drawn += after.pixels_drawn - before.pixels_drawn;
  work.triangles_drawn += after.triangles_drawn - before.triangles_drawn;
  work.bytes_uploaded += after.bytes_uploaded - before.bytes_uploaded;
}

// Pixels that the silhouette reaches. Drawn pixels lie across their edges and spill a little into the next ones.
cv::Rect outline_of(const SeenIntruder& seen) {
  if (!seen.silhouette || !seen.silhouette->all_have_image) return kEverywhere;
  return pixels_touched(seen.silhouette->box, 0, kEverywhere);
}

std::optional<cv::Rect> common(const std::optional<cv::Rect>& box, const cv::Rect& outline) {
  const cv::Rect both = box ? *box & outline : cv::Rect();
  return both.empty() ? std::nullopt : std::optional<cv::Rect>(both);
}

}  // namespace

Camera seeing_camera(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera;
  const LensParameters& lens = scene.camera.lens.parameters();
  return {*Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}), scene.camera.size_px};
}

Result<SeenIntruder> see_intruder(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                  Bench& bench, const ColorInfo& footage) {
  LensTable& lens = bench.lens_of(seeing_camera(scene));
  const std::int64_t evaluations_before = lens.evaluations();
  const Model& model = *scene.intruders[static_cast<std::size_t>(placed.id)].model;
  SeenIntruder seen{.placed = placed};
  const QuickSilhouette silhouette =
      silhouette_of(model.points_m, model.tree, placed.camera_from_body, lens.camera().lens);
  seen.silhouette = silhouette.silhouette;
  if (!lens.camera().lens.is_pinhole()) seen.work.lens_evaluations = silhouette.lens_evaluations;
  if (scene.compositing.method != MethodChoice::plain)
    seen.sigma_px = scene.compositing.blur_px_per_m * placed.distance_m();

  if (!seen.silhouette && placed.distance_m() > model.mesh.radius_m) return seen;
  const Light light{moment.light_in_camera, scene.light.color, scene.light.ambient};
  const Sitter sitter{model.mesh, seen.placed, light, corners_in_camera(model.mesh, placed.camera_from_body)};
  Sitting sitting = sitting_for(seen, lens, sitter, scene);
  if (sitting.views.empty() && sitting.views_of_cells.empty()) {
    seen.work.lens_evaluations += lens.evaluations() - evaluations_before;
    return seen;
  }

  const Result<Renderer*> renderer = bench.renderer();
  if (!renderer) return fail(renderer.error());
  const RenderWork drawn_before = (*renderer)->work();
  const Result<void> sat = sit(seen, sitting, lens, sitter, scene, footage, **renderer);
  if (!sat) return fail(sat.error());
  if (seen.silhouette && !seen.sharp.empty()) {
    const Result<double> area = whole_area_px(seen, lens, sitter, **renderer);
    if (!area) return fail(area.error());
    seen.whole_area_px = *area;
  }
  count_drawing(seen.work, drawn_before, (*renderer)->work());
  seen.work.lens_evaluations += lens.evaluations() - evaluations_before;
  return seen;
}

std::vector<IntruderTruth> measured(const Scene& scene, const SceneMoment& moment,
                                    const std::vector<SeenIntruder>& far_to_near, const cv::Mat& mask) {
  const glm::dvec3 up_in_camera = glm::conjugate(moment.world_from_camera.rotation) * glm::dvec3(0, 0, -1);
  std::vector<IntruderTruth> truths;
  for (std::size_t i = 0; i < far_to_near.size(); ++i) {
    const SeenIntruder& seen = far_to_near[i];
    const auto id = static_cast<std::size_t>(seen.placed.id);
    IntruderTruth truth{.id = seen.placed.id,
                        .name = scene.intruders[id].name,
                        .position_m = seen.placed.camera_from_body.translation_m,
                        .attitude = seen.placed.attitude};
    if (seen.silhouette) truth.silhouette = seen.silhouette->box;
    if (scene.horizon_is_known)
      truth.horizon =
          horizon_side_of(scene.intruders[id].model->outermost_m, seen.placed.camera_from_body, up_in_camera);
    const cv::Rect outline = outline_of(seen);
    const Layer inside = clipped(seen.sharp, picture_of(scene));
    const double inside_px = area_px(inside.coverage);
    const double whole_px = std::max(seen.whole_area_px, inside_px);
    // By its own measure: a distant one may cover no pixel by more than a hundredth.
    const float least = kLeastShare * strongest(seen.sharp.coverage);
    truth.in_picture = common(covered_box(inside.coverage, inside.rect, least), outline).has_value();
    if (truth.in_picture) truth.inside_fraction = std::min(inside_px / whole_px, 1.0);
    if (truth.in_picture && !seen.soft.empty() && !mask.empty()) {
      cv::Mat visible = seen.soft.coverage.clone();
      visible.setTo(0, mask(seen.soft.rect) == 0);
      for (std::size_t j = i + 1; j < far_to_near.size(); ++j)
        hide_coverage(visible, seen.soft.rect, far_to_near[j].soft);
      const float least_visible = std::max(least, kLeastVisible);
      truth.box = common(covered_box(visible, seen.soft.rect, least_visible), outline);
      if (truth.box) truth.visible = covered_pixels(visible, seen.soft.rect, least_visible, *truth.box);
      if (truth.box) truth.visible_pixels = cv::countNonZero(truth.visible);
      const double visible_px = area_px(visible);
      truth.visible_fraction = visible_px < kRounding * inside_px ? 0.0 : std::min(visible_px / whole_px, 1.0);
    }
    truths.push_back(std::move(truth));
  }
  return truths;
}

}  // namespace sigs
