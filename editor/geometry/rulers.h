// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "editor/geometry/orbit_camera.h"

namespace sigs::editor {

// The smallest of 1, 2 and 5 times a power of ten that is no less than `minimum`; 1 where that is no positive number.
[[nodiscard]] double round_step(double minimum);

// The multiple of the step nearest to a value, in the digits that the step has: 0.3, not 0.30000000000000004.
[[nodiscard]] double rounded_to(double value, double step);

// Which frames a strip of the screen shows. Frame n covers [x_of(n), x_of(n + 1)).
struct TimeRuler {
  double left_x = 0;
  double width = 1;
  double first = 0;    // frame at the left edge
  double count = 250;  // frames across, > 0

  [[nodiscard]] double x_of(double frame) const;
  [[nodiscard]] double frame_at(double x) const;                             // fractional
  [[nodiscard]] int nearest_frame(double x, int lowest, int highest) const;  // the frame whose cell x lies in, clamped
};

// Zoomed about a place of the strip, between 4 frames across and four thirds of all of them; then kept over the
// footage.
[[nodiscard]] TimeRuler zoomed(const TimeRuler& ruler, double factor, double fixed_x, int frame_count);
[[nodiscard]] TimeRuler panned(const TimeRuler& ruler, double by_frames, int frame_count);
// Moved no more than it takes to have the frame in the strip.
[[nodiscard]] TimeRuler with_frame_in_sight(const TimeRuler& ruler, double frame, int frame_count);

struct Tick {
  double frame = 0;
  bool labelled = false;
};
// Ticks at 1, 2, 5, 10, 20, 50 ... frames, labels no closer than label_width px, ticks no closer than 6 px.
[[nodiscard]] std::vector<Tick> ticks(const TimeRuler& ruler, double label_width);

// "1:02.48": minutes, seconds and hundredths; hours where there are any; a minus sign before negative ones.
[[nodiscard]] std::string time_text(double time_s);

// A line of the ground grid, parallel to world X or Y.
struct GridLine {
  std::array<glm::dvec3, 2> ends_m;  // in the world, z = 0
  bool bold = false;
  double at_m = 0;      // the coordinate that all of it has
  bool is_of_x = true;  // whether that is x
};

// The ground, world z = 0, ruled in metres.
struct GroundGrid {
  double step_m = 1;
  std::vector<GridLine> lines;
};

// Lines at 1, 2 or 5 times a power of ten metres, 40 screen pixels or more apart at the middle of the screen; every
// tenth (of twos: fifth) bold. At most 200 lines around the place of the ground in the middle of the screen, or under
// the target where the ground is not visible there.
[[nodiscard]] GroundGrid ground_grid(const OrbitCamera& camera, const ScreenRect& rect);

// "0", "250 m", "1.5 km".
[[nodiscard]] std::string round_distance_text(double distance_m);

}  // namespace sigs::editor
