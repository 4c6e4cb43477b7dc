// SPDX-License-Identifier: MIT
#include "editor/document/document.h"

#include <doctest/doctest.h>

#include <string>

using namespace sigs;
using namespace sigs::editor;

namespace {

Document document_with_intruder() {
  Project project;
  project.intruders.push_back({.name = "glider"});
  project.intruders[0].trajectory.waypoints = {{.frame = {}, .position_m = {300, 0, -150}}};
  return Document(project);
}

// "camera.speed_mps light ", in the order in which they are listed.
std::string fields_of(const Guesses& guesses) {
  std::string fields;
  for (const Problem& guess : guesses.left()) fields += guess.field + " ";
  return fields;
}

void change(Document& document, const std::function<void(Project&)>& what) {
  document.apply(ChangeProject{"change", what, {}});
}

}  // namespace

TEST_CASE("a guess is listed until its setting is changed, and again when that is undone") {
  Document document = document_with_intruder();
  Guesses guesses;
  guesses.begin(
      {{{"camera.speed_mps", "no log"}}, {{"light", "seen in 5 frames"}}, {{"intruders[0].trajectory", "crosses"}}},
      document);
  const std::string all = "camera.speed_mps light intruders[0].trajectory ";
  CHECK(fields_of(guesses) == all);

  change(document, [](Project& p) { p.camera.yaw_deg = 20; });  // nobody guessed that
  guesses.follow(document);
  CHECK(fields_of(guesses) == all);

  change(document, [](Project& p) { p.camera.speed_mps = 31; });
  guesses.follow(document);
  CHECK(fields_of(guesses) == "light intruders[0].trajectory ");

  change(document, [](Project& p) { p.light.ambient = 0.5; });  // a part of a group is a change of it
  change(document, [](Project& p) { p.intruders[0].trajectory.waypoints[0].position_m.x = 400; });
  guesses.follow(document);
  CHECK(guesses.left().empty());

  for (int i = 0; i < 3; ++i) document.apply(Undo{});
  guesses.follow(document);
  CHECK(fields_of(guesses) == all);
}

TEST_CASE("guesses go with the project that they were made for") {
  Document document = document_with_intruder();
  Guesses guesses;
  guesses.begin({{{"camera.speed_mps", "no log"}}}, document);
  document = Document(Project(), document.last_number() + 1);
  guesses.follow(document);
  CHECK(guesses.left().empty());
}

TEST_CASE("a guess in a setting that no project has stays, whatever its name") {
  Document document = document_with_intruder();
  Guesses guesses;
  guesses.begin({{{"", "?"}}, {{"intruders[9].model", "?"}}, {{"a~b[", "?"}}}, document);
  change(document, [](Project& p) { p.camera.yaw_deg = 20; });
  guesses.follow(document);
  CHECK(guesses.left().size() == 3);
}
