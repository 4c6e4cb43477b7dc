// SPDX-License-Identifier: MIT
#include "scene/scene_files.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "scene/opened_project.h"
#include "scene/sample_scenes.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// A triangle that extends from the origin to `reach` along X.
std::string triangle_obj(const std::string& reach) {
  return "v 0 0 0\nv " + reach + " 0 0\nv 0 1 0\nf 1 2 3\n";
}

// As an editor does that saves within the clock's resolution: the clock is advanced explicitly.
void put_clock_forward(const std::filesystem::path& path) {
  std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(2));
}

}  // namespace

TEST_CASE("the same file and axes give the same model and others give another") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", triangle_obj("4"));
  SceneFiles files;
  const auto model = files.model(folder / "a.obj", {}).value();
  CHECK(files.model(folder / "a.obj", {}).value() == model);
  CHECK(files.model(folder.path() / "." / "a.obj", {}).value() == model);
  // Scales that agree in six decimals are still different.
  const auto small = files.model(folder / "a.obj", {.scale = 1e-9}).value();
  const auto smaller = files.model(folder / "a.obj", {.scale = 2e-9}).value();
  CHECK(small != smaller);
  CHECK(smaller->mesh.high_m.x == doctest::Approx(8e-9).epsilon(1e-6));
  CHECK(files.model(folder / "a.obj", {}).value() == model);
}

TEST_CASE("a model that was saved again is read again, and its scenes keep the former one") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.obj";
  write_text(file, triangle_obj("4"));
  SceneFiles files;
  const auto before = files.model(file, {}).value();
  SUBCASE("of another size") {
    write_text(file, triangle_obj("5.0"));
  }
  SUBCASE("of the same size") {
    write_text(file, triangle_obj("5"));
    put_clock_forward(file);
  }
  const auto after = files.model(file, {}).value();
  CHECK(after != before);
  CHECK(before->mesh.high_m.x == 4);
  CHECK(after->mesh.high_m.x == 5);
}

TEST_CASE("an error lasts until the file is repaired") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.obj";
  SceneFiles files;
  CHECK(files.model(file, {}).error().kind == ErrorKind::cannot_read);
  write_text(file, "v 0 0 0\n");
  const Error broken = files.model(file, {}).error();
  CHECK(broken.kind == ErrorKind::bad_data);
  CHECK(files.model(file, {}).error().text() == broken.text());
  write_text(file, triangle_obj("4"));
  CHECK(files.model(file, {}).has_value());
  std::filesystem::remove(file);
  CHECK(files.model(file, {}).error().kind == ErrorKind::cannot_read);
  CHECK_FALSE(files.model(file, {.scale = std::numeric_limits<double>::quiet_NaN()}).has_value());
  CHECK_FALSE(files.model(folder.path(), {}).has_value());
  CHECK_FALSE(files.model("", {}).has_value());
}

TEST_CASE("unused models are released after a while, used ones never") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", triangle_obj("4"));
  SceneFiles files;
  const auto held = files.model(folder / "a.obj", {}).value();
  std::weak_ptr<const Model> idle = files.model(folder / "a.obj", {.scale = 0.5}).value();
  CHECK_FALSE(idle.expired());
  for (int i = 1; i < 40; ++i) REQUIRE(files.model(folder / "a.obj", {.scale = 1.0 + i}).has_value());
  CHECK(idle.expired());
  CHECK(files.model(folder / "a.obj", {}).value() == held);
}

TEST_CASE("a camera is scaled to each footage and a mask belongs to one size") {
  const std::filesystem::path calibration = source_dir() / "assets/calibrations/sample.xml";
  const std::filesystem::path mask = source_dir() / "assets/footage/sample_own_body.png";
  SceneFiles files;
  for (int round = 0; round < 2; ++round) {
    for (const cv::Size size : {cv::Size(1280, 960), cv::Size(640, 480)}) {
      const LensParameters expected = read_calibration(calibration, size).value().lens.parameters();
      const Camera camera = files.camera(calibration, {.size_px = size}).value();
      CHECK(camera.lens.parameters().fx == expected.fx);
      CHECK(camera.size_px == size);
    }
    CHECK(files.own_body_mask(mask, {640, 480}).error().kind == ErrorKind::bad_data);
    CHECK(same_bits(files.own_body_mask(mask, {1280, 960}).value(), read_own_body_mask(mask, {1280, 960}).value()));
  }
  CHECK(files.own_body_mask(mask, {1280, 960}).value().data == files.own_body_mask(mask, {1280, 960}).value().data);
}

TEST_CASE("an attitude file that was saved again is read again") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "gyro.csv";
  const std::string header = "frame,roll_deg,pitch_deg,yaw_deg\n";
  SceneFiles files;
  CHECK(files.attitudes(file).error().kind == ErrorKind::cannot_read);
  write_text(file, header + "0,0,0,1\n");
  CHECK(files.attitudes(file).value().size() == 1);
  write_text(file, header + "0,0,0,1\n1,0,0,2\n");
  CHECK(files.attitudes(file).value().size() == 2);
  write_text(file, header + "0,0,0,x\n1,0,0,2\n");
  put_clock_forward(file);
  CHECK(files.attitudes(file).error().kind == ErrorKind::bad_data);
}

TEST_CASE("a scene that is opened again after a waypoint moved shares everything else") {
  Project project = sample_project("two-intruders");
  SceneFiles files;
  const Scene before = open_scene(project, sample_footage(), files).value();
  project.intruders[1].trajectory.waypoints[1].position_m.z -= 10;
  const Scene after = open_scene(project, sample_footage(), files).value();
  CHECK(before.models == after.models);
  CHECK(before.intruders[0].model == after.intruders[0].model);
  CHECK(before.own_body.data == after.own_body.data);
  CHECK(before.intruders[1].trajectory.position_m(4).z > after.intruders[1].trajectory.position_m(4).z);
}

TEST_CASE("a mesh's warnings are given each time a scene is opened, once for all its intruders") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", "mtllib none.mtl\n" + triangle_obj("4"));
  Project project = sample_project("two-intruders");
  for (IntruderSettings& intruder : project.intruders) intruder.model.file = (folder / "a.obj").string();
  SceneFiles files;
  const std::vector<Warning> alone = open_scene(project, sample_footage()).value().warnings;
  REQUIRE(alone.size() == 1);
  for (int round = 0; round < 3; ++round) {
    const Scene scene = open_scene(project, sample_footage(), files).value();
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0].text() == alone[0].text());
    CHECK(scene.models.size() == 1);
  }
}

TEST_CASE("a scene outlives the files that it was made from") {
  auto files = std::make_unique<SceneFiles>();
  const Scene scene = open_scene(sample_project("crossing"), sample_footage(), *files).value();
  files.reset();
  CHECK(scene.intruders[0].model == scene.models[0].get());
  CHECK(scene.intruders[0].model->mesh.vertices.size() > 1000);
}
