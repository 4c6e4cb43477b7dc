// SPDX-License-Identifier: MIT
#include "editor/views/timeline/deviation_band.h"

#include <algorithm>
#include <cmath>

namespace sigs::editor {

void draw_deviation_band(ImDrawList& list, const TimelineStrip& strip, const LaneValues& lane, int first_frame,
                         const LaneBox& box, ImU32 shade) {
  if (lane.deviations.empty()) return;
  const auto y_of = [&](double value) {
    return static_cast<float>(box.top_y + (1 - lane.scale.share_of(value)) * box.height);
  };
  const double stride = std::max(1.0, std::ceil(strip.ruler.count / std::max(1.0, strip.ruler.width)));
  const double first = first_frame;
  const auto count = static_cast<double>(lane.deviations.size());
  const double from = std::clamp(std::floor((strip.ruler.first - first) / stride) * stride, 0.0, count);
  const double to = std::clamp(strip.ruler.first + strip.ruler.count + stride - first, 0.0, count);
  for (double i = from; i < to; i += stride) {
    const auto index = static_cast<std::size_t>(i);
    const double sd = lane.deviations[index];
    if (!std::isfinite(sd)) continue;
    const double value = lane.values[index];
    list.AddRectFilled({strip.edge_x(first + i), y_of(value + sd)},
                       {strip.edge_x(first + i + stride), y_of(value - sd)}, shade);
  }
}

}  // namespace sigs::editor
