// SPDX-License-Identifier: MIT
#include <cmath>

#include "land.h"
#include "light.h"
#include "noise.h"

namespace sigs::footage {

namespace {

// How one object changes the cells around it: share() of the cell at the offset from its middle, and its effect there.
class Brush {
 public:
  Brush(const GroundMap::Layer& layer, cv::Mat& color) : layer_(layer), color_(color) {}

  // Cells within radius_m of middle_m: blend(offset_m, colour) returns the changed colour.
  template <class Blend>
  void touch(const glm::dvec2& middle_m, double radius_m, const Blend& blend) {
    const glm::dvec2 low = (middle_m - radius_m - layer_.origin_m) / layer_.cell_m;
    const glm::dvec2 high = (middle_m + radius_m - layer_.origin_m) / layer_.cell_m;
    for (int r = std::max(0, int(std::ceil(low.x))); r <= std::min(color_.rows - 1, int(std::floor(high.x))); ++r)
      for (int c = std::max(0, int(std::ceil(low.y))); c <= std::min(color_.cols - 1, int(std::floor(high.y))); ++c) {
        cv::Vec3f& cell = color_.at<cv::Vec3f>(r, c);
        const glm::dvec2 here = layer_.origin_m + layer_.cell_m * glm::dvec2(r, c);
        const glm::vec3 changed = blend(glm::vec2(here - middle_m), glm::vec3(cell[0], cell[1], cell[2]));
        cell = {changed.r, changed.g, changed.b};
      }
  }
  [[nodiscard]] float soft_m() const { return static_cast<float>(layer_.cell_m); }
  [[nodiscard]] const GroundMap::Layer& layer() const { return layer_; }

 private:
  const GroundMap::Layer& layer_;
  cv::Mat& color_;
};

const glm::vec2 kAwayFromSun = -glm::vec2(kToSun) / static_cast<float>(-kToSun.z);  // shadow's length for 1 m of height

void draw_shadow(Brush& brush, const glm::dvec2& middle_m, float radius_m, float height_m) {
  const glm::vec2 throw_m = kAwayFromSun * height_m;
  const float length = glm::length(throw_m);
  brush.touch(
      middle_m + 0.5 * glm::dvec2(throw_m), radius_m + 0.5 * length, [&](const glm::vec2& at, const glm::vec3& old) {
        const glm::vec2 along = throw_m / length;
        const float u = glm::max(std::abs(glm::dot(at, along)) - 0.5F * length, 0.0F),
                    v = at.x * along.y - at.y * along.x;
        const float inside = 1 - smooth(radius_m - brush.soft_m(), radius_m + 0.5F * brush.soft_m(), std::hypot(u, v));
        return old * (1 - 0.52F * inside);
      });
}

// The map is flat, but a tree is seen from the side: its top hides the ground behind it.
glm::vec2 hidden_for_each_metre(const glm::dvec2& p_m, const glm::dvec2& eye_m) {
  constexpr double kEyeHeight_m = 150, kMost = 7;
  const glm::dvec2 lean = (p_m - eye_m) / kEyeHeight_m;
  return glm::vec2(lean * std::min(1.0, kMost / std::max(glm::length(lean), 1e-9)));
}

void draw_tree(Brush& brush, const glm::dvec2& foot_m, const glm::dvec2& eye_m, std::uint32_t id) {
  const float radius_m = 2.2F + 3.0F * chance(hash(id)), height_m = radius_m * (1.7F + 0.7F * chance(hash(id, 6, 1)));
  draw_shadow(brush, foot_m, 0.9F * radius_m, height_m);
  const glm::vec3 leaf =
      glm::mix(glm::vec3(0.040F, 0.070F, 0.020F), glm::vec3(0.085F, 0.112F, 0.034F), chance(hash(id, 1, 1)));
  const glm::vec2 lean = hidden_for_each_metre(foot_m, eye_m), crown = lean * std::max(height_m - radius_m, 0.1F);
  const glm::vec2 to_sun = glm::normalize(glm::vec2(kToSun));
  brush.touch(
      foot_m + 0.5 * glm::dvec2(crown), 0.5F * glm::length(crown) + 1.4F * radius_m,
      [&](const glm::vec2& at, const glm::vec3& old) {
        const glm::vec2 from_foot = at + 0.5F * crown;
        const float up = glm::clamp(glm::dot(from_foot, crown) / std::max(glm::dot(crown, crown), 1e-4F), 0.0F, 1.0F);
        const glm::vec2 aside = from_foot - up * crown;
        // Along the line of sight everything is stretched by the oblique view, the leaves' pattern too.
        const glm::dvec2 pattern = glm::dvec2(aside) + glm::dvec2(foot_m) + glm::dvec2(2.5 * up, 3.5 * up);
        const float ragged = radius_m * (1 + 0.5F * gradient_noise(pattern / 2.1, 91));
        const float inside = 1 - smooth(ragged - brush.soft_m(), ragged + 0.3F * brush.soft_m(), glm::length(aside));
        const float bumps = 1 + 0.6F * gradient_noise(pattern / 1.3, 92);
        const float lit =
            glm::clamp(0.38F + 0.50F * up + 0.40F * glm::dot(aside, to_sun) / radius_m, 0.15F, 1.4F) * bumps;
        return glm::mix(old, leaf * lit * (kSunlight + kSkylight), inside);
      });
}

void draw_house(Brush& brush, const glm::dvec2& middle_m, std::uint32_t id) {
  const double turn = 6.2832 * chance(hash(id, 1, 5));
  const glm::vec2 ridge{static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn))},
      side{-ridge.y, ridge.x};
  const glm::vec2 half{5.0F + 4.5F * chance(hash(id, 2, 5)), 3.8F + 1.8F * chance(hash(id, 3, 5))};
  static const glm::vec3 kRoofs[] = {{0.36F, 0.155F, 0.095F},
                                     {0.30F, 0.13F, 0.085F},
                                     {0.20F, 0.115F, 0.09F},
                                     {0.15F, 0.15F, 0.16F},
                                     {0.42F, 0.24F, 0.16F}};
  const glm::vec3 roof = kRoofs[hash(id, 4, 5) % 5] * (0.85F + 0.3F * chance(hash(id, 5, 5)));
  draw_shadow(brush, middle_m, half.y * 1.05F, 6.5F);
  brush.touch(middle_m, half.x + half.y, [&](const glm::vec2& at, const glm::vec3& old) {
    const float u = std::abs(glm::dot(at, ridge)) - half.x, v = glm::dot(at, side);
    const float outside = glm::max(u, std::abs(v) - half.y);
    const float inside = 1 - smooth(-0.5F * brush.soft_m(), 0.5F * brush.soft_m(), outside);
    const glm::vec3 up = glm::normalize(glm::vec3(side * (v > 0 ? 0.65F : -0.65F), -1.0F));
    const float lit = glm::max(glm::dot(up, glm::vec3(kToSun)), 0.0F);
    return glm::mix(old, roof * (kSunlight * lit * 1.25F + kSkylight), inside);
  });
}

