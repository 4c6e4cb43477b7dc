// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <doctest/doctest.h>

#include <vector>

using sigs::editor::frame_from_entry;

TEST_CASE("numbers, steps from the playhead and times are frames, within the footage") {
  const std::vector<double> times_s{0, 0.04, 0.08, 0.2, 0.24};  // one frame was dropped
  CHECK(frame_from_entry("3", 0, times_s) == 3);
  CHECK(frame_from_entry("  3 ", 0, times_s) == 3);
  CHECK(frame_from_entry("+2", 1, times_s) == 3);
  CHECK(frame_from_entry("-1", 1, times_s) == 0);
  CHECK(frame_from_entry("-9", 1, times_s) == 0);
  CHECK(frame_from_entry("99999999999999999999", 1, times_s) == 4);
  CHECK(frame_from_entry("+99999999999999999999", 1, times_s) == 4);
  CHECK(frame_from_entry("0:00.13", 0, times_s) == 2);
  CHECK(frame_from_entry("0:00.15", 0, times_s) == 3);
  CHECK(frame_from_entry("0:0:0.24", 0, times_s) == 4);
  CHECK(frame_from_entry("1:00", 0, times_s) == 4);
  CHECK(frame_from_entry("12", 0, {}) == 12);
}

TEST_CASE("text that is not a number is not a frame") {
  const std::vector<double> times_s{0, 0.04};
  for (const char* entry :
       {"", "  ", "+", "-", "abc", "1x", "1e3", "nan", "inf", ":", "1:", ":5", "--1", "0x1", "+0:01"})
    CHECK_FALSE(frame_from_entry(entry, 0, times_s).has_value());
  CHECK_FALSE(frame_from_entry("0:01", 0, {}).has_value());  // no footage, no times
}
