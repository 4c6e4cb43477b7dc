// SPDX-License-Identifier: MIT
#include "ground.h"

#include <algorithm>
#include <cmath>

#include "land.h"
#include "light.h"

namespace sigs::footage {

namespace {

constexpr double kMaxStep_m = 180;
constexpr double kFade_m = 20;

// The same cells, by their position in the landscape.
GroundMap::Layer in_country(GroundMap::Layer layer, const glm::dvec2& begin_m) {
  layer.origin_m += begin_m;
  return layer;
}

std::vector<glm::vec3> painted_row(const Clouds& clouds, const GroundMap::Layer& layer, int row) {
  std::vector<glm::vec3> colors(layer.color.cols);
  for (int i = 0; i < layer.color.cols; ++i) {
    const glm::dvec2 middle_m = layer.origin_m + layer.cell_m * glm::dvec2(row, i);
    glm::vec3 albedo{0};
    const int samples = layer.cell_m < 2 ? 4 : 2;
    for (int k = 0; k < samples; ++k) {
      const int corner = samples == 4 ? k : 3 * k;
      const glm::dvec2 fine{0.5 * (corner % 2) - 0.25, 0.5 * (corner / 2) - 0.25};
      albedo += ground_albedo(middle_m + layer.cell_m * fine, layer.cell_m) / static_cast<float>(samples);
    }
    const float shade = layer.cell_m < 12 ? wood_shadow(middle_m) : 1.0F;
    const glm::vec3 light = kSunlight * (shade * static_cast<float>(-kToSun.z) * 1.25F) + kSkylight;
    colors[i] = albedo * light * glm::mix(glm::vec3(0.42F, 0.46F, 0.53F), glm::vec3(1), clouds.sun_share(middle_m));
  }
  return colors;
}

}  // namespace

Ground::Ground(const Clouds& clouds, const glm::dvec2& country_m, double flight_m)
    : clouds_(clouds), country_m_(country_m) {
  const double count = std::max(1.0, std::ceil(flight_m / kMaxStep_m));
  stretch_m_ = flight_m / count;
  maps_.resize(static_cast<std::size_t>(count));
}

std::size_t Ground::stretch_at(double x_m) const {
  return std::min(static_cast<std::size_t>(std::max(x_m, 0.0) / stretch_m_), maps_.size() - 1);
}

float Ground::share_of_next(double x_m) const {
  const std::size_t stretch = stretch_at(x_m);
  if (stretch + 1 == maps_.size()) return 0;
  const double left_m = stretch_m_ * static_cast<double>(stretch + 1) - x_m;
  return static_cast<float>(std::max(0.0, 1 - left_m / kFade_m));
}

std::unique_ptr<GroundMap> Ground::painted(std::size_t stretch) const {
  const glm::dvec2 begin_m = country_m_ + glm::dvec2(stretch_m_ * static_cast<double>(stretch), 0);
  const glm::dvec2 middle_m = begin_m + glm::dvec2(0.5 * stretch_m_, 0);
  return std::make_unique<GroundMap>(
      stretch_m_,
      [&](const GroundMap::Layer& layer, int row) { return painted_row(clouds_, in_country(layer, begin_m), row); },
      [&](const GroundMap::Layer& layer, cv::Mat& color) {
        draw_objects(in_country(layer, begin_m), middle_m, color);
      });
}

void Ground::prepare(double x_m) {
  const std::size_t stretch = stretch_at(x_m);
  const bool next_is_seen = share_of_next(x_m) > 0;
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const bool is_seen = i == stretch || (next_is_seen && i == stretch + 1);
    if (!is_seen) maps_[i].reset();
    if (is_seen && !maps_[i]) maps_[i] = painted(i);
  }
}

glm::vec3 Ground::mean(double x_m, const glm::dvec2& p_m, const glm::dvec2& step_right_m,
                       const glm::dvec2& step_down_m) const {
  const std::size_t stretch = stretch_at(x_m);
  const auto seen_in = [&](std::size_t i) {
    const glm::dvec2 begin_m{stretch_m_ * static_cast<double>(i), 0};
    return maps_[i]->mean(p_m - begin_m, step_right_m, step_down_m);
  };
  const float next = share_of_next(x_m);
  if (next <= 0) return seen_in(stretch);
  return glm::mix(seen_in(stretch), seen_in(stretch + 1), next);
}

}  // namespace sigs::footage
