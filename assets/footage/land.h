// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "ground_map.h"

namespace sigs::footage {

// The landscape below: fields in blocks with lanes between them, woods, a river, a road, villages. World X, Y in
// metres.

struct Field {
  std::uint32_t id = 0;
  float to_edge_m = 0;  // of the field
  bool hedged = false;  // whether there is a hedge along that edge
  float across_m = 0;   // across the direction of ploughing
  float to_lane_m = 0;  // border between two blocks of fields
};
[[nodiscard]] Field field_at(const glm::dvec2& p_m);

[[nodiscard]] float wood_at(const glm::dvec2& p_m);              // above 0: in a wood
[[nodiscard]] float distance_to_river_m(const glm::dvec2& p_m);  // from its middle
[[nodiscard]] float river_half_width_m(const glm::dvec2& p_m);
[[nodiscard]] float distance_to_road_m(const glm::dvec2& p_m);  // from its middle line
[[nodiscard]] float village_at(const glm::dvec2& p_m);          // 0..1, how densely built

// What the bare ground reflects, 0..1 linear, without sun or shadow. Details finer than cell_m are left out.
[[nodiscard]] glm::vec3 ground_albedo(const glm::dvec2& p_m, double cell_m);

// Shadow that woods cast on the fields beside them: 1 none.
[[nodiscard]] float wood_shadow(const glm::dvec2& p_m);

// Draws single trees and houses with their shadows on top of a painted layer, as they are seen from 150 m above eye_m.
void draw_objects(const GroundMap::Layer& layer, const glm::dvec2& eye_m, cv::Mat& color);

}  // namespace sigs::footage
