// SPDX-License-Identifier: MIT
#include "scene/draft.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "project/fields.h"
#include "scene/opened_project.h"
#include "scene/sample_scenes.h"
#include "scene/scene_at.h"

using namespace sigs;
using namespace sigs::test;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

DraftScene drafted(const Project& project) {
  SceneFiles files;
  return draft_scene(project, sample_footage(), files);
}

int problems_of(const DraftScene& draft, const std::string& field) {
  return static_cast<int>(std::count_if(draft.problems.begin(), draft.problems.end(),
                                        [&](const Problem& problem) { return problem.field == field; }));
}

bool same(const Pose<frame::Camera, frame::Body>& a, const Pose<frame::Camera, frame::Body>& b) {
  return a.rotation == b.rotation && a.translation_m == b.translation_m;
}

bool same(const Vertex& a, const Vertex& b) {
  return a.position_m == b.position_m && a.normal == b.normal && a.uv == b.uv;
}

void check_same_model(const Model& a, const Model& b) {
  CHECK(a.mesh.indices == b.mesh.indices);
  REQUIRE(a.mesh.vertices.size() == b.mesh.vertices.size());
  CHECK(std::equal(a.mesh.vertices.begin(), a.mesh.vertices.end(), b.mesh.vertices.begin(),
                   [](const Vertex& left, const Vertex& right) { return same(left, right); }));
  CHECK(a.points_m == b.points_m);
}

void check_same_moment(const Scene& a, const Scene& b, int frame) {
  const SceneMoment left = scene_at(a, frame);
  const SceneMoment right = scene_at(b, frame);
  CHECK(left.time_s == right.time_s);
  CHECK(left.light_in_camera == right.light_in_camera);
  REQUIRE(left.intruders.size() == right.intruders.size());
  for (std::size_t i = 0; i < left.intruders.size(); ++i) {
    CHECK(left.intruders[i].id == right.intruders[i].id);
    CHECK(same(left.intruders[i].camera_from_body, right.intruders[i].camera_from_body));
  }
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_sound(const DraftScene& draft) {
  const Scene& scene = draft.scene;
  CHECK(0 <= scene.first_frame);
  CHECK(scene.first_frame <= scene.last_frame);
  CHECK(scene.last_frame < static_cast<int>(scene.footage.times_s.size()));
  CHECK(scene.compositing.supersampling >= 1);
  CHECK(blur_by_distance_px_per_m(scene.compositing) >= 0);
  for (const int frame : {scene.first_frame, scene.last_frame}) {
    const SceneMoment moment = scene_at(scene, frame);
    CHECK(is_finite(moment.light_in_camera));
    for (const PlacedIntruder& placed : moment.intruders) CHECK(is_finite(placed.camera_from_body.translation_m));
  }
  std::set<std::string> fields;
  for (const Problem& problem : draft.problems) CHECK_MESSAGE(fields.insert(problem.field).second, problem.field);
}

// The project with one number set to a value; vectors in their middle part. False where the field is no number.
bool set_number(const Field& field, double value) {
  if (auto* const number = std::get_if<double*>(&field.value)) return **number = value, true;
  if (auto* const vector = std::get_if<glm::dvec3*>(&field.value)) return (**vector)[1] = value, true;
  if (auto* const number = std::get_if<std::optional<double>*>(&field.value)) return **number = value, true;
  const double whole = std::isfinite(value) ? std::clamp(value, -2e9, 2e9) : -7;
  if (auto* const number = std::get_if<int*>(&field.value)) return **number = static_cast<int>(whole), true;
  if (auto* const number = std::get_if<std::optional<int>*>(&field.value))
    return **number = static_cast<int>(whole), true;
  return false;
}

}  // namespace

TEST_CASE("the draft of a project without problems is what open_scene gives") {
  for (const char* const name : kSampleProjects) {
    const Project project = sample_project(name);
    const Scene opened = open_scene(project, sample_footage()).value();
    const DraftScene draft = drafted(project);
    CHECK(draft.problems.empty());
    CHECK(draft.scene.camera.lens.parameters() == opened.camera.lens.parameters());
    CHECK(draft.scene.camera.size_px == opened.camera.size_px);
    CHECK(same_bits(draft.scene.own_body, opened.own_body));
    CHECK_FALSE(opened.own_body.empty());
    CHECK(draft.scene.motion.attitudes.empty());
    CHECK(draft.scene.light.color == opened.light.color);
    CHECK(draft.scene.compositing.blur_px_per_m == opened.compositing.blur_px_per_m);
    CHECK(draft.scene.first_frame == opened.first_frame);
    CHECK(draft.scene.last_frame == opened.last_frame);
    REQUIRE(draft.scene.intruders.size() == opened.intruders.size());
    for (std::size_t i = 0; i < opened.intruders.size(); ++i) {
      CHECK(draft.intruder_of_project[i] == static_cast<int>(i));
      CHECK(draft.scene.intruders[i].name == opened.intruders[i].name);
      check_same_model(*draft.scene.intruders[i].model, *opened.intruders[i].model);
    }
    for (int frame = 0; frame < 200; ++frame) check_same_moment(draft.scene, opened, frame);
  }
}

