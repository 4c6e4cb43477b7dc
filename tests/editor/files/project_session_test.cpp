// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "session.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("a project is opened in the background and becomes a recent one") {
  SessionFixture d;
  const fs::path path = d.written("a.json", "a");
  CHECK_FALSE(d.session.has_project());
  d.open(path);
  CHECK(d.session.has_project());
  CHECK(d.document.project().name == "a");
  CHECK_FALSE(d.document.has_unsaved_changes());
  REQUIRE(d.settings.recent.size() == 1);
  CHECK(d.settings.recent[0] == path);
}

TEST_CASE("a project that cannot be opened is reported, and the current one stays") {
  SessionFixture d;
  d.open(d.written("a.json", "a"));
  std::ofstream(d.folder / "broken.json") << "{";
  for (const char* file : {"broken.json", "nowhere.json"}) {
    d.open(d.folder / file);
    CHECK(d.errors().find(file) != std::string::npos);
    CHECK(d.document.project().name == "a");
    CHECK(d.session.has_project());
  }
}

TEST_CASE("unsaved changes are asked for before they are lost, whatever would lose them") {
  SessionFixture d;
  const fs::path other = d.written("b.json", "b");
  for (const Request& request :
       {Request(OpenProject{other}), Request(NewProject{}), Request(CloseProject{}), Request(Quit{})}) {
    d.open(d.written("a.json", "a"));
    d.edit("changed");
    CHECK(d.session.handle(request));
    REQUIRE(d.session.question());
    REQUIRE(d.session.question()->answers.size() == 3);
    d.session.answer(2);  // cancel
    d.wait();
    CHECK(d.document.project().name == "changed");
    CHECK_FALSE(d.session.is_done());

    d.session.handle(request);
    d.session.answer(1);  // don't save
    d.wait();
    CHECK((d.session.is_done() || d.document.project().name != "changed"));
    CHECK(read_project(d.folder / "a.json")->project.name == "a");
  }
}

TEST_CASE("saving from the question continues with the requested action") {
  SessionFixture d;
  d.open(d.written("a.json", "a"));
  d.edit("changed");
  d.session.handle(Quit{});
  d.session.answer(0);
  CHECK(d.session.is_done());
  CHECK(read_project(d.folder / "a.json")->project.name == "changed");
}

TEST_CASE("a failed save cancels the action that was to follow") {
  SessionFixture d;
  d.session.handle(NewProject{});
  d.edit("a");
  d.session.handle(Quit{});
  d.session.answer(0);
  d.choose_file(d.folder / "no such folder/a.json");
  CHECK_FALSE(d.errors().empty());
  CHECK_FALSE(d.session.is_done());
  CHECK(d.document.has_unsaved_changes());
}

TEST_CASE("a project without a file asks for a name, and takes it") {
  SessionFixture d;
  d.session.handle(NewProject{});
  d.document.apply(ChangeProject{"speed", [](Project& p) { p.camera.speed_mps = 5; }, {}});
  d.session.handle(SaveProject{});
  d.choose_file(d.folder / "flight.json");
  CHECK_FALSE(d.document.has_unsaved_changes());
  CHECK(read_project(d.folder / "flight.json")->project.name == "flight");
}

TEST_CASE("a cancelled choice of a file name cancels the action that was to follow") {
  SessionFixture d;
  d.session.handle(NewProject{});
  d.edit("a");
  d.session.handle(Quit{});
  d.session.answer(0);
  (void)d.session.take_requests();  // the user closes the browser
  d.session.handle(SaveProject{});
  d.choose_file(d.folder / "a.json");
  CHECK_FALSE(d.session.is_done());
}

TEST_CASE("changes on disk by another program are not overwritten without a question") {
  SessionFixture d;
  const fs::path path = d.written("a.json", "a");
  d.open(path);
  d.edit("mine");
  std::ofstream(path) << "somebody else's";
  d.session.handle(SaveProject{});
  REQUIRE(d.session.question());
  d.session.answer(2);
  CHECK(fs::file_size(path) == 15);
  d.session.handle(SaveProject{});
  d.session.answer(1);
  CHECK(read_project(path)->project.name == "mine");
  d.edit("mine again");
  d.session.handle(SaveProject{});
  CHECK_FALSE(d.session.question());
}

