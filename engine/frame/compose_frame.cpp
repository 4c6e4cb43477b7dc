// SPDX-License-Identifier: MIT
#include "frame/compose_frame.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "compositor/blend.h"
#include "compositor/blur.h"
#include "compositor/warp.h"
#include "frame/cloud_cover.h"
#include "frame/composite.h"
#include "frame/contrail.h"
#include "frame/frame_truth.h"
#include "frame/ground_shadow.h"
#include "frame/look.h"
#include "frame/panorama.h"
#include "scene/scene_at.h"
#include "truth/measure.h"
#include "video/color_space.h"
#include "video/frame_source.h"

namespace sigs {
namespace {

// The classic method blurs whole images of its own. Of a single intruder's layer it needs the coverage alone, which
// blur does not change; with several, the blurred opacity determines what a nearer one occludes of a farther one.
bool needs_blurred_layers(const Scene& scene) {
  return scene.compositing.method != MethodChoice::classic || scene.intruders.size() > 1;
}

// Pixels of the image that the intruder takes up; in a 360 degree image those of its larger part.
cv::Rect box_in_image(const IntruderLayers& layers, const Lens& lens, cv::Size image_size_px) {
  cv::Rect box = layers.warped.rect & layers.window;
  if (layers.silhouette && layers.silhouette->all_have_image)
    box = pixels_touched(layers.silhouette->box, 0, layers.window);
  return larger_part(box, lens, image_size_px);
}

// A layer without what own body and, at this distance, the occluder hide.
Layer without_hidden(const Scene& scene, const SceneMoment& moment, const Layer& layer, double distance_m,
                     LensTable& lens) {
  const Layer free = occluded_by_body(layer, scene.own_body);
  if (!scene.occluder.hides(distance_m) || free.empty()) return free;
  return occluded_by(free, occluder_seen_from(moment.world_from_camera, scene.occluder, lens, free.rect));
}

// Error: the colours are not those of the palette that is stated.
Result<void> check_palette(const Scene& scene, double off_codes, int frame) {
  if (off_codes <= kMaxOffPalette_codes) return {};
  return fail("footage.palette",
              fmt::format("the footage's colours are not those of {}: in frame {} they are off by {:.0f} codes in the "
                          "mean; set it to the camera's palette, or record white-hot or black-hot",
                          kHeatPaletteNames[static_cast<std::size_t>(scene.palette)], frame, off_codes),
              ErrorKind::bad_project);
}

// Fills `contrail`: through haze, blurred by the lens. What it hides of its aircraft is no longer covered. How warm ice
// looks is not modelled.
void add_contrail(const Scene& scene, const SceneMoment& moment, const Frame* background, LensTable& lens,
                  IntruderLayers& layers) {
  const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(layers.placed.id)];
  if (intruder.contrail.strands == 0 || scene.is_thermal || scene.compositing.method != MethodChoice::direct) return;
  const cv::Rect& window = layers.window;
  const Lens& model = lens.camera().lens;
  const std::vector<TrailStrand> strands = contrail_strands(scene, moment, layers.placed, model);
  const Trail trail = trail_of(strands, contrail_color(scene, moment, intruder.contrail),
                               grown(window, blur_margin_px(std::min(layers.formation.blur_px, 100.0))));
  if (trail.layer.empty()) return;
  const cv::Rect box = larger_part(trail.layer.rect & window, model, scene.footage.size_px);
  const Layer seen = in_footage_look(scene, trail.layer, trail.distance_m, box, background);
  // The part of the trail at some distances, which is before the occluder or behind it as a whole.
  const auto shown = [&](const cv::Mat& at_these, double distance_m) {
    Layer part{seen.rect, {}, seen.coverage};
    seen.color.copyTo(part.color, at_these);
    return without_hidden(scene, moment, blurred_through(model, part, layers.formation.blur_px, window), distance_m,
                          lens);
  };
  constexpr double kBeyondAll_m = 1e30;
  const double occluder_m = scene.occluder.mask.empty() ? kBeyondAll_m : scene.occluder.distance_m;
  const cv::Mat is_behind = trail.distance_m > occluder_m;
  layers.contrail = shown(~is_behind, 0);
  if (!layers.contrail.empty() && cv::countNonZero(is_behind) > 0)
    layers.contrail.color += shown(is_behind, occluder_m + 1).color;
  layers.contrail_is_nearer = is_before_aircraft(scene, moment, layers.placed);
  if (!layers.contrail_is_nearer || layers.contrail.empty() || layers.occluded.empty()) return;
  layers.occluded.coverage = layers.occluded.coverage.clone();
  occlude_coverage(layers.occluded.coverage, layers.occluded.rect, layers.contrail);
}

// Fills `lamps`. A thermal camera sees none of them.
void add_lamps(const Scene& scene, const SceneMoment& moment, LensTable& lens, IntruderLayers& layers) {
  const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(layers.placed.id)];
  if (intruder.lights.is_dark() || scene.is_thermal || scene.compositing.method != MethodChoice::direct) return;
  const AppearanceSettings& look = scene.appearance;
  const Lens& model = lens.camera().lens;
  for (const LampImage& lamp : lamp_images(scene, moment, layers.placed, model)) {
    const LampSpread spread{.sigma_px = layers.formation.blur_px,
                            .glare = look.glare,
                            .glare_px = look.glare_px,
                            .widening = widening_at(model, lamp.pixel.y)};
    LampLayer made = lamp_layer(lamp, spread, window_around(lamp.pixel.x, model, scene.footage.size_px));
    if (made.layer.empty()) continue;
    made = with_layer(without_hidden(scene, moment, made.layer, layers.placed.distance_m(), lens));
    if (made.layer.empty()) continue;
    layers.lamp_truths.push_back({lamp.name, lamp.pixel, lamp.share, made.brightest});
    layers.lamps.push_back(std::move(made));
  }
}

