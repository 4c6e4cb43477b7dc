// SPDX-License-Identifier: MIT
#include "frame/composite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <utility>

#include "compositor/blend.h"
#include "compositor/classic.h"
#include "frame/look.h"
#include "video/color_space.h"

namespace sigs {

namespace {

// Point of the occluder's sphere that a ray meets: |offset + t ray| = distance, with t > 0. All of it in one frame of
// axes; none where the ray starts outside the sphere.
std::optional<glm::dvec3> on_sphere(const glm::dvec3& offset_m, const glm::dvec3& unit_ray, double distance_m) {
  const double along_m = glm::dot(offset_m, unit_ray);
  const double inside = distance_m * distance_m - glm::dot(offset_m, offset_m);
  if (!(inside > 0)) return std::nullopt;
  return offset_m + unit_ray * (std::sqrt(along_m * along_m + inside) - along_m);
}

// Bilinear; beyond the borders is nothing, beside those of a mask that goes round.
float sampled(const cv::Mat& mask, const glm::dvec2& at, bool goes_round) {
  if (!(at.y > -1 && at.y < mask.rows)) return 0;
  if (!goes_round && !(at.x > -1 && at.x < mask.cols)) return 0;
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  const auto right = static_cast<float>(at.x - x);
  const auto down = static_cast<float>(at.y - y);
  const auto value = [&](int column, int row) {
    if (goes_round) column = column_round(column, mask.cols);
    return column < 0 || row < 0 || column >= mask.cols || row >= mask.rows ? 0.0F : mask.at<float>(row, column);
  };
  return (1 - down) * ((1 - right) * value(x, y) + right * value(x + 1, y)) +
         down * ((1 - right) * value(x, y + 1) + right * value(x + 1, y + 1));
}

// Unit vectors along which the middles of a row's pixels look; zero where a corner of the pixel has no ray.
std::vector<glm::dvec3> middle_rays(LensTable& lens, const cv::Rect& rect, int y) {
  const auto corners_of = [&](int row) {
    const std::span<const glm::dvec3> corners = lens.corner_rays(rect.x, row, rect.width + 1);
    return std::vector<glm::dvec3>(corners.begin(), corners.end());
  };
  const std::vector<glm::dvec3> upper = corners_of(y);
  const std::vector<glm::dvec3> lower = corners_of(y + 1);
  std::vector<glm::dvec3> rays;
  for (std::size_t x = 0; x + 1 < upper.size(); ++x) {
    const std::array<glm::dvec3, 4> corners = {upper[x], upper[x + 1], lower[x], lower[x + 1]};
    const bool has_rays =
        std::none_of(corners.begin(), corners.end(), [](const glm::dvec3& corner) { return corner == glm::dvec3(0); });
    rays.push_back(has_rays ? glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]) : glm::dvec3(0));
  }
  return rays;
}

// Adds opacity, the last channel of an image of floats over rect, to the mask as one sheet over another. What is
// touched at all gets at least 1.
void add_to_mask(cv::Mat& mask, cv::Size image_size_px, const cv::Rect& rect, const cv::Mat& opacity) {
  if (mask.empty()) mask = cv::Mat::zeros(image_size_px, CV_8UC1);
  const int stride = opacity.channels();
  for (int j = 0; j < rect.height; ++j) {
    const float* above = opacity.ptr<float>(j) + stride - 1;
    uchar* below = mask.ptr<uchar>(rect.y + j) + rect.x;
    for (int i = 0; i < rect.width; ++i, above += stride, ++below) {
      if (!(*above > 0)) continue;
      const float both = 255.0F - (255.0F - *below) * (1.0F - std::min(*above, 1.0F));
      *below = static_cast<uchar>(std::max(1.0F, both + 0.5F));
    }
  }
}

// A layer as it looks before black, over the whole image, in code values of the footage.
cv::Mat shown(const Layer& layer, const ColorInfo& footage, cv::Size image_size_px) {
  cv::Mat image = cv::Mat::zeros(image_size_px, CV_8UC3);
  const cv::Mat colors = in_footage_primaries(layer.color, footage);
  const TransferCurve curve = transfer_curve_of(footage);
  const cv::Rect inside = layer.rect & cv::Rect({0, 0}, image_size_px);
  for (int y = inside.y; y < inside.y + inside.height; ++y)
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      const cv::Vec4f& color = colors.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x);
      for (int c = 0; c < 3; ++c)
        image.at<cv::Vec3b>(y, x)[2 - c] = cv::saturate_cast<uchar>(255.0F * curve.display_of_linear(color[c]));
    }
  return image;
}

