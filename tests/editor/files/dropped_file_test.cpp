// SPDX-License-Identifier: MIT
#include "editor/document/project_paths.h"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::source_dir;
using sigs::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

DroppedKind kind_of(const fs::path& path) {
  return classified_drop(path).kind;
}

DroppedKind kind_of_bytes(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << bytes;
  return kind_of(folder / name);
}

Project after(const DroppedFile& dropped, const Selection& selection, Project project) {
  const std::optional<ChangeProject> change = change_by(dropped, selection);
  REQUIRE(change);
  CHECK_FALSE(change->name.empty());
  change->change(project);
  return project;
}

}  // namespace

TEST_CASE("the files of the sample projects are recognized") {
  CHECK(kind_of(source_dir() / "projects/head-on/head-on.json") == DroppedKind::project);
  for (const auto& [assets, kind] :
       {std::pair{"assets/footage", DroppedKind::video}, std::pair{"assets/calibrations", DroppedKind::calibration},
        std::pair{"assets/models", DroppedKind::model}}) {
    const std::string folder = assets;
    int found = 0;
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / folder))
      found += kind_of(entry.path()) == kind;
    CHECK_MESSAGE(found > 0, folder);
  }
}

TEST_CASE("the first bytes take precedence over the name") {
  CHECK(kind_of_bytes(std::string("\x89PNG\r\n\x1a\n"), "mask") == DroppedKind::mask);
  CHECK(kind_of_bytes(std::string("\0\0\0\x20"
                                  "ftypisom",
                                  12),
                      "clip.xml") == DroppedKind::video);
  CHECK(kind_of_bytes(std::string("RIFF\0\0\0\0AVI LIST", 16), "clip") == DroppedKind::video);
  CHECK(kind_of_bytes("\xEF\xBB\xBF\n {\"sigs\": 1}", "p.txt") == DroppedKind::project);
  CHECK(kind_of_bytes("{\"calibrator_version\": \"1\"}", "lens.json") == DroppedKind::calibration);
  CHECK(kind_of_bytes("%YAML:1.0\n---\n", "cam") == DroppedKind::calibration);
}

TEST_CASE("the name decides where the bytes do not") {
  CHECK(kind_of_bytes("v 0 0 0\n", "A.OBJ") == DroppedKind::model);
  CHECK(kind_of_bytes("camera_matrix:\n", "cam.yaml") == DroppedKind::calibration);
  CHECK(kind_of_bytes("", "clip.MP4") == DroppedKind::video);
}

TEST_CASE("an unrecognized file gives the reason") {
  const TemporaryFolder folder;
  std::ofstream(folder / "letter.doc") << "Dear Sir";
  for (const fs::path& path : {folder / "letter.doc", folder / "nowhere.mp4", folder.path(), fs::path()}) {
    const DroppedFile dropped = classified_drop(path);
    CHECK(dropped.kind == DroppedKind::nothing);
    CHECK_FALSE(dropped.problem.empty());
    CHECK_FALSE(change_by(dropped, {}));
  }
}

TEST_CASE("dropped inputs are named from the project's folder") {
  Project project;
  project.file = "/a/b/p.json";
  CHECK(after({DroppedKind::video, "/a/clip.mp4", {}}, {}, project).footage.video == "../clip.mp4");
  CHECK(after({DroppedKind::calibration, "/a/b/c.xml", {}}, {}, project).footage.calibration == "c.xml");
  CHECK(after({DroppedKind::mask, "/a/b/m.png", {}}, {}, project).footage.own_body_mask == "m.png");
}

TEST_CASE("tracking results are distinguished from calibrations and projects, and change no project") {
  CHECK(kind_of_bytes("frame,x,y,width,height\n0,1,2,3,4\n", "kcf.csv") == DroppedKind::results);
  CHECK(kind_of_bytes("1,2,3,4\n", "kcf.TXT") == DroppedKind::results);
  CHECK(kind_of_bytes(" \n[{\"img_name\": \"a.png\", \"detections\": []}]", "kcf.json") == DroppedKind::results);
  CHECK(kind_of_bytes("{\"K\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}", "lens.json") == DroppedKind::calibration);
  CHECK_FALSE(change_by({DroppedKind::results, "kcf.csv", {}}, {}));
}

TEST_CASE("a model goes to the selected intruder, else it is one more, ahead of the camera") {
  Project project;
  project.file = "/a/p.json";
  project.camera.yaw_deg = 90;
  const DroppedFile model{DroppedKind::model, "/a/models/glider.obj", {}};
  const Project added = after(model, {Selected::intruder, 3, 0}, project);
  REQUIRE(added.intruders.size() == 1);
  CHECK(added.intruders[0].name == "glider");
  CHECK(added.intruders[0].model.file == "models/glider.obj");
  REQUIRE(added.intruders[0].trajectory.waypoints.size() == 1);
  // Yaw 90 degrees looks along world Y.
  const glm::dvec3 expected = project.camera.position_m + glm::dvec3(0, 300, 0);
  CHECK(glm::distance(added.intruders[0].trajectory.waypoints[0].position_m, expected) < 1e-9);  // rounding of cos

  const Project replaced = after({DroppedKind::model, "/a/b.obj", {}}, {Selected::waypoint, 0, 0}, added);
  REQUIRE(replaced.intruders.size() == 1);
  CHECK(replaced.intruders[0].model.file == "b.obj");
  CHECK(replaced.intruders[0].name == "glider");
}
