// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "cli/program.h"
#include "cli/tiny_project.h"

namespace sigs::test {
TEST_CASE("check prints how well conditioned each path is") {
  TinyProject tiny;
  const Run two = run_sigs("check " + tiny.project());
  CHECK(two.status == 0);
  CHECK(has(two.out, "intruders[0] \"cube\": 2 waypoints, condition 1\n"));
  tiny.change(R"("trajectory": {)", R"("trajectory": {"spline": "approximating", )");
  CHECK(has(run_sigs("check " + tiny.project()).out, "intruders[0] \"cube\": 2 waypoints\n"));
}

TEST_CASE("check warns of a path that overshoots its waypoints by far and exits with status 0") {
  TinyProject tiny;
  // 30 m within a hundredth of a frame, then all of the footage for 6 m.
  tiny.change(R"({"frame": 0, "position_m": [20, -3, -150]})",
              R"({"frame": 0, "position_m": [20, -3, -150]}, {"frame": 0.01, "position_m": [20, 27, -150]})");
  const Run run = run_sigs("check " + tiny.project());
  CHECK(run.status == 0);
  CHECK(has(run.err, "warning: "));
  CHECK(has(run.err, "intruders[0].trajectory: \"cube\" overshoots "));
  CHECK(has(run.err, "of frames 0.01 and 9, where no leg is longer than 30 m"));
}

}  // namespace sigs::test