// Fills `shadow`. A thermal camera sees none.
void add_shadow(const Scene& scene, const SceneMoment& moment, LensTable& lens, IntruderLayers& layers) {
  if (scene.is_thermal || scene.compositing.method != MethodChoice::direct) return;
  const GroundShadow shadow = ground_shadow(scene, moment, layers.placed, lens.camera().lens,
                                            scene.appearance.psf_sigma_px, {{0, 0}, scene.footage.size_px});
  if (!shadow.layer.empty()) layers.shadow = without_hidden(scene, moment, shadow.layer, shadow.distance_m, lens);
}

// Samples a pixel, each way, of the light of an intruder that is blurred before pixels average it, as a lens does.
// Where pixels averaged first, what is hardly larger than one would stay in its middle while it moves through it: the
// smaller the target, the farther off. 1: pixels average first, which the size or no blur allows.
int steps_before_pixels(const Scene& scene, const IntruderLayers& layers) {
  constexpr double kTiny_px = 4;
  constexpr double kSmall_px = 40;  // above, the error of drawing is larger
  constexpr double kLongest = 64;   // blur in samples: a wider one hides where in a pixel light falls
  if (scene.compositing.method != MethodChoice::direct || !layers.silhouette || !layers.silhouette->all_have_image)
    return 1;
  if (layers.formation.blur_px < kMinMotion_px && layers.motion.shifts.empty()) return 1;
  const Box& box = layers.silhouette->box;
  const double size_px = std::max(box.width, box.height);
  int steps = size_px <= kTiny_px ? 8 : size_px <= kSmall_px ? 4 : 1;
  while (steps > 1 &&
         (steps * layers.formation.blur_px > kWideSigma_px || steps * layers.formation.motion_blur_px > kLongest))
    steps /= 2;
  return steps;
}

// `blurred` of light that pixels have not averaged yet.
//   fine  hazed, with so many samples a pixel
Layer blurred_finely(const IntruderLayers& layers, const Lens& lens, const Layer& fine, int steps) {
  const MotionKernel motion = motion_kernel(double(steps) * layers.motion_xy_px);
  const cv::Rect window(layers.window.tl() * steps, layers.window.size() * steps);
  const Layer moved = motion_blurred(fine, motion, kUnboundedRect);
  const Lens fine_lens = lens.period_px() > 0 ? with_pixels_of(lens, 1.0 / steps) : lens;  // no other is asked
  Layer out =
      averaged(blurred_through(fine_lens, moved, steps * layers.formation.blur_px, window, motion.spread_px2), steps);
  if (!out.empty()) out.coverage = coverage_over(out.rect, layers.warped);
  return out;
}

// Fills `motion_blurred` and `blurred`; the latter stays empty where the layer is too faint to be seen.
//   hazed_finely  `hazed` with so many samples a pixel, which is asked for where it is used
void blur(const Scene& scene, const Lens& lens, const ColorInfo& footage, int bit_depth,
          const std::function<Layer(int steps)>& hazed_finely, IntruderLayers& layers) {
  layers.motion_blurred = motion_blurred(layers.hazed, layers.motion, kUnboundedRect);
  layers.op_counts.pixels_motion_blurred +=
      static_cast<std::int64_t>(layers.motion.shifts.size()) * std::int64_t{layers.hazed.rect.area()};
  if (!is_visible_after_blur(layers.motion_blurred, layers.formation.blur_px, footage, bit_depth)) return;
  if (!needs_blurred_layers(scene)) {
    layers.blurred = clipped(layers.motion_blurred, layers.window);
    return;
  }
  if (const int steps = steps_before_pixels(scene, layers); steps > 1)
    layers.blurred = blurred_finely(layers, lens, hazed_finely(steps), steps);
  else
    layers.blurred =
        blurred_through(lens, layers.motion_blurred, layers.formation.blur_px, layers.window, layers.motion.spread_px2);
  if (layers.formation.blur_px > 0) layers.op_counts.pixels_blurred += layers.blurred.rect.area();
}

