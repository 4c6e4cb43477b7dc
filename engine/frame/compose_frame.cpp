// SPDX-License-Identifier: MIT
#include "frame/compose_frame.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "compositor/blend.h"
#include "compositor/blur.h"
#include "compositor/haze.h"
#include "compositor/warp.h"
#include "frame/cloud_cover.h"
#include "frame/composite.h"
#include "frame/contrail.h"
#include "frame/ground_shadow.h"
#include "frame/panorama.h"
#include "frame/render_plan.h"
#include "scene/scene.h"
#include "scene/scene_at.h"
#include "truth/annotation.h"
#include "truth/measure.h"
#include "video/color_space.h"
#include "video/frame.h"
#include "video/frame_source.h"

namespace sigs {
namespace {

// Luma of the footage where an intruder will be blended onto it, and around. Empty where it will not be.
struct FootageLuma {
  cv::Rect rect;
  cv::Mat luma;  // CV_8UC1 over rect, of its own
};

// Of a grey with this luma. RGB's luma has full range, as its map has.
LuminanceOfCode luminance_of_code(const Frame& frame) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  const TransferCurve curve = transfer_curve_of(frame.color);
  LuminanceOfCode luminance{};
  for (std::size_t code = 0; code < luminance.size(); ++code)
    luminance[code] =
        std::max(curve.linear_of_display(map.to_rgb(0, 0) * (static_cast<float>(code) - map.offset[0])), 0.0F);
  return luminance;
}

// Of each intruder. To be called before they are blended, since that rewrites the footage in place.
std::vector<FootageLuma> footage_luma_of(const Frame& footage, const std::vector<IntruderLayers>& far_to_near) {
  std::vector<FootageLuma> all(far_to_near.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    cv::Rect own = far_to_near[i].occluded.empty() ? cv::Rect() : far_to_near[i].occluded.rect;
    for (const LampLayer& lamp : far_to_near[i].lamps) own |= lamp.layer.rect;
    if (own.empty()) continue;
    const cv::Rect rect = background_rect(own, footage.size_px());
    all[i] = {rect, luma_of_part(footage, rect).clone()};
  }
  return all;
}

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

// Linear light of the haze in front of what is in a box of the image. Where the footage around it is asked for, but the
// box is far beyond the image or wholly over the own body, the colour of the settings.
cv::Vec3d airlight_of(const Scene& scene, const cv::Rect& box, const Frame* background) {
  const HazeSettings& haze = scene.appearance.haze;
  const glm::dvec3& color = haze.airlight_color;
  std::optional<cv::Vec3d> behind;
  if (haze.airlight == AirlightChoice::behind && background != nullptr)
    behind = airlight_around(*background, box, scene.own_body);
  return behind.value_or(cv::Vec3d(color.x, color.y, color.z));
}

// The layer in the footage's tones and behind its haze. The saturation and the black are the camera's, which the
// airlight has already as the footage shows it: so they come before haze.
Layer hazed_layer(const Scene& scene, const Layer& layer, double distance_m, const cv::Rect& box,
                  const Frame* background) {
  const AppearanceSettings& look = scene.appearance;
  if (scene.compositing.method != MethodChoice::direct) return layer;
  const Layer in_tone = toned(layer, look.saturation, look.black);
  if (!look.haze.visibility_m) return in_tone;
  return hazed(in_tone, haze_transmission(distance_m, *look.haze.visibility_m), airlight_of(scene, box, background));
}

// A layer without what own body and, at this distance, the occluder hide.
Layer without_hidden(const Scene& scene, const SceneMoment& moment, const Layer& layer, double distance_m,
                     LensTable& lens) {
  const Layer free = occluded_by_body(layer, scene.own_body);
  if (!scene.occluder.hides(distance_m) || free.empty()) return free;
  return occluded_by(free, occluder_seen_from(moment.world_from_camera, scene.occluder, lens, free.rect));
}

// Error: thermal footage in colours. What a palette stands for is not known.
Result<void> check_spectrum(const Scene& scene, const Frame& background) {
  constexpr double kGray_codes = 6;  // of 8 bits, from gray in the mean: more than what compression leaves
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
  return fail("footage.spectrum",
              "thermal, but the footage is in colours: heat can be drawn in gray footage alone; record it white-hot or "
              "black-hot, or convert it by its palette",
              ErrorKind::bad_project);
}

// Fills `contrail`: through haze, blurred by the lens. How warm ice looks is not modelled.
void add_contrail(const Scene& scene, const SceneMoment& moment, const Frame* background, LensTable& lens,
                  IntruderLayers& layers) {
  const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(layers.placed.id)];
  if (intruder.contrail.strands == 0 || scene.is_thermal || scene.compositing.method != MethodChoice::direct) return;
  const cv::Rect& window = layers.window;
  const Lens& model = lens.camera().lens;
  const double distance_m = layers.placed.distance_m();
  const std::vector<TrailStrand> strands = contrail_strands(scene, moment, layers.placed, model);
  const Layer trail = trail_layer(strands, contrail_color(scene, moment, intruder.contrail),
                                  grown(window, blur_margin_px(std::min(layers.sigma_px, 100.0))));
  if (trail.empty()) return;
  const cv::Rect box = larger_part(trail.rect & window, model, scene.footage.size_px);
  const Layer hazed = hazed_layer(scene, trail, distance_m, box, background);
  layers.contrail =
      without_hidden(scene, moment, blurred_through(model, hazed, layers.sigma_px, window), distance_m, lens);
  layers.contrail_is_nearer = is_before_aircraft(scene, moment, layers.placed);
}