TEST_CASE("the placeholder of a missing calibration is a pinhole with a horizontal field of view of 60 degrees") {
  Project project = sample_project("crossing");
  SUBCASE("missing") {
    project.footage.calibration = "none.xml";
  }
  SUBCASE("no calibration") {
    project.footage.calibration = "crossing.json";
  }
  SUBCASE("not named") {
    project.footage.calibration = "";
  }
  const DraftScene draft = drafted(project);
  CHECK(draft.problems.size() == 1);
  CHECK(problems_of(draft, "footage.calibration") == 1);
  const Lens& lens = draft.scene.camera.lens;
  CHECK(lens.is_pinhole());
  // The image's edges are half a pixel outside the centres of the first and last column.
  const double half_rad = std::acos(-1.0) / 6;
  CHECK(lens.pixel({std::cos(half_rad), std::sin(half_rad), 0})->x == doctest::Approx(1279.5));
  CHECK(lens.pixel({std::cos(half_rad), -std::sin(half_rad), 0})->x == doctest::Approx(-0.5));
  CHECK(lens.pixel({1, 0, 0})->y == doctest::Approx(479.5));
}

TEST_CASE("an unusable mask is reported and occludes nothing") {
  Project project = sample_project("crossing");
  SUBCASE("missing") {
    project.footage.own_body_mask = "none.png";
  }
  SUBCASE("no image") {
    project.footage.own_body_mask = "crossing.json";
  }
  SUBCASE("another size") {
    project.footage.own_body_mask = "../../assets/models/airliner/fin.png";
  }
  const DraftScene draft = drafted(project);
  CHECK(draft.problems.size() == 1);
  CHECK(problems_of(draft, "footage.own_body_mask") == 1);
  CHECK(draft.scene.own_body.empty());
  CHECK(draft.scene.intruders[0].model->mesh.vertices.size() > 1000);  // all else is there
}

TEST_CASE("an unusable attitude file is reported and the camera stays level") {
  const TemporaryFolder folder;
  Project project = sample_project("crossing");
  project.camera.attitude_file = (folder / "gyro.csv").string();
  std::string said = "no such file";
  SUBCASE("missing") {}
  SUBCASE("wrong in a line") {
    std::ofstream(folder / "gyro.csv") << "frame,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n1,0,left,0\n";
    said = "line 3: pitch_deg";
  }
  const DraftScene draft = drafted(project);
  CHECK(draft.problems.size() == 1);
  CHECK(problems_of(draft, "camera.attitude_file") == 1);
  CHECK(draft.scene.motion.attitudes.empty());
  CHECK(draft.scene.intruders.size() == 1);
  const Result<Scene> opened = open_scene(project, sample_footage());
  REQUIRE_FALSE(opened.has_value());
  CHECK(opened.error().text().find("crossing.json: camera.attitude_file: ") != std::string::npos);
  CHECK(opened.error().text().find(said) != std::string::npos);
}

TEST_CASE("a model that cannot be read becomes a cross of its length") {
  Project project = sample_project("two-intruders");
  project.intruders[1].model.length_m = 34;
  SUBCASE("missing") {
    project.intruders[1].model.file = "none.obj";
  }
  SUBCASE("no model") {
    project.intruders[1].model.file = "two-intruders.json";
  }
  SUBCASE("a folder") {
    project.intruders[1].model.file = ".";
  }
  SUBCASE("not named") {
    project.intruders[1].model.file = "";
  }
  const DraftScene draft = drafted(project);
  CHECK(draft.problems.size() == 1);
  CHECK(problems_of(draft, "intruders[1].model.file") == 1);
  const Mesh& cross = draft.scene.intruders[1].model->mesh;
  CHECK(cross.low_m == glm::vec3(-17));
  CHECK(cross.high_m == glm::vec3(17));
  const Project good = sample_project("two-intruders");
  CHECK(scene_at(draft.scene, 77).intruders[1].camera_from_body.translation_m ==
        scene_at(drafted(good).scene, 77).intruders[1].camera_from_body.translation_m);
}