TEST_CASE("what another program writes while a project is being read, or after a crash, is not overwritten unasked") {
  SessionFixture d;
  const fs::path path = d.written("a.json", "a");
  d.session.handle(OpenProject{path});
  d.wait_until_read(1);
  d.written("a.json", "somebody else's, while the project waits to be shown");
  d.wait();
  d.edit("mine");
  d.session.handle(SaveProject{});
  REQUIRE(d.session.question());
  d.session.answer(2);

  d.open(d.written("b.json", "b"));
  d.session.answer(1);
  d.wait();
  d.edit("mine");
  {
    Recovery crashed(d.folder / "state");
    REQUIRE(crashed.write(d.document));
  }
  d.written("b.json", "somebody else's, after the crash");
  const std::vector<AbandonedProject> abandoned = abandoned_projects(d.folder / "state");
  REQUIRE(abandoned.size() == 1);
  SessionFixture after;
  after.session.recover(abandoned[0]);
  CHECK(after.document.project().name == "mine");
  after.session.handle(SaveProject{});
  REQUIRE(after.session.question());
  CHECK(after.session.question()->title == "Changed on disk");
}

TEST_CASE("a running export is not lost without a question") {
  SessionFixture d;
  d.exporting = true;
  d.session.handle(Quit{});
  REQUIRE(d.session.question());
  d.session.answer(0);
  CHECK_FALSE(d.session.is_done());
  d.session.handle(Quit{});
  d.session.answer(1);
  CHECK(d.session.is_done());
}

TEST_CASE("edits made while a file is read are not lost either") {
  SessionFixture d;
  d.open(d.written("a.json", "a"));
  d.session.handle(OpenProject{d.written("b.json", "b")});
  d.edit("quick");
  d.wait();
  REQUIRE(d.session.question());
  d.session.answer(2);
  CHECK(d.document.project().name == "quick");
}

