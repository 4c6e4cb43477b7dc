// SPDX-License-Identifier: MIT
#include "frame/cloud_cover.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace sigs {

namespace {

constexpr double kThinnest = 1e-6;  // opacity below which there is no cloud
constexpr double kDensest = 0.01;   // what an opaque cloud lets through at least, so that its depth counts

// The layer behind clouds. op is its opacity, T its light, S the clear sky's and B the footage's, which is the sky
// through the clouds. A target behind clouds of transmission t is seen as B + op t (T' - B): with B - S, the clouds'
// own light over a clear sky, T' = T + (1 - t) / t (1 - a) / a (B - S), which for all of the clouds is T + (B - S).
Layer behind_clouds(const Layer& layer, const CloudPart& clouds, double depth, bool has_veil) {
  Layer out{layer.rect, layer.color.clone(), layer.coverage.clone()};
  for (int y = 0; y < out.rect.height; ++y)
    for (int x = 0; x < out.rect.width; ++x) {
      const double opacity = std::clamp<double>(clouds.opacity(y, x), 0, 1);
      if (opacity < kThinnest) continue;
      const double left = cloud_transmission(opacity, depth);
      cv::Vec4f& color = out.color.at<cv::Vec4f>(y, x);
      if (has_veil && left > 0) {
        const double veil = (1 - left) / left * (1 - opacity) / opacity * color[3];
        for (int c = 0; c < 3; ++c)
          color[c] = std::max(color[c] + static_cast<float>(veil) * clouds.brightness(y, x)[c], 0.0F);
      }
      color *= static_cast<float>(left);
      out.coverage.at<float>(y, x) *= static_cast<float>(left);
    }
  return out;
}

// Of the layer's coverage, the share that was taken away.
double share_hidden(const Layer& before, const Layer& after) {
  const double whole = before.empty() ? 0 : cv::sum(before.coverage)[0];
  return whole > 0 ? std::clamp(1 - cv::sum(after.coverage)[0] / whole, 0.0, 1.0) : 0;
}

bool is_seen(const IntruderLayers& layers) {
  return !layers.occluded.empty() || !layers.contrail.empty() || !layers.lamps.empty();
}

}  // namespace

double cloud_transmission(double opacity, double depth) {
  return depth >= 1 ? 1 - opacity : std::pow(std::max(1 - opacity, kDensest), depth);
}

std::optional<CloudMap> clouds_of(const Scene& scene, const Frame& background, const std::vector<IntruderLayers>& all,
                                  Stages stages) {
  if (!scene.clouds || scene.compositing.method != MethodChoice::direct) return std::nullopt;
  const auto is_beyond = [&](const IntruderLayers& layers) {
    return is_seen(layers) && scene.clouds->depth_before(layers.placed.distance_m()) > 0;
  };
  if (stages == Stages::leave_out && std::ranges::none_of(all, is_beyond)) return std::nullopt;
  cv::Mat own_body;
  if (!scene.own_body.empty()) scene.own_body.convertTo(own_body, CV_8U, 255);
  return CloudMap(background, own_body);
}

void hide_behind_clouds(const Scene& scene, const CloudMap* map, std::vector<IntruderLayers>& all) {
  if (!scene.clouds || scene.compositing.method != MethodChoice::direct) return;
  for (IntruderLayers& layers : all) {
    layers.clouds = CloudTruth{.hidden = 0, .assumed_distance_m = scene.clouds->distance_m};
    const double depth = scene.clouds->depth_before(layers.placed.distance_m());
    if (map == nullptr || depth <= 0) continue;
    const auto hide = [&](Layer& layer) {
      if (!layer.empty()) layer = behind_clouds(layer, map->part(layer.rect), depth, !scene.is_thermal);
    };
    const Layer whole = layers.occluded;
    hide(layers.occluded);
    layers.clouds->hidden = share_hidden(whole, layers.occluded);
    hide(layers.contrail);
    // Of 360 degrees a part of the image need not have all lamps that are named.
    const bool are_named = layers.lamp_truths.size() == layers.lamps.size();
    for (std::size_t i = 0; i < layers.lamps.size(); ++i) {
      hide(layers.lamps[i].layer);
      layers.lamps[i] = with_layer(std::move(layers.lamps[i].layer));
      if (are_named) layers.lamp_truths[i].brightest = layers.lamps[i].brightest;
    }
    std::erase_if(layers.lamps, [](const LampLayer& lamp) { return lamp.layer.empty(); });
    std::erase_if(layers.lamp_truths, [](const LampTruth& lamp) { return lamp.brightest == 0; });
  }
}

}  // namespace sigs
