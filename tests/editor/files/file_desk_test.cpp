// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "desk.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("a project is opened in the background and becomes a recent one") {
  Desk d;
  const fs::path path = d.written("a.json", "a");
  CHECK_FALSE(d.desk.has_project());
  d.open(path);
  CHECK(d.desk.has_project());
  CHECK(d.document.project().name == "a");
  CHECK_FALSE(d.document.has_unsaved_changes());
  REQUIRE(d.settings.recent.size() == 1);
  CHECK(d.settings.recent[0] == path);
}

TEST_CASE("what cannot be opened is told, and the present project stays") {
  Desk d;
  d.open(d.written("a.json", "a"));
  std::ofstream(d.folder / "broken.json") << "{";
  for (const char* file : {"broken.json", "nowhere.json"}) {
    d.open(d.folder / file);
    CHECK(d.errors().find(file) != std::string::npos);
    CHECK(d.document.project().name == "a");
    CHECK(d.desk.has_project());
  }
}

TEST_CASE("unsaved changes are asked for before they are lost, whatever would lose them") {
  Desk d;
  const fs::path other = d.written("b.json", "b");
  for (const Request& request :
       {Request(OpenProject{other}), Request(NewProject{}), Request(CloseProject{}), Request(Quit{})}) {
    d.open(d.written("a.json", "a"));
    d.edit("changed");
    CHECK(d.desk.take(request));
    REQUIRE(d.desk.question());
    REQUIRE(d.desk.question()->answers.size() == 3);
    d.desk.answer(2);  // cancel
    d.wait();
    CHECK(d.document.project().name == "changed");
    CHECK_FALSE(d.desk.is_done());

    d.desk.take(request);
    d.desk.answer(1);  // don't save
    d.wait();
    CHECK((d.desk.is_done() || d.document.project().name != "changed"));
    CHECK(read_project(d.folder / "a.json")->project.name == "a");
  }
}

TEST_CASE("saving from the question goes on to what was wanted") {
  Desk d;
  d.open(d.written("a.json", "a"));
  d.edit("changed");
  d.desk.take(Quit{});
  d.desk.answer(0);
  CHECK(d.desk.is_done());
  CHECK(read_project(d.folder / "a.json")->project.name == "changed");
}

TEST_CASE("a save that fails stops what was to follow") {
  Desk d;
  d.desk.take(NewProject{});
  d.edit("a");
  d.desk.take(Quit{});
  d.desk.answer(0);
  d.choose_file(d.folder / "no such folder/a.json");
  CHECK_FALSE(d.errors().empty());
  CHECK_FALSE(d.desk.is_done());
  CHECK(d.document.has_unsaved_changes());
}

TEST_CASE("a project without a file asks for a name, and takes it") {
  Desk d;
  d.desk.take(NewProject{});
  d.document.apply(ChangeProject{"speed", [](Project& p) { p.camera.speed_mps = 5; }, {}});
  d.desk.take(SaveProject{});
  d.choose_file(d.folder / "flight.json");
  CHECK_FALSE(d.document.has_unsaved_changes());
  CHECK(read_project(d.folder / "flight.json")->project.name == "flight");
}

TEST_CASE("a file name that was not chosen ends what was to follow it") {
  Desk d;
  d.desk.take(NewProject{});
  d.edit("a");
  d.desk.take(Quit{});
  d.desk.answer(0);
  (void)d.desk.take_requests();  // the person closes the browser
  d.desk.take(SaveProject{});
  d.choose_file(d.folder / "a.json");
  CHECK_FALSE(d.desk.is_done());
}

TEST_CASE("another's changes on disk are not overwritten without a question") {
  Desk d;
  const fs::path path = d.written("a.json", "a");
  d.open(path);
  d.edit("mine");
  std::ofstream(path) << "somebody else's";
  d.desk.take(SaveProject{});
  REQUIRE(d.desk.question());
  d.desk.answer(2);
  CHECK(fs::file_size(path) == 15);
  d.desk.take(SaveProject{});
  d.desk.answer(1);
  CHECK(read_project(path)->project.name == "mine");
  d.edit("mine again");
  d.desk.take(SaveProject{});
  CHECK_FALSE(d.desk.question());
}

TEST_CASE("a running export is not lost without a question") {
  Desk d;
  d.exporting = true;
  d.desk.take(Quit{});
  REQUIRE(d.desk.question());
  d.desk.answer(0);
  CHECK_FALSE(d.desk.is_done());
  d.desk.take(Quit{});
  d.desk.answer(1);
  CHECK(d.desk.is_done());
}

TEST_CASE("what is edited while a file is read is not lost either") {
  Desk d;
  d.open(d.written("a.json", "a"));
  d.desk.take(OpenProject{d.written("b.json", "b")});
  d.edit("quick");
  d.wait();
  REQUIRE(d.desk.question());
  d.desk.answer(2);
  CHECK(d.document.project().name == "quick");
}

