// SPDX-License-Identifier: MIT
#include "frame/render_intruder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "camera/lens_table.h"
#include "camera/virtual_camera.h"
#include "compositor/blur.h"
#include "compositor/occlude.h"
#include "frame/render_item.h"
#include "truth/measure.h"
#include "video/transfer_function.h"

namespace sigs {

namespace {

constexpr int kLargestView_px = 4096;  // some 300 MB; a larger image of a nearer intruder is rendered coarser
constexpr double kRounding = 1e-6;     // of sums of floats: a visible share below it is none
constexpr int kWholeAreaSteps = 128;   // pixels across in which a silhouette beyond the image's edge is measured

cv::Rect image_rect(const Scene& scene) {
  return {{0, 0}, scene.footage.size_px};
}

// A box around the intruder's image. None where it has no image in part: its faces may still span the image.
std::optional<Box> bounds_of(const IntruderLayers& layers, double radius_m) {
  if (!layers.silhouette || !layers.silhouette->all_have_image || layers.placed.distance_m() <= radius_m)
    return std::nullopt;
  return layers.silhouette->box;
}

// Whether the box around a body may look so wide that it takes more than one view: what no pixel looks at is then worth
// being cut off. The box lies within sqrt(3) radii of its middle, and a view holds 50 degrees either way.
bool may_span_several_views(const RenderItem& item) {
  constexpr double kRadii = 2.3;  // sqrt(3) / sin(50 degrees)
  return item.placed.distance_m() < kRadii * item.mesh.radius_m;
}

// How far beyond the image's edge light is looked for that blur carries into it: all that a sigma of 100 px carries.
// From farther off only a near intruder has any, before a blur in which nothing of it can be recognised.
constexpr int kFarthestLight_px = 300;

int reach_px(double sigma_px) {
  return sigma_px > kFarthestLight_px ? kFarthestLight_px : std::min(blur_margin_px(sigma_px), kFarthestLight_px);
}

// Pixels that the intruder can reach, blur counted in.
cv::Rect sharp_rect_of(const std::optional<Box>& bounds, int blur_px, const cv::Rect& image) {
  const cv::Rect grown(image.x - blur_px, image.y - blur_px, image.width + 2 * blur_px, image.height + 2 * blur_px);
  return bounds ? pixels_touched(*bounds, 1, grown) : grown;
}

// Draws the views, and adds the seconds that took.
Result<std::vector<RenderedView>> rendered_in_time(double& draw_s, const std::vector<VirtualCamera>& views,
                                                   const RenderItem& item, Renderer& renderer) {
  const auto start = std::chrono::steady_clock::now();
  Result<std::vector<RenderedView>> rendered = rendered_views(views, item, renderer);
  draw_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return rendered;
}

// The same lens before coarser pixels, for this one intruder.
LensTable coarse_lens(const LensTable& lens, double step) {
  return LensTable(coarse_camera(lens.camera(), step), lens.tolerance_px());
}

// Where the silhouette reaches beyond the pixels that were warped, its whole area is measured on a coarser grid through
// the same lens, in views of their own: means by area keep it, however coarse they are.
Result<double> whole_area_px(IntruderLayers& layers, const LensTable& lens, const RenderItem& item,
                             Renderer& renderer) {
  const Box& box = layers.silhouette->box;
  const cv::Rect whole = pixels_touched(box, 1, kEverywhere);
  if ((whole & layers.warped.rect) == whole) return area_px(layers.warped.coverage);
  // By the box itself, not by its clamped pixels: near the plane of a pinhole's lens it can be 1e9 px wide.
  const double step = std::max({1.0, box.width / kWholeAreaSteps, box.height / kWholeAreaSteps});
  LensTable coarse = coarse_lens(lens, step);
  const cv::Rect coarse_rect = pixels_touched(coarse_box(box, step), 1, kEverywhere);
  const std::vector<VirtualCamera> views = virtual_cameras(coarse, item.corners, coarse_rect, 1, 4 * kWholeAreaSteps);
  const Result<std::vector<RenderedView>> rendered = rendered_in_time(layers.draw_s, views, item, renderer);
  if (!rendered) return fail(rendered.error());
  if (rendered->empty()) return 0;
  const double coarse_area = area_px(warped(*rendered, coarse, coarse_rect).coverage);
  layers.op_counts.pixels_warped += coarse_rect.area();
  layers.op_counts.lens_evaluations += coarse.evaluations();
  return coarse_area * step * step;
}

// What is to be rendered of an intruder, and where it goes.
struct RenderPlan {
  cv::Rect sharp_rect;  // of its warped layer
  std::vector<VirtualCamera> views;
};

RenderPlan render_plan_for(const IntruderLayers& layers, LensTable& lens, const RenderItem& item, const Scene& scene) {
  const std::optional<Box> bounds = bounds_of(layers, item.mesh.radius_m);
  RenderPlan plan{.sharp_rect = sharp_rect_of(bounds, reach_px(layers.sigma_px), image_rect(scene))};
  const bool is_within = bounds && pixels_touched(*bounds, 1, kEverywhere) == plan.sharp_rect;
  // Of a body that lies within there is nothing to cut off.
  const std::optional<cv::Rect> target =
      is_within && !may_span_several_views(item) ? std::nullopt : std::optional(plan.sharp_rect);
  if (!plan.sharp_rect.empty())
    plan.views = virtual_cameras(lens, item.corners, target, scene.compositing.supersampling, kLargestView_px);
  return plan;
}

// The classic method blurs whole images of its own. Of a lone intruder's layer it needs the coverage, which blur
// leaves alone; only what a nearer intruder hides of a farther one is told by its blurred opacity.
bool needs_blur(const Scene& scene) {
  return scene.compositing.method != MethodChoice::classic || scene.intruders.size() > 1;
}

// The warped layer, blurred, within the image. Empty where it is too faint to change any 8-bit sample.
Layer blurred_in_image(const IntruderLayers& layers, const Scene& scene, const ColorInfo& footage) {
  const cv::Rect image = image_rect(scene);
  const bool is_wide = layers.sigma_px > kWideSigma_px;
  const TransferFunction function = transfer_function_of(footage.transfer).value_or(TransferFunction::srgb);
  if (is_wide && max_after_blur(layers.warped, layers.sigma_px) < min_light(function)) return {};
  if (!needs_blur(scene)) return clipped(layers.warped, image);
  if (!is_wide) return clipped(blurred(layers.warped, layers.sigma_px), image);
  constexpr double kEverywhere_px = 1e6;
  const int grown_px = static_cast<int>(std::min(std::ceil(3 * layers.sigma_px), kEverywhere_px));
  const cv::Rect& rect = layers.warped.rect;
  const cv::Rect grown(rect.x - grown_px, rect.y - grown_px, rect.width + 2 * grown_px, rect.height + 2 * grown_px);
  return widely_blurred(layers.warped, layers.sigma_px, grown & image);
}

void count_warping(OpCounts& counts, const IntruderLayers& layers, const Scene& scene) {
  counts.pixels_warped += layers.warped.rect.area();
  if (layers.sigma_px > 0 && needs_blur(scene)) counts.pixels_blurred += layers.blurred.rect.area();
}

// Draws the views and makes the layers of them.
Result<void> render_layers(IntruderLayers& layers, RenderPlan& plan, LensTable& lens, const RenderItem& item,
                           const Scene& scene, const ColorInfo& footage, Renderer& renderer) {
  Result<std::vector<RenderedView>> rendered = rendered_in_time(layers.draw_s, plan.views, item, renderer);
  if (!rendered) return fail(rendered.error());
  layers.warped = warped(*rendered, lens, plan.sharp_rect);
  layers.blurred = blurred_in_image(layers, scene, footage);
  layers.occluded = occluded_by_body(layers.blurred, scene.own_body);
  layers.views = std::move(*rendered);
  count_warping(layers.op_counts, layers, scene);
  return {};
}

void count_rendering(OpCounts& counts, const RenderCounts& before, const RenderCounts& after) {
  counts.pixels_drawn += after.pixels_drawn - before.pixels_drawn;
  counts.triangles_drawn += after.triangles_drawn - before.triangles_drawn;
  counts.bytes_uploaded += after.bytes_uploaded - before.bytes_uploaded;
}

// Pixels that the silhouette reaches. Drawn pixels lie across their edges and spill a little into the next ones.
cv::Rect outline_of(const IntruderLayers& layers) {
  if (!layers.silhouette || !layers.silhouette->all_have_image) return kEverywhere;
  return pixels_touched(layers.silhouette->box, 0, kEverywhere);
}

std::optional<cv::Rect> common(const std::optional<cv::Rect>& box, const cv::Rect& outline) {
  const cv::Rect both = box ? *box & outline : cv::Rect();
  return both.empty() ? std::nullopt : std::optional<cv::Rect>(both);
}

}  // namespace

Camera compositing_camera(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera;
  const LensParameters& lens = scene.camera.lens.parameters();
  return {*Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}), scene.camera.size_px};
}