bool has_tree(const glm::dvec2& p_m, float draw) {
  if (distance_to_road_m(p_m) < 6 || distance_to_river_m(p_m) < river_half_width_m(p_m) + 2) return false;
  if (village_at(p_m) > 0.1F) return draw < 0.30F;
  if (distance_to_river_m(p_m) < river_half_width_m(p_m) + 22) return draw < 0.5F;
  const Field field = field_at(p_m);
  if (field.to_lane_m < 10) return field.to_lane_m > 4 && draw < 0.42F;
  if (field.hedged && field.to_edge_m < 6) return draw < 0.8F;
  if (wood_at(p_m) > -0.03F && wood_at(p_m) < 0.01F) return draw < 0.8F;
  return draw < 0.0015F;
}

bool has_house(const glm::dvec2& p_m, float draw) {
  if (distance_to_road_m(p_m) < 14 || wood_at(p_m) > -0.05F) return false;
  if (distance_to_river_m(p_m) < river_half_width_m(p_m) + 20 || field_at(p_m).to_lane_m < 12) return false;
  return draw < 0.75F * village_at(p_m) || draw > 0.9994F;
}

// Calls visit(place, id) for one jittered place in each square of spacing_m that the layer holds, the farthest first.
template <class Visit>
void for_each_place(const GroundMap::Layer& layer, double spacing_m, std::uint32_t seed, const Visit& visit) {
  const glm::dvec2 far = layer.origin_m + layer.cell_m * glm::dvec2(layer.color.rows, layer.color.cols);
  const int first = static_cast<int>(std::floor(layer.origin_m.x / spacing_m)) - 1;
  for (int i = static_cast<int>(std::ceil(far.x / spacing_m)); i >= first; --i)
    for (int j = int(std::floor(layer.origin_m.y / spacing_m)) - 1; j * spacing_m < far.y; ++j) {
      const std::uint32_t id = hash(i, j, seed);
      visit(spacing_m * (glm::dvec2(i, j) + glm::dvec2(chance(hash(id, 1, 1)), chance(hash(id, 2, 1)))), id);
    }
}

}  // namespace

void draw_objects(const GroundMap::Layer& layer, const glm::dvec2& eye_m, cv::Mat& color) {
  if (layer.cell_m > 6) return;
  Brush brush(layer, color);
  for_each_place(layer, 7.5, 95, [&](const glm::dvec2& p_m, std::uint32_t id) {
    if (const float draw = chance(hash(id, 3, 1)); draw < 0.8F && has_tree(p_m, draw)) draw_tree(brush, p_m, eye_m, id);
  });
  for_each_place(layer, 23, 96, [&](const glm::dvec2& p_m, std::uint32_t id) {
    if (has_house(p_m, chance(hash(id, 3, 1)))) draw_house(brush, p_m, id);
  });
}

}  // namespace sigs::footage
