// SPDX-License-Identifier: MIT
#include "editor/views/estimate_session.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

using namespace sigs;
using namespace sigs::editor;

namespace {

// Finds a speed and sets it.
class SpeedSession : public EstimateSession<int, double> {
 public:
  SpeedSession(Edits& edits, Work work)
      : EstimateSession(
            edits, [] {}, std::move(work), "No speed was found",
            [&edits](const std::shared_ptr<const double>& found) {
              edits.change("set the speed", [found](Project& project) { project.camera.speed_mps = *found; });
            }) {}
  void start(const Document& document) { begin(document, 7); }
};

Result<double> thrice(int request, const JobControl&) {
  return 3.0 * request;
}

Result<double> failing(int, const JobControl&) {
  return fail("flight.mp4", "is gone");
}

Result<double> endless(int, const JobControl& control) {
  while (!*control.cancel) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return fail("", "stopped", ErrorKind::interrupted);
}

Project at_rest() {
  Project project;
  project.file = "/flights/flight.json";
  project.footage.video = "flight.mp4";
  return project;
}

void follow_to_its_end(SpeedSession& session, const Document& document) {
  for (int i = 0; i < 20000; ++i) {
    session.follow(document);
    if (!session.state().is_running()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL("an estimate has not ended");
}

}  // namespace

TEST_CASE("what an estimate finds is put into the project once, in one step of undo") {
  Document document(at_rest());
  Edits edits;
  SpeedSession session(edits, thrice);
  session.start(document);
  follow_to_its_end(session, document);
  document.apply(edits.take_edits());
  CHECK(document.project().camera.speed_mps == 21);
  session.follow(document);
  CHECK(edits.take_edits().empty());
  document.apply(Edit(Undo{}));
  CHECK(document.project() == at_rest());
  CHECK_FALSE(document.can_undo());
}

TEST_CASE("an estimate that is stopped changes nothing and says nothing") {
  const Document document(at_rest());
  Edits edits;
  SpeedSession session(edits, endless);
  session.start(document);
  session.follow(document);
  CHECK(session.state().is_running());
  session.stop();
  follow_to_its_end(session, document);
  CHECK(session.state().phase == JobPhase::cancelled);
  CHECK(edits.take_edits().empty());
  CHECK(edits.take_requests().empty());
}

TEST_CASE("an estimate that fails changes nothing and says why, once") {
  const Document document(at_rest());
  Edits edits;
  SpeedSession session(edits, failing);
  session.start(document);
  follow_to_its_end(session, document);
  session.follow(document);
  CHECK(edits.take_edits().empty());
  const std::vector<Request> requests = edits.take_requests();
  REQUIRE(requests.size() == 1);
  CHECK(std::get<ShowMessage>(requests[0]).text == "No speed was found: flight.mp4: is gone");
  CHECK(std::get<ShowMessage>(requests[0]).is_error);
}

TEST_CASE("another video stops an estimate of the one before") {
  Document document(at_rest());
  Edits edits;
  SpeedSession session(edits, endless);
  session.start(document);
  session.follow(document);
  document.apply(Edit(ChangeProject{"other", [](Project& project) { project.footage.video = "other.mp4"; }, {}}));
  follow_to_its_end(session, document);
  CHECK(session.state().phase == JobPhase::none);
  CHECK(edits.take_edits().empty());
}