// Fills `lamps`. A thermal camera sees none of them.
void add_lamps(const Scene& scene, const SceneMoment& moment, LensTable& lens, IntruderLayers& layers) {
  const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(layers.placed.id)];
  if (intruder.lights.is_dark() || scene.is_thermal || scene.compositing.method != MethodChoice::direct) return;
  const AppearanceSettings& look = scene.appearance;
  const Lens& model = lens.camera().lens;
  for (const LampImage& lamp : lamp_images(scene, moment, layers.placed, model)) {
    const LampSpread spread{.sigma_px = layers.sigma_px,
                            .glare = look.glare,
                            .glare_px = look.glare_px,
                            .widening = widening_at(model, lamp.pixel.y)};
    LampLayer made = lamp_layer(lamp, spread, window_around(lamp.pixel.x, model, scene.footage.size_px));
    if (made.layer.empty()) continue;
    made.layer = without_hidden(scene, moment, made.layer, layers.placed.distance_m(), lens);
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

// Fills `motion_blurred` and `blurred`; the latter stays empty where the layer is too faint to be seen.
void blur(const Scene& scene, const Lens& lens, const ColorInfo& footage, int bit_depth, IntruderLayers& layers) {
  layers.motion_blurred = motion_blurred(layers.hazed, layers.motion, kUnboundedRect);
  layers.op_counts.pixels_motion_blurred +=
      static_cast<std::int64_t>(layers.motion.shifts.size()) * std::int64_t{layers.hazed.rect.area()};
  if (!is_visible_after_blur(layers.motion_blurred, layers.sigma_px, footage, bit_depth)) return;
  if (!needs_blurred_layers(scene)) {
    layers.blurred = clipped(layers.motion_blurred, layers.window);
    return;
  }
  layers.blurred =
      blurred_through(lens, layers.motion_blurred, layers.sigma_px, layers.window, layers.motion.spread_px2);
  if (layers.sigma_px > 0) layers.op_counts.pixels_blurred += layers.blurred.rect.area();
}

// Unit vector away from the ground.
glm::dvec3 up_in_camera(const SceneMoment& moment) {
  return glm::conjugate(moment.world_from_camera.rotation) * glm::dvec3(0, 0, -1);
}

// What measuring needs of the intruders.
std::vector<MeasuredLayers> measured_layers(const Scene& scene, const std::vector<IntruderLayers>& far_to_near) {
  std::vector<MeasuredLayers> all;
  for (const IntruderLayers& layers : far_to_near) {
    const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(layers.placed.id)];
    all.push_back({.id = layers.placed.id,
                   .name = intruder.name,
                   .camera_from_body = layers.placed.camera_from_body,
                   .world_from_body = layers.placed.world_from_body,
                   .silhouette = layers.body ? layers.body : layers.silhouette,
                   .outermost_m = intruder.model->outermost_m,
                   .whole_area_px = layers.whole_area_px,
                   .inside = clipped(layers.warped, layers.window),
                   .max_coverage = max_coverage(layers.warped.coverage),
                   .occluded = layers.occluded});
  }
  return all;
}

