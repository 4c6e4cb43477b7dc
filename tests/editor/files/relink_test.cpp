// SPDX-License-Identifier: MIT
#include "editor/document/project_paths.h"

#include <doctest/doctest.h>

#include <fstream>

#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

void touch(const fs::path& path) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << "x";
}

Project project_in(const fs::path& folder) {
  Project project;
  project.file = folder / "p/p.json";
  project.footage.video = "../footage/day/clip.mp4";
  project.footage.calibration = "../calibrations/cam.xml";
  project.intruders.resize(2);
  project.intruders[0].model.file = (folder / "models/a.obj").string();
  project.intruders[1].model.file = (folder / "models/a.obj").string();
  return project;
}

fs::path place_of(const std::vector<Relinked>& places, const std::string& field) {
  for (const Relinked& relinked : places)
    if (relinked.field == field) return relinked.place;
  return {};
}

}  // namespace

TEST_CASE("missing files are named by field and path; existing and unnamed ones are not") {
  const TemporaryFolder folder;
  touch(folder / "calibrations/cam.xml");
  const std::vector<MissingFile> missing = missing_files(project_in(folder.path()));
  REQUIRE(missing.size() == 3);
  CHECK(missing[0] == MissingFile{"footage.video", "../footage/day/clip.mp4", folder / "footage/day/clip.mp4"});
  CHECK(missing[1].field == "intruders[0].model.file");
  CHECK(missing[2].field == "intruders[1].model.file");
}

TEST_CASE("a folder or a pattern of images, and a camera of a rig's calibration, are no missing files") {
  const TemporaryFolder folder;
  Project project;
  project.file = folder / "p.json";
  for (const char* file : {"images/01.png", "images/02.png", "rig.yaml"}) touch(folder / file);
  project.footage.calibration = "rig.yaml#cam1";
  for (const char* video : {"images", "images/%02d.png"}) {
    project.footage.video = video;
    CHECK(missing_files(project).empty());
  }
  project.footage.video = "images/%03d.png";
  project.footage.calibration = "another.yaml#cam1";
  const std::vector<MissingFile> missing = missing_files(project);
  REQUIRE(missing.size() == 2);
  CHECK(place_at(missing[1], folder / "rig.yaml") == folder / "rig.yaml#cam1");
}

TEST_CASE("a sequence and a rig's calibration that have moved are found with one of them") {
  const TemporaryFolder folder;
  for (const char* file : {"images/01.png", "images/02.png", "rig.yaml"}) touch(folder / "disk2" / file);
  Project project;
  project.file = folder / "p.json";
  project.footage.video = "images/%02d.png";
  project.footage.calibration = "rig.yaml#cam1";
  const std::vector<MissingFile> missing = missing_files(project);
  REQUIRE(missing.size() == 2);
  const fs::path video = place_at(missing[0], folder / "disk2/images/01.png");
  CHECK(video == folder / "disk2/images/%02d.png");
  const auto places = suggested_places(missing, missing[0], video);
  CHECK(place_of(places, "footage.calibration") == folder / "disk2/rig.yaml#cam1");
  relink(project, {{"footage.video", video}, places.front()});
  CHECK(missing_files(project).empty());
}

TEST_CASE("a folder tree that moved as a whole is found from one of its files") {
  const TemporaryFolder folder;
  for (const char* file : {"footage/day/clip.mp4", "calibrations/cam.xml", "models/a.obj"})
    touch(folder / "disk2/archive" / file);
  const std::vector<MissingFile> missing = missing_files(project_in(folder.path()));
  REQUIRE(missing.size() == 4);
  const auto places = suggested_places(missing, missing[0], folder / "disk2/archive/footage/day/clip.mp4");
  CHECK(places.size() == 3);
  CHECK(place_of(places, "footage.calibration") == folder / "disk2/archive/calibrations/cam.xml");
  CHECK(place_of(places, "intruders[0].model.file") == folder / "disk2/archive/models/a.obj");
  CHECK(place_of(places, "intruders[1].model.file") == folder / "disk2/archive/models/a.obj");
}

TEST_CASE("files collected in one folder are found there") {
  const TemporaryFolder folder;
  for (const char* file : {"clip.mp4", "cam.xml", "a.obj"}) touch(folder / "all" / file);
  const std::vector<MissingFile> missing = missing_files(project_in(folder.path()));
  const auto places = suggested_places(missing, missing[0], folder / "all/clip.mp4");
  CHECK(place_of(places, "footage.calibration") == folder / "all/cam.xml");
  CHECK(place_of(places, "intruders[1].model.file") == folder / "all/a.obj");
}

TEST_CASE("a renamed file is the same one for all fields that had it") {
  const TemporaryFolder folder;
  touch(folder / "new/b.obj");
  const std::vector<MissingFile> missing = missing_files(project_in(folder.path()));
  const auto places = suggested_places(missing, missing[2], folder / "new/b.obj");
  REQUIRE(places.size() == 1);
  CHECK(places[0] == Relinked{"intruders[1].model.file", folder / "new/b.obj"});
}

TEST_CASE("no missing file is proposed") {
  const TemporaryFolder folder;
  touch(folder / "new/clip.mp4");
  const std::vector<MissingFile> missing = missing_files(project_in(folder.path()));
  CHECK(suggested_places(missing, missing[0], folder / "new/clip.mp4").empty());
  CHECK(suggested_places(missing, missing[0], "/").empty());
}

TEST_CASE("relinked, the project names its files from its own folder, and none is missing") {
  const TemporaryFolder folder;
  for (const char* file : {"clip.mp4", "cam.xml", "a.obj"}) touch(folder / "all" / file);
  Project project = project_in(folder.path());
  const std::vector<MissingFile> missing = missing_files(project);
  auto places = suggested_places(missing, missing[0], folder / "all/clip.mp4");
  places.push_back({missing[0].field, folder / "all/clip.mp4"});
  places.push_back({"intruders[7].model.file", folder / "all/a.obj"});
  relink(project, places);
  CHECK(project.footage.video == "../all/clip.mp4");
  CHECK(missing_files(project).empty());
}
