// SPDX-License-Identifier: MIT
#include "frame/render_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "compositor/blend.h"
#include "frame/panorama.h"

namespace sigs {
namespace {

// Where the reference point appears in a frame that is taken since_s after the moment.
std::optional<glm::dvec2> pixel_at(const Scene& scene, const SceneMoment& moment, std::size_t intruder,
                                   const Lens& lens, double since_s) {
  const std::optional<SeenInRow> seen = seen_in_row(scene, [&](double row_s) {
    return lens.pixel(camera_from_body_at(scene, intruder, moment.time_s + since_s + row_s).translation_m);
  });
  return seen ? std::optional(seen->pixel) : std::nullopt;
}

constexpr int kMaxViewSize_px = 4096;  // some 300 MB; the image of a nearer intruder is rendered coarser
constexpr int kWholeAreaSteps = 128;   // pixels across in which a silhouette beyond the image's edge is measured

const Mesh& mesh_of(const Scene& scene, const PlacedIntruder& placed) {
  return scene.intruders[static_cast<std::size_t>(placed.id)].model->mesh;
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

// A box around the intruder's image. None where some points have no image: its faces may still span the image.
std::optional<Box> bounds_of(const IntruderLayers& layers, double radius_m) {
  if (!layers.silhouette || !layers.silhouette->all_have_image || layers.placed.distance_m() <= radius_m)
    return std::nullopt;
  return layers.silhouette->box;
}

// Whether the box around a body may look so wide that it takes more than one view: clipping away what no pixel samples
// then saves time. The box lies within sqrt(3) radii of its middle, and a view holds 50 degrees either way.
bool may_span_several_views(double distance_m, double radius_m) {
  constexpr double kRadii = 2.3;  // sqrt(3) / sin(50 degrees)
  return distance_m < kRadii * radius_m;
}

// Of the Gaussian that an intruder is blurred by. The classic method knows the paper's blur by distance alone, the
// method `plain` none.
double sigma_px_of(const Scene& scene, double distance_m) {
  if (scene.compositing.method == MethodChoice::plain) return 0;
  const double by_distance_px = blur_by_distance_px_per_m(scene.compositing) * distance_m;
  const double own_px = scene.compositing.method == MethodChoice::direct ? scene.appearance.psf_sigma_px : 0;
  return own_px > 0 ? std::hypot(by_distance_px, own_px) : by_distance_px;
}

// How far beyond the image's edge light is rendered that the blur carries into it: all that a sigma of 100 px carries.
// From farther away only a near intruder contributes, with a blur in which it cannot be recognised.
int margin_px(double sigma_px) {
  constexpr int kMaxMargin_px = 300;
  return sigma_px > kMaxMargin_px ? kMaxMargin_px : std::min(blur_margin_px(sigma_px), kMaxMargin_px);
}

// How far a blur reaches across from the rows of an intruder: farther towards the poles of a 360 degree image.
double margin_across_px(const IntruderLayers& layers, double blur_px, const Lens& lens) {
  if (!layers.silhouette) return blur_px;
  const Box& box = layers.silhouette->box;
  return blur_px * std::max(widening_at(lens, box.y - blur_px), widening_at(lens, box.y + box.height + blur_px));
}

// Pixels from which light of the intruder can get into the window. In a 360 degree image all columns, and what lies
// over a pole, where some of it gets to a pole or to both sides of the window.
//   blur_px, motion_px  how far the blurs carry it, the motion's too
cv::Rect warp_rect_of(const std::optional<Box>& bounds, int blur_px, cv::Size motion_px, const IntruderLayers& layers,
                      const Lens& lens) {
  const cv::Rect& window = layers.window;
  const cv::Size margin_px = motion_px + cv::Size(blur_px, blur_px);
  const cv::Rect grown(window.x - margin_px.width, window.y - margin_px.height, window.width + 2 * margin_px.width,
                       window.height + 2 * margin_px.height);
  if (!(lens.period_px() > 0)) return bounds ? pixels_touched(*bounds, 1, grown) : grown;
  constexpr int kNear_px = 2;  // beyond the points by which the silhouette is measured
  const cv::Rect all_round(window.x - motion_px.width, grown.y, window.width + 2 * motion_px.width, grown.height);
  if (!bounds) return all_round;
  const double across_px = margin_across_px(layers, blur_px, lens) + motion_px.width + kNear_px;
  const cv::Rect own = pixels_touched(*bounds, 1, kUnboundedRect);
  const bool at_zenith = own.y - margin_px.height - kNear_px < window.y;
  const bool at_nadir = own.br().y + margin_px.height + kNear_px > window.br().y;
  const bool is_inside = own.x - across_px >= window.x && own.br().x + across_px <= window.br().x;
  if (!at_zenith && !at_nadir && is_inside) return own;
  const int first = at_zenith ? grown.y : own.y, past = at_nadir ? grown.br().y : own.br().y;
  return {all_round.x, first, all_round.width, past - first};
}

Light light_of(const Scene& scene, const SceneMoment& moment) {
  const SceneLight& light = scene.light;
  if (light.kind == LightKind::point)
    return {.p_in_camera = moment.light_in_camera, .color = light.color, .ambient = light.ambient};
  return {.color = light.color * moment.sun_visible_share,
          .kind = Light::Kind::sun,
          .to_sun = moment.to_sun_in_camera,
          .up = moment.up_in_camera,
          .sky_color = light.sky_color,
          .ground_color = light.ground_color,
          .exposure = light.exposure};
}

// With the pixels that the rows of a rolling shutter look at beside.
cv::Rect with_row_shift(const cv::Rect& rect, double shift_px) {
  const int margin_px = static_cast<int>(std::ceil(std::min(shift_px, 1e4)));
  return rect.empty() ? rect : grown(rect, margin_px);
}

Box coarse_box(const Box& box_px, double step) {
  return {(box_px.x + 0.5) / step - 0.5, (box_px.y + 0.5) / step - 0.5, box_px.width / step, box_px.height / step};
}

// When the pixels of a view are exposed, which only a model with rotors asks for. Over a view, rows of the image are
// taken to follow each other evenly.
Shutter shutter_of(const RenderPlan& plan, const VirtualCamera& view, const Scene& scene) {
  Shutter shutter{.time_s = plan.time_s, .rotors_cover = scene.rotors_count};
  if (plan.exposure_s > 0) shutter.exposure_s = plan.exposure_s;
  const double last_row = scene.footage.size_px.height - 1;
  if (!(scene.motion.readout_s > 0) || !(last_row > 0)) return shutter;
  const glm::dvec2 middle = 0.5 * glm::dvec2(view.size_px.width, view.size_px.height) - 0.5;
  const glm::dvec2 step = 0.25 * glm::dvec2(view.size_px.width, view.size_px.height);
  const Lens& lens = compositing_camera(scene).lens;
  const auto row_at = [&](const glm::dvec2& in_view) -> std::optional<double> {
    const glm::dvec2 at = (in_view - view.center_px) / view.focal_px;
    const std::optional<glm::dvec2> pixel =
        lens.pixel(glm::conjugate(view.view_from_camera.rotation) * glm::dvec3(1, at.x, at.y));
    return pixel ? std::optional(pixel->y) : std::nullopt;
  };
  const std::optional<double> center = row_at(middle);
  const std::optional<double> right = row_at(middle + glm::dvec2(step.x, 0));
  const std::optional<double> down = row_at(middle + glm::dvec2(0, step.y));
  if (!center || !right || !down) return shutter;
  const double s_per_row = scene.motion.readout_s / last_row;
  shutter.s_per_px = s_per_row * glm::dvec2(*right - *center, *down - *center) / step;
  shutter.center_s = s_per_row * (*center - 0.5 * last_row) + glm::dot(shutter.s_per_px, view.center_px - middle);
  return shutter;
}

void count_rendering(OpCounts& counts, const RenderCounts& before, const RenderCounts& after) {
  counts.pixels_drawn += after.pixels_drawn - before.pixels_drawn;
  counts.triangles_drawn += after.triangles_drawn - before.triangles_drawn;
  counts.bytes_uploaded += after.bytes_uploaded - before.bytes_uploaded;
}

// How far an intruder's reference point moves in the image while the shutter is open, px: from the first half of the
// exposure to the second, by the camera's turn and by both flights. (0, 0) where it has no image at either end.
glm::dvec2 motion_during_exposure(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                  const Lens& lens) {
  if (!(moment.exposure_s > 0)) return {0, 0};
  const auto id = static_cast<std::size_t>(placed.id);
  const std::optional<glm::dvec2> first = pixel_at(scene, moment, id, lens, -moment.exposure_s / 2);
  const std::optional<glm::dvec2> last = pixel_at(scene, moment, id, lens, moment.exposure_s / 2);
  return first && last ? lens.way(*first, *last) : glm::dvec2(0, 0);
}

// Below, a view is drawn twice in hardly less time than once as a whole.
constexpr double kLeastForTwo_px = 2'000'000;
constexpr double kMostRead = 0.6;     // share of a view's occupied cells: above, drawing all of them is faster
constexpr double kMaxBend_codes = 2;  // of what is interpolated: a tenth of it is then the error, at most

// Whether there is something to be saved.
bool may_be_sparing(const RenderPlan& plan, const Scene& scene, const Renderer& renderer) {
  double pixels = 0;
  for (const VirtualCamera& view : plan.views) pixels += view.size_px.area();
  // Where a cell has something is told by its coverage.
  const bool covers_all = scene.rotors_count;
  return covers_all && scene.compositing.quality == QualityChoice::automatic &&
         scene.compositing.method == MethodChoice::direct && scene.compositing.supersampling > 1 &&
         !renderer.is_multisampled() && pixels >= kLeastForTwo_px;
}

Result<std::vector<RenderedView>> coarse_views(const RenderPlan& plan, const Scene& scene, IntruderLayers& layers,
                                               Renderer& renderer) {
  const Mesh& mesh = mesh_of(scene, layers.placed);
  const int step = scene.compositing.supersampling + 1;  // views are finer than the image over most of their parts
  std::vector<RenderedView> views;
  for (const VirtualCamera& view : plan.views) {
    const Shutter shutter = has_rotors(mesh) ? shutter_of(plan, view, scene) : Shutter();
    Result<CoarseDrawing> drawn =
        renderer.draw_coarsely(mesh, layers.placed.camera_from_body, plan.light, view, step, shutter);
    if (!drawn) return fail(drawn.error());
    const cv::Mat is_rough = bent_pixels(drawn->layer, kMaxBend_codes) | drawn->at_edges;
    views.push_back({view, {}, CoarseView{std::move(drawn->layer), is_rough, step}});
  }
  return views;
}

// The cells to be drawn finely; none where that would save little.
std::optional<std::vector<cv::Mat>> fine_cells(const std::vector<RenderedView>& views, const RenderPlan& plan,
                                               LensTable& lens, const IntruderLayers& layers) {
  constexpr double kReadARough = 1.5;  // cells, at least, since a pixel touches several
  double occupied = 0;
  double rough = 0;
  for (const RenderedView& drawn : views) {
    occupied += cv::countNonZero(drawn.coarse->layer.coverage);
    rough += cv::countNonZero(drawn.coarse->is_rough);
  }
  if (kReadARough * rough > kMostRead * occupied) return std::nullopt;
  std::optional<std::vector<cv::Mat>> read = cells_read(views, lens, plan.warp_rect, row_transform(layers));
  double fine = 0;
  for (std::size_t i = 0; read && i < views.size(); ++i) fine += cv::countNonZero((*read)[i]);
  return fine <= kMostRead * occupied ? std::move(read) : std::nullopt;
}

}  // namespace

std::optional<SeenInRow> seen_in_row(const Scene& scene,
                                     const std::function<std::optional<glm::dvec2>(double row_s)>& pixel_at) {
  constexpr int kSteps = 4;  // each takes the error times the share of the readout that the point moves by: 1e-2
  const double last_row = scene.footage.size_px.height - 1;
  std::optional<glm::dvec2> pixel = pixel_at(0);
  double row_s = 0;
  if (scene.motion.readout_s > 0 && last_row > 0)
    for (int step = 0; step < kSteps && pixel; ++step) {
      row_s = scene.motion.readout_s * (std::clamp(pixel->y / last_row, 0.0, 1.0) - 0.5);
      pixel = pixel_at(row_s);
    }
  return pixel ? std::optional(SeenInRow{*pixel, row_s}) : std::nullopt;
}

std::vector<cv::Point2d> earlier_places(const Scene& scene, int frame, const PlacedIntruder& placed, const Lens& lens,
                                        int count) {
  const auto id = static_cast<std::size_t>(placed.id);
  const auto pixel_in = [&](int n) {
    return lens.pixel(camera_from_body_at(scene, id, time_of_frame_s(scene.footage, n)).translation_m);
  };
  std::vector<cv::Point2d> places;
  const std::optional<glm::dvec2> now = pixel_in(frame);
  for (int k = 1; now && k <= std::min(count, frame); ++k) {
    const std::optional<glm::dvec2> then = pixel_in(frame - k);
    if (!then) break;
    const glm::dvec2 way = lens.way(*now, *then);
    places.emplace_back(way.x, way.y);
  }
  return places;
}

Lens with_pixels_of(const Lens& lens, double step) {
  LensParameters scaled = lens.parameters();
  scaled.fx /= step;
  scaled.fy /= step;
  scaled.cx = (scaled.cx + 0.5) / step - 0.5;
  scaled.cy = (scaled.cy + 0.5) / step - 0.5;
  return *Lens::make(scaled);
}

RowTransform row_transform(const IntruderLayers& layers, double step) {
  if (!layers.row_motion) return nullptr;
  return [&motion = *layers.row_motion, step](double row) { return motion.row_transform((row + 0.5) * step - 0.5); };
}

IntruderLayers placed_layers(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                             const Camera& camera) {
  const auto id = static_cast<std::size_t>(placed.id);
  const Model& model = *scene.intruders[id].model;
  IntruderLayers layers{.placed = placed, .world_from_camera = moment.world_from_camera};
  if (scene.motion.readout_s > 0) {
    const auto pose_at = [&](double since_s) { return camera_from_body_at(scene, id, moment.time_s + since_s); };
    layers.row_motion.emplace(pose_at, scene.footage.size_px.height, scene.motion.readout_s);
  }
  const auto seen = [&](const std::vector<glm::vec3>& points_m) {
    if (layers.row_motion) return silhouette_of(points_m, *layers.row_motion, camera.lens);
    return with_covered_poles(silhouette_of(points_m, placed.camera_from_body, camera.lens), model.mesh,
                              placed.camera_from_body, camera.lens, camera.size_px);
  };
  layers.silhouette = seen(model.points_m);
  if (!scene.rotors_count && !model.body_m.empty()) layers.body = seen(model.body_m);
  if (!camera.lens.is_pinhole() && layers.silhouette) layers.op_counts.lens_evaluations = std::ssize(model.points_m);
  const bool is_direct = scene.compositing.method == MethodChoice::direct;
  layers.formation.blur_px = sigma_px_of(scene, placed.distance_m());
  if (is_direct) layers.formation.visibility_m = scene.appearance.haze.visibility_m;
  if (is_direct && moment.exposure_s > 0) {
    const glm::dvec2 motion_px = motion_during_exposure(scene, moment, placed, camera.lens);
    layers.motion = motion_kernel(motion_px);
    layers.motion_xy_px = motion_px;
    if (!layers.motion.shifts.empty())
      layers.formation.motion_blur_px = std::min(glm::length(motion_px), kMaxMotion_px);
    if (!camera.lens.is_pinhole()) layers.op_counts.lens_evaluations += 2;
  }
  const double blur_px = margin_px(layers.formation.blur_px) + layers.motion.margin_px.width;
  layers.window =
      window_of(layers.silhouette, margin_across_px(layers, blur_px, camera.lens), camera.lens, scene.footage.size_px);
  return layers;
}

RenderPlan render_plan_for(const IntruderLayers& layers, LensTable& lens, const Scene& scene,
                           const SceneMoment& moment) {
  const Mesh& mesh = mesh_of(scene, layers.placed);
  const double distance_m = layers.placed.distance_m();
  if (!layers.silhouette && distance_m > mesh.radius_m) return {};
  RenderPlan plan{.corners = corners_in_camera(mesh, layers.placed.camera_from_body),
                  .light = light_of(scene, moment),
                  .time_s = moment.time_s,
                  .exposure_s = moment.exposure_s};
  const std::optional<Box> bounds = bounds_of(layers, mesh.radius_m);
  const int blur_px = margin_px(layers.formation.blur_px);
  plan.warp_rect = warp_rect_of(bounds, blur_px, layers.motion.margin_px, layers, lens.camera().lens);
  const bool is_within = bounds && pixels_touched(*bounds, 1, kUnboundedRect) == plan.warp_rect;
  // A body that lies within needs no clipping.
  std::optional<cv::Rect> target;
  if (!is_within || may_span_several_views(distance_m, mesh.radius_m))
    target =
        with_row_shift(plan.warp_rect, layers.row_motion ? layers.row_motion->max_shift_px(lens.camera().lens) : 0);
  if (!plan.warp_rect.empty())
    plan.views = virtual_cameras(lens, plan.corners, target, drawn_px_per_px(scene.compositing), kMaxViewSize_px);
  return plan;
}

Result<std::vector<RenderedView>> rendered_views(const std::vector<VirtualCamera>& views, const RenderPlan& plan,
                                                 const Scene& scene, IntruderLayers& layers, Renderer& renderer) {
  const Stopwatch watch;
  const RenderCounts before = renderer.counts();
  std::vector<RenderedView> rendered;
  for (const VirtualCamera& view : views) {
    const Mesh& mesh = mesh_of(scene, layers.placed);
    const Shutter shutter = has_rotors(mesh) ? shutter_of(plan, view, scene) : Shutter();
    Result<Layer> layer = renderer.draw(mesh, layers.placed.camera_from_body, plan.light, view, shutter);
    if (!layer) return fail(layer.error());
    rendered.push_back({view, std::move(*layer), {}});
  }
  count_rendering(layers.op_counts, before, renderer.counts());
  layers.draw_s += watch.elapsed_s();
  return rendered;
}

Result<std::vector<RenderedView>> sparingly_rendered_views(const RenderPlan& plan, const Scene& scene, LensTable& lens,
                                                           IntruderLayers& layers, Renderer& renderer) {
  if (!may_be_sparing(plan, scene, renderer)) return rendered_views(plan.views, plan, scene, layers, renderer);
  Stopwatch watch;
  const RenderCounts before = renderer.counts();
  Result<std::vector<RenderedView>> views = coarse_views(plan, scene, layers, renderer);
  if (!views) return fail(views.error());
  layers.draw_s += watch.elapsed_s();
  const std::optional<std::vector<cv::Mat>> cells = fine_cells(*views, plan, lens, layers);
  watch = Stopwatch();
  for (std::size_t i = 0; cells && i < views->size(); ++i) {
    RenderedView& drawn = (*views)[i];
    const Mesh& mesh = mesh_of(scene, layers.placed);
    const Shutter shutter = has_rotors(mesh) ? shutter_of(plan, drawn.view, scene) : Shutter();
    Result<Layer> layer = renderer.draw_cells(mesh, layers.placed.camera_from_body, plan.light, drawn.view,
                                              {(*cells)[i], drawn.coarse->step}, shutter);
    if (!layer) return fail(layer.error());
    drawn.layer = std::move(*layer);
  }
  layers.draw_s += watch.elapsed_s();
  count_rendering(layers.op_counts, before, renderer.counts());
  if (cells) return views;
  layers.given_up = std::move(*views);
  return rendered_views(plan.views, plan, scene, layers, renderer);
}

Result<double> whole_area_px(IntruderLayers& layers, const RenderPlan& plan, const LensTable& lens, const Scene& scene,
                             Renderer& renderer) {
  if (!layers.silhouette || layers.warped.empty()) return 0;
  if (lens.camera().lens.period_px() > 0) return area_px(clipped(layers.warped, layers.window).coverage);
  const Box& box = layers.silhouette->box;
  const cv::Rect whole = pixels_touched(box, 1, kUnboundedRect);
  if ((whole & layers.warped.rect) == whole) return area_px(layers.warped.coverage);
  // By the box itself, not by its clamped pixels: near the plane of a pinhole's lens it can be 1e9 px wide. Means by
  // area keep the sum, however coarse they are.
  const double step = std::max({1.0, box.width / kWholeAreaSteps, box.height / kWholeAreaSteps});
  LensTable coarse({with_pixels_of(lens.camera().lens, step), lens.camera().size_px}, lens.tolerance_px());
  const cv::Rect coarse_rect = pixels_touched(coarse_box(box, step), 1, kUnboundedRect);
  const double shift_px = layers.row_motion ? layers.row_motion->max_shift_px(coarse.camera().lens) : 0;
  const std::vector<VirtualCamera> views =
      virtual_cameras(coarse, plan.corners, with_row_shift(coarse_rect, shift_px), 1, 4 * kWholeAreaSteps);
  const Result<std::vector<RenderedView>> rendered = rendered_views(views, plan, scene, layers, renderer);
  if (!rendered) return fail(rendered.error());
  if (rendered->empty()) return 0;
  const double coarse_area = area_px(warped(*rendered, coarse, coarse_rect, row_transform(layers, step)).coverage);
  layers.op_counts.pixels_warped += coarse_rect.area();
  layers.op_counts.lens_evaluations += coarse.evaluations();
  return coarse_area * step * step;
}

}  // namespace sigs
