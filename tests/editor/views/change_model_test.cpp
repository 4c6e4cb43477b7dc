// SPDX-License-Identifier: MIT
#include "editor/views/models/change_model.h"

#include <doctest/doctest.h>

#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::source_dir;
using sigs::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const JobControl kQuiet{.progress = [](int, int) {}, .warn = [](const Warning&) {}, .cancel = nullptr};

fs::path sample(const std::string& name) {
  return source_dir() / "assets/models" / name / (name + ".obj");
}

Project project_in(const fs::path& folder) {
  Project project;
  project.file = folder / "flight.json";
  project.intruders.resize(1);
  project.intruders[0].model = {.file = "light-aircraft/light-aircraft.obj", .forward = "+y", .scale = 0.01};
  project.intruders[0].trajectory.waypoints = {{.frame = 3, .position_m = {300, 0, -150}}};
  return project;
}

}  // namespace

TEST_CASE(
    "a sample that is chosen lies beside the project, and the intruder has its axes, its kind and its own flight") {
  const TemporaryFolder folder;
  Project project = project_in(folder.path());
  TrajectoryPlan flight = project.intruders[0].trajectory;
  const Result<ChosenModel> chosen =
      chosen_model({.project = project, .intruder = 0, .model = sample("helicopter")}, kQuiet);
  REQUIRE_MESSAGE(chosen, chosen.error().text());
  use_model(project, 0, *chosen);
  const IntruderSettings& intruder = project.intruders[0];
  CHECK(intruder.model.file == "helicopter/helicopter.obj");
  CHECK(test::text_of(folder / intruder.model.file) == test::text_of(sample("helicopter")));
  CHECK(fs::exists(folder / "helicopter/helicopter.mtl"));
  CHECK(intruder.model.forward == "+x");
  CHECK(intruder.model.scale == 1);
  CHECK(intruder.category == "helicopter");
  flight.attitude = AttitudeKind::helicopter;  // it flies as its kind does, on its own path
  CHECK(intruder.trajectory == flight);
  CHECK(chosen->guesses.empty());
}

TEST_CASE("a kind that was chosen by hand stays; a project that was never saved names the model where it lies") {
  const TemporaryFolder folder;
  Project project = project_in(folder.path());
  project.intruders[0].category = "mosquito";
  project.file.clear();
  const Result<ChosenModel> chosen = chosen_model({.project = project, .intruder = 0, .model = sample("bird")}, kQuiet);
  REQUIRE(chosen);
  use_model(project, 0, *chosen);
  CHECK(project.intruders[0].category == "mosquito");
  CHECK(fs::path(project.intruders[0].model.file) == sample("bird"));
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("of a user's model axes and unit are guessed, and said; what is no model is an error and copies nothing") {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  test::write_file_and_folders(elsewhere / "jet.obj", test::text_of(sample("light-aircraft")));
  test::write_file_and_folders(elsewhere / "none.obj", "hello");
  Project project = project_in(folder.path());
  const Result<ChosenModel> chosen =
      chosen_model({.project = project, .intruder = 0, .model = elsewhere / "jet.obj"}, kQuiet);
  REQUIRE_MESSAGE(chosen, chosen.error().text());
  CHECK(chosen->guesses.size() == 2);
  CHECK(chosen->file == folder / "jet/jet.obj");
  CHECK_FALSE(chosen_model({.project = project, .intruder = 0, .model = elsewhere / "none.obj"}, kQuiet));
  CHECK_FALSE(fs::exists(folder / "none"));
}

TEST_CASE("the image of a model fills its tile: it reaches to within a tenth of one pair of edges") {
  ComposeContext compose;
  for (const char* const name : {"light-aircraft", "balloon", "quadcopter"}) {
    CAPTURE(name);
    const Result<cv::Mat> image = model_thumbnail(sample(name), {220, 132}, compose);
    REQUIRE_MESSAGE(image, image.error().text());
    REQUIRE(image->size() == cv::Size(220, 132));
    std::vector<cv::Point> seen;
    for (int y = 0; y < image->rows; ++y)
      for (int x = 0; x < image->cols; ++x)
        if (image->at<cv::Vec4b>(y, x)[3] > 0) seen.emplace_back(x, y);
    REQUIRE_FALSE(seen.empty());
    int left = 220, right = 0, top = 132, bottom = 0;
    for (const cv::Point& p : seen) {
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    CHECK((right - left > 0.8 * 220 || bottom - top > 0.8 * 132));
    CHECK(left >= 0.04 * 220);
    CHECK(top >= 0.04 * 132);
  }
}
