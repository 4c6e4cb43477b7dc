// SPDX-License-Identifier: MIT
#include "editor/views/estimate_session.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "base/staged_outputs.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::TemporaryFolder;

namespace {

Project with_footage(const std::filesystem::path& folder) {
  Project project;
  project.file = folder / "flight.json";
  project.footage.video = "flight.mp4";
  project.footage.calibration = "camera.xml";
  project.camera.pitch_deg = -3;
  return project;
}

Result<EstimatedMotion> quick_estimate(const EgoMotionRequest& request, const JobControl&) {
  return EstimatedMotion{.file = request.file, .frames = 300, .lost_frames = 2, .found = {.is_complete = false}};
}

bool ends(EgoMotionSession& session, const Document& document) {
  for (int i = 0; i < 20000; ++i) {
    session.follow(document);
    if (!session.state().is_running()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("an estimate that is done is used as the camera's log, in one step of undo") {
  const TemporaryFolder folder;
  Document document(with_footage(folder.path()));
  Edits edits;
  EgoMotionSession session(
      edits, [] {}, quick_estimate);
  session.start(document);
  REQUIRE(ends(session, document));
  document.apply(edits.take_edits());
  const CameraSettings& camera = document.project().camera;
  CHECK(camera.track.file == "flight.attitude.csv");
  CHECK(camera.track.offset_s == 0);
  CHECK(camera.track.incomplete == IncompleteTrackChoice::use);  // two frames have no attitude
  CHECK(camera.pitch_deg == -3.0);  // no horizon was found: that of the start, which the file does not know
  session.follow(document);
  CHECK(edits.take_edits().empty());
  document.apply(Edit(Undo{}));
  CHECK(document.project() == with_footage(folder.path()));
  CHECK_FALSE(document.can_undo());
}

TEST_CASE("an estimate whose level is known has the camera's whole attitude") {
  const TemporaryFolder folder;
  Document document(with_footage(folder.path()));
  Edits edits;
  EgoMotionSession session(
      edits, [] {},
      [](const EgoMotionRequest& request, const JobControl&) -> Result<EstimatedMotion> {
        return EstimatedMotion{.file = request.file,
                               .frames = 300,
                               .level_sd_rad = 0.01,
                               .found = {.level_at_start = Attitude{.roll_rad = 0.01, .pitch_rad = -0.02}}};
      });
  session.start(document);
  REQUIRE(ends(session, document));
  document.apply(edits.take_edits());
  // camera.attitude_deg is that of the start, and no mount's angles that would be added to the file's.
  CHECK(document.project().camera.track.mount == TrackMountChoice::none);
  CHECK(document.project().camera.pitch_deg == -1.15);
  CHECK(document.project().camera.track.incomplete == IncompleteTrackChoice::refuse);
}

TEST_CASE("an estimate takes a name that is free, beside the project") {
  const TemporaryFolder folder;
  const Project project = with_footage(folder.path());
  CHECK(new_attitude_file(project).filename() == "flight.attitude.csv");
  REQUIRE(write_text(folder / "flight.attitude.csv", "mine", true));
  CHECK(new_attitude_file(project) == folder / "flight.attitude_2.csv");
}

TEST_CASE("without calibration an estimate does not begin, and says what is missing") {
  Project project = with_footage("/tmp");
  project.footage.calibration.clear();
  const Document document(project);
  Edits edits;
  EgoMotionSession session(
      edits, [] {}, quick_estimate);
  session.start(document);
  CHECK_FALSE(session.state().is_running());
  CHECK(edits.take_requests().size() == 1);
}