// What they hide, over the whole image.
Stage clouds_stage(const CloudMap& clouds, const Scene& scene) {
  Stage stage{.name = "clouds", .image = {}};
  clouds.part({{0, 0}, scene.footage.size_px}).opacity.convertTo(stage.image, CV_8U, 255);
  return stage;
}

// Of a frame that is light, or heat in gray.
Result<ComposedFrame> composed_onto(Frame&& background, const Scene& scene, int frame, ComposeContext& context,
                                    Stages stages) {
  const Stopwatch watch;
  const SceneMoment moment = scene_at(scene, frame);
  std::vector<IntruderLayers> far_to_near;
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> layers =
        intruder_layers(scene, moment, placed, context, background.color, &background, background.bit_depth);
    if (!layers) return fail(layers.error());
    for (IntruderLayers& part : parts_in_image(std::move(*layers), scene.camera.lens, scene.footage.size_px))
      far_to_near.push_back(std::move(part));
  }
  const std::optional<CloudMap> clouds = clouds_of(scene, background, far_to_near, stages);
  hide_behind_clouds(scene, clouds ? &*clouds : nullptr, far_to_near);
  const std::vector<FootageLuma> footage_luma = footage_luma_of(background, far_to_near);
  ComposedFrame composed = composited(std::move(background), scene, frame, far_to_near, context, stages);
  if (clouds && stages == Stages::keep)
    composed.stages.insert(composed.stages.begin() + 1, clouds_stage(*clouds, scene));
  composed.truth = frame_truth(scene, moment, frame, composed, far_to_near, footage_luma);
  for (const IntruderLayers& layers : far_to_near) {
    composed.op_counts += layers.op_counts;
    composed.times.draw_s += layers.draw_s;
  }
  composed.times.composite_s = watch.elapsed_s() - composed.times.draw_s;
  return composed;
}

// Heat in colours: the heat that they stand for is composed, and what it changes gets its colours.
Result<ComposedFrame> composed_in_colors(Frame&& background, const Scene& scene, int frame, ComposeContext& context,
                                         Stages stages) {
  const HeatColors& colors = context.colors_of(scene.palette);
  HeatColors::Heat heat = colors.heat_of(background);
  if (const Result<void> fits = check_palette(scene, heat.off_codes, frame); !fits) return fail(fits.error());
  const cv::Mat before = heat.frame.planes[0].clone();
  Result<ComposedFrame> composed = composed_onto(std::move(heat.frame), scene, frame, context, stages);
  if (!composed) return composed;
  const cv::Mat after = composed->image.planes[0];
  composed->image = std::move(background);
  if (!composed->mask.empty()) colors.show(before, after, composed->image);
  return composed;
}

bool is_same(const Camera& a, const Camera& b) {
  return a.size_px == b.size_px && a.lens.parameters() == b.lens.parameters();
}

}  // namespace

Result<IntruderLayers> intruder_layers(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                       ComposeContext& context, const ColorInfo& footage, const Frame* background,
                                       int bit_depth) {
  LensTable& lens = context.lens_of(compositing_camera(scene));
  lens.turn_to(placed.camera_from_body.translation_m);
  const std::int64_t evaluations_before = lens.evaluations();
  IntruderLayers layers = placed_layers(scene, moment, placed, lens.camera());
  const RenderPlan plan = render_plan_for(layers, lens, scene, moment);
  if (!plan.views.empty()) {
    const Result<Renderer*> renderer = context.renderer();
    if (!renderer) return fail(renderer.error());
    Result<std::vector<RenderedView>> views = sparingly_rendered_views(plan, scene, lens, layers, **renderer);
    if (!views) return fail(views.error());
    layers.views = std::move(*views);
    layers.warped = warped(layers.views, lens, plan.warp_rect, row_transform(layers));
    const cv::Rect box = box_in_image(layers, lens.camera().lens, scene.footage.size_px);
    const auto hazed = [&](const Layer& seen) {
      return in_footage_look(scene, seen, placed.distance_m(), box, background);
    };
    layers.hazed = hazed(layers.warped);
    const auto hazed_finely = [&](int steps) {
      return hazed(finely_warped(layers.views, lens, plan.warp_rect, steps, row_transform(layers)));
    };
    blur(scene, lens.camera().lens, footage, bit_depth, hazed_finely, layers);
    layers.occluded = without_hidden(scene, moment, layers.blurred, placed.distance_m(), lens);
    const Result<double> area = whole_area_px(layers, plan, lens, scene, **renderer);
    if (!area) return fail(area.error());
    layers.whole_area_px = *area;
    layers.op_counts.pixels_warped += layers.warped.rect.area();
  }
  add_contrail(scene, moment, background, lens, layers);
  add_lamps(scene, moment, lens, layers);
  add_shadow(scene, moment, lens, layers);
  layers.op_counts.lens_evaluations += lens.evaluations() - evaluations_before;
  return layers;
}