TEST_CASE("invalid axes are reported and the model becomes a cross of ten metres") {
  Project project = sample_project("crossing");
  project.intruders[0].model.up = "-x";
  const DraftScene draft = drafted(project);
  CHECK(draft.problems.size() == 1);
  CHECK(problems_of(draft, "intruders[0].model.up") == 1);
  CHECK(draft.scene.intruders[0].model->mesh.high_m.x == 5);
}

TEST_CASE("every face of the cross faces outwards") {
  SceneFiles files;
  const auto cross = files.cross(12);
  CHECK(files.cross(12) == cross);
  CHECK(files.cross(13) != cross);
  const Mesh& mesh = cross->mesh;
  CHECK(mesh.indices.size() == 3 * 12 * 3);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vertex& a = mesh.vertices[mesh.indices[i]];
    const Vertex& b = mesh.vertices[mesh.indices[i + 1]];
    const Vertex& c = mesh.vertices[mesh.indices[i + 2]];
    const glm::vec3 outward = glm::normalize(glm::cross(b.position_m - a.position_m, c.position_m - a.position_m));
    CHECK(glm::distance(outward, a.normal) < 1e-6F);
    CHECK(glm::dot(a.position_m, a.normal) > 0);  // a beam holds the origin
    CHECK(glm::length(c.position_m) <= mesh.radius_m);
  }
}

TEST_CASE("a trajectory that cannot be flown hovers at its first waypoint") {
  Project project = sample_project("crossing");
  std::vector<WaypointSettings>& waypoints = project.intruders[0].trajectory.waypoints;
  const std::string key = "intruders[0].trajectory.waypoints";
  std::string field;
  SUBCASE("equal frames") {
    waypoints[1].frame = 0;
    field = key + "[1].frame";
  }
  SUBCASE("backwards") {
    waypoints[2].frame = 50;
    field = key + "[2].frame";
  }
  SUBCASE("a place that is none") {
    waypoints[2].position_m.y = kNaN;
    field = key + "[2].position_m";
  }
  SUBCASE("a time that is none") {
    waypoints[1].frame = kInfinity;
    field = key + "[1].frame";
  }
  SUBCASE("spread over no frames") {
    for (WaypointSettings& waypoint : waypoints) waypoint.frame = std::nullopt;
    project.footage.first_frame = 20;
    project.footage.last_frame = 20;
    field = key + "[1].frame";
  }
  const DraftScene draft = drafted(project);
  CHECK(draft.problems.size() >= 1);
  CHECK(problems_of(draft, field) == 1);
  REQUIRE(draft.scene.intruders.size() == 1);
  for (const double time_s : {0.0, 3.0, 100.0})
    CHECK(draft.scene.intruders[0].trajectory.position_m(time_s) == glm::dvec3(420, -330, -215));
  check_sound(draft);
}

TEST_CASE("numbers of rotors and of places on the Earth are sanitized like others") {
  Project project = sample_project("crossing");
  IntruderSettings& intruder = project.intruders.at(0);
  intruder.model.rotors = {{.part = "fan", .blades = 99, .rpm = NAN, .axis = {0, NAN, 2}}};
  intruder.trajectory.waypoints.at(0).place = {.latitude_deg = 100, .longitude_deg = 8, .height_m = NAN};
  const Project clean = sanitized(project);
  const RotorSettings& rotor = clean.intruders[0].model.rotors.at(0);
  CHECK(rotor.part == "fan");
  CHECK(rotor.blades == 16);
  CHECK_FALSE(rotor.rpm);
  CHECK(rotor.axis == glm::dvec3(0, 0, 1));
  CHECK(clean.intruders[0].trajectory.waypoints[0].place->latitude_deg == 90);
  CHECK(clean.intruders[0].trajectory.waypoints[0].place->longitude_deg == 8);
  CHECK(clean.intruders[0].trajectory.waypoints[0].place->height_m == 0);
}

TEST_CASE("a rotor that the model cannot have is a problem of its setting, and the model is drawn without it") {
  Project project = sample_project("crossing");
  const DraftScene plain = drafted(project);
  project.intruders.at(0).model.rotors = {{.part = "no such part"}};
  const DraftScene draft = drafted(project);
  CHECK(problems_of(draft, "intruders[0].model.rotors[0].part") == 1);
  CHECK(draft.scene.intruders.at(0).model->mesh.vertices.size() ==
        plain.scene.intruders.at(0).model->mesh.vertices.size());
}