// Where the body changes nothing, what is visible are the pixels that its lights change.
void see_lights(const ComposedFrame& composed, const IntruderLayers& layers, const FootageLuma& behind,
                IntruderTruth& truth) {
  constexpr double kLeast_codes = 1;  // in the mean: a body that changes less is not seen
  constexpr int kSeen_codes = 2;      // of a pixel that lights change, beyond rounding
  if (layers.lamps.empty() || behind.luma.empty()) return;
  const auto change = composed.body_changes.find(truth.id);
  if (change != composed.body_changes.end() && change->second >= kLeast_codes) return;
  cv::Mat lit = cv::Mat::zeros(behind.rect.size(), CV_8UC1);
  for (const LampLayer& lamp : layers.lamps) {
    cv::Mat opacity;
    cv::extractChannel(lamp.layer.color, opacity, 3);
    const cv::Mat part = lit(lamp.layer.rect - behind.rect.tl());
    cv::bitwise_or(part, opacity > 0, part);
  }
  cv::Mat changed;
  cv::absdiff(luma_of_part(composed.image, behind.rect), behind.luma, changed);
  lit &= changed >= kSeen_codes;
  const cv::Rect box = cv::boundingRect(lit);
  if (box.empty()) return;
  truth.lights_alone = true;
  truth.visible_box = box + behind.rect.tl();
  truth.visible = lit(box).clone();
  truth.visible_pixels = cv::countNonZero(truth.visible);
  if (truth.visible_fraction == 0) truth.visible_fraction = truth.inside_fraction;  // too dark, not hidden
}

// How well an intruder that can be seen stands out in the image.
std::optional<Detectability> detectability_in(const Frame& image, const IntruderTruth& truth, const FootageLuma& behind,
                                              const Scene& scene) {
  if (behind.luma.empty() || !truth.visible_box) return std::nullopt;
  const cv::Rect rect = background_rect(*truth.visible_box, image.size_px()) & behind.rect;
  return detectability(truth, luma_of_part(image, *truth.visible_box), behind.luma(rect - behind.rect.tl()), rect,
                       scene.own_body, luminance_of_code(image));
}

// What they hide, over the whole image.
Stage clouds_stage(const CloudMap& clouds, const Scene& scene) {
  Stage stage{.name = "clouds", .image = {}};
  clouds.part({{0, 0}, scene.footage.size_px}).opacity.convertTo(stage.image, CV_8U, 255);
  return stage;
}

// The truth of every intruder, by id: what is measured in the composed image, and what the scene says.
std::vector<IntruderTruth> intruder_truths(const Scene& scene, const SceneMoment& moment, const ComposedFrame& composed,
                                           const std::vector<IntruderLayers>& far_to_near,
                                           const std::vector<FootageLuma>& footage_luma) {
  const std::vector<MeasuredLayers> all = measured_layers(scene, far_to_near);
  const auto up = scene.horizon_is_known ? std::optional(up_in_camera(moment)) : std::nullopt;
  const bool has_haze = scene.compositing.method == MethodChoice::direct;
  std::vector<IntruderTruth> truths;
  std::vector<IntruderTruth> parts;  // of one intruder
  for (std::size_t i = 0; i < all.size(); ++i) {
    IntruderTruth truth = measured(all[i], std::span(all).subspan(i + 1), composed.mask, up);
    see_lights(composed, far_to_near[i], footage_luma[i], truth);
    truth.detectability = detectability_in(composed.image, truth, footage_luma[i], scene);
    truth.image_formation = {.blur_px = far_to_near[i].sigma_px,
                             .motion_blur_px = far_to_near[i].motion_px,
                             .visibility_m = has_haze ? scene.appearance.haze.visibility_m : std::nullopt};
    if (scene.earth) truth.place = scene.earth->place_of(moment.world_from_camera * truth.position_m);
    truth.lights = far_to_near[i].lamp_truths;
    truth.clouds = far_to_near[i].clouds;
    truth.has_contrail = !far_to_near[i].contrail.empty();
    truth.has_shadow = !far_to_near[i].shadow.empty();
    truth.is_distractor = scene.intruders[static_cast<std::size_t>(truth.id)].is_distractor;
    parts.push_back(std::move(truth));
    if (i + 1 < all.size() && all[i + 1].id == all[i].id) continue;
    truths.push_back(joined(parts));
    parts.clear();
  }
  std::ranges::sort(truths, {}, &IntruderTruth::id);
  return truths;
}

