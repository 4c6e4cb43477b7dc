// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace sigs::editor {

// Of marks that are drawn in order, leaves out those that nobody could tell from the last one drawn.
class Thinning {
 public:
  explicit Thinning(double min_px) : min_px_(min_px) {}

  // True: leave it out. False: it is drawn, and what follows is compared with it.
  [[nodiscard]] bool leaves_out(const glm::dvec2& at) {
    if (glm::distance(last_, at) < min_px_) return true;
    last_ = at;
    return false;
  }

 private:
  double min_px_;
  glm::dvec2 last_{std::numeric_limits<double>::infinity()};  // none yet: far from everything
};

}  // namespace sigs::editor
