// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "plot/plot.h"

namespace sigs {

// The range of an axis in pixels.
struct Axis {
  PlotSpan range;
  PlotScale scale = PlotScale::linear;
  double first_px = 0;
  double last_px = 0;

  [[nodiscard]] double at(double value) const;
  [[nodiscard]] double length_px() const;
  [[nodiscard]] double per_px() const;

  // To this many units a pixel, about the middle.
  void widen(double wanted_per_px);
};

// Labelled places of an axis with this scale, at most 12, rising.
[[nodiscard]] std::vector<double> ticks_of(const PlotSpan& range, PlotScale scale);

// The same with their texts; of a linear axis at most this many.
[[nodiscard]] std::vector<PlotTick> ticks_on(const Axis& axis, double most);

}  // namespace sigs
