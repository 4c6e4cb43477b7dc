// SPDX-License-Identifier: MIT
#include "frame/frame_truth.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <utility>

#include "truth/measure.h"
#include "video/color_space.h"

namespace sigs {
namespace {

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

// Whether a layer changes some pixel by half a code of 8 bits, between black and white.
bool is_seen(const Layer& layer) {
  if (layer.empty()) return false;
  cv::Mat opacity;
  cv::extractChannel(layer.color, opacity, 3);
  return cv::countNonZero(opacity > 0.5 / 255) > 0;
}

// The truth of every intruder, by id: what is measured in the composed image, and what the scene says.
std::vector<IntruderTruth> intruder_truths(const Scene& scene, const SceneMoment& moment, const ComposedFrame& composed,
                                           const std::vector<IntruderLayers>& far_to_near,
                                           const std::vector<FootageLuma>& footage_luma) {
  const std::vector<MeasuredLayers> all = measured_layers(scene, far_to_near);
  const auto up = scene.horizon_is_known ? std::optional(up_in_camera(moment)) : std::nullopt;
  std::vector<IntruderTruth> truths;
  std::vector<IntruderTruth> parts;  // of one intruder
  for (std::size_t i = 0; i < all.size(); ++i) {
    IntruderTruth truth = measured(all[i], std::span(all).subspan(i + 1), composed.mask, up);
    see_lights(composed, far_to_near[i], footage_luma[i], truth);
    truth.detectability = detectability_in(composed.image, truth, footage_luma[i], scene);
    truth.image_formation = far_to_near[i].formation;
    if (scene.earth) truth.place = scene.earth->place_of(moment.world_from_camera * truth.position_m);
    truth.lights = far_to_near[i].lamp_truths;
    truth.clouds = far_to_near[i].clouds;
    truth.has_contrail = is_seen(far_to_near[i].contrail);
    truth.has_shadow = is_seen(far_to_near[i].shadow);
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

}  // namespace

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

FrameTruth frame_truth(const Scene& scene, const SceneMoment& moment, int frame, const ComposedFrame& composed,
                       const std::vector<IntruderLayers>& far_to_near, const std::vector<FootageLuma>& footage_luma) {
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
          .intruders = intruder_truths(scene, moment, composed, far_to_near, footage_luma),
          .real_aircraft = real_aircraft_in(scene, frame)};
}

}  // namespace sigs