// "1_warped" for the intruder with id 1; plain "warped" where there is only one.
std::string stage_name(const std::string& name, const IntruderLayers& layers, const Scene& scene) {
  return scene.intruders.size() == 1 ? name : fmt::format("{}_{}", layers.placed.id, name);
}

void composite_direct(ComposedFrame& composed, const Scene& scene, const Layer& layer, BlendChoice space) {
  composed.op_counts.pixels_blended += blend_over(composed.image, layer, space);
  add_to_mask(composed.mask, scene.footage.size_px, layer.rect, layer.color);
}

// With the stages that follow blending, in code values. The mask has what they rewrite beyond the layer.
void composite_with_post_blend_stages(ComposedFrame& composed, const Scene& scene, const Layer& layer,
                                      BlendChoice space, int intruder, int frame, const StageDone& done) {
  const Rewritten rewritten = blend_with_post_blend_stages(composed, scene, layer, space, intruder, frame, done);
  add_to_mask(composed.mask, scene.footage.size_px, layer.rect, layer.color);
  cv::Mat mask = composed.mask(rewritten.rect);
  cv::max(mask, rewritten.changed & 1, mask);
  composed.op_counts.pixels_blended += cv::countNonZero(rewritten.changed);
}

// The mean of what a layer's blending changes luma by, weighted by its coverage; or of what it changes squares of 7
// pixels by, whichever is more: a body that is bright above and dark below changes the whole by nothing. In such
// squares noise of 4 codes is less than one.
double luma_change(const cv::Mat& before, const cv::Mat& after, const Layer& layer) {
  constexpr int kSquare_px = 7;
  const double covered = cv::sum(layer.coverage)[0];
  if (!(covered > 0)) return 0;
  cv::Mat change;
  cv::subtract(after, before, change, cv::noArray(), CV_32F);
  const double of_whole = std::abs(change.dot(layer.coverage));
  cv::boxFilter(change.mul(layer.coverage), change, CV_32F, {kSquare_px, kSquare_px}, {-1, -1}, true,
                cv::BORDER_CONSTANT);
  return std::max(of_whole, cv::norm(change, cv::NORM_L1)) / covered;
}

// On the ground, which is farther than every intruder. It takes light, so it is mixed in light.
void composite_shadow(ComposedFrame& composed, const Scene& scene, const IntruderLayers& layers, int frame, bool keep) {
  if (has_post_blend_stages(scene))
    composite_with_post_blend_stages(composed, scene, layers.shadow, BlendChoice::linear, layers.placed.id, frame, {});
  else
    composite_direct(composed, scene, layers.shadow, BlendChoice::linear);
  if (keep) composed.stages.push_back({stage_name("shadow", layers, scene), bgr_of(composed.image)});
}

// An intruder's contrail and the intruder itself, the farther one first, and its lights, which add to the light that is
// there whatever is mixed elsewhere.
void composite_intruder(ComposedFrame& composed, const Scene& scene, const IntruderLayers& layers, int frame,
                        bool keep) {
  const auto blend_in = [&](BlendChoice space, const Layer& layer, const StageDone& done) {
    if (layer.empty()) return;
    if (has_post_blend_stages(scene))
      composite_with_post_blend_stages(composed, scene, layer, space, layers.placed.id, frame, done);
    else
      composite_direct(composed, scene, layer, space);
  };
  const auto blend = [&](const Layer& layer, const StageDone& done) { blend_in(scene.compositing.blend, layer, done); };
  const auto keep_stage = [&](const std::string& name) {
    composed.stages.push_back({stage_name(name, layers, scene), bgr_of(composed.image)});
  };
  if (!layers.contrail_is_nearer) blend(layers.contrail, {});
  const bool is_watched = !layers.lamps.empty() && !layers.occluded.empty();
  const cv::Mat before = is_watched ? luma_of_part(composed.image, layers.occluded.rect).clone() : cv::Mat();
  blend(layers.occluded, keep ? StageDone(keep_stage) : StageDone());
  if (is_watched)
    composed.body_changes[layers.placed.id] =  // of a 360 degree image's two parts the larger change
        std::max(composed.body_changes[layers.placed.id],
                 luma_change(before, luma_of_part(composed.image, layers.occluded.rect), layers.occluded));
  if (layers.contrail_is_nearer) blend(layers.contrail, {});
  if (keep && !layers.contrail.empty()) keep_stage("contrail");
  for (const LampLayer& lamp : layers.lamps) blend_in(BlendChoice::linear, lamp.layer, {});
  if (keep && !layers.lamps.empty()) keep_stage("lights");
}

