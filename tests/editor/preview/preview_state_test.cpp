// SPDX-License-Identifier: MIT
#include "editor/preview/preview_state.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr int kStates = 10'001;
constexpr ContentId kInputFiles{.low = 5};

// A window. In place of the threads, put_image() makes the image of a revision, one with a brightness of its own.
struct PreviewStateFixture {
  PreviewState preview_state;

  explicit PreviewStateFixture(std::size_t cache_bytes)
      : preview_state(PreviewLimits{.cache_bytes = cache_bytes}, [] {}) {
    preview_state.set_input_files(kInputFiles, {.id = {.low = 6}});
  }

  static double brightness_of(const Revision& revision) { return std::fmod(revision.project->camera.speed_mps, 251); }

  void put_image(const Revision& revision) {
    PreviewImage image{.revision = revision.number};
    image.bgr.ground = cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(brightness_of(revision)));
    preview_state.put_image({combined_id(revision.content, kInputFiles), 0},
                            std::make_shared<const PreviewImage>(std::move(image)), 1, true);
  }

  // Whether the revision's own image is shown as soon as it is wanted.
  bool shows_at_once(const Revision& revision) {
    preview_state.want({.revision = revision});
    const PreviewOutput shown = preview_state.shown();
    return shown.image_is_current && shown.image &&
           shown.image->bgr.whole().at<cv::Vec3b>(0, 0)[0] == brightness_of(revision);
  }

  bool shows_when_made(const Revision& revision) {
    preview_state.want({.revision = revision});
    put_image(revision);
    return shows_at_once(revision);
  }
};

ChangeProject speed(int mps, const std::string& gesture) {
  return {"set speed", [=](Project& project) { project.camera.speed_mps = mps; }, gesture};
}

}  // namespace

TEST_CASE("after a drag of ten thousand moves undo, redo and the next edit are shown") {
  PreviewStateFixture fixture(std::size_t{1} << 16);
  Document document;
  CHECK(fixture.shows_when_made(document.revision()));
  int missed = 0;
  for (int i = 1; i < kStates; ++i) {
    document.apply(Edit(speed(i, "drag")));
    missed += fixture.shows_when_made(document.revision()) ? 0 : 1;
  }
  CHECK(missed == 0);
  document.apply(Edit(EndGesture{}));
  document.apply(Edit(Undo{}));
  CHECK(document.revision().number == document.first_number());
  CHECK(fixture.shows_when_made(document.revision()));
  document.apply(Edit(Redo{}));
  CHECK(fixture.shows_when_made(document.revision()));
  document.apply(Edit(Undo{}));
  document.apply(Edit(speed(kStates + 5, "")));
  CHECK(fixture.shows_when_made(document.revision()));
}

TEST_CASE("undo after five thousand revisions shows each image at once, without the rendering thread") {
  PreviewStateFixture fixture(std::size_t{1} << 24);  // holds all of them: 192 bytes each
  std::vector<Revision> revisions;
  Document document;
  for (int i = 1; i <= 5000; ++i) {
    document.apply(Edit(speed(i, "")));
    revisions.push_back(document.revision());
    REQUIRE(fixture.shows_when_made(document.revision()));
  }
  int missed = 0;
  for (auto back = revisions.rbegin(); back != revisions.rend(); ++back) missed += fixture.shows_at_once(*back) ? 0 : 1;
  CHECK(missed == 0);
  // As far back as the document remembers.
  while (document.can_undo()) document.apply(Edit(Undo{}));
  CHECK(document.revision().number < 4500);
  CHECK(fixture.shows_at_once(document.revision()));
}

TEST_CASE("a change that touches no image keeps the image that is shown, and files that change do not") {
  PreviewStateFixture fixture(std::size_t{1} << 16);
  Document document;
  REQUIRE(fixture.shows_when_made(document.revision()));
  document.apply(Edit(ChangeProject{"rename", [](Project& project) { project.name = "another"; }, ""}));
  CHECK(fixture.shows_at_once(document.revision()));
  fixture.preview_state.set_input_files({.low = 7}, {.id = {.low = 6}});
  CHECK_FALSE(fixture.shows_at_once(document.revision()));
  fixture.preview_state.set_input_files(kInputFiles, {.id = {.low = 6}});
  CHECK(fixture.shows_at_once(document.revision()));
}

TEST_CASE("while the playhead is pulled nothing is made ahead of it; while it steps or plays, and soon after, it is") {
  PreviewStateFixture fixture(std::size_t{1} << 16);
  Document document;
  PreviewState& state = fixture.preview_state;
  const auto want = [&](int frame, bool playing) {
    state.want({.revision = document.revision(), .frame = frame, .playing = playing});
    return state.snapshot()->ahead;
  };
  const auto comes_to_rest = [&] {
    for (int i = 0; i < 500 && !state.snapshot()->ahead; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return state.snapshot()->ahead;
  };
  (void)want(0, false);
  REQUIRE(comes_to_rest());
  CHECK(want(1, false));
  CHECK(want(0, false));
  CHECK(want(7, true));
  CHECK(want(300, true));
  // One of many: should this thread have to wait long between two lines, the pull is over.
  bool made_ahead = true;
  for (int i = 0; i < 50 && made_ahead; ++i) made_ahead = want(10 * i, false);
  CHECK_FALSE(made_ahead);
  CHECK(comes_to_rest());
}

TEST_CASE(
    "what changes with the files of a project is told at once: other footage, or an image that is there already") {
  int calls = 0;
  PreviewState state(PreviewLimits{}, [&calls] { ++calls; });
  const Revision revision(1, std::make_shared<const Project>());
  state.want({.revision = revision});
  state.set_input_files(kInputFiles, {.id = {.low = 6}});
  CHECK(calls == 1);
  CHECK(state.shown().opening);
  state.set_input_files(kInputFiles, {.id = {.low = 6}});
  CHECK(calls == 1);
  state.put_image({combined_id(revision.content, kInputFiles), 0}, std::make_shared<const PreviewImage>(), 1, true);
  state.set_input_files({.low = 9}, {.id = {.low = 6}});
  CHECK_FALSE(state.shown().image_is_current);
  CHECK(calls == 3);
  state.set_input_files(kInputFiles, {.id = {.low = 6}});
  CHECK(state.shown().image_is_current);
  CHECK(calls == 4);
}
