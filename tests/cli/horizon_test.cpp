// SPDX-License-Identifier: MIT
// The side of the horizon in labels is known where the camera's attitude is given, and unknown otherwise.
#include <doctest/doctest.h>

#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

struct Labels {
  std::string xml;
  std::string csv;
  std::string coco;
  std::string aot;
};

Labels labels_of(const TinyProject& tiny, const std::string& options = "") {
  const Run run = run_sigs("export " + tiny.project() + " --force --labels xml,csv,coco,aot --out " + tiny.out() +
                           (options.empty() ? "" : " ") + options);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const auto text = [&](const char* name) { return read_text(tiny.out() + "/" + name).value(); };
  return {text("tiny.xml"), text("tiny.csv"), text("tiny.coco.json"), text("tiny.aot.json")};
}

// The cube is 20 m ahead and as high as the camera, to both sides of a level horizon by 1 m.
void check_unknown(const Labels& labels) {
  CHECK(has(labels.xml, "horizon=\"unknown\""));
  CHECK_FALSE(has(labels.xml, "horizon=\"on\""));
  CHECK(has(labels.csv, ",unknown,"));
  CHECK(has(labels.coco, "\"unknown\""));
  CHECK(has(labels.aot, "\"is_above_horizon\": 0"));
}

}  // namespace

TEST_CASE("without an attitude the side of the horizon is unknown in every format") {
  TinyProject tiny;
  check_unknown(labels_of(tiny));
  tiny.change(R"("intruders")", R"("camera": {"attitude_deg": {"roll": null, "pitch": null, "yaw": 10}}, "intruders")");
  check_unknown(labels_of(tiny));
}

TEST_CASE("an attitude set in the file or on the command line determines the side of the horizon") {
  TinyProject tiny;
  CHECK(has(labels_of(tiny, "--set camera.attitude_deg.pitch=0").xml, "horizon=\"on\""));
  CHECK(has(labels_of(tiny, "--set camera.attitude_deg.roll=0").xml, "horizon=\"on\""));
  // The world's level plane counts: the cube is higher than the camera, whatever the camera's pitch.
  tiny.change("[20, -3, -150]", "[20, -3, -154]");
  tiny.change("[20, 3, -150]", "[20, 3, -154]");
  tiny.change(R"("intruders")", R"("camera": {"attitude_deg": {"pitch": 12}}, "intruders")");
  const Labels above = labels_of(tiny);
  CHECK(has(above.xml, "horizon=\"above\""));
  CHECK_FALSE(has(above.xml, "horizon=\"unknown\""));
  CHECK(has(above.aot, "\"is_above_horizon\": 1"));
  CHECK(has(above.csv, ",above,"));
  CHECK(has(labels_of(tiny, "--set camera.attitude_deg.pitch=null").xml, "horizon=\"unknown\""));
}

TEST_CASE("an attitude file determines the side of the horizon") {
  TinyProject tiny;
  write_file(tiny.file("turns.csv"), "frame,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n9,1,1,0\n");
  tiny.change(R"("intruders")", R"("camera": {"attitude_file": "turns.csv"}, "intruders")");
  const Labels labels = labels_of(tiny);
  CHECK(has(labels.xml, "horizon=\"on\""));
  CHECK_FALSE(has(labels.xml, "horizon=\"unknown\""));
}

}  // namespace sigs::test