Result<void> check_spectrum(const Scene& scene, const Frame& background, int frame) {
  constexpr double kGray_codes = 6;  // of 8 bits, from gray in the mean: more than what compression leaves
  if (const std::optional<HeatColors> colors = heat_colors(scene.palette))
    return check_palette(scene, colors->heat_of(background).off_codes, frame);
  if (!scene.is_thermal || background.plane_count() == 1) return {};
  const double code = codes_per_8_bit_step(background.bit_depth);
  double off = 0;
  for (std::size_t plane = 1; plane < 3; ++plane) {
    const cv::Mat& codes = background.planes[plane];
    const double differs =
        background.layout == PixelLayout::rgb
            ? cv::norm(codes, background.planes[0], cv::NORM_L1)
            : cv::norm(codes, cv::Mat(codes.size(), codes.type(), cv::Scalar(128 * code)), cv::NORM_L1);
    off = std::max(off, differs / static_cast<double>(codes.total()) / code);
  }
  if (off <= kGray_codes) return {};
  return fail(
      "footage.spectrum",
      fmt::format("thermal, but the footage is in colours: set footage.palette to the camera's palette ({}), where "
                  "it is one of these; else record it white-hot or black-hot",
                  fmt::join(kHeatPaletteNames.begin() + 1, kHeatPaletteNames.end(), ", ")),
      ErrorKind::bad_project);
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background, ComposeContext& context,
                                    Stages stages) {
  ENSURE(background.size_px() == scene.footage.size_px);
  if (scene.palette != HeatPalette::gray)
    return composed_in_colors(std::move(background), scene, frame, context, stages);
  if (const Result<void> gray = check_spectrum(scene, background, frame); !gray) return fail(gray.error());
  return composed_onto(std::move(background), scene, frame, context, stages);
}

Result<std::optional<FrameTruth>> truth_without_image(const Scene& scene, int frame, const ColorInfo& footage,
                                                      int bit_depth, ComposeContext& context) {
  const SceneMoment moment = scene_at(scene, frame);
  std::vector<IntruderLayers> far_to_near;
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> layers = intruder_layers(scene, moment, placed, context, footage, nullptr, bit_depth);
    if (!layers) return fail(layers.error());
    const bool draws =
        !layers->occluded.empty() || !layers->contrail.empty() || !layers->shadow.empty() || !layers->lamps.empty();
    if (draws) return std::optional<FrameTruth>();
    far_to_near.push_back(std::move(*layers));
  }
  hide_behind_clouds(scene, nullptr, far_to_near);
  return std::optional(
      frame_truth(scene, moment, frame, {}, far_to_near, std::vector<FootageLuma>(far_to_near.size())));
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background, ComposeContext& context,
                                    Stages stages) {
  return compose_frame(scene, frame, cloned(background), context, stages);
}

Result<Renderer*> ComposeContext::renderer() {
  if (!renderer_) {
    Result<Renderer> created = Renderer::create(settings_.samples_per_pixel);
    if (!created) return fail(created.error());
    renderer_.emplace(std::move(*created));
  }
  return &*renderer_;
}

const DistortMaps& ComposeContext::maps_of(const Camera& camera) {
  if (!camera_of_maps_ || !is_same(*camera_of_maps_, camera)) {
    maps_ = distort_maps(camera);
    camera_of_maps_ = camera;
  }
  return *maps_;
}

LensTable& ComposeContext::lens_of(const Camera& camera) {
  if (!lens_ || !is_same(lens_->camera(), camera)) lens_.emplace(camera, settings_.lens_tolerance_px);
  return *lens_;
}

const HeatColors& ComposeContext::colors_of(HeatPalette palette) {
  if (!colors_ || colors_->palette() != palette) colors_.emplace(palette);
  return *colors_;
}

void ComposeContext::forget(const Mesh& mesh) {
  if (renderer_) renderer_->forget(mesh);
}

std::string ComposeContext::renderer_description() const {
  return renderer_ ? renderer_->description() : std::string();
}

}  // namespace sigs
