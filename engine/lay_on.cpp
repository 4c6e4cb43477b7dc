// SPDX-License-Identifier: MIT
#include "lay_on.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/image.h"
#include "base/pose.h"
#include "compositor/blend.h"
#include "compositor/classic.h"
#include "compositor/footage_light.h"
#include "compositor/hide.h"
#include "compositor/replace.h"

namespace sigs {

namespace {

// Adds opacity, the last channel of a picture of floats over rect, to the mask as one sheet over another. What is
// touched at all gets at least 1.
void add_to_mask(cv::Mat& mask, cv::Size picture_size_px, const cv::Rect& rect, const cv::Mat& opacity) {
  if (mask.empty()) mask = cv::Mat::zeros(picture_size_px, CV_8UC1);
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

// A layer as it looks before black, over the whole picture, in code values of the footage.
cv::Mat shown(const Layer& layer, const ColorInfo& footage, cv::Size picture_size_px) {
  cv::Mat picture = cv::Mat::zeros(picture_size_px, CV_8UC3);
  const cv::Mat colors = in_footage_primaries(layer.color, footage);
  const TransferTable& curve = transfer_table_of(footage);
  const cv::Rect inside = layer.rect & cv::Rect({0, 0}, picture_size_px);
  for (int y = inside.y; y < inside.y + inside.height; ++y)
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      const cv::Vec4f& color = colors.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x);
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(y, x)[2 - c] = cv::saturate_cast<uchar>(255.0F * curve.exact_display(color[c]));
    }
  return picture;
}

// "1_bent" for the intruder with id 1; plain "bent" where there is only one.
std::string stage_name(const std::string& name, const SeenIntruder& seen, const Scene& scene) {
  return scene.intruders.size() == 1 ? name : std::to_string(seen.placed.id) + "_" + name;
}

void lay_direct(ComposedFrame& composed, const Scene& scene, const SeenIntruder& seen) {
  const BlendSpace space = scene.compositing.blend == BlendChoice::linear ? BlendSpace::linear : BlendSpace::display;
  composed.work.pixels_blended += blend_over(composed.picture, seen.soft, space);
  add_to_mask(composed.mask, scene.footage.size_px, seen.soft.rect, seen.soft.color);
}

void keep_direct_stages(std::vector<Stage>& stages, const Scene& scene, const SeenIntruder& seen,
                        const ColorInfo& footage) {
  const cv::Size size = scene.footage.size_px;
  for (const auto& [view, layer] : seen.views)
    stages.push_back({stage_name("layer", seen, scene), shown(layer, footage, view.size_px)});
  stages.push_back({stage_name("bent", seen, scene), shown(seen.sharp, footage, size)});
  stages.push_back({stage_name("blurred", seen, scene), shown(seen.blurred, footage, size)});
  stages.push_back({stage_name("hidden", seen, scene), shown(seen.soft, footage, size)});
}

// What the own body leaves of the pixels of part that the classic methods changed: CV_32FC1, 0 where nothing is to
// change.
cv::Mat weight_of(const cv::Mat& changed, const cv::Mat& own_body, const cv::Rect& part) {
  cv::Mat weight;
  changed(part).convertTo(weight, CV_32F, 1.0 / 255.0);
  return own_body.empty() ? weight : cv::Mat(weight.mul(1.0 - own_body(part)));
}

// The part of a pinhole's picture in which the views can show anything: all of it where one reaches beyond 90 degrees.
cv::Rect reach_of(std::span<const DrawnView> views, const Camera& pinhole) {
  constexpr int kMargin_px = 3;  // views are read by area
  const cv::Rect whole({0, 0}, pinhole.size_px);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const auto& [view, layer] : views)
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
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

// The intruder in the undistorted picture's plane, where the classic methods key it.
Layer pinhole_layer(const Scene& scene, const SeenIntruder& seen) {
  const cv::Rect whole({0, 0}, scene.footage.size_px);
  if (scene.compositing.method == MethodChoice::plain) return clipped(seen.sharp, whole);
  const LensParameters& lens = scene.camera.lens.parameters();
  const Camera pinhole{*Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}),
                       scene.footage.size_px};
  const cv::Rect reach = reach_of(seen.views, pinhole);
  return reach.empty() ? Layer{} : bent(seen.views, pinhole, reach);
}

