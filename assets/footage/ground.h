// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "clouds.h"
#include "ground_map.h"

namespace sigs::footage {

// The ground below a flight of any length along world X. Trees are painted as they are seen from one place, so a long
// flight has a map for each stretch; over its last metres a stretch fades into the next.
class Ground {
 public:
  // country_m: where in the landscape the flight begins. clouds must outlive this.
  Ground(const Clouds& clouds, const glm::dvec2& country_m, double flight_m);

  // Paints the ground visible from x_m and discards that behind it. To be called before mean() for each x_m.
  void prepare(double x_m);

  // As GroundMap::mean, for an eye above x_m.
  [[nodiscard]] glm::vec3 mean(double x_m, const glm::dvec2& p_m, const glm::dvec2& step_right_m,
                               const glm::dvec2& step_down_m) const;

 private:
  [[nodiscard]] std::size_t stretch_at(double x_m) const;
  [[nodiscard]] float share_of_next(double x_m) const;
  [[nodiscard]] std::unique_ptr<GroundMap> painted(std::size_t stretch) const;

  const Clouds& clouds_;
  glm::dvec2 country_m_;
  double stretch_m_;
  std::vector<std::unique_ptr<GroundMap>> maps_;  // each from where its stretch begins; none: not near
};

}  // namespace sigs::footage
