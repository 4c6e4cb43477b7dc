// SPDX-License-Identifier: MIT
#include "project/project.h"

#include <doctest/doctest.h>

#include "editor/document/document.h"
#include "editor/document/field_edits.h"
#include "editor/document/project_edits.h"
#include "editor/document/project_paths.h"
#include "project/json.h"
#include "project/validate.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

// Three cameras; the last has a look of its own.
Project rig_project() {
  Project project;
  project.name = "rig";
  project.file = "/flights/rig.json";
  for (const char* name : {"front", "left", "narrow"}) {
    RigCamera camera;
    camera.name = name;
    camera.footage.video = std::string(name) + ".mp4";
    camera.footage.calibration = std::string(name) + ".yaml";
    camera.mount.yaw_deg = -30.0 * static_cast<double>(project.cameras.size());
    camera.clock.offset_s = 0.25 * static_cast<double>(project.cameras.size());
    project.cameras.push_back(camera);
  }
  project.cameras[2].appearance = AppearanceSettings();
  project.cameras[0].footage.last_frame = 99;
  project.intruders.emplace_back().trajectory.waypoints = {{.frame = 0, .position_m = {300, 0, -150}},
                                                           {.frame = 90, .position_m = {300, 50, -150}}};
  return project;
}

ChangeProject put(const std::string& key, const PlainValue& value, std::string gesture = {}) {
  return {"change " + key, [=](Project& project) { CHECK(put_value(project, key, value)); }, std::move(gesture)};
}

}  // namespace

TEST_CASE("settings of a camera that are changed while it is active are that camera's, and undo brings all back") {
  const Project whole = rig_project();
  Document document(whole);
  document.apply(Edit(ActivateCamera{1}));
  document.apply(Edit(put("footage.calibration", std::string("other.yaml"))));
  document.apply(Edit(put("mount.position_m", glm::dvec3(0.5, -1, 2))));
  document.apply(Edit(put("clock.offset_s", 1.5)));
  document.apply(Edit(put("camera.speed_mps", 40.0)));
  Project expected = whole;
  expected.cameras[1].footage.calibration = "other.yaml";
  expected.cameras[1].mount.position_m = {0.5, -1, 2};
  expected.cameras[1].clock.offset_s = 1.5;
  expected.camera.speed_mps = 40;
  CHECK(document.whole() == expected);
  CHECK(document.project().footage.calibration == "other.yaml");
  CHECK(document.project().name == "rig");
  document.apply(Edit(ActivateCamera{0}));  // undo reaches what was done through another camera
  for (int i = 0; i < 4; ++i) document.apply(Edit(Undo{}));
  CHECK(document.whole() == whole);
  CHECK_FALSE(document.can_undo());
  for (int i = 0; i < 4; ++i) document.apply(Edit(Redo{}));
  CHECK(document.whole() == expected);
}

TEST_CASE("a look that is changed is from then on the active camera's own, and that of one which has one stays there") {
  for (const std::size_t camera : {std::size_t(0), std::size_t(2)}) {
    const Project whole = rig_project();
    Document document(whole);
    document.apply(Edit(ActivateCamera{camera}));
    document.apply(Edit(put("appearance.psf_sigma_px", 1.25)));
    CHECK(document.whole().appearance == whole.appearance);
    REQUIRE(document.whole().cameras[camera].appearance);
    CHECK(document.whole().cameras[camera].appearance->psf_sigma_px == 1.25);
    CHECK(document.whole().cameras[1] == whole.cameras[1]);
  }
}

TEST_CASE("looking through another camera is no change; revisions tell the cameras of one state apart") {
  Document document(rig_project(), 7);
  const Revision first = document.revision();
  CHECK(first.number == 7);
  document.apply(Edit(ActivateCamera{2}));
  const Revision third = document.revision();
  CHECK(third.number != first.number);
  CHECK(state_number(third.number) == 7);
  CHECK(third.content != first.content);
  CHECK(document.state().number == 7);
  CHECK_FALSE(document.has_unsaved_changes());
  CHECK_FALSE(document.can_undo());
  CHECK(document.project().footage.video == "narrow.mp4");
  document.apply(Edit(ActivateCamera{9}));
  CHECK(document.active_camera() == 2);
  document.apply(Edit(ActivateCamera{0}));
  CHECK(document.revision() == first);
}

TEST_CASE("the playhead counts the first camera's frames, whichever camera is active") {
  Document document(rig_project());
  document.set_frame_count(190);
  for (const std::size_t camera : {std::size_t(0), std::size_t(1), std::size_t(2)}) {
    document.apply(Edit(ActivateCamera{camera}));
    document.apply(Edit(GoToFrame{150}));
    CHECK(document.last_frame() == 99);
    CHECK(document.playhead() == 99);
  }
}

TEST_CASE("a waypoint that is dragged through one camera moves for all, and Escape takes it back") {
  const Project whole = rig_project();
  Document document(whole);
  document.apply(Edit(ActivateCamera{1}));
  Edits edits;
  for (int i = 1; i <= 5; ++i) edits.move_waypoint(0, 1, {300, 50.0 + i, -150}, "drag");
  document.apply(edits.take_edits());
  for (std::size_t camera = 0; camera < 3; ++camera)
    CHECK(revision_of_camera(document.state(), camera).project->intruders[0].trajectory.waypoints[1].position_m.y ==
          55);
  document.apply(Edit(CancelGesture{"drag"}));
  CHECK(document.whole() == whole);
}

TEST_CASE("a project with one camera is itself what is seen, and its content is that of before") {
  Document document{Project()};
  document.apply(Edit(put("camera.speed_mps", 40.0)));
  CHECK(document.revision().project == document.state().project);
  CHECK(document.revision().number == document.state().number);
  CHECK(document.cameras().empty());
  document.apply(Edit(ActivateCamera{3}));
  CHECK(document.active_camera() == 0);
}