// The key's own edge, bent and blurred as the picture is: how much of each changed pixel of part is the intruder's.
cv::Mat classic_opacity(const ClassicStages& stages, const DistortMaps& maps, double sigma_px, const cv::Rect& part) {
  const cv::Rect from = softened_from(part, sigma_px, stages.key.size());
  const cv::Mat edge = softened(distorted(stages.key, maps, cv::Scalar::all(0), from), sigma_px);
  cv::Mat opacity;
  edge(part - from.tl()).convertTo(opacity, CV_32F, 1.0 / 255.0);
  // A pixel that F counts as changed is touched, however little of the key is left in it after rounding.
  cv::max(opacity, 1.0 / 512.0, opacity);
  return opacity;
}

// Beside the conversion: the intruder once more, without the lens, and whole pictures D and F.
void count_classic(Work& work, const Layer& pinhole, const ClassicStages& stages, double sigma_px) {
  work.pixels_bent += pinhole.rect.area();
  if (sigma_px > 0) work.pixels_blurred += 2 * static_cast<std::int64_t>(stages.d.total());
}

ClassicStages lay_classic(ComposedFrame& composed, const Scene& scene, const SeenIntruder& seen, Bench& bench) {
  ClassicStages buffers = std::exchange(bench.classic_buffers(), {});
  const cv::Mat input1 = bgr_of(composed.picture);
  composed.work.pixels_converted += static_cast<std::int64_t>(input1.total());
  const Layer pinhole = pinhole_layer(scene, seen);
  const cv::Mat input2 = on_green_screen(pinhole, composed.picture.color, scene.footage.size_px, buffers.input2);
  const DistortMaps* maps = scene.compositing.method == MethodChoice::classic ? &bench.maps_of(scene.camera) : nullptr;
  ClassicStages stages = maps ? classic_stages(input1, input2, *maps, seen.sigma_px, std::move(buffers))
                              : plain_stages(input1, input2, std::move(buffers));
  if (maps) count_classic(composed.work, pinhole, stages, seen.sigma_px);
  const cv::Rect part = cv::boundingRect(stages.changed);
  if (part.empty()) return stages;
  const cv::Mat weight = weight_of(stages.changed, scene.own_body, part);
  composed.work.pixels_blended += replace_pixels(composed.picture, part, stages.output(part), weight);
  const cv::Mat opacity = maps ? cv::Mat(classic_opacity(stages, *maps, seen.sigma_px, part).mul(weight)) : weight;
  add_to_mask(composed.mask, scene.footage.size_px, part, opacity);
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

ComposedFrame laid_on(Frame background, const Scene& scene, const std::vector<SeenIntruder>& far_to_near, Bench& bench,
                      Stages stages) {
  ComposedFrame composed{.picture = std::move(background)};
  const bool keep = stages == Stages::keep;
  const bool direct = scene.compositing.method == MethodChoice::direct;
  if (keep && direct) composed.stages.push_back({"input1", bgr_of(composed.picture)});
  for (const SeenIntruder& seen : far_to_near) {
    if (seen.views.empty()) continue;
    if (direct) {
      if (!seen.soft.empty()) lay_direct(composed, scene, seen);
      if (keep) keep_direct_stages(composed.stages, scene, seen, composed.picture.color);
    } else {
      ClassicStages classic = lay_classic(composed, scene, seen, bench);
      if (keep)
        keep_classic_stages(composed.stages, classic, scene, seen);
      else
        bench.classic_buffers() = std::move(classic);
    }
  }
  if (keep) {
    if (!composed.mask.empty()) composed.stages.push_back({"mask", composed.mask});
    composed.stages.push_back({"output", bgr_of(composed.picture)});
  }
  return composed;
}

}  // namespace sigs
