// SPDX-License-Identifier: MIT
#include "editor/preview/jobs.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "base/pose.h"
#include "comes_true.h"
#include "project/json.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::comes_true;
using sigs::test::source_dir;
using sigs::test::TemporaryFolder;

namespace {

Project sample_with_tilt(double roll_deg, double pitch_deg) {
  Project project = read_project(source_dir() / "projects/head-on/head-on.json")->project;
  project.camera.roll_deg = roll_deg;
  project.camera.pitch_deg = pitch_deg;
  return project;
}

}  // namespace

TEST_CASE("an estimate is a log with an attitude for each frame, against the first where no horizon is seen") {
  const TemporaryFolder folder;
  int last_done = 0;
  const EgoMotionRequest request{sample_with_tilt(3, -5), folder / "a.csv"};
  const auto found = estimated_motion(
      request,
      {.progress = [&](int done, int) { last_done = done; }, .warn = [](const Warning&) {}, .cancel = nullptr});
  REQUIRE_MESSAGE(found, found.error().text());
  CHECK(last_done == 200);
  CHECK(found->frames == 200);  // ffprobe -count_frames assets/footage/sample.mp4
  const Result<Track> track = read_track(request.file);
  REQUIRE(track);
  CHECK(static_cast<int>(track->ned_from_camera.values.size()) == found->frames - found->lost_frames);
  CHECK(track->on_footage_time);
  CHECK(track->level_is_known == found->level_sd_rad.has_value());
  if (found->level_sd_rad) return;
  const Attitude first = attitude_of(track->ned_from_camera.values.front());
  CHECK(first.roll_rad == doctest::Approx(0));
  CHECK(first.pitch_rad == doctest::Approx(0));
}

TEST_CASE("an estimate that is cancelled, or has no calibration, leaves no file") {
  const TemporaryFolder folder;
  Project project = sample_with_tilt(0, 0);
  {
    BackgroundJob<EgoMotionRequest, EstimatedMotion> job([] {}, estimated_motion);
    REQUIRE(job.start({project, folder / "a.csv"}));
    job.cancel();
    REQUIRE(comes_true([&] { return !job.is_running(); }));
    CHECK(job.state().phase == JobPhase::cancelled);
  }
  project.footage.calibration = "nowhere.xml";
  const auto failed =
      estimated_motion({project, folder / "a.csv"}, {.progress = [](int, int) {}, .warn = [](const Warning&) {}});
  REQUIRE_FALSE(failed);
  CHECK(failed.error().text().find("nowhere.xml") != std::string::npos);
  CHECK(std::filesystem::is_empty(folder.path()));
}
