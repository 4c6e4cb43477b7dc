// SPDX-License-Identifier: MIT
#include "editor/views/estimate_session.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

using namespace sigs;
using namespace sigs::editor;

namespace {

Project hazy_project() {
  Project project;
  project.file = "/flights/flight.json";
  project.footage.video = "flight.mp4";
  project.appearance.psf_sigma_px = 7;
  return project;
}

Result<Appearance> quick_look(const Project&, const JobControl&) {
  Appearance found;
  found.frames_used = 24;
  found.point_spread.sigma_px = {.value = 0.62, .sd = 0.03, .is_known = true};
  return found;
}

bool has_ended(AppearanceSession& session, const Document& document) {
  for (int i = 0; i < 20000; ++i) {
    session.follow(document);
    if (!session.state().is_running()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("a look at the footage sets the project's appearance in one step of undo") {
  Document document(hazy_project());
  Edits edits;
  AppearanceSession session(
      edits, [] {}, quick_look);
  session.start(document);
  REQUIRE(has_ended(session, document));
  document.apply(edits.take_edits());
  CHECK(document.project().appearance.psf_sigma_px == doctest::Approx(0.62));
  session.follow(document);
  CHECK(edits.take_edits().empty());  // once
  document.apply(Edit(Undo{}));
  CHECK(document.project() == hazy_project());
  CHECK_FALSE(document.can_undo());
}

TEST_CASE("without footage there is no look, and a message says what is missing") {
  const Document empty;
  Edits edits;
  AppearanceSession session(
      edits, [] {}, quick_look);
  session.start(empty);
  session.follow(empty);
  CHECK_FALSE(session.state().is_running());
  CHECK(std::get<ShowMessage>(edits.take_requests().at(0)).is_error);
}
