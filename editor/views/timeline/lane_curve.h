// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "editor/geometry/rulers.h"

namespace sigs::editor {

// logarithmic: by log(1 + value), so that 0 has a place; negative values count as 0.
enum class Scaling { linear, logarithmic };

// Which values a lane shows from its lower to its upper edge.
struct LaneScale {
  double low = 0;
  double high = 1;
  Scaling scaling = Scaling::linear;

  // Height of a value: 0 at low, 1 at high, clamped to them; 0.5 where low and high are equal.
  [[nodiscard]] double share_of(double value) const;
};

// For all finite values: from 0 where they come near it, else a little more than they take; never less across than
// min_span.
[[nodiscard]] LaneScale scale_for(std::span<const double> values, double min_span, Scaling scaling = Scaling::linear);

// Where a lane's curve is drawn.
struct LaneBox {
  double top_y = 0;
  double height = 1;
};

// The values of successive frames as lines on the screen, no more points than it takes to be within a third of a pixel;
// where several frames share a pixel both extremes show. Values that are not finite leave gaps. Frame n lies in the
// middle of its cell.
using Polyline = std::vector<glm::vec2>;
[[nodiscard]] std::vector<Polyline> curve_of(std::span<const double> values, int first_frame, const TimeRuler& ruler,
                                             const LaneScale& scale, const LaneBox& box);

}  // namespace sigs::editor