void keep_direct_stages(std::vector<Stage>& stages, const Scene& scene, const IntruderLayers& layers,
                        const ColorInfo& footage) {
  const cv::Size size = scene.footage.size_px;
  for (const RenderedView& drawn : layers.views) {
    const Layer& layer = drawn.coarse ? drawn.coarse->layer : drawn.layer;  // the finer one has not all of it
    stages.push_back({stage_name("layer", layers, scene), shown(layer, footage, layer.rect.size())});
  }
  stages.push_back({stage_name("warped", layers, scene), shown(layers.warped, footage, size)});
  if (layers.hazed.color.data != layers.warped.color.data)
    stages.push_back({stage_name("hazed", layers, scene), shown(layers.hazed, footage, size)});
  if (layers.motion_blurred.color.data != layers.hazed.color.data)
    stages.push_back({stage_name("motion_blurred", layers, scene), shown(layers.motion_blurred, footage, size)});
  stages.push_back({stage_name("blurred", layers, scene), shown(layers.blurred, footage, size)});
  stages.push_back({stage_name("occluded", layers, scene), shown(layers.occluded, footage, size)});
}

// What the own body leaves of the pixels of part that the classic methods changed: CV_32FC1, 0 where nothing is to
// change.
cv::Mat weight_of(const cv::Mat& changed, const cv::Mat& own_body, const cv::Rect& part) {
  cv::Mat weight;
  changed(part).convertTo(weight, CV_32F, 1.0 / 255.0);
  return own_body.empty() ? weight : cv::Mat(weight.mul(1.0 - own_body(part)));
}

// The part of a pinhole's image in which the views have content: all of it where one extends beyond 90 degrees.
cv::Rect visible_rect_of(std::span<const RenderedView> views, const Camera& pinhole) {
  constexpr int kMargin_px = 3;  // views are read by area
  const cv::Rect whole({0, 0}, pinhole.size_px);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const RenderedView& drawn : views)
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
      const VirtualCamera& view = drawn.view;
      const glm::dvec2 at =
          (corner * glm::dvec2(view.size_px.width, view.size_px.height) - 0.5 - view.center_px) / view.focal_px;
      const std::optional<glm::dvec2> pixel =
          pinhole.lens.pixel(inverse(view.view_from_camera) * glm::dvec3(1, at.x, at.y));
      if (!pixel) return whole;
      low = glm::min(low, *pixel);
      high = glm::max(high, *pixel);
    }
  return pixels_touched({low.x, low.y, high.x - low.x, high.y - low.y}, kMargin_px, whole);
}

// The intruder in the undistorted image's plane, where the classic methods key it.
Layer pinhole_layer(const Scene& scene, const IntruderLayers& layers) {
  const cv::Rect whole({0, 0}, scene.footage.size_px);
  if (scene.compositing.method == MethodChoice::plain) return clipped(layers.warped, whole);
  const Camera pinhole{scene.camera.lens.pinhole(), scene.footage.size_px};
  const cv::Rect visible_rect = visible_rect_of(layers.views, pinhole);
  return visible_rect.empty() ? Layer{} : warped(layers.views, pinhole, visible_rect);
}

// The key's own edge, warped and blurred like the image: the intruder's share of each changed pixel of part.
cv::Mat classic_opacity(const ClassicStages& stages, const DistortMaps& maps, double sigma_px, const cv::Rect& part) {
  const cv::Rect from = gaussian_blur_source(part, sigma_px, stages.key.size());
  const cv::Mat edge = gaussian_blurred(distorted(stages.key, maps, cv::Scalar::all(0), from), sigma_px);
  cv::Mat opacity;
  edge(part - from.tl()).convertTo(opacity, CV_32F, 1.0 / 255.0);
  // A pixel that F counts as changed is rewritten, however little of the key remains in it after rounding.
  cv::max(opacity, 1.0 / 512.0, opacity);
  return opacity;
}