// Boxes of aircraft that the footage itself shows in a frame, as whole pixels of the image.
std::vector<cv::Rect> real_aircraft_in(const Scene& scene, int frame) {
  std::vector<cv::Rect> boxes;
  const auto there = scene.real_aircraft.find(frame);
  if (there == scene.real_aircraft.end()) return boxes;
  for (const Box& box : there->second)
    if (const cv::Rect pixels = pixels_touched(box, 0, {{0, 0}, scene.footage.size_px}); !pixels.empty())
      boxes.push_back(pixels);
  return boxes;
}

FrameTruth truth_of(const Scene& scene, const SceneMoment& moment, int frame, const ComposedFrame& composed,
                    std::vector<IntruderTruth> intruders) {
  const glm::dvec3& position_m = moment.world_from_camera.translation_m;
  return {.index = frame,
          .time_s = moment.time_s,
          .substituted = composed.image.damaged,
          .camera_position_m = position_m,
          .world_from_camera = moment.world_from_camera.rotation,
          .camera = {.position_source = scene.motion.source.position,
                     .attitude_source = scene.motion.source.attitude,
                     .attitude_sd_rad = attitude_sd_at(scene.motion.deviations, moment.time_s),
                     .place = scene.earth ? std::optional(scene.earth->place_of(position_m)) : std::nullopt},
          .intruders = std::move(intruders),
          .real_aircraft = real_aircraft_in(scene, frame)};
}

}  // namespace

Result<IntruderLayers> intruder_layers(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                       ComposeContext& context, const ColorInfo& footage, const Frame* background) {
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
    layers.hazed = hazed_layer(scene, layers.warped, placed.distance_m(),
                               box_in_image(layers, lens.camera().lens, scene.footage.size_px), background);
    blur(scene, lens.camera().lens, footage, background == nullptr ? 8 : background->bit_depth, layers);
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

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background, ComposeContext& context,
                                    Stages stages) {
  ENSURE(background.size_px() == scene.footage.size_px);
  const Stopwatch watch;
  if (const Result<void> gray = check_spectrum(scene, background); !gray) return fail(gray.error());
  const SceneMoment moment = scene_at(scene, frame);
  std::vector<IntruderLayers> far_to_near;
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> layers = intruder_layers(scene, moment, placed, context, background.color, &background);
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
  composed.truth =
      truth_of(scene, moment, frame, composed, intruder_truths(scene, moment, composed, far_to_near, footage_luma));
  for (const IntruderLayers& layers : far_to_near) {
    composed.op_counts += layers.op_counts;
    composed.times.draw_s += layers.draw_s;
  }
  composed.times.composite_s = watch.elapsed_s() - composed.times.draw_s;
  return composed;
}

Result<std::optional<FrameTruth>> truth_without_image(const Scene& scene, int frame, ComposeContext& context) {
  const SceneMoment moment = scene_at(scene, frame);
  std::vector<IntruderLayers> far_to_near;
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> layers = intruder_layers(scene, moment, placed, context);
    if (!layers) return fail(layers.error());
    const bool draws =
        !layers->occluded.empty() || !layers->contrail.empty() || !layers->shadow.empty() || !layers->lamps.empty();
    if (draws) return std::optional<FrameTruth>();
    far_to_near.push_back(std::move(*layers));
  }
  const ComposedFrame nothing;
  return std::optional(
      truth_of(scene, moment, frame, nothing,
               intruder_truths(scene, moment, nothing, far_to_near, std::vector<FootageLuma>(far_to_near.size()))));
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background, ComposeContext& context,
                                    Stages stages) {
  return compose_frame(scene, frame, cloned(background), context, stages);
}

}  // namespace sigs