TEST_CASE("an intruder without waypoints is left out and the others keep their place") {
  Project project = sample_project("two-intruders");
  project.intruders[0].trajectory.waypoints.clear();
  const DraftScene draft = drafted(project);
  CHECK(problems_of(draft, "intruders[0].trajectory.waypoints") == 1);
  CHECK(draft.intruder_of_project == std::vector<int>{-1, 0});
  CHECK(draft.scene.intruders[0].name == "light-aircraft");
}

TEST_CASE("a range beyond the footage is cut to it") {
  Project project = sample_project("crossing");
  project.footage.last_frame = 500;
  DraftScene draft = drafted(project);
  CHECK(problems_of(draft, "footage.last_frame") == 1);
  CHECK(draft.scene.last_frame == 199);
  project.footage.first_frame = 300;
  draft = drafted(project);
  CHECK(problems_of(draft, "footage.first_frame") == 1);
  CHECK(draft.scene.first_frame == 199);
}

TEST_CASE("every problem that check finds is reported in the same words") {
  Project project = sample_project("two-intruders");
  project.name = "";
  project.footage.video = "none.mp4";
  project.compositing.supersampling = 0;
  project.compositing.blur_px_per_m = -1;
  project.intruders[0].model.file = "none.obj";
  project.intruders[1].trajectory.waypoints[1].frame = 0;
  const DraftScene draft = drafted(project);
  const std::vector<Problem> checked = validate(project);
  CHECK(checked.size() >= 6);
  REQUIRE(draft.problems.size() >= checked.size());
  for (std::size_t i = 0; i < checked.size(); ++i) {
    CHECK(draft.problems[i].field == checked[i].field);
    CHECK(draft.problems[i].what == checked[i].what);
  }
  check_sound(draft);
}

TEST_CASE("any number in any field gives a scene that can be shown") {
  SceneFiles files;
  for (const double value : {kNaN, kInfinity, -kInfinity, 0.0, -1.0, 1e9, 1e13, -1e300}) {
    const std::size_t count = [] {
      Project project = sample_project("two-intruders");
      return fields_of(project).size();
    }();
    for (std::size_t i = 0; i < count; ++i) {
      Project project = sample_project("two-intruders");
      const Field field = fields_of(project)[i];
      if (!set_number(field, value)) continue;
      CAPTURE(field.key);
      CAPTURE(value);
      const DraftScene draft = draft_scene(project, sample_footage(), files);
      check_sound(draft);
      for (const Problem& problem : validate(project))
        CHECK_MESSAGE(problems_of(draft, problem.field) >= 1, problem.field);
    }
  }
}

TEST_CASE("placeholder footage is as long as the project asks for") {
  Project project;
  FootageShape footage = placeholder_footage(project);
  CHECK(footage.size_px == cv::Size(1280, 960));
  CHECK(footage.times_s.size() == 250);
  CHECK(footage.times_s[25] == doctest::Approx(1));
  project.footage.last_frame = 999;
  CHECK(placeholder_footage(project).times_s.size() == 1000);
  project.intruders.emplace_back().trajectory.waypoints = {{.frame = 10}, {.frame = 1200.5}, {}};
  CHECK(placeholder_footage(project).times_s.size() == 1202);
  project.intruders[0].trajectory.waypoints[2].frame = 1e300;
  CHECK(placeholder_footage(project).times_s.size() == 100'000);
  project.intruders[0].trajectory.waypoints[2].frame = kNaN;
  CHECK(placeholder_footage(project).times_s.size() == 1202);
}

TEST_CASE("placeholder footage has the size that the calibration is made for") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "lens.yaml") << "%YAML:1.0\n---\nimage_width: 854\nimage_height: 480\n"
                                         "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                                         "   data: [ 500., 0., 427., 0., 500., 240., 0., 0., 1. ]\n"
                                         "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n"
                                         "   data: [ 0., 0., 0., 0. ]\n";
  Project project;
  project.file = folder / "p.json";
  project.footage.calibration = "lens.yaml";
  CHECK(placeholder_footage(project).size_px == cv::Size(854, 480));
  project.footage.calibration = "nowhere.yaml";
  CHECK(placeholder_footage(project).size_px == cv::Size(1280, 960));
}