Result<IntruderLayers> render_intruder(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                       ComposeContext& context, const ColorInfo& footage) {
  LensTable& lens = context.lens_of(compositing_camera(scene));
  const std::int64_t evaluations_before = lens.evaluations();
  const Model& model = *scene.intruders[static_cast<std::size_t>(placed.id)].model;
  IntruderLayers layers{.placed = placed};
  layers.silhouette = silhouette_of(model.points_m, placed.camera_from_body, lens.camera().lens);
  if (!lens.camera().lens.is_pinhole())
    layers.op_counts.lens_evaluations = static_cast<std::int64_t>(model.points_m.size());
  if (scene.compositing.method != MethodChoice::plain)
    layers.sigma_px = scene.compositing.blur_px_per_m * placed.distance_m();

  if (!layers.silhouette && placed.distance_m() > model.mesh.radius_m) return layers;
  const Light light{moment.light_in_camera, scene.light.color, scene.light.ambient};
  const RenderItem item{model.mesh, layers.placed, light, corners_in_camera(model.mesh, placed.camera_from_body)};
  RenderPlan plan = render_plan_for(layers, lens, item, scene);
  if (plan.views.empty()) {
    layers.op_counts.lens_evaluations += lens.evaluations() - evaluations_before;
    return layers;
  }

  const Result<Renderer*> renderer = context.renderer();
  if (!renderer) return fail(renderer.error());
  const RenderCounts drawn_before = (*renderer)->counts();
  const Result<void> rendered_layers = render_layers(layers, plan, lens, item, scene, footage, **renderer);
  if (!rendered_layers) return fail(rendered_layers.error());
  if (layers.silhouette && !layers.warped.empty()) {
    const Result<double> area = whole_area_px(layers, lens, item, **renderer);
    if (!area) return fail(area.error());
    layers.whole_area_px = *area;
  }
  count_rendering(layers.op_counts, drawn_before, (*renderer)->counts());
  layers.op_counts.lens_evaluations += lens.evaluations() - evaluations_before;
  return layers;
}

