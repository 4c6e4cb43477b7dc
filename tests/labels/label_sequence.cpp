// SPDX-License-Identifier: MIT
#include "labels/label_sequence.h"

namespace sigs::test::labels {

LabelSequence label_sequence(int last) {
  return {.name = "crossing",
          .footage = {.video = "flight.mp4",
                      .size_px = {64, 48},
                      .first_frame = 100,
                      .last_frame = last,
                      .frame_rate_num = 30000,
                      .frame_rate_den = 1001},
          .intruders = {{.id = 0, .name = "airliner", .category = "airplane"},
                        {.id = 1, .name = "sailplane", .category = "glider"}},
          .categories = {"airplane", "glider"},
          .images = "crossing"};
}

std::vector<FrameTruth> frames_of(const std::vector<std::vector<IntruderTruth>>& intruders) {
  std::vector<FrameTruth> frames;
  for (const std::vector<IntruderTruth>& there : intruders) {
    const int index = 100 + static_cast<int>(frames.size());
    frames.push_back({.index = index, .time_s = index * 1001.0 / 30000, .intruders = there});
  }
  return frames;
}

std::vector<std::string> special_names() {
  return {"a & b <c> \"d\" 'e'",
          "light aircraft",
          "Flugzeug \xC3\xBC",
          "\xE9\xA3\x9B\xE8\xA1\x8C\xE6\xA9\x9F",
          ": - #",
          "back\\slash",
          "%s{}"};
}

}  // namespace sigs::test::labels
