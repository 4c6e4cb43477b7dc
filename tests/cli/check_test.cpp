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

TEST_CASE("thermal footage whose colours are not those of its palette is named by check, frame and export alike") {
  const TinyProject tiny;
  for (const std::string& command :
       {"check " + tiny.project(), "frame " + tiny.project() + " --frame 0 --out " + tiny.file("frames").string(),
        "export " + tiny.project() + " --out " + tiny.file("out").string()}) {
    CAPTURE(command);
    const Run run = run_sigs(command + " --set footage.spectrum=thermal --set footage.palette=jet");
    CHECK(run.status == 78);
    CHECK(has(run.err, tiny.project() + ": footage.palette: the footage's colours are not those of jet: in frame 0"));
  }
}

}  // namespace sigs::test