std::vector<IntruderTruth> measured(const Scene& scene, const SceneMoment& moment,
                                    const std::vector<IntruderLayers>& far_to_near, const cv::Mat& mask) {
  const glm::dvec3 up_in_camera = glm::conjugate(moment.world_from_camera.rotation) * glm::dvec3(0, 0, -1);
  std::vector<IntruderTruth> truths;
  for (std::size_t i = 0; i < far_to_near.size(); ++i) {
    const IntruderLayers& layers = far_to_near[i];
    const auto id = static_cast<std::size_t>(layers.placed.id);
    IntruderTruth truth{.id = layers.placed.id,
                        .name = scene.intruders[id].name,
                        .position_m = layers.placed.camera_from_body.translation_m,
                        .attitude = layers.placed.attitude};
    if (layers.silhouette) truth.amodal_box = layers.silhouette->box;
    if (scene.horizon_is_known)
      truth.horizon =
          horizon_side_of(scene.intruders[id].model->outermost_m, layers.placed.camera_from_body, up_in_camera);
    const cv::Rect outline = outline_of(layers);
    const Layer inside = clipped(layers.warped, image_rect(scene));
    const double inside_px = area_px(inside.coverage);
    const double whole_px = std::max(layers.whole_area_px, inside_px);
    // By its own measure: a distant one may cover no pixel by more than a hundredth.
    const float min_coverage = kMinCoverageShare * max_coverage(layers.warped.coverage);
    truth.in_image = common(covered_box(inside.coverage, inside.rect, min_coverage), outline).has_value();
    if (truth.in_image) truth.inside_fraction = std::min(inside_px / whole_px, 1.0);
    if (truth.in_image && !layers.occluded.empty() && !mask.empty()) {
      cv::Mat visible = layers.occluded.coverage.clone();
      visible.setTo(0, mask(layers.occluded.rect) == 0);
      for (std::size_t j = i + 1; j < far_to_near.size(); ++j)
        occlude_coverage(visible, layers.occluded.rect, far_to_near[j].occluded);
      const float min_visible = std::max(min_coverage, kMinVisibleCoverage);
      truth.visible_box = common(covered_box(visible, layers.occluded.rect, min_visible), outline);
      if (truth.visible_box)
        truth.visible = covered_pixels(visible, layers.occluded.rect, min_visible, *truth.visible_box);
      if (truth.visible_box) truth.visible_pixels = cv::countNonZero(truth.visible);
      const double visible_px = area_px(visible);
      truth.visible_fraction = visible_px < kRounding * inside_px ? 0.0 : std::min(visible_px / whole_px, 1.0);
    }
    truths.push_back(std::move(truth));
  }
  return truths;
}

}  // namespace sigs