TEST_CASE("after a crash the project is offered, recovered unsaved, and gone from the list") {
  Desk before;
  const fs::path path = before.written("a.json", "a");
  const pid_t child = ::fork();
  if (child == 0) {
    Desk crashing;
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
  FileDesk desk(document, settings, {before.folder / "state", [] {}, {}});
  REQUIRE(desk.abandoned().size() == 1);
  desk.recover(desk.abandoned()[0]);
  CHECK(desk.has_project());
  CHECK(document.project().name == "lost work");
  CHECK(document.project().file == path);
  CHECK(document.has_unsaved_changes());
  CHECK(desk.abandoned().empty());
  desk.take(SaveProject{});
  CHECK(read_project(path)->project.name == "lost work");
  CHECK(abandoned_projects(before.folder / "state").empty());
}

TEST_CASE("dropped files open projects or change the one that is there") {
  Desk d;
  Edits edits;
  const fs::path path = d.written("a.json", "a");
  d.desk.take_dropped(path, edits);
  d.wait();
  CHECK(d.document.project().name == "a");
  std::ofstream(d.folder / "m.obj") << "v 0 0 0\n";
  d.desk.take_dropped(d.folder / "m.obj", edits);
  d.document.apply(edits.take_edits());
  REQUIRE(d.document.project().intruders.size() == 1);
  CHECK(d.document.project().intruders[0].model.file == "m.obj");
  std::ofstream(d.folder / "letter.doc") << "Dear Sir";
  d.desk.take_dropped(d.folder / "letter.doc", edits);
  CHECK(d.errors().find("letter.doc") != std::string::npos);
}

TEST_CASE("requests that belong to others are left to them") {
  Desk d;
  CHECK_FALSE(d.desk.take(Play{1}));
  CHECK_FALSE(d.desk.take(ShowHelp{}));
  CHECK_FALSE(d.desk.question());
}

TEST_CASE("a mask that was not saved is asked for before it is lost, whatever would lose it") {
  Desk d;
  const fs::path other = d.written("b.json", "b");
  for (const Request& request :
       {Request(OpenProject{other}), Request(NewProject{}), Request(CloseProject{}), Request(Quit{})}) {
    d.unsaved_mask = 0;
    d.open(d.written("a.json", "a"));
    d.unsaved_mask = 7;
    CHECK(d.desk.take(request));
    REQUIRE(d.desk.question());
    CHECK(d.desk.question()->text.find("mask") != std::string::npos);
    d.desk.answer(2);  // cancel
    d.wait();
    CHECK(d.document.project().name == "a");
    CHECK_FALSE(d.desk.is_done());

    d.desk.take(request);
    d.desk.answer(1);  // don't save
    CHECK_FALSE(d.desk.question());
    d.wait();
    CHECK((d.desk.is_done() || d.document.project().name != "a"));
  }
}

TEST_CASE("mask and project are asked for one after the other, and saving either goes on to the next") {
  Desk d;
  d.open(d.written("a.json", "a"));
  d.edit("changed");
  d.unsaved_mask = 7;
  d.desk.take(Quit{});
  REQUIRE(d.desk.question());
  d.desk.answer(0);  // save the mask
  REQUIRE(d.to_save_mask.size() == 1);
  CHECK_FALSE(d.desk.is_done());
  d.unsaved_mask = 0;
  d.to_save_mask[0]();
  REQUIRE(d.desk.question());
  CHECK(d.desk.question()->text.find("changes") != std::string::npos);
  d.desk.answer(0);  // save the project
  CHECK(d.desk.is_done());
  CHECK(read_project(d.folder / "a.json")->project.name == "changed");
}

TEST_CASE("what is painted while another project is read is asked for again") {
  Desk d;
  const fs::path other = d.written("b.json", "b");
  d.open(d.written("a.json", "a"));
  d.unsaved_mask = 7;
  d.desk.take(OpenProject{other});
  d.desk.answer(1);    // may be lost
  d.unsaved_mask = 8;  // another stroke
  d.wait();
  REQUIRE(d.desk.question());
  CHECK(d.document.project().name == "a");
  d.desk.answer(1);
  d.wait();
  CHECK(d.document.project().name == "b");
}

TEST_CASE("a project that was never saved is to be saved beside its footage, not where one looked last") {
  Desk d;
  d.settings.last_folder = d.folder / "looked";
  fs::create_directories(d.folder / "clips");
  fs::create_directories(d.folder / "mine");
  const auto proposed = [&]() -> fs::path {
    d.desk.take(SaveProjectAs{});
    for (const Request& request : d.desk.take_requests())
      if (const auto* wanted = std::get_if<AskForFile>(&request)) return wanted->start.parent_path();
    return {};
  };
  d.desk.take(NewProject{});
  CHECK(proposed() == d.folder / "looked");
  d.settings.recent = {d.folder / "mine/a.json"};
  CHECK(proposed() == d.folder / "mine");
  const std::string video = (d.folder / "clips/a.mp4").string();
  d.document.apply(ChangeProject{"set footage", [&](Project& p) { p.footage.video = video; }, {}});
  CHECK(proposed() == d.folder / "clips");
}

TEST_CASE("messages of the project before are cleared when another is shown, before anything is said of that") {
  Desk d;
  d.open(d.written("a.json", "a"));
  const std::vector<Request> requests = d.desk.take_requests();
  const auto clear = std::find_if(requests.begin(), requests.end(), [](const Request& request) {
    return std::holds_alternative<ClearMessages>(request);
  });
  const auto said = std::find_if(requests.begin(), requests.end(),
                                 [](const Request& request) { return std::holds_alternative<Say>(request); });
  REQUIRE(clear != requests.end());
  CHECK(clear < said);
}
