// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "session.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("a project that is read while a question is open waits for the answer") {
  for (const int answer : {1, 2}) {  // don't save; cancel
    SessionFixture d;
    d.open(d.written("a.json", "a"));
    d.session.handle(OpenProject{d.written("b.json", "b")});
    d.edit("quick");
    d.session.handle(Quit{});
    REQUIRE(d.session.question());
    d.wait_for_disk();
    REQUIRE(d.session.question());
    d.session.answer(answer);
    CHECK(d.session.is_done() == (answer == 1));  // it was quitting that was asked for
    CHECK(d.document.project().name == "quick");
    if (answer == 1) continue;
    d.wait();
    REQUIRE_MESSAGE(d.session.question(), "then the project that waits is asked for");
    d.session.answer(2);
    CHECK(d.document.project().name == "quick");
    CHECK_FALSE(d.session.question());
  }
}

TEST_CASE("requests made while a question is open are asked for after it") {
  SessionFixture d;
  const fs::path other = d.written("b.json", "b");
  Edits edits;
  d.open(d.written("a.json", "a"));
  d.edit("mine");
  d.session.handle(NewProject{});
  REQUIRE(d.session.question());
  d.session.handle_dropped(other, edits);
  d.session.handle(Quit{});  // the window's close button
  d.session.answer(2);       // no new project
  REQUIRE(d.session.question());
  CHECK(d.document.project().name == "mine");
  d.session.answer(2);  // nor the one that was dropped
  REQUIRE(d.session.question());
  d.session.answer(0);  // but quit, and save
  CHECK(d.session.is_done());
  CHECK(read_project(d.folder / "a.json")->project.name == "mine");
}

TEST_CASE("a project is only made after unsaved work was saved or given up, and then opens without another question") {
  for (const int answer : {0, 1, 2}) {
    CAPTURE(answer);
    SessionFixture d;
    const fs::path made = d.written("made.json", "made");
    d.open(d.written("a.json", "a"));
    d.edit("mine");
    int begun = 0;
    d.session.replace_then([&] { ++begun; });
    REQUIRE(d.session.question());
    CHECK(begun == 0);
    d.session.answer(answer);
    CHECK(begun == (answer == 2 ? 0 : 1));
    CHECK(d.document.project().name == "mine");  // until the project is there
    CHECK(read_project(d.folder / "a.json")->project.name == (answer == 0 ? "mine" : "a"));
    if (answer == 2) continue;
    d.session.open_agreed(made);
    d.wait();
    CHECK_FALSE(d.session.question());
    CHECK(d.document.project().name == "made");
  }
}

TEST_CASE("a name that is asked for saves the project that it was asked for, and no other") {
  SessionFixture d;
  d.session.handle(NewProject{});
  d.edit("mine");
  d.session.handle(Quit{});
  d.session.answer(0);  // save it: under which name?
  std::function<void(const fs::path&)> chosen;
  for (const Request& request : d.session.take_requests())
    if (const auto* wanted = std::get_if<AskForFile>(&request)) chosen = wanted->chosen;
  REQUIRE(chosen);
  d.session.handle(OpenProject{d.written("b.json", "b")});
  d.session.answer(1);  // don't save
  d.wait();
  REQUIRE(d.document.project().name == "b");
  chosen(d.folder / "mine.json");
  CHECK_FALSE(fs::exists(d.folder / "mine.json"));
  CHECK_FALSE(d.session.is_done());
}

TEST_CASE("a recovered project brings its mask; one that cannot be opened stays in the list with the reason") {
  TemporaryFolder folder;
  Project project;
  project.name = "painted";
  const pid_t child = ::fork();
  if (child == 0) {
    Recovery recovery(folder / "state");
    const MaskToKeep mask{.state = 3, .pixels = cv::Mat(4, 6, CV_8UC1, cv::Scalar(9)), .has_strokes = true};
    ::_exit(recovery.write(Document(project), mask) ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  REQUIRE(status == 0);
  std::ofstream(folder / "state/editor-1-1.json")
      << R"({"sigs_recovery": 1, "name": "odd", "written_unix_s": 1, "project": "{ no project"})";

  Document document;
  Settings settings;
  ProjectSession session(document, settings, {folder / "state", [] {}, {}});
  REQUIRE(session.abandoned().size() == 2);
  REQUIRE(session.abandoned()[1].name == "odd");
  session.recover(session.abandoned()[1]);
  CHECK_FALSE(session.has_project());
  REQUIRE(session.abandoned().size() == 2);
  CHECK_FALSE(session.abandoned()[1].problem.empty());
  session.discard(session.abandoned()[1]);
  session.answer(0);
  REQUIRE(session.abandoned().size() == 1);
  session.recover(session.abandoned()[0]);
  CHECK(document.project().name == "painted");
  const std::optional<RecoveredMask> mask = session.take_recovered_mask();
  REQUIRE(mask);
  CHECK(mask->pixels.size() == cv::Size(6, 4));
  CHECK(mask->has_strokes);
  CHECK_FALSE(session.take_recovered_mask());
}

TEST_CASE("saving the project keeps an unsaved mask for recovery, beside the project as it was saved") {
  TemporaryFolder folder;
  Document document;
  Settings settings;
  const MaskToKeep mask{.state = 3, .pixels = cv::Mat(4, 6, CV_8UC1, cv::Scalar(9))};
  ProjectSession session(
      document, settings,
      {.recovery_folder = folder / "state",
       .wake = [] {},
       .is_exporting = {},
       .mask = {.unsaved = [] { return std::uint64_t(3); }, .save_then = {}, .to_keep = [&] { return mask; }}});
  session.handle(NewProject{});
  document.apply(ChangeProject{"rename", [](Project& p) { p.name = "mine"; }, {}});
  session.handle(SaveProjectAs{folder / "mine.json"});
  CHECK_FALSE(document.has_unsaved_changes());
  int masks = 0;
  for (const auto& entry : fs::directory_iterator(folder / "state")) masks += entry.path().extension() == ".png";
  CHECK(masks == 1);
}
