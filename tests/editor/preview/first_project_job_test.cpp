// SPDX-License-Identifier: MIT
#include "editor/preview/jobs.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "comes_true.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::comes_true;
using sigs::test::source_dir;

TEST_CASE("a project is made in the background: its step is told, its options are those asked for") {
  std::atomic<bool> go_on = false;
  FirstProjectJob job([] {},
                      [&](const FirstProjectOptions& options, const FirstProjectControl& control) {
                        control.progress(2, 5, "looking for the horizon");
                        while (!go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                        FirstProject made;
                        made.project.file = options.out;
                        return Result<FirstProject>(made);
                      });
  CHECK(job.state().step.empty());
  REQUIRE(job.start({.video = "flight.mp4", .out = "/a/flight.json"}));
  REQUIRE(comes_true([&] { return !job.state().step.empty(); }));
  CHECK(job.state().step == "looking for the horizon");
  CHECK(comes_true([&] { return job.state().done == 2 && job.state().total == 5; }));
  go_on = true;
  REQUIRE(comes_true([&] { return !job.is_running(); }));
  REQUIRE(job.state().value);
  CHECK(job.state().value->project.file == "/a/flight.json");
}

TEST_CASE("making a project ends when it is cancelled, and leaves nothing") {
  const test::TemporaryFolder folder;
  FirstProjectJob job([] {});
  REQUIRE(job.start({.video = source_dir() / "assets/footage/sample.mp4", .out = folder / "a.json"}));
  job.cancel();
  REQUIRE(comes_true([&] { return !job.is_running(); }));
  CHECK(job.state().phase == JobPhase::cancelled);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("the facts of a video are those of its file, and what is none says so") {
  const auto told = video_facts(source_dir() / "assets/footage/sample.mp4",
                                {.progress = [](int, int) {}, .warn = [](const Warning&) {}, .cancel = nullptr});
  REQUIRE_MESSAGE(told, told.error().text());
  // ffprobe -count_frames assets/footage/sample.mp4
  CHECK(told->size_px == cv::Size(1280, 960));
  CHECK(told->frames == 200);
  CHECK(told->rate_hz == doctest::Approx(25));
  CHECK(told->duration_s == doctest::Approx(8));
  CHECK(told->lens.empty());
  const auto none = video_facts(source_dir() / "README.md",
                                {.progress = [](int, int) {}, .warn = [](const Warning&) {}, .cancel = nullptr});
  REQUIRE_FALSE(none);
  CHECK(none.error().text().find("README.md") != std::string::npos);
}
