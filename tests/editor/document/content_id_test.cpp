// SPDX-License-Identifier: MIT
#include "editor/document/content_id.h"

#include <doctest/doctest.h>

#include <functional>
#include <type_traits>

#include "base/staged_outputs.h"
#include "editor/document/document.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

Project head_on() {
  return read_project(source_dir() / "projects/head-on/head-on.json")->project;
}

}  // namespace

TEST_CASE("the content id changes with everything that affects an image, and with nothing else") {
  const ContentId id = content_id_of(head_on());
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
    CHECK(content_id_of(changed) == id);
  }
  const std::vector<std::function<void(Project&)>> telling{
      [](Project& p) { p.footage.last_frame = 9; },
      [](Project& p) { p.footage.own_body_mask.clear(); },
      [](Project& p) { p.camera.speed_mps += 1e-9; },
      [](Project& p) { p.camera.attitude_file = std::string("gyro.csv"); },
      [](Project& p) { p.camera.track.file = std::string("flight.csv"); },
      [](Project& p) { p.camera.track.offset_s = 0.001; },
      [](Project& p) { p.camera.readout_s = 0.02; },
      [](Project& p) { p.geo.heading_deg = 1; },
      [](Project& p) { p.light.ambient = 0.1; },
      [](Project& p) { p.intruders[0].name += "b"; },  // the truth has it
      [](Project& p) { p.intruders[0].trajectory.waypoints[1].position_m.z += 1e-9; },
      [](Project& p) { p.intruders[0].trajectory.waypoints[1].frame.reset(); },
      [](Project& p) { p.intruders[0].trajectory.waypoints[1].frame.emplace(0.5); },
      [](Project& p) { p.intruders[0].trajectory.waypoints.pop_back(); },
      [](Project& p) { p.intruders[0].model.length_m = 3; },
      [](Project& p) { p.compositing.method = MethodChoice::plain; },
      [](Project& p) { p.intruders.push_back(p.intruders[0]); }};
  for (const auto& change : telling) {
    Project changed = head_on();
    change(changed);
    CHECK_FALSE(content_id_of(changed) == id);
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

TEST_CASE("a file that appears or changes on disk changes the id of the files alone") {
  const TemporaryFolder folder;
  Project project;
  project.file = folder / "p.json";
  project.footage.video = "a.mp4";
  ModelStamps models;
  const ContentId content = content_id_of(project);
  const ContentId without = input_files_id_of(project, models);
  const FileStamp footage_without = footage_stamp_of(project);
  REQUIRE(write_text(folder / "a.mp4", "a", true));
  const ContentId with = input_files_id_of(project, models);
  CHECK_FALSE(with == without);
  CHECK_FALSE(footage_stamp_of(project) == footage_without);
  CHECK_FALSE(id_of(footage_stamp_of(project)) == id_of(footage_without));
  REQUIRE(write_text(folder / "a.mp4", "ab", true));
  CHECK_FALSE(input_files_id_of(project, models) == with);
  CHECK(content_id_of(project) == content);
  project.camera.track.file = "flight.csv";
  const ContentId without_log = input_files_id_of(project, models);
  REQUIRE(write_text(folder / "flight.csv", "time_s,roll_deg", true));
  CHECK_FALSE(input_files_id_of(project, models) == without_log);
  CHECK_FALSE(combined_id(content, with) == combined_id(content, without));
  CHECK_FALSE(combined_id(content, with) == combined_id(with, content));
}

TEST_CASE("the materials and textures of a model count among its files, those too that were missing") {
  const TemporaryFolder folder;
  Project project;
  project.file = folder / "p.json";
  project.intruders.resize(1);
  project.intruders[0].model.file = "a.obj";
  ModelStamps models;
  ContentId last = input_files_id_of(project, models);
  const auto is_seen = [&] {
    const ContentId before = std::exchange(last, input_files_id_of(project, models));
    return !(before == last);
  };
  CHECK_FALSE(is_seen());
  REQUIRE(write_text(folder / "a.obj", "mtllib a.mtl\n", true));
  CHECK(is_seen());
  REQUIRE(write_text(folder / "a.mtl", "newmtl skin\nmap_Kd maps/skin.png\n", true));
  CHECK(is_seen());
  std::filesystem::create_directory(folder / "maps");
  CHECK_FALSE(is_seen());
  REQUIRE(write_text(folder / "maps/skin.png", "1", true));
  REQUIRE(write_text(folder / "a.mtl", "newmtl skin\n\nmap_Kd maps/skin.png\n", true));
  CHECK(is_seen());
  REQUIRE(write_text(folder / "maps/skin.png", "12", true));
  CHECK(is_seen());
  REQUIRE(write_text(folder / "other.png", "1", true));
  CHECK_FALSE(is_seen());
  std::filesystem::remove(folder / "maps/skin.png");
  CHECK(is_seen());
}

TEST_CASE("images that are named by a pattern change the id with their folder") {
  const TemporaryFolder folder;
  Project project;
  project.footage.video = (folder / "%03d.png").string();
  ModelStamps models;
  const ContentId before = input_files_id_of(project, models);
  const FileStamp footage = footage_stamp_of(project);
  CHECK(footage.exists);
  std::filesystem::last_write_time(folder.path(), footage.changed + std::chrono::seconds(1));
  CHECK_FALSE(input_files_id_of(project, models) == before);
  CHECK_FALSE(footage_stamp_of(project) == footage);
}

TEST_CASE("undo brings the content id back with the revision, and saving elsewhere keeps it") {
  const TemporaryFolder folder;
  Document document(head_on());
  const ContentId before = document.revision().content;
  CHECK(before == content_id_of(document.project()));
  document.apply(Edit(ChangeProject{"set speed", [](Project& p) { p.camera.speed_mps += 1; }, "drag"}));
  CHECK_FALSE(document.revision().content == before);
  document.apply(Edit(Undo{}));
  CHECK(document.revision().content == before);
  document.apply(Edit(Redo{}));
  CHECK_FALSE(document.revision().content == before);
  document.apply(Edit(Undo{}));
  REQUIRE(document.save_as(folder / "x.json"));
  CHECK(document.revision().content == before);
}

TEST_CASE("an id does not keep its project alive, so that thousands of them take little memory") {
  CHECK(std::is_trivially_copyable_v<ContentId>);
  CHECK(sizeof(ContentId) <= 32);
}

TEST_CASE("names with bytes that are not UTF-8 have different ids") {
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
