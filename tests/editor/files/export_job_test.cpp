// SPDX-License-Identifier: MIT
#include "editor/preview/background_job.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "../preview/comes_true.h"
#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "editor/preview/export_plan.h"
#include "project/json.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::comes_true;
using sigs::test::TinyProject;

namespace {

namespace fs = std::filesystem;

Project read(const TinyProject& tiny) {
  return read_project(tiny.project()).value().project;
}

ExportState finished(const ExportJob& job) {
  REQUIRE(comes_true([&] { return !job.is_running(); }));
  return job.state();
}

}  // namespace

TEST_CASE("an export in the background gives the bytes of the command that it names") {
  const TinyProject tiny;
  const ExportRequest request{.project = read(tiny), .folder = tiny.file("from editor"), .frames = FrameRange{2, 7}};
  std::atomic<int> wakes = 0;
  ExportJob job([&] { ++wakes; }, exported);
  REQUIRE(job.start(request));
  const ExportState state = finished(job);
  REQUIRE_MESSAGE(state.phase == JobPhase::done, state.error.text());
  CHECK(state.done == 6);
  CHECK(state.total == 6);
  CHECK(comes_true([&] { return wakes >= 2; }));  // the first frame, and the end, told after the state says it

  ExportRequest by_program = request;
  by_program.folder = tiny.file("from program");
  REQUIRE(export_command(by_program).starts_with("sigs "));
  const test::Run run = test::run_sigs(export_command(by_program).substr(5));
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(state.value->written.size() == 3);
  for (const fs::path& path : state.value->written)
    CHECK_MESSAGE(read_text(path).value() == read_text(by_program.folder / path.filename()).value(), path);
}

TEST_CASE("the project is exported as it is in memory, whatever lies on disk") {
  const TinyProject tiny;
  Project project = read(tiny);
  project.name = "changed";
  ExportJob job([] {}, exported);
  REQUIRE(job.start({.project = project, .folder = tiny.out()}));
  REQUIRE(finished(job).phase == JobPhase::done);
  CHECK(fs::exists(fs::path(tiny.out()) / "changed.mkv"));
}

TEST_CASE("a cancelled export leaves nothing behind, and another can follow") {
  const TinyProject tiny(2000);
  (void)tiny.file("p.json");
  ExportJob job([] {}, exported);
  REQUIRE(job.start({.project = read(tiny), .folder = tiny.out()}));
  CHECK_FALSE(job.start({.project = read(tiny), .folder = tiny.out()}));
  REQUIRE(comes_true([&] { return job.state().done > 3; }));
  job.cancel();
  CHECK(finished(job).phase == JobPhase::cancelled);
  CHECK(tiny.files_out() == 0);
  job.forget();
  CHECK(job.state().phase == JobPhase::none);
  CHECK(job.start({.project = read(tiny), .folder = tiny.out(), .frames = FrameRange{0, 1}}));
  CHECK(finished(job).phase == JobPhase::done);
}

TEST_CASE("an editor that closes during an export leaves nothing behind") {
  const TinyProject tiny(2000);
  {
    ExportJob job([] {}, exported);
    REQUIRE(job.start({.project = read(tiny), .folder = tiny.out()}));
    REQUIRE(comes_true([&] { return job.state().done > 3; }));
  }
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("errors are reported by field") {
  const TinyProject tiny;
  Project project = read(tiny);
  project.intruders[0].model.file = "nowhere.obj";
  ExportJob job([] {}, exported);
  REQUIRE(job.start({.project = project, .folder = tiny.out()}));
  const ExportState state = finished(job);
  REQUIRE(state.phase == JobPhase::failed);
  CHECK(state.error.text().find("intruders[0].model.file") != std::string::npos);
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("existing files are not overwritten unless requested") {
  const TinyProject tiny(3);
  ExportJob job([] {}, exported);
  ExportRequest request{.project = read(tiny), .folder = tiny.out()};
  REQUIRE(job.start(request));
  REQUIRE(finished(job).phase == JobPhase::done);
  REQUIRE(job.start(request));
  CHECK(finished(job).phase == JobPhase::failed);
  request.overwrite = true;
  REQUIRE(job.start(request));
  CHECK(finished(job).phase == JobPhase::done);
}

TEST_CASE("the export runs at low priority, the calling thread keeps its own") {
  const TinyProject tiny(300);
  const int own = ::getpriority(PRIO_PROCESS, 0);
  std::atomic<int> exporting = own;
  ExportJob job([&] { exporting = ::getpriority(PRIO_PROCESS, 0); }, exported);
  REQUIRE(job.start({.project = read(tiny), .folder = tiny.out(), .frames = FrameRange{0, 5}}));
  REQUIRE(finished(job).phase == JobPhase::done);
  CHECK(::getpriority(PRIO_PROCESS, 0) == own);
  CHECK(exporting >= std::min(10, own + 1));
}