TEST_CASE("a rig is saved with its cameras, and read back the same") {
  const sigs::test::TemporaryFolder folder;
  Document document(rig_project());
  document.apply(Edit(ActivateCamera{1}));
  document.apply(Edit(put("mount.attitude_deg.roll", 4.0)));
  REQUIRE(document.save_as(folder.path() / "saved.json"));
  CHECK(document.active_camera() == 1);
  CHECK_FALSE(document.has_unsaved_changes());
  const Project read = read_project(folder.path() / "saved.json").value().project;
  CHECK(read == document.whole());
  CHECK(read.cameras[1].mount.roll_deg == 4);
}

TEST_CASE("the images of a camera depend on its mount, its clock and the first camera's frames, not on other cameras") {
  const Project whole = rig_project();
  const auto content_of = [](const Project& project, std::size_t camera) {
    return revision_of_camera({1, std::make_shared<const Project>(project)}, camera).content;
  };
  const auto changed = [&](const auto& change) {
    Project other = whole;
    change(other);
    return content_of(other, 1) != content_of(whole, 1);
  };
  CHECK(changed([](Project& p) { p.cameras[1].mount.position_m.x = 0.1; }));
  CHECK(changed([](Project& p) { p.cameras[1].clock.drift_ppm = 3; }));
  CHECK(changed([](Project& p) { p.cameras[0].footage.last_frame = 80; }));
  CHECK(changed([](Project& p) { p.cameras[0].footage.video = "another.mp4"; }));
  CHECK(changed([](Project& p) { p.cameras[0].mount.yaw_deg = 1; }));  // a log of its attitude is that one's
  CHECK_FALSE(changed([](Project& p) { p.cameras[2].mount.yaw_deg = 1; }));
  CHECK_FALSE(changed([](Project& p) { p.cameras[2].footage.video = "another.mp4"; }));
  CHECK_FALSE(changed([](Project& p) { p.name = "another"; }));
}

TEST_CASE("adding a camera makes a rig of a project, whose first camera has what the project had") {
  Project project = rig_project();
  project.cameras.clear();
  project.footage = rig_project().cameras[0].footage;
  const Project before = project;
  add_camera(project, "/flights/tail.mp4");
  add_camera(project, "/elsewhere/tail.mp4");
  REQUIRE(project.cameras.size() == 3);
  CHECK(project.cameras[0].name == "camera 1");
  CHECK(project.cameras[0].footage == before.footage);
  CHECK(project.cameras[0].mount == MountSettings());
  CHECK(project.cameras[1].name == "tail");
  CHECK(project.cameras[1].footage.video == "tail.mp4");
  CHECK(project.cameras[2].name == "tail 2");
  CHECK(resolved(project, project.cameras[2].footage.video).lexically_normal() == "/elsewhere/tail.mp4");
  for (const Problem& problem : validate(project)) CHECK(problem.field.find("name") == std::string::npos);
  const Project seen = seen_by(project, 0);
  CHECK(seen.footage == before.footage);
  CHECK(seen.appearance == before.appearance);
  CHECK(seen.camera == before.camera);

  remove_camera(project, 0);  // stays
  CHECK(project.cameras.size() == 3);
  remove_camera(project, 1);
  CHECK(project.cameras[1].name == "tail 2");
  remove_camera(project, 1);
  CHECK(project == before);
}

TEST_CASE("a rig whose only camera left sits elsewhere on the aircraft stays one") {
  Project project = rig_project();
  project.cameras[0].mount.position_m = {1, 0, 0};
  remove_camera(project, 2);
  remove_camera(project, 1);
  CHECK(project.cameras.size() == 1);
}

TEST_CASE("removing the active camera makes the one before it active, and undo brings it back") {
  Document document(rig_project());
  document.apply(Edit(ActivateCamera{2}));
  document.apply(Edit(ChangeProject{"remove", [](Project& p) { remove_camera(p, 2); }, {}, ChangeOf::whole}));
  CHECK(document.cameras().size() == 2);
  CHECK(document.active_camera() == 1);
  document.apply(Edit(Undo{}));
  CHECK(document.cameras().size() == 3);
}

TEST_CASE("a camera has a name of its own that can be part of a file's name") {
  const Project whole = rig_project();
  CHECK(why_not_called(whole, 1, "left").empty());
  CHECK(why_not_called(whole, 1, "port side").empty());
  CHECK_FALSE(why_not_called(whole, 1, "front").empty());
  CHECK_FALSE(why_not_called(whole, 1, "").empty());
  CHECK_FALSE(why_not_called(whole, 1, "a/b").empty());
}

TEST_CASE("files that are made for one camera of a rig are called after it") {
  const Project seen = seen_by(rig_project(), 1);
  CHECK(file_beside(seen, ".mask", ".png") == "/flights/rig.left.mask.png");
  Project single = rig_project();
  single.cameras.clear();
  CHECK(file_beside(single, ".mask", ".png") == "/flights/rig.mask.png");
}

TEST_CASE("a rig's fields have defaults to go back to, mount and clock among them") {
  const Project seen = seen_by(rig_project(), 1);
  const FieldSheet sheet(seen);
  const Field* const yaw = sheet.find("mount.attitude_deg.yaw");
  REQUIRE(yaw != nullptr);
  CHECK(sheet.default_of(*yaw) == PlainValue(0.0));
  CHECK(sheet.can_be_reset(*yaw));
  CHECK(sheet.find("clock.offset_s") != nullptr);
  CHECK(FieldSheet(Project()).find("mount.attitude_deg.yaw") == nullptr);
}
