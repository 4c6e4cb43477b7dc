// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "desk.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("a project that is read while a question is open waits for the answer") {
  for (const int answer : {1, 2}) {  // don't save; cancel
    Desk d;
    d.open(d.written("a.json", "a"));
    d.desk.take(OpenProject{d.written("b.json", "b")});
    d.edit("quick");
    d.desk.take(Quit{});
    REQUIRE(d.desk.question());
    d.wait_for_disk();
    REQUIRE(d.desk.question());
    d.desk.answer(answer);
    CHECK(d.desk.is_done() == (answer == 1));  // it was quitting that was asked for
    CHECK(d.document.project().name == "quick");
    if (answer == 1) continue;
    d.wait();
    REQUIRE_MESSAGE(d.desk.question(), "then the project that waits is asked for");
    d.desk.answer(2);
    CHECK(d.document.project().name == "quick");
    CHECK_FALSE(d.desk.question());
  }
}

TEST_CASE("whatever comes while a question is open is asked for after it") {
  Desk d;
  const fs::path other = d.written("b.json", "b");
  Edits edits;
  d.open(d.written("a.json", "a"));
  d.edit("mine");
  d.desk.take(NewProject{});
  REQUIRE(d.desk.question());
  d.desk.take_dropped(other, edits);
  d.desk.take(Quit{});  // the window's close button
  d.desk.answer(2);     // no new project
  REQUIRE(d.desk.question());
  CHECK(d.document.project().name == "mine");
  d.desk.answer(2);  // nor the one that was dropped
  REQUIRE(d.desk.question());
  d.desk.answer(0);  // but quit, and save
  CHECK(d.desk.is_done());
  CHECK(read_project(d.folder / "a.json")->project.name == "mine");
}

TEST_CASE("a name that is asked for saves the project that it was asked for, and no other") {
  Desk d;
  d.desk.take(NewProject{});
  d.edit("mine");
  d.desk.take(Quit{});
  d.desk.answer(0);  // save it: under which name?
  std::function<void(const fs::path&)> chosen;
  for (const Request& request : d.desk.take_requests())
    if (const auto* wanted = std::get_if<AskForFile>(&request)) chosen = wanted->chosen;
  REQUIRE(chosen);
  d.desk.take(OpenProject{d.written("b.json", "b")});
  d.desk.answer(1);  // don't save
  d.wait();
  REQUIRE(d.document.project().name == "b");
  chosen(d.folder / "mine.json");
  CHECK_FALSE(fs::exists(d.folder / "mine.json"));
  CHECK_FALSE(d.desk.is_done());
}
