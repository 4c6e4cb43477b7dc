// SPDX-License-Identifier: MIT
#include "editor/preview/content_id.h"

#include <doctest/doctest.h>

#include <functional>
#include <type_traits>

#include "base/staged_outputs.h"
#include "project/json.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

Project head_on() {
  return read_project(source_dir() / "projects/head-on/head-on.json")->project;
}

}  // namespace

TEST_CASE("what touches no image leaves its name alone and what does changes it") {
  const ContentId name = content_id_of(head_on());
  const std::vector<std::function<void(Project&)>> harmless{
      [](Project& p) { p.name = "another"; },
      [](Project& p) { p.own_body.frames = 9; },
      [](Project& p) { p.output.crf = 3; },
      [](Project& p) { p.output.labels.clear(); },
      [](Project& p) { p.unknown_json = std::string("{\"a\": 1}"); },
      [](Project& p) { p.intruders[0].unknown_json = std::string("{\"a\": 1}"); }};
  for (const auto& change : harmless) {
    Project changed = head_on();
    change(changed);
    CHECK(content_id_of(changed) == name);
  }
  const std::vector<std::function<void(Project&)>> telling{
      [](Project& p) { p.footage.last_frame = 9; },
      [](Project& p) { p.footage.own_body_mask.clear(); },
      [](Project& p) { p.camera.speed_mps += 1e-9; },
      [](Project& p) { p.camera.attitude_file = std::string("gyro.csv"); },
      [](Project& p) { p.light.ambient = 0.1; },
      [](Project& p) { p.intruders[0].name += "b"; },  // the truth has it
      [](Project& p) { p.intruders[0].trajectory.waypoints[1].position_m.z += 1; },
      [](Project& p) { p.intruders[0].model.length_m = 3; },
      [](Project& p) { p.compositing.method = MethodChoice::plain; },
      [](Project& p) { p.intruders.push_back(p.intruders[0]); }};
  for (const auto& change : telling) {
    Project changed = head_on();
    change(changed);
    CHECK_FALSE(content_id_of(changed) == name);
  }
}

TEST_CASE("a project saved elsewhere whose paths mean the same files keeps its images") {
  const Project project = head_on();
  Project moved = project;
  moved.file = "/tmp/elsewhere/x.json";
  CHECK_FALSE(content_id_of(moved) == content_id_of(project));
  moved.footage.video = resolved(project, project.footage.video);
  moved.footage.calibration = resolved(project, project.footage.calibration);
  moved.footage.own_body_mask = resolved(project, project.footage.own_body_mask);
  moved.intruders[0].model.file = resolved(project, project.intruders[0].model.file);
  CHECK(content_id_of(moved) == content_id_of(project));
}

TEST_CASE("a file that appears or changes on disk changes the name") {
  const TemporaryFolder folder;
  Project project;
  project.file = folder / "p.json";
  project.footage.video = "a.mp4";
  const ContentId without = content_id_of(project);
  const FileStamp footage_without = footage_stamp_of(project);
  REQUIRE(write_text(folder / "a.mp4", "a", true));
  const ContentId with = content_id_of(project);
  CHECK_FALSE(with == without);
  CHECK_FALSE(footage_stamp_of(project) == footage_without);
  REQUIRE(write_text(folder / "a.mp4", "ab", true));
  CHECK_FALSE(content_id_of(project) == with);
}

TEST_CASE("a name keeps nothing of its project, so that thousands of them take no room") {
  CHECK(std::is_trivially_copyable_v<ContentId>);
  CHECK(sizeof(ContentId) <= 32);
}

TEST_CASE("names of bytes that are no UTF-8 are told apart") {
  Project one = head_on();
  Project other = head_on();
  one.intruders[0].name = "\xE9";
  other.intruders[0].name = "\xE8";
  CHECK_FALSE(content_id_of(one) == content_id_of(other));
  one = other;
  one.intruders[0].model.file = "/nowhere/\xE9.obj";
  other.intruders[0].model.file = "/nowhere/\xE8.obj";
  CHECK_FALSE(content_id_of(one) == content_id_of(other));
}

TEST_CASE("relative paths of a project without a file start at the current directory") {
  Project project;
  project.footage.video = "a.mp4";
  CHECK(footage_stamp_of(project).path == std::filesystem::current_path() / "a.mp4");
}

TEST_CASE("equal names get equal numbers and others their own") {
  IdTable<int> book;
  const std::uint64_t three = book.id_of(3);
  const std::uint64_t five = book.id_of(5);
  CHECK(three != five);
  CHECK(three > 0);
  CHECK(book.id_of(3) == three);
  CHECK(book.id_of(5) == five);
  for (int i = 10; i < 5000; ++i) CHECK(book.id_of(i) > five);  // forgotten or not, no number comes twice
  CHECK(book.id_of(3) > five);
}
