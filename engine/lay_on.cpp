// SPDX-License-Identifier: MIT
#include "lay_on.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/transfer.h"
#include "compositor/blend.h"
#include "compositor/classic.h"
#include "compositor/replace.h"

namespace sigs {

namespace {

// Adds opacity to the mask as one sheet over another. What is touched at all gets at least 1.
void add_to_mask(cv::Mat& mask, cv::Size picture_size_px, const cv::Rect& rect, const cv::Mat& opacity) {
  if (mask.empty()) mask = cv::Mat::zeros(picture_size_px, CV_8UC1);
  for (int j = 0; j < rect.height; ++j)
    for (int i = 0; i < rect.width; ++i) {
      const float above = std::clamp(opacity.at<float>(j, i), 0.0F, 1.0F);
      if (above <= 0) continue;
      uchar& below = mask.at<uchar>(rect.y + j, rect.x + i);
      const float both = 255.0F - (255.0F - below) * (1.0F - above);
      below = static_cast<uchar>(std::max(1L, std::lround(both)));
    }
}

cv::Mat opacity_of(const Layer& layer) {
  cv::Mat opacity;
  cv::extractChannel(layer.color, opacity, 3);
  return opacity;
}

// A layer as it looks before black, over the whole picture.
cv::Mat shown(const Layer& layer, cv::Size picture_size_px) {
  cv::Mat picture = cv::Mat::zeros(picture_size_px, CV_8UC3);
  const cv::Rect inside = layer.rect & cv::Rect({0, 0}, picture_size_px);
  for (int y = inside.y; y < inside.y + inside.height; ++y)
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      const cv::Vec4f& color = layer.color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x);
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(y, x)[2 - c] = cv::saturate_cast<uchar>(255.0F * display_of_linear(color[c]));
    }
  return picture;
}

cv::Mat shown_view(const DrawnView& drawn) {
  return shown(drawn.layer, drawn.view.size_px);
}

// "1_bent" for the intruder with id 1; plain "bent" where there is only one.
std::string stage_name(const std::string& name, const SeenIntruder& seen, const Scene& scene) {
  return scene.intruders.size() == 1 ? name : std::to_string(seen.placed.id) + "_" + name;
}

void lay_direct(ComposedFrame& composed, const Scene& scene, const SeenIntruder& seen) {
  const BlendSpace space = scene.compositing.blend == BlendChoice::linear ? BlendSpace::linear : BlendSpace::display;
  blend_over(composed.picture, seen.soft, space);
  add_to_mask(composed.mask, scene.footage.size_px, seen.soft.rect, opacity_of(seen.soft));
}

void keep_direct_stages(std::vector<Stage>& stages, const Scene& scene, const SeenIntruder& seen) {
  const cv::Size size = scene.footage.size_px;
  for (const DrawnView& view : seen.views) stages.push_back({stage_name("layer", seen, scene), shown_view(view)});
  stages.push_back({stage_name("bent", seen, scene), shown(seen.sharp, size)});
  stages.push_back({stage_name("blurred", seen, scene), shown(seen.blurred, size)});
  stages.push_back({stage_name("hidden", seen, scene), shown(seen.soft, size)});
}

// What the own body leaves of the pixels that the classic methods changed: CV_32FC1, 0 where nothing is to change.
cv::Mat weight_of(const cv::Mat& changed, const cv::Mat& own_body) {
  cv::Mat weight;
  changed.convertTo(weight, CV_32F, 1.0 / 255.0);
  return own_body.empty() ? weight : cv::Mat(weight.mul(1.0 - own_body));
}

// The intruder in the undistorted picture's plane, where the classic methods key it.
Layer pinhole_layer(const Scene& scene, const SeenIntruder& seen) {
  const LensParameters& lens = scene.camera.lens.parameters();
  const Camera pinhole{*Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}),
                       scene.footage.size_px};
  return bent(seen.views, pinhole, cv::Rect({0, 0}, scene.footage.size_px));
}

// The key's own edge, bent and blurred as the picture is: how much of each changed pixel is the intruder's.
cv::Mat classic_opacity(const ClassicStages& stages, const DistortMaps& maps, double sigma_px, bool bends) {
  cv::Mat key;
  cv::inRange(stages.input2, cv::Scalar(kKeyGreen), cv::Scalar(kKeyGreen), key);
  key = ~key;
  cv::Mat opacity;
  (bends ? softened(distorted(key, maps, cv::Scalar::all(0)), sigma_px) : key).convertTo(opacity, CV_32F, 1.0 / 255.0);
  // A pixel that F counts as changed is touched, however little of the key is left in it after rounding.
  cv::max(opacity, 1.0 / 512.0, opacity);
  return opacity;
}

ClassicStages lay_classic(ComposedFrame& composed, const Scene& scene, const SeenIntruder& seen, Bench& bench) {
  const bool bends = scene.compositing.method == MethodChoice::classic;
  const cv::Mat input1 = bgr_of(composed.picture);
  const cv::Mat input2 = on_green_screen(pinhole_layer(scene, seen), scene.footage.size_px);
  const DistortMaps maps = bends ? bench.maps_of(scene.camera) : DistortMaps{};
  ClassicStages stages =
      bends ? classic_stages(input1, input2, scene.camera, maps, seen.sigma_px) : plain_stages(input1, input2);
  const cv::Mat weight = weight_of(stages.changed, scene.own_body);
  replace_pixels(composed.picture, stages.output, weight);
  const cv::Mat opacity = classic_opacity(stages, maps, seen.sigma_px, bends).mul(weight);
  add_to_mask(composed.mask, scene.footage.size_px, {{0, 0}, scene.footage.size_px}, opacity);
  return stages;
}

void keep_classic_stages(std::vector<Stage>& kept, const ClassicStages& stages, const Scene& scene,
                         const SeenIntruder& seen) {
  const std::pair<const char*, const cv::Mat*> all[] = {
      {"input1", &stages.input1}, {"input2", &stages.input2}, {"a", &stages.a}, {"b", &stages.b},
      {"c", &stages.c},           {"d", &stages.d},           {"f", &stages.f}, {"keyed", &stages.output}};
  for (const auto& [name, picture] : all)
    if (!picture->empty()) kept.push_back({stage_name(name, seen, scene), *picture});
}

}  // namespace

ComposedFrame laid_on(const Frame& background, const Scene& scene, const std::vector<SeenIntruder>& far_to_near,
                      Bench& bench, Stages stages) {
  ComposedFrame composed{.picture = cloned(background)};
  const bool keep = stages == Stages::keep;
  const bool direct = scene.compositing.method == MethodChoice::direct;
  if (keep && direct) composed.stages.push_back({"input1", bgr_of(background)});
  for (const SeenIntruder& seen : far_to_near) {
    if (seen.views.empty()) continue;
    if (direct) {
      if (!seen.soft.empty()) lay_direct(composed, scene, seen);
      if (keep) keep_direct_stages(composed.stages, scene, seen);
    } else {
      const ClassicStages classic = lay_classic(composed, scene, seen, bench);
      if (keep) keep_classic_stages(composed.stages, classic, scene, seen);
    }
  }
  if (keep) {
    if (!composed.mask.empty()) composed.stages.push_back({"mask", composed.mask});
    composed.stages.push_back({"output", bgr_of(composed.picture)});
  }
  return composed;
}

}  // namespace sigs
