// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <fstream>
#include <limits>

#include "project/validate.h"
#include "support/test_data.h"

using namespace sigs;

namespace {

// A project whose files are all there.
struct Fixture {
  test::TemporaryFolder folder;
  Project project;

  Fixture() {
    for (const char* const name : {"a.mkv", "c.xml", "p.obj"}) std::ofstream(folder / name) << "x";
    project.file = folder / "p.json";
    project.footage.video = "a.mkv";
    project.footage.calibration = "c.xml";
    IntruderSettings intruder;
    intruder.model.file = "p.obj";
    intruder.trajectory.waypoints = {{.frame = 0, .position_m = {1, 2, 3}}, {.frame = 9, .position_m = {4, 5, 6}}};
    project.intruders = {intruder};
  }

  [[nodiscard]] std::vector<std::string> wrong_fields() const {
    std::vector<std::string> fields;
    for (const Problem& problem : validate(project)) fields.push_back(problem.field);
    return fields;
  }
};

using Fields = std::vector<std::string>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a project whose files exist has no problems") {
  CHECK(wrong_fields() == Fields{});
}

TEST_CASE_FIXTURE(Fixture, "a project without intruders has no problems") {
  project.intruders.clear();
  CHECK(wrong_fields() == Fields{});
}

TEST_CASE_FIXTURE(Fixture, "a missing file is named by its field and path and cannot be read") {
  project.intruders[0].model.file = "gone/q.obj";
  const std::vector<Problem> problems = validate(project);
  REQUIRE(problems.size() == 1);
  const Error error = error_of(project, problems[0]);
  CHECK(error.kind == ErrorKind::cannot_read);
  CHECK(error.text() ==
        (folder / "p.json").string() + ": intruders[0].model.file: no such file: " + (folder / "gone/q.obj").string());
}

TEST_CASE_FIXTURE(Fixture, "empty required fields are named") {
  project.footage.video.clear();
  project.footage.calibration.clear();
  project.intruders[0].model.file.clear();
  CHECK(wrong_fields() == Fields{"footage.video", "footage.calibration", "intruders[0].model.file"});
}

TEST_CASE_FIXTURE(Fixture, "numbers beyond their range or not finite are named") {
  project.compositing.supersampling = 0;
  project.light.ambient = 1.5;
  project.camera.speed_mps = kNan;
  project.camera.position_m.y = std::numeric_limits<double>::infinity();
  project.output.crf = 99;
  Fields wrong = wrong_fields();
  std::sort(wrong.begin(), wrong.end());
  CHECK(wrong == Fields{"camera.position_m", "camera.speed_mps", "compositing.supersampling", "export.video.crf",
                        "light.ambient"});
}

TEST_CASE_FIXTURE(Fixture, "waypoints that are missing, not finite or not in order are named") {
  auto& waypoints = project.intruders[0].trajectory.waypoints;
  waypoints[1].position_m.z = kNan;
  CHECK(wrong_fields() == Fields{"intruders[0].trajectory.waypoints[1].position_m"});
  waypoints[1].position_m.z = 0;
  waypoints[1].frame = 0;
  CHECK(wrong_fields() == Fields{"intruders[0].trajectory.waypoints[1].frame"});
  waypoints[1].frame = kNan;
  CHECK_FALSE(wrong_fields().empty());
  waypoints.clear();
  CHECK(wrong_fields() == Fields{"intruders[0].trajectory.waypoints"});
}

TEST_CASE_FIXTURE(Fixture, "axes that are invalid or parallel are named") {
  project.intruders[0].model.forward = "north";
  CHECK(wrong_fields() == Fields{"intruders[0].model.forward"});
  project.intruders[0].model.forward = "-z";
  project.intruders[0].model.up = "+z";
  CHECK(wrong_fields() == Fields{"intruders[0].model.up"});
}

TEST_CASE_FIXTURE(Fixture, "a range that ends before it begins is named") {
  project.footage.first_frame = 10;
  project.footage.last_frame = 9;
  CHECK(wrong_fields() == Fields{"footage.last_frame"});
}

TEST_CASE_FIXTURE(Fixture, "codec, container and labels that do not go together are named") {
  project.output.container = ContainerChoice::mp4;
  project.output.labels = {"xml", "yaml"};
  CHECK(wrong_fields() == Fields{"export.video.container", "export.labels"});
}

TEST_CASE_FIXTURE(Fixture,
                  "a volume of well clear that nobody knows is named with those there are, and one given twice") {
  project.output.encounter = {kWellClearNames.begin(), kWellClearNames.end()};
  CHECK(wrong_fields().empty());
  project.output.encounter = {"nmac", "hockey-puck"};
  REQUIRE(wrong_fields() == Fields{"export.encounter"});
  const std::string what = validate(project).front().what;
  for (const std::string_view word : {"hockey-puck", "dwc-en-route", "small-uas", "nmac"})
    CHECK_MESSAGE(what.find(word) != std::string::npos, what);
  project.output.encounter = {"nmac", "small-uas", "nmac"};
  CHECK(wrong_fields() == Fields{"export.encounter"});
  CHECK(validate(project).front().what.find("\"nmac\" twice") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "a name that would leave the output folder is refused") {
  project.name = "../elsewhere";
  CHECK(wrong_fields().front() == "name");
}