TEST_CASE("after a crash the project is offered, recovered unsaved, and gone from the list") {
  SessionFixture before;
  const fs::path path = before.written("a.json", "a");
  const pid_t child = ::fork();
  if (child == 0) {
    SessionFixture crashing;
    Document document(read_project(path)->project);
    document.apply(ChangeProject{"rename", [](Project& p) { p.name = "lost work"; }, {}});
    Recovery recovery(before.folder / "state");
    ::_exit(recovery.write(document) ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  REQUIRE(status == 0);

  Document document;
  Settings settings;
  ProjectSession session(document, settings, {before.folder / "state", [] {}, {}});
  REQUIRE(session.abandoned().size() == 1);
  session.recover(session.abandoned()[0]);
  CHECK(session.has_project());
  CHECK(document.project().name == "lost work");
  CHECK(document.project().file == path);
  CHECK(document.has_unsaved_changes());
  CHECK(session.abandoned().empty());
  session.handle(SaveProject{});
  CHECK(read_project(path)->project.name == "lost work");
  CHECK(abandoned_projects(before.folder / "state").empty());
}

TEST_CASE("dropped files open projects or change the one that is there") {
  SessionFixture d;
  Edits edits;
  const fs::path path = d.written("a.json", "a");
  d.session.handle_dropped(path, edits);
  d.wait();
  CHECK(d.document.project().name == "a");
  std::ofstream(d.folder / "m.obj") << "v 0 0 0\n";
  d.session.handle_dropped(d.folder / "m.obj", edits);
  d.document.apply(edits.take_edits());
  REQUIRE(d.document.project().intruders.size() == 1);
  CHECK(d.document.project().intruders[0].model.file == "m.obj");
  std::ofstream(d.folder / "letter.doc") << "Dear Sir";
  d.session.handle_dropped(d.folder / "letter.doc", edits);
  CHECK(d.errors().find("letter.doc") != std::string::npos);
}

TEST_CASE("requests for other modules are left to them") {
  SessionFixture d;
  CHECK_FALSE(d.session.handle(Play{1}));
  CHECK_FALSE(d.session.handle(ShowHelp{}));
  CHECK_FALSE(d.session.question());
}

TEST_CASE("a mask that was not saved is asked for before it is lost, whatever would lose it") {
  SessionFixture d;
  const fs::path other = d.written("b.json", "b");
  for (const Request& request :
       {Request(OpenProject{other}), Request(NewProject{}), Request(CloseProject{}), Request(Quit{})}) {
    d.unsaved_mask = 0;
    d.open(d.written("a.json", "a"));
    d.unsaved_mask = 7;
    CHECK(d.session.handle(request));
    REQUIRE(d.session.question());
    CHECK(d.session.question()->text.find("mask") != std::string::npos);
    d.session.answer(2);  // cancel
    d.wait();
    CHECK(d.document.project().name == "a");
    CHECK_FALSE(d.session.is_done());

    d.session.handle(request);
    d.session.answer(1);  // don't save
    CHECK_FALSE(d.session.question());
    d.wait();
    CHECK((d.session.is_done() || d.document.project().name != "a"));
  }
}

TEST_CASE("mask and project are asked for one after the other, and saving either goes on to the next") {
  SessionFixture d;
  d.open(d.written("a.json", "a"));
  d.edit("changed");
  d.unsaved_mask = 7;
  d.session.handle(Quit{});
  REQUIRE(d.session.question());
  d.session.answer(0);  // save the mask
  REQUIRE(d.to_save_mask.size() == 1);
  CHECK_FALSE(d.session.is_done());
  d.unsaved_mask = 0;
  d.to_save_mask[0]();
  REQUIRE(d.session.question());
  CHECK(d.session.question()->text.find("changes") != std::string::npos);
  d.session.answer(0);  // save the project
  CHECK(d.session.is_done());
  CHECK(read_project(d.folder / "a.json")->project.name == "changed");
}

TEST_CASE("strokes painted while another project is read are asked for again") {
  SessionFixture d;
  const fs::path other = d.written("b.json", "b");
  d.open(d.written("a.json", "a"));
  d.unsaved_mask = 7;
  d.session.handle(OpenProject{other});
  d.session.answer(1);  // may be lost
  d.unsaved_mask = 8;   // another stroke
  d.wait();
  REQUIRE(d.session.question());
  CHECK(d.document.project().name == "a");
  d.session.answer(1);
  d.wait();
  CHECK(d.document.project().name == "b");
}

TEST_CASE("a project never saved is proposed beside its footage, not in the folder visited last") {
  SessionFixture d;
  d.settings.last_folder = d.folder / "looked";
  fs::create_directories(d.folder / "clips");
  fs::create_directories(d.folder / "mine");
  const auto proposed = [&]() -> fs::path {
    d.session.handle(SaveProjectAs{});
    for (const Request& request : d.session.take_requests())
      if (const auto* wanted = std::get_if<AskForFile>(&request)) return wanted->start.parent_path();
    return {};
  };
  d.session.handle(NewProject{});
  CHECK(proposed() == d.folder / "looked");
  d.settings.recent = {d.folder / "mine/a.json"};
  CHECK(proposed() == d.folder / "mine");
  const std::string video = (d.folder / "clips/a.mp4").string();
  d.document.apply(ChangeProject{"set footage", [&](Project& p) { p.footage.video = video; }, {}});
  CHECK(proposed() == d.folder / "clips");
}

TEST_CASE("messages of the previous project are cleared before the next one can give any") {
  SessionFixture d;
  d.open(d.written("a.json", "a"));
  const std::vector<Request> requests = d.session.take_requests();
  const auto clear = std::find_if(requests.begin(), requests.end(), [](const Request& request) {
    return std::holds_alternative<ClearMessages>(request);
  });
  const auto message = std::find_if(requests.begin(), requests.end(), [](const Request& request) {
    return std::holds_alternative<ShowMessage>(request);
  });
  REQUIRE(clear != requests.end());
  CHECK(clear < message);
}