// Beside the conversion: the intruder once more, without the lens, and whole images D and F.
void count_classic(OpCounts& counts, const Layer& pinhole, const ClassicStages& stages, double sigma_px) {
  counts.pixels_warped += pinhole.rect.area();
  if (sigma_px > 0) counts.pixels_blurred += 2 * static_cast<std::int64_t>(stages.d.total());
}

ClassicStages composite_classic(ComposedFrame& composed, const Scene& scene, const IntruderLayers& layers,
                                ComposeContext& context) {
  ClassicStages buffers = std::exchange(context.classic_buffers(), {});
  const cv::Mat input1 = bgr_of(composed.image);
  composed.op_counts.pixels_converted += static_cast<std::int64_t>(input1.total());
  const Layer pinhole = pinhole_layer(scene, layers);
  const cv::Mat input2 = on_green_screen(pinhole, composed.image.color, scene.footage.size_px, buffers.input2);
  const DistortMaps* maps =
      scene.compositing.method == MethodChoice::classic ? &context.maps_of(scene.camera) : nullptr;
  ClassicStages stages = maps ? classic_stages(input1, input2, *maps, layers.formation.blur_px, std::move(buffers))
                              : plain_stages(input1, input2, std::move(buffers));
  if (maps) count_classic(composed.op_counts, pinhole, stages, layers.formation.blur_px);
  const cv::Rect part = cv::boundingRect(stages.changed);
  if (part.empty()) return stages;
  cv::Mat weight = weight_of(stages.changed, scene.own_body, part);
  if (scene.occluder.hides(layers.placed.distance_m()))
    weight = weight.mul(1.0 - occluder_seen_from(layers.world_from_camera, scene.occluder,
                                                 context.lens_of(compositing_camera(scene)), part));
  composed.op_counts.pixels_blended += replace_pixels(composed.image, part, stages.output(part), weight);
  const cv::Mat opacity =
      maps ? cv::Mat(classic_opacity(stages, *maps, layers.formation.blur_px, part).mul(weight)) : weight;
  add_to_mask(composed.mask, scene.footage.size_px, part, opacity);
  return stages;
}

void keep_classic_stages(std::vector<Stage>& kept, const ClassicStages& stages, const Scene& scene,
                         const IntruderLayers& layers) {
  const std::pair<const char*, const cv::Mat*> all[] = {
      {"input1", &stages.input1}, {"input2", &stages.input2}, {"a", &stages.a}, {"b", &stages.b},
      {"c", &stages.c},           {"d", &stages.d},           {"f", &stages.f}, {"keyed", &stages.output}};
  for (const auto& [name, image] : all)
    if (!image->empty()) kept.push_back({stage_name(name, layers, scene), *image});
}

// None where there is none to be done: it is not asked for, the method is not direct, the footage has more than 8 bits,
// its codec keeps every sample, or no intruder reaches the image.
std::optional<CodecMatch> codec_match_for(const Frame& background, const Scene& scene, int frame, const Lens& lens,
                                          const std::vector<IntruderLayers>& layers) {
  const CodecMatchSettings& settings = scene.appearance.codec;
  if (settings.match == CodecMatchChoice::none || scene.compositing.method != MethodChoice::direct) return std::nullopt;
  if (background.bit_depth > 8) return std::nullopt;
  const cv::Rect image({0, 0}, background.size_px());
  std::vector<cv::Rect> reaches;
  std::vector<std::vector<cv::Point2d>> earlier_px;
  constexpr int kCodedHalo_px = 36;  // beyond it a halo is too even for a codec to change it
  const int margin_px = post_blend_stages_margin_px(scene, background.layout, kCodedHalo_px);
  for (const IntruderLayers& intruder : layers) {
    for (const Layer* const still : {&intruder.contrail, &intruder.shadow}) {  // which hardly move
      if (still->empty()) continue;
      reaches.push_back(grown(still->rect, margin_px) & image);
      if (settings.predicted_frames > 0)
        earlier_px.emplace_back(std::min(settings.predicted_frames, frame), cv::Point2d(0, 0));
    }
    cv::Rect own = intruder.occluded.empty() ? cv::Rect() : intruder.occluded.rect;
    for (const LampLayer& lamp : intruder.lamps) own |= lamp.layer.rect;
    if (own.empty()) continue;
    reaches.push_back(grown(own, margin_px) & image);
    if (settings.predicted_frames > 0)
      earlier_px.push_back(earlier_places(scene, frame, intruder.placed, lens, settings.predicted_frames));
  }
  if (reaches.empty()) return std::nullopt;
  std::optional<FrameQuantisers> quantisers =
      matched_quantisers(settings.match, settings.quantiser, background.quantisers.get());
  if (!quantisers) return std::nullopt;
  return CodecMatch(background, reaches, std::move(*quantisers), earlier_px);
}

}  // namespace

