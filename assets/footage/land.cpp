// SPDX-License-Identifier: MIT
#include "land.h"

#include <cmath>

#include "light.h"
#include "noise.h"

namespace sigs::footage {

namespace {

constexpr double kBlock_m = 1150;

struct Strip {
  int number = 0;
  double to_edge_m = 0;
  int edge = 0;  // number of the nearer edge
};

// Uneven cuts along a line: which piece x lies in, and how far its nearer end is.
Strip strip_at(double x, double mean_m, std::uint32_t seed) {
  const auto cut = [&](int i) { return (i + 0.75 * (chance(i, 7, seed) - 0.5)) * mean_m; };
  int i = static_cast<int>(std::floor(x / mean_m));
  while (cut(i) > x) --i;
  while (cut(i + 1) <= x) ++i;
  const double left = x - cut(i), right = cut(i + 1) - x;
  return {i, std::min(left, right), left < right ? i : i + 1};
}

struct Crop {
  glm::vec3 color;
  float rows;     // strength of the tracks that machines leave
  float mottled;  // strength of the uneven growth
};

Crop crop_of(std::uint32_t id) {
  static const Crop kCrops[] = {{{0.095F, 0.150F, 0.040F}, 0.05F, 0.45F}, {{0.120F, 0.175F, 0.052F}, 0.05F, 0.40F},
                                {{0.070F, 0.135F, 0.030F}, 0.25F, 0.25F}, {{0.375F, 0.300F, 0.140F}, 0.30F, 0.20F},
                                {{0.300F, 0.245F, 0.120F}, 0.35F, 0.25F}, {{0.170F, 0.118F, 0.072F}, 0.20F, 0.35F},
                                {{0.215F, 0.160F, 0.098F}, 0.20F, 0.35F}, {{0.150F, 0.205F, 0.075F}, 0.30F, 0.30F},
                                {{0.060F, 0.105F, 0.030F}, 0.30F, 0.20F}, {{0.105F, 0.165F, 0.045F}, 0.10F, 0.45F},
                                {{0.240F, 0.235F, 0.100F}, 0.25F, 0.30F}, {{0.400F, 0.345F, 0.075F}, 0.15F, 0.15F}};
  const float pick = chance(hash(id, 3, 11));
  const int kind = pick > 0.996F ? 11 : static_cast<int>(pick * 11.0F / 0.996F);
  Crop crop = kCrops[kind];
  crop.color *= 0.85F + 0.3F * chance(hash(id, 5, 12));
  return crop;
}

// Only noise that the cells can hold; finer octaves would be aliased.
float texture(const glm::dvec2& p_m, double size_m, int octaves, double cell_m, std::uint32_t seed) {
  const int affordable = static_cast<int>(std::floor(std::log2(std::max(size_m / (1.5 * cell_m), 0.5)))) + 1;
  return affordable <= 0 ? 0.0F : fractal_noise(p_m / size_m, std::min(octaves, affordable), seed);
}

float fading(double size_m, double cell_m) {
  return smooth(1.0F, 3.0F, static_cast<float>(size_m / cell_m));
}

glm::vec3 field_albedo(const glm::dvec2& p_m, const Field& field, double cell_m) {
  const Crop crop = crop_of(field.id);
  const float growth = texture(p_m, 140, 3, cell_m, 21) + 0.6F * texture(p_m, 18, 5, cell_m, 22);
  const float tram = std::cos(field.across_m * (6.2832F / 21.0F));
  const float fine = std::cos(field.across_m * (6.2832F / 2.9F) + 2 * texture(p_m, 30, 1, cell_m, 23));
  float shade = 1 + crop.mottled * growth - crop.rows * smooth(0.93F, 1.0F, tram) * 0.8F * fading(3.0, cell_m) +
                0.28F * crop.rows * fine * fading(1.4, cell_m);
  shade *=
      1 - 0.25F * crop.rows * smooth(0.0F, 1.0F, std::cos(field.across_m * (6.2832F / 63.0F))) * fading(20, cell_m);
  const glm::vec3 tint{1 + 0.12F * growth, 1.0F, 1 + 0.05F * growth};
  return crop.color * tint * glm::max(shade, 0.3F);
}

glm::vec3 wood_albedo(const glm::dvec2& p_m, double cell_m) {
  const float stand = texture(p_m, 160, 3, cell_m, 31);
  glm::vec3 color = glm::mix(glm::vec3(0.034F, 0.062F, 0.020F), glm::vec3(0.058F, 0.088F, 0.026F), 0.5F + 0.8F * stand);
  if (cell_m > 6) return color * 0.85F;
  const CellHit crown = cell_at(p_m / 8.5, 32);
  const glm::vec2 to_sun{static_cast<float>(kToSun.x), static_cast<float>(kToSun.y)};
  const float lit = 0.78F + 1.05F * glm::dot(crown.offset, to_sun) - 0.9F * crown.to_centre * crown.to_centre;
  const float own = 0.75F + 0.5F * chance(crown.id);
  const float leaves = 1 + 0.45F * texture(p_m, 2.4, 2, cell_m, 33);
  return glm::mix(color * 0.85F, color * (own * glm::max(lit, 0.12F) * leaves * 1.25F), fading(8.5, cell_m));
}

glm::vec3 lane_albedo(float to_lane_m, const glm::dvec2& p_m, double cell_m) {
  const glm::vec3 gravel = glm::vec3(0.34F, 0.30F, 0.24F) * (1 + 0.3F * texture(p_m, 6, 3, cell_m, 41));
  const glm::vec3 verge = glm::vec3(0.13F, 0.17F, 0.06F) * (1 + 0.4F * texture(p_m, 5, 3, cell_m, 42));
  return glm::mix(gravel, verge, smooth(1.9F, 2.9F, to_lane_m));
}

glm::vec3 road_albedo(float to_middle_m, const glm::dvec2& p_m, double cell_m) {
  const glm::vec3 verge = glm::vec3(0.14F, 0.17F, 0.07F) * (1 + 0.4F * texture(p_m, 4, 3, cell_m, 43));
  glm::vec3 asphalt = glm::vec3(0.165F, 0.165F, 0.17F) * (1 + 0.15F * texture(p_m, 9, 4, cell_m, 44));
  if (to_middle_m < 0.13F || (to_middle_m > 3.05F && to_middle_m < 3.25F)) asphalt = glm::vec3(0.6F);
  return to_middle_m < 3.6F ? asphalt : verge;
}

glm::vec3 water_albedo(const glm::dvec2& p_m, double cell_m) {
  const float ripple = texture(p_m, 25, 4, cell_m, 51);
  return glm::vec3(0.085F, 0.125F, 0.135F) * (1 + 0.22F * ripple);
}

}  // namespace

Field field_at(const glm::dvec2& p_m) {
  const glm::dvec2 bent = p_m + 22.0 * glm::dvec2(gradient_noise(p_m / 420.0, 61), gradient_noise(p_m / 420.0, 62));
  const CellHit block = cell_at(bent / kBlock_m, 63);
  const double turn = 6.2832 * chance(hash(block.id));
  const double u = std::cos(turn) * bent.x + std::sin(turn) * bent.y,
               v = std::cos(turn) * bent.y - std::sin(turn) * bent.x;
  const Strip strip = strip_at(u, 130, block.id);
  const std::uint32_t along = hash(strip.number, 1, block.id);
  const Strip piece = strip_at(v, 270, along);
  Field field;
  field.id = hash(piece.number, 2, along);
  const bool side = strip.to_edge_m < piece.to_edge_m;
  field.to_edge_m = static_cast<float>(std::min(strip.to_edge_m, piece.to_edge_m));
  const std::uint32_t edge = side ? hash(strip.edge, 4, block.id) : hash(piece.edge, 5, along);
  field.hedged = chance(edge) < 0.42F;
  field.across_m = static_cast<float>(u);
  field.to_lane_m = static_cast<float>(block.to_border * kBlock_m);
  return field;
}

float wood_at(const glm::dvec2& p_m) {
  return fractal_noise(p_m / 900.0, 4, 71) + 0.12F * gradient_noise(p_m / 60.0, 75) - 0.33F;
}

float distance_to_river_m(const glm::dvec2& p_m) {
  const double y = p_m.y;
  const double middle = 760 + 0.62 * y + 190 * std::sin(y / 610 + 0.4) + 70 * std::sin(y / 233 + 1.3);
  const double slope = 0.62 + 190.0 / 610 * std::cos(y / 610 + 0.4) + 70.0 / 233 * std::cos(y / 233 + 1.3);
  return static_cast<float>(std::abs(p_m.x - middle) / std::sqrt(1 + slope * slope));
}

float river_half_width_m(const glm::dvec2& p_m) {
  return 15 + 6 * gradient_noise(p_m / 130.0, 52);
}

float distance_to_road_m(const glm::dvec2& p_m) {
  const double x = p_m.x;
  const double middle = 95 + 0.10 * x + 60 * std::sin(x / 420 + 2.2) + 170 * std::sin(x / 1900);
  const double slope = 0.10 + 60.0 / 420 * std::cos(x / 420 + 2.2) + 170.0 / 1900 * std::cos(x / 1900);
  return static_cast<float>(std::abs(p_m.y - middle) / std::sqrt(1 + slope * slope));
}

float village_at(const glm::dvec2& p_m) {
  const CellHit site = cell_at(p_m / 2400.0, 81);
  if (chance(hash(site.id)) > 0.75F) return 0;
  const float radius_m = 150 + 260 * chance(hash(site.id, 1, 2));
  const float ragged = 1 + 0.5F * gradient_noise(p_m / 170.0, 82);
  return 1 - smooth(0.75F, 1.0F, site.to_centre * 2400 / (radius_m * ragged));
}

glm::vec3 ground_albedo(const glm::dvec2& p_m, double cell_m) {
  if (const float road = distance_to_road_m(p_m); road < 5.2F) return road_albedo(road, p_m, cell_m);
  const float bank = distance_to_river_m(p_m) - river_half_width_m(p_m);
  if (bank < 0) return water_albedo(p_m, cell_m);
  if (bank < 3) return glm::vec3(0.22F, 0.20F, 0.13F);
  if (wood_at(p_m) > 0) return wood_albedo(p_m, cell_m);
  const Field field = field_at(p_m);
  if (field.to_lane_m < 4) return lane_albedo(field.to_lane_m, p_m, cell_m);
  const float village = village_at(p_m);
  if (village > 0.02F) {
    const glm::vec3 gardens = glm::vec3(0.13F, 0.155F, 0.07F) * (1 + 0.6F * texture(p_m, 22, 4, cell_m, 83));
    // Far away houses are no longer drawn one by one; their roofs stay in the mean.
    const float roofs = 0.28F * village * smooth(3.0F, 12.0F, static_cast<float>(cell_m));
    return glm::mix(gardens, glm::vec3(0.40F, 0.30F, 0.25F), roofs);
  }
  const float hedge_m = 2.2F + 1.6F * texture(p_m, 9, 3, cell_m, 45);
  if (field.hedged && field.to_edge_m < hedge_m)
    return glm::vec3(0.040F, 0.068F, 0.022F) * (1 + 0.5F * texture(p_m, 4, 3, cell_m, 46));
  const glm::vec3 crop = field_albedo(p_m, field, cell_m);
  const glm::vec3 margin{0.14F, 0.17F, 0.07F};
  return glm::mix(margin, crop, smooth(0.6F, 1.8F, field.to_edge_m));
}

float wood_shadow(const glm::dvec2& p_m) {
  constexpr double kTrees_m = 15;
  if (wood_at(p_m) > 0) return 1;
  const glm::dvec2 to_sun = glm::dvec2(kToSun) / -kToSun.z;
  for (const double share : {0.35, 0.7, 1.0})
    if (wood_at(p_m + share * kTrees_m * to_sun) > 0) return 0.34F;
  return 1;
}

}  // namespace sigs::footage
