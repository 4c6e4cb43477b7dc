// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace sigs::editor {

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

}  // namespace sigs::editor