cv::Mat occluder_seen_from(const Pose<frame::World, frame::Camera>& world_from_camera, const Occluder& occluder,
                           LensTable& lens, const cv::Rect& rect) {
  const Pose<frame::World, frame::Camera>& made_at = occluder.world_from_camera;
  const glm::dquat made_from_now = glm::conjugate(made_at.rotation) * world_from_camera.rotation;
  const glm::dvec3 offset_m = occluder.distance_m > 0 ? glm::conjugate(made_at.rotation) *
                                                            (world_from_camera.translation_m - made_at.translation_m)
                                                      : glm::dvec3(0);
  if (made_at.rotation == world_from_camera.rotation && offset_m == glm::dvec3(0))
    return part_round(occluder.mask, rect);
  const bool goes_round = lens.camera().lens.period_px() > 0;
  cv::Mat seen = cv::Mat::zeros(rect.size(), CV_32FC1);
  for (int y = 0; y < rect.height; ++y) {
    const std::vector<glm::dvec3> rays = middle_rays(lens, rect, rect.y + y);
    for (int x = 0; x < rect.width; ++x) {
      const glm::dvec3& ray = rays[static_cast<std::size_t>(x)];
      if (ray == glm::dvec3(0)) continue;
      std::optional<glm::dvec3> point = made_from_now * ray;
      if (occluder.distance_m > 0) point = on_sphere(offset_m, *point, occluder.distance_m);
      const std::optional<glm::dvec2> pixel = point ? lens.pixel(*point) : std::nullopt;
      if (pixel) seen.at<float>(y, x) = sampled(occluder.mask, *pixel, goes_round);
    }
  }
  return seen;
}

ComposedFrame composited(Frame background, const Scene& scene, int frame,
                         const std::vector<IntruderLayers>& far_to_near, ComposeContext& context, Stages stages) {
  ComposedFrame composed{.image = std::move(background)};
  const bool keep = stages == Stages::keep;
  const bool direct = scene.compositing.method == MethodChoice::direct;
  const std::optional<CodecMatch> codec_match =
      codec_match_for(composed.image, scene, frame, compositing_camera(scene).lens, far_to_near);
  if (keep && direct) composed.stages.push_back({"input1", bgr_of(composed.image)});
  for (const IntruderLayers& layers : far_to_near)
    if (!layers.shadow.empty()) composite_shadow(composed, scene, layers, frame, keep);
  for (const IntruderLayers& layers : far_to_near) {
    if (layers.views.empty() && layers.contrail.empty() && layers.lamps.empty()) continue;
    if (direct) {
      if (keep && !layers.views.empty()) keep_direct_stages(composed.stages, scene, layers, composed.image.color);
      composite_intruder(composed, scene, layers, frame, keep);
    } else {
      ClassicStages classic = composite_classic(composed, scene, layers, context);
      if (keep)
        keep_classic_stages(composed.stages, classic, scene, layers);
      else
        context.classic_buffers() = std::move(classic);
    }
  }
  if (codec_match) {
    if (keep) composed.stages.push_back({"uncoded", bgr_of(composed.image)});
    composed.op_counts.pixels_coded += codec_match->apply(composed.image, composed.mask, scene.own_body);
  }
  if (keep) {
    if (!composed.mask.empty()) composed.stages.push_back({"mask", composed.mask});
    composed.stages.push_back({"output", bgr_of(composed.image)});
  }
  return composed;
}

}  // namespace sigs
