// SPDX-License-Identifier: MIT
#include "editor/preview/background_job.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <chrono>

#include "comes_true.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::comes_true;

namespace {

DetectionState finished(const OwnBodyJob& job) {
  REQUIRE(comes_true([&] { return !job.is_running(); }));
  return job.state();
}

OwnBody body_of(int frames) {
  return {.mask = cv::Mat(4, 6, CV_8UC1, cv::Scalar(frames)), .frames_used = frames};
}

// Goes through its frames at once.
Result<OwnBody> quick(const Project& project, const JobControl& control) {
  for (int i = 1; i <= project.own_body.frames; ++i) control.progress(i, project.own_body.frames);
  return body_of(project.own_body.frames);
}

// Goes on until it is stopped.
Result<OwnBody> endless(const Project&, const JobControl& control) {
  for (int i = 1; !*control.cancel; ++i) {
    control.progress(i, 1'000'000);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return fail("", "stopped", ErrorKind::interrupted);
}

// Endless where all of the footage is asked for.
Result<OwnBody> either(const Project& project, const JobControl& control) {
  return project.own_body.frames > 1000 ? endless(project, control) : quick(project, control);
}

Project of(int frames) {
  Project project;
  project.own_body.frames = frames;
  return project;
}

}  // namespace

TEST_CASE("a detection ends with its result and the settings that it was started with") {
  std::atomic<int> wakes = 0;
  OwnBodyJob job([&] { ++wakes; }, quick);
  CHECK(job.state().phase == JobPhase::none);
  REQUIRE(job.start(of(40)));
  const DetectionState state = finished(job);
  REQUIRE(state.phase == JobPhase::done);
  CHECK(state.done == 40);
  CHECK(state.total == 40);
  REQUIRE(state.value);
  CHECK(state.value->frames_used == 40);
  CHECK(state.value_request == of(40));
  CHECK(comes_true([&] { return wakes >= 2; }));  // the first frame, and the end
}

TEST_CASE("a detection that is stopped ends soon, and another can follow") {
  OwnBodyJob job([] {}, either);
  REQUIRE(job.start(of(1500)));
  CHECK_FALSE(job.start(of(2)));
  REQUIRE(comes_true([&] { return job.state().done > 3; }));
  job.cancel();
  CHECK(finished(job).phase == JobPhase::cancelled);
  CHECK_FALSE(job.state().is_stopping);
  CHECK_FALSE(job.state().value);
  REQUIRE(job.start(of(5)));
  CHECK(finished(job).phase == JobPhase::done);
}

TEST_CASE("the previous result stays during another detection, and when that fails") {
  bool fails = false;
  OwnBodyJob job([] {},
                 [&](const Project& project, const JobControl& control) -> Result<OwnBody> {
                   if (fails) return fail("clip.mp4", "nothing moves");
                   return either(project, control);
                 });
  REQUIRE(job.start(of(7)));
  REQUIRE(finished(job).value);
  REQUIRE(job.start(of(1500)));
  CHECK(job.state().value->frames_used == 7);
  job.cancel();
  CHECK(finished(job).value->frames_used == 7);
  fails = true;
  REQUIRE(job.start(of(9)));
  const DetectionState state = finished(job);
  CHECK(state.phase == JobPhase::failed);
  CHECK(state.error.text() == "clip.mp4: nothing moves");
  CHECK(state.value->frames_used == 7);
  CHECK(state.value_request == of(7));
}

TEST_CASE("a discarded detection ends without a message, whether it was running or done") {
  OwnBodyJob job([] {}, either);
  REQUIRE(job.start(of(5)));
  REQUIRE(finished(job).value);
  job.forget();
  CHECK_FALSE(job.state().value);
  CHECK(job.state().phase == JobPhase::none);
  REQUIRE(job.start(of(1500)));
  REQUIRE(comes_true([&] { return job.state().done > 3; }));
  job.forget();
  CHECK(finished(job).phase == JobPhase::none);
  CHECK_FALSE(job.state().value);
}

TEST_CASE("an editor that closes during a detection does not wait for its end") {
  std::atomic<bool> ended = false;
  {
    OwnBodyJob job([] {},
                   [&](const Project& project, const JobControl& control) {
                     const Result<OwnBody> stopped = endless(project, control);
                     ended = true;
                     return stopped;
                   });
    REQUIRE(job.start(of(1500)));
  }
  CHECK(ended);  // by being cancelled: it has no other end
}

TEST_CASE("the window is woken some ten times a second, however fast frames pass") {
  std::atomic<int> wakes = 0;
  OwnBodyJob job([&] { ++wakes; }, quick);
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(job.start(of(100000)));
  CHECK(finished(job).done == 100000);
  const std::chrono::duration<double> took_s = std::chrono::steady_clock::now() - start;
  CHECK(wakes <= 3 + 10 * took_s.count());
}

TEST_CASE("the detection runs at low priority, the calling thread keeps its own") {
  const int own = ::getpriority(PRIO_PROCESS, 0);
  std::atomic<int> detecting = own;
  OwnBodyJob job([] {},
                 [&](const Project&, const JobControl&) -> Result<OwnBody> {
                   detecting = ::getpriority(PRIO_PROCESS, 0);
                   return body_of(1);
                 });
  REQUIRE(job.start(of(2)));
  REQUIRE(finished(job).phase == JobPhase::done);
  CHECK(::getpriority(PRIO_PROCESS, 0) == own);
  CHECK(detecting >= std::min(10, own + 1));
}

TEST_CASE("footage that cannot be opened is reported by its name") {
  OwnBodyJob job([] {}, detected);
  Project project = of(10);
  project.footage.video = "nowhere.mp4";
  REQUIRE(job.start(project));
  const DetectionState state = finished(job);
  CHECK(state.phase == JobPhase::failed);
  CHECK(state.error.text().find("nowhere.mp4") != std::string::npos);
}
