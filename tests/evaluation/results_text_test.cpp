// SPDX-License-Identifier: MIT
#include "evaluation/results_text.h"

#include <doctest/doctest.h>

#include "base/staged_outputs.h"
#include "evaluation/clips.h"
#include "support/test_data.h"

namespace sigs::test {

TEST_CASE("results that are written are read back as they were") {
  Results written{.name = "mine"};
  report(written, 3, {0.1, -7.25, 1.0 / 3, 20}, 0, 0.75);
  report(written, 3, {5.5, 6.5, 7, 8}, 4, -2);
  report(written, 9, {1e6, 2e-3, 1e-9, 400}, kNoTrack);
  const TemporaryFolder folder;
  REQUIRE(write_text(folder / "mine.csv", csv_text(written), false).has_value());
  const FootageTruth clip{.size_px = {640, 480}, .last_frame = 9};
  const Result<Results> read = read_results(folder / "mine.csv", clip, {.multiple_per_frame = true});
  REQUIRE_MESSAGE(read.has_value(), read.error().text());
  CHECK(read->name == "mine");
  REQUIRE(read->frames.size() == 2);
  for (const auto& [frame, boxes] : written.frames) {
    REQUIRE(read->frames.at(frame).size() == boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const ReportedBox& back = read->frames.at(frame)[i];
      // The file's x is the edge and half a pixel: a rounding each way.
      CHECK(back.box.x == doctest::Approx(boxes[i].box.x).epsilon(1e-12));
      CHECK(back.box.y == doctest::Approx(boxes[i].box.y).epsilon(1e-12));
      CHECK(back.box.width == boxes[i].box.width);
      CHECK(back.box.height == boxes[i].box.height);
      CHECK(back.score == boxes[i].score);
      CHECK(back.track == boxes[i].track);
    }
  }
}

TEST_CASE("results without a box are a header alone") {
  CHECK(csv_text({.name = "silent"}) == "frame,x,y,width,height,score,track\n");
}

}  // namespace sigs::test
