// SPDX-License-Identifier: MIT
#include "editor/document/project_paths.h"

#include <doctest/doctest.h>

#include <filesystem>

using namespace sigs;
using namespace sigs::editor;
namespace fs = std::filesystem;

namespace {

Project at(const fs::path& file) {
  Project project;
  project.file = file;
  project.footage.video = "../clips/a.mp4";
  project.footage.calibration = "/calibrations/b.xml";
  project.intruders.push_back({});
  project.intruders[0].model.file = "c.obj";
  return project;
}

fs::path meant(const Project& project, const std::string& path) {
  return fs::absolute(resolved(project, path)).lexically_normal();
}

}  // namespace

TEST_CASE("a project that moves means the same files") {
  const Project before = at("/home/a/projects/x.json");
  for (const fs::path target :
       {"/home/a/projects/deeper/still/y.json", "/home/y.json", "/z.json", "/other/place/y.json"}) {
    const Project after = moved_to(before, target);
    CHECK(after.file == target);
    CHECK(meant(after, after.footage.video) == "/home/a/clips/a.mp4");
    CHECK(meant(after, after.intruders[0].model.file) == "/home/a/projects/c.obj");
    CHECK(after.footage.calibration == "/calibrations/b.xml");
    CHECK(fs::path(after.footage.video).is_relative());
    CHECK(after.footage.own_body_mask.empty());
  }
}

TEST_CASE("a new name in the same folder changes no path") {
  const Project before = at("/home/a/projects/x.json");
  Project after = moved_to(before, "/home/a/projects/y.json");
  after.file = before.file;
  CHECK(after == before);
}

TEST_CASE("a project without a file names files absolutely, from the current folder") {
  Project project = at("");
  CHECK(path_in_project(project, "/x/y.mp4") == "/x/y.mp4");
  CHECK(fs::path(path_in_project(project, "y.mp4")) == fs::absolute("y.mp4").lexically_normal());
  const Project saved = moved_to(project, fs::current_path() / "sub/p.json");
  CHECK(meant(saved, saved.intruders[0].model.file) == fs::current_path() / "c.obj");
}

TEST_CASE("a project's first save beside its files names them relatively, far ones absolutely") {
  Project project;
  project.footage.video = "/home/a/clips/a.mp4";
  project.footage.calibration = "/calibrations/b.xml";
  project.intruders.resize(1);
  project.intruders[0].model.file = "/home/a/b/c/d/e/c.obj";
  const Project saved = moved_to(project, "/home/a/b/c/d/e/p.json");
  CHECK(saved.intruders[0].model.file == "c.obj");
  CHECK(saved.footage.video == "../../../../clips/a.mp4");
  CHECK(saved.footage.calibration == "/calibrations/b.xml");
}

TEST_CASE("a file near the project is named relative to it, one far away absolutely") {
  const Project project = at("/home/a/b/c/d/e/x.json");
  CHECK(path_in_project(project, "/home/a/b/c/d/e/v.mp4") == "v.mp4");
  CHECK(path_in_project(project, "/home/a/b/v.mp4") == "../../../v.mp4");
  CHECK(path_in_project(project, "/mnt/v.mp4") == "/mnt/v.mp4");
}
