// SPDX-License-Identifier: MIT
#include "export/export_project.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "frame/synthetic_scenes.h"
#include "project/project.h"
#include "scene/opened_project.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const cv::Size kFrontSize(640, 480);
const cv::Size kLeftSize(480, 360);

// Lenses by OpenCV's own parameters.
struct KnownLens {
  cv::Matx33d matrix;
  std::vector<double> coefficients;
  bool is_fisheye = false;
};

const KnownLens kFront{{280, 0, 322.3, 0, 281, 238.4, 0, 0, 1}, {0.04, 0.01, -0.01, 0.002}, true};
const KnownLens kLeft{{420, 0, 241.2, 0, 421, 178.9, 0, 0, 1}, {-0.1, 0.03, 0.0005, -0.0003, 0}};
const KnownLens kNarrow{{1500, 0, 320.4, 0, 1498, 241.7, 0, 0, 1}, {-0.05, 0.1, 0, 0.0002, 0}};

// Images, as a camera of another rate takes them.
void write_images(const fs::path& folder, cv::Size size_px, int count) {
  fs::create_directories(folder);
  for (int n = 0; n < count; ++n) {
    cv::Mat image(size_px, CV_8UC3, cv::Scalar(150 + n % 7, 140, 120));
    cv::imwrite((folder / ("image_" + std::to_string(100 + n) + ".png")).string(), image);
  }
}

void write_lens(const Scenario& scenario, const std::string& name, const KnownLens& lens, cv::Size size_px) {
  write_calibration(scenario.path(name), lens.matrix, lens.coefficients, size_px, lens.is_fisheye);
}

RigCamera& add_camera(Project& project, const std::string& name, const std::string& video) {
  RigCamera camera{.name = name};
  camera.footage.video = video;
  camera.footage.calibration = name + ".xml";
  project.cameras.push_back(camera);
  return project.cameras.back();
}

// A front camera at 25 frames a second, one to the left at 20 that began 0.17 s later, a narrow one that looks ahead.
void prepare_rig(Scenario& scenario) {
  Project& project = scenario.project;
  project.footage = {};
  write_footage(scenario.path("front.mkv"), kFrontSize, 26, PixelLayout::yuv420);
  write_images(scenario.path("left"), kLeftSize, 15);
  write_footage(scenario.path("narrow.mkv"), kFrontSize, 20, PixelLayout::yuv420);
  write_lens(scenario, "front.xml", kFront, kFrontSize);
  write_lens(scenario, "left.xml", kLeft, kLeftSize);
  write_lens(scenario, "narrow.xml", kNarrow, kFrontSize);
  add_camera(project, "front", "front.mkv").mount = {.position_m = {0.4, 0, -0.1}};
  RigCamera& left = add_camera(project, "left", "left");
  left.footage.frame_rate_hz = 20;
  left.mount = {.position_m = {0.1, -0.6, 0.05}, .roll_deg = 3, .pitch_deg = -4, .yaw_deg = -60};
  left.clock = {.offset_s = 0.17, .drift_ppm = 50};
  add_camera(project, "narrow", "narrow.mkv").mount = {.position_m = {0.5, 0.2, 0}, .pitch_deg = -2};
  project.cameras.back().clock.offset_s = 0.1;
  project.camera.speed_mps = 30;
  project.camera.roll_deg = 5;
  project.camera.pitch_deg = -3;
  project.camera.yaw_deg = 2;
  project.output.labels = {"jsonl", "xml"};
  project.output.masks = MasksChoice::none;
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {30, -180, -160}},
                                                           {.frame = 12, .position_m = {110, -110, -158}},
                                                           {.frame = 25, .position_m = {230, 10, -155}}};
}

RigReport exported(const Scenario& scenario, const std::string& folder = "out",
                   const std::optional<FrameRange>& frames = {}) {
  ExportRequest request{.project = scenario.project, .folder = scenario.path(folder), .frames = frames};
  Result<RigReport> report = export_rig(request, {});
  if (!report) FAIL(report.error().text());
  return *std::move(report);
}

std::vector<json> lines_of(const fs::path& file) {
  std::vector<json> lines;
  std::istringstream text(text_of(file));
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  return lines;
}

// Yaw, pitch and roll as matrices of rotation about Z, Y and X: written out, not by the engine's quaternions.
cv::Matx33d rotation_of_angles(double roll_deg, double pitch_deg, double yaw_deg) {
  const double k = std::acos(-1.0) / 180;
  const double cr = std::cos(k * roll_deg), sr = std::sin(k * roll_deg);
  const double cp = std::cos(k * pitch_deg), sp = std::sin(k * pitch_deg);
  const double cy = std::cos(k * yaw_deg), sy = std::sin(k * yaw_deg);
  const cv::Matx33d z(cy, -sy, 0, sy, cy, 0, 0, 0, 1);
  const cv::Matx33d y(cp, 0, sp, 0, 1, 0, -sp, 0, cp);
  const cv::Matx33d x(1, 0, 0, 0, cr, -sr, 0, sr, cr);
  return z * y * x;
}

cv::Vec3d vec(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

// Where OpenCV sees a point of the world in a camera of the rig at a time.
cv::Point2d opencv_pixel(const Project& project, std::size_t camera, const KnownLens& lens, double time_s,
                         const cv::Vec3d& p_world) {
  const MountSettings& mount = project.cameras[camera].mount;
  const cv::Matx33d world_from_body =
      rotation_of_angles(*project.camera.roll_deg, *project.camera.pitch_deg, project.camera.yaw_deg);
  const cv::Vec3d body_m = vec(project.camera.position_m) + cv::Vec3d(project.camera.speed_mps * time_s, 0, 0);
  const cv::Matx33d world_from_camera =
      world_from_body * rotation_of_angles(mount.roll_deg, mount.pitch_deg, mount.yaw_deg);
  const cv::Vec3d camera_m = body_m + world_from_body * vec(mount.position_m);
  const cv::Matx33d optical(0, 1, 0, 0, 0, 1, 1, 0, 0);
  const cv::Matx33d rotation = optical * world_from_camera.t();
  cv::Vec3d rvec;
  cv::Rodrigues(rotation, rvec);
  const cv::Vec3d tvec = -(rotation * camera_m);
  std::vector<cv::Point2d> pixels;
  const std::vector<cv::Point3d> points{cv::Point3d(p_world[0], p_world[1], p_world[2])};
  if (lens.is_fisheye)
    cv::fisheye::projectPoints(points, pixels, rvec, tvec, lens.matrix, lens.coefficients);
  else
    cv::projectPoints(points, rvec, tvec, lens.matrix, lens.coefficients, pixels);
  return pixels.at(0);
}

cv::Vec3d world_point(const json& frame) {
  // From the labels of the first camera: its position, its attitude and the intruder's place in its axes.
  const json& camera = frame["camera"]["position"];
  const json& attitude = frame["camera"]["attitude"];
  const json& at = frame["intruders"][0]["position"];
  const auto number = [](const json& object, const char* key) { return object[key].get<double>(); };
  const cv::Matx33d turn =
      rotation_of_angles(number(attitude, "roll_deg"), number(attitude, "pitch_deg"), number(attitude, "yaw_deg"));
  return cv::Vec3d(number(camera, "x_m"), number(camera, "y_m"), number(camera, "z_m")) +
         turn * cv::Vec3d(number(at, "x_m"), number(at, "y_m"), number(at, "z_m"));
}

}  // namespace

TEST_CASE("the labels of each camera put the intruder where OpenCV projects it to, 0.001 px") {
  Scenario scenario;
  prepare_rig(scenario);
  const RigReport report = exported(scenario);
  CHECK(report.cameras.size() == 3);
  const Project& project = scenario.project;
  const std::array<const KnownLens*, 3> lenses{&kFront, &kLeft, &kNarrow};
  // Where it is at each time, by the trajectory that each camera has on its own.
  const Trajectory trajectory = [&] {
    const Scene scene = open_scene(seen_by(project, 0),
                                   [] {
                                     FootageShape shape{.size_px = kFrontSize};
                                     for (int n = 0; n < 26; ++n) shape.times_s.push_back(n / 25.0);
                                     return shape;
                                   }())
                            .value();
    return scene.intruders[0].trajectory;
  }();
  int compared = 0;
  for (std::size_t camera = 0; camera < 3; ++camera) {
    const RigCamera& one = project.cameras[camera];
    const auto lens = read_calibration(scenario.path(one.name + ".xml"), camera == 1 ? kLeftSize : kFrontSize).value();
    const double rate_hz = camera == 1 ? 20 : 25;
    for (const json& frame : lines_of(scenario.path("out/lot." + one.name + ".jsonl"))) {
      const int index = frame["index"];
      const double time_s = one.clock.offset_s + index / rate_hz * (1 + one.clock.drift_ppm * 1e-6);
      CAPTURE(one.name);
      CAPTURE(index);
      CHECK(frame["time_s"].get<double>() == doctest::Approx(time_s).epsilon(1e-6));
      const json& at = frame["intruders"][0]["position"];
      const glm::dvec3 p_in_camera(at["x_m"].get<double>(), at["y_m"].get<double>(), at["z_m"].get<double>());
      const std::optional<glm::dvec2> pixel = lens.lens.pixel(p_in_camera);
      // Six digits of a label are worth the more pixels the farther outside of the image it is.
      const cv::Size size_px = lens.size_px;
      if (!pixel || pixel->x < -size_px.width || pixel->x > 2 * size_px.width || pixel->y < -size_px.height ||
          pixel->y > 2 * size_px.height)
        continue;
      const cv::Point2d expected =
          opencv_pixel(project, camera, *lenses[camera], time_s, vec(trajectory.position_m(time_s)));
      CHECK(std::hypot(pixel->x - expected.x, pixel->y - expected.y) < 0.001);
      ++compared;
    }
  }
  CHECK(compared > 30);
  // The label files alone agree too: their numbers have six digits after the point.
  for (const json& frame : lines_of(scenario.path("out/lot.front.jsonl"))) {
    const cv::Vec3d p = world_point(frame);
    const double time_s = frame["time_s"].get<double>();
    CHECK(cv::norm(p - vec(trajectory.position_m(time_s))) < 1e-4);
  }
}

TEST_CASE("frames of other rates and starts: those of the first camera's time, each at its own") {
  Scenario scenario;
  prepare_rig(scenario);
  scenario.project.cameras[0].footage.first_frame = 5;  // 0.2 s
  scenario.project.cameras[0].footage.last_frame = 15;  // 0.6 s
  exported(scenario);
  const std::vector<json> left = lines_of(scenario.path("out/lot.left.jsonl"));
  REQUIRE(left.size() == 9);
  CHECK(left.front()["index"] == 1);  // 0.22 s; frame 0 at 0.17 s is more than half a frame before
  CHECK(left.back()["index"] == 9);   // 0.62 s; frame 10 at 0.67 s is more than half a frame after
  CHECK(lines_of(scenario.path("out/lot.narrow.jsonl")).size() == 11);
  // Of --frames A-B likewise.
  exported(scenario, "some", FrameRange{10, 12});
  CHECK(lines_of(scenario.path("some/lot.front.jsonl")).size() == 3);
  CHECK(lines_of(scenario.path("some/lot.left.jsonl")).front()["index"] == 5);  // 0.42 s
}

TEST_CASE("a camera that films at another time is an error that says so") {
  Scenario scenario;
  prepare_rig(scenario);
  scenario.project.cameras[1].clock.offset_s = 60;
  const Result<RigReport> report = export_rig({.project = scenario.project, .folder = scenario.path("out")}, {});
  REQUIRE_FALSE(report.has_value());
  CHECK(report.error().text().find("cameras[1].clock.offset_s") != std::string::npos);
  CHECK(report.error().text().find("first camera") != std::string::npos);
}

TEST_CASE("the crossing goes from the left camera to the front one without a gap") {
  Scenario scenario;
  prepare_rig(scenario);
  exported(scenario);
  const json rig = json_of(scenario.path("out/lot.rig.json"));
  REQUIRE(rig["cameras"].size() == 3);
  CHECK(rig["cameras"][1]["clock"]["offset_s"] == 0.17);
  const json& intruder = rig["intruders"][0];
  bool has_handover = false;
  for (const json& handover : intruder["handovers"])
    if (handover["from"] == "left") {
      has_handover = true;
      CHECK(handover["gap_s"].get<double>() <= 0.05);
    }
  CHECK(has_handover);
  const std::string csv = text_of(scenario.path("out/lot.rig.csv"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 27);
}

TEST_CASE("each camera's files are those of its export alone") {
  Scenario scenario;
  prepare_rig(scenario);
  exported(scenario);
  for (std::size_t camera = 0; camera < 3; ++camera) {
    const std::string name = scenario.project.cameras[camera].name;
    ExportRequest request{.project = seen_by(scenario.project, camera), .folder = scenario.path("alone")};
    const Result<ExportReport> report = export_project(request, {});
    REQUIRE_MESSAGE(report.has_value(), name);
    for (const fs::path& file : report->written)
      CHECK_MESSAGE(text_of(file) == text_of(scenario.path("out") / file.filename()), file.filename().string());
  }
}

TEST_CASE("cameras of the same footage share its decoder, and write the same bytes") {
  Scenario scenario;
  prepare_rig(scenario);
  Project& project = scenario.project;
  project.cameras[1] = project.cameras[0];
  project.cameras[1].name = "twin";
  project.cameras[1].mount.yaw_deg = -8;
  const RigReport report = exported(scenario);
  CHECK(report.cameras[0].frames == 26);
  CHECK(report.cameras[1].frames == 26);
  ExportRequest request{.project = seen_by(project, 1), .folder = scenario.path("alone")};
  const Result<ExportReport> alone = export_project(request, {});
  REQUIRE(alone.has_value());
  for (const fs::path& file : alone->written)
    CHECK_MESSAGE(text_of(file) == text_of(scenario.path("out") / file.filename()), file.filename().string());
}

TEST_CASE("a stereo pair: the depth from the labels of both is the truth's, to 0.1 px of disparity") {
  Scenario scenario;
  Project& project = scenario.project;
  project.footage = {};
  const double focal_px = 800;
  const double baseline_m = 0.8;
  write_footage(scenario.path("left.mkv"), kFrontSize, 8, PixelLayout::yuv420);
  write_footage(scenario.path("right.mkv"), kFrontSize, 8, PixelLayout::yuv420);
  const KnownLens lens{{focal_px, 0, 319.5, 0, focal_px, 239.5, 0, 0, 1}, {0, 0, 0, 0, 0}};
  write_lens(scenario, "left.xml", lens, kFrontSize);
  write_lens(scenario, "right.xml", lens, kFrontSize);
  add_camera(project, "left", "left.mkv").mount.position_m = {0.3, -baseline_m / 2, 0};
  add_camera(project, "right", "right.mkv").mount.position_m = {0.3, baseline_m / 2, 0};
  project.output.labels = {"jsonl"};
  project.output.masks = MasksChoice::none;
  write_sphere_obj(scenario.path("ball.obj"), 2.0);
  scenario.add("ball.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {60, -8, -152}},
                                                       {.frame = 7, .position_m = {160, 12, -145}}};
  exported(scenario);
  const std::vector<json> left = lines_of(scenario.path("out/lot.left.jsonl"));
  const std::vector<json> right = lines_of(scenario.path("out/lot.right.jsonl"));
  REQUIRE(left.size() == 8);
  std::istringstream table(text_of(scenario.path("out/lot.rig.csv")));
  std::string row;
  std::getline(table, row);
  for (std::size_t n = 0; n < left.size(); ++n) {
    const auto middle = [](const json& frame) {
      const json& box = frame["intruders"][0]["silhouette"];
      return box["x"].get<double>() + box["width"].get<double>() / 2;
    };
    const double disparity_px = middle(left[n]) - middle(right[n]);
    const double depth_m = focal_px * baseline_m / disparity_px;
    const double truth_m = left[n]["intruders"][0]["position"]["x_m"].get<double>();
    CAPTURE(n);
    const double allowed_m = 0.1 * truth_m * truth_m / (focal_px * baseline_m);
    CHECK(std::abs(depth_m - truth_m) < allowed_m);
    // The table says what a pixel of disparity is worth.
    std::getline(table, row);
    std::vector<std::string> fields;
    std::istringstream cells(row);
    for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
    CHECK(fields.at(8) == "left+right");
    const double worth_m = std::stod(fields.at(9));
    CHECK(worth_m == doctest::Approx(truth_m * truth_m / (focal_px * baseline_m)).epsilon(0.02));
  }
}

TEST_CASE("nuScenes' tables put the annotated box where each camera has it") {
  Scenario scenario;
  prepare_rig(scenario);
  scenario.project.output.rig = {"nuscenes"};
  exported(scenario);
  const auto table = [&](const std::string& name) {
    return json_of(scenario.path("out/lot.nuscenes/v1.0-sigs") / (name + ".json"));
  };
  const auto by_token = [](const json& records) {
    std::map<std::string, json> map;
    for (const json& record : records) map.emplace(record["token"].get<std::string>(), record);
    CHECK(map.size() == records.size());
    return map;
  };
  for (const char* name : {"log", "map", "scene", "sample", "sample_data", "ego_pose", "calibrated_sensor", "sensor",
                           "instance", "category", "attribute", "visibility", "sample_annotation"})
    CHECK_NOTHROW(static_cast<void>(by_token(table(name))));
  CHECK(table("sample").size() == 26);
  CHECK(table("sample_data").size() == 26 + 15 + 20);

  // As the devkit does it: world -> aircraft -> camera, each by a quaternion and a translation.
  const auto poses = by_token(table("ego_pose"));
  const auto sensors = by_token(table("calibrated_sensor"));
  const auto names = by_token(table("sensor"));
  const auto annotations = by_token(table("sample_annotation"));
  const auto turned_back = [](const json& q, cv::Vec3d v) {
    const glm::dquat turn(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>());
    const glm::dvec3 p = glm::conjugate(turn) * glm::dvec3(v[0], v[1], v[2]);
    return cv::Vec3d(p.x, p.y, p.z);
  };
  const auto vector_of = [](const json& v) {
    return cv::Vec3d(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
  };
  int compared = 0;
  for (const json& image : table("sample_data")) {
    const json& pose = poses.at(image["ego_pose_token"]);
    const json& sensor = sensors.at(image["calibrated_sensor_token"]);
    const std::string camera = names.at(sensor["sensor_token"])["channel"];
    for (const auto& [token, annotation] : annotations) {
      const bool is_same_time = annotation["sample_token"] == image["sample_token"] && image["is_key_frame"] == true;
      if (!is_same_time || camera != "front") continue;  // the sample's time is the first camera's
      cv::Vec3d p = vector_of(annotation["translation"]);
      p = turned_back(pose["rotation"], p - vector_of(pose["translation"]));
      p = turned_back(sensor["rotation"], p - vector_of(sensor["translation"]));
      const std::string file = image["filename"];
      CHECK((scenario.path("out/lot.nuscenes") / file).lexically_normal().parent_path() ==
            scenario.path("out/lot." + camera));
      const int index = std::stoi(file.substr(file.find("frame_") + 6, 6));
      const json line = lines_of(scenario.path("out/lot.front.jsonl")).at(static_cast<std::size_t>(index));
      const json& at = line["intruders"][0]["position"];
      const cv::Vec3d reference(at["y_m"].get<double>(), at["z_m"].get<double>(), at["x_m"].get<double>());
      CHECK(cv::norm(p - reference) < 3);  // the middle of the box lies within the aircraft
      CHECK(p[2] > 0);
      ++compared;
    }
  }
  CHECK(compared > 5);
}

TEST_CASE("KITTI's calibration takes a point from the first camera to the others; fisheyes are refused") {
  Scenario scenario;
  prepare_rig(scenario);
  scenario.project.output.rig = {"kitti"};
  const Result<RigReport> refused = export_rig({.project = scenario.project, .folder = scenario.path("no")}, {});
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().text().find("front") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scenario.path("no")));

  std::swap(scenario.project.cameras[0], scenario.project.cameras[2]);
  scenario.project.cameras[0].clock = {};
  scenario.project.cameras.pop_back();
  exported(scenario);
  std::map<std::string, std::vector<double>> values;
  std::istringstream text(text_of(scenario.path("out/lot.kitti/calib_cam_to_cam.txt")));
  for (std::string line; std::getline(text, line);) {
    std::istringstream numbers(line.substr(line.find(':') + 1));
    for (double number = 0; numbers >> number;) values[line.substr(0, line.find(':'))].push_back(number);
  }
  CHECK(values.at("S_01") == std::vector<double>{480, 360});
  CHECK(values.at("K_00").at(0) == 1500);
  CHECK(values.at("D_01").size() == 5);
  // A point of the aircraft's axes in both cameras, by matrices of the mounts' angles.
  const cv::Matx33d optical(0, 1, 0, 0, 0, 1, 1, 0, 0);
  const auto in_camera = [&](const MountSettings& mount, const cv::Vec3d& p) {
    return optical * rotation_of_angles(mount.roll_deg, mount.pitch_deg, mount.yaw_deg).t() *
           (p - vec(mount.position_m));
  };
  const cv::Vec3d p(40, -30, 5);
  const cv::Matx33d rotation(values.at("R_01").data());
  const cv::Vec3d shift(values.at("T_01").data());
  CHECK(cv::norm(rotation * in_camera(scenario.project.cameras[0].mount, p) + shift -
                 in_camera(scenario.project.cameras[1].mount, p)) < 1e-9);
  std::istringstream poses(text_of(scenario.path("out/lot.kitti/poses.txt")));
  std::string pose;
  std::getline(poses, pose);
  CHECK(pose.starts_with("1.0000000000"));
}

TEST_CASE("nothing is overwritten unasked, and an error leaves no rig files") {
  Scenario scenario;
  prepare_rig(scenario);
  exported(scenario);
  const Result<RigReport> again = export_rig({.project = scenario.project, .folder = scenario.path("out")}, {});
  REQUIRE_FALSE(again.has_value());
  CHECK(again.error().kind == ErrorKind::cannot_create);
  std::atomic<bool> cancel = true;
  const Result<RigReport> stopped =
      export_rig({.project = scenario.project, .folder = scenario.path("stopped")}, {.cancel = &cancel});
  REQUIRE_FALSE(stopped.has_value());
  CHECK(stopped.error().kind == ErrorKind::interrupted);
  CHECK_FALSE(std::filesystem::exists(scenario.path("stopped")));
}

TEST_CASE("cameras get their names together: what fails after the first one leaves nothing, or all that was there") {
  Scenario scenario;
  prepare_rig(scenario);
  for (const char* const folder : {"new", "out"}) {
    std::filesystem::create_directories(scenario.path(folder));
    if (std::string(folder) == "out") exported(scenario);
    const auto before = files_below(scenario.path(folder));
    std::vector<std::string> bytes;
    for (const auto& file : before) bytes.push_back(text_of(scenario.path(std::string(folder) + "/" + file)));
    std::atomic<bool> cancel = false;
    int begun = 0;
    const Result<RigReport> stopped =
        export_rig({.project = scenario.project, .folder = scenario.path(folder), .overwrite = true},
                   {.progress =
                        [&](int done, int total) {
                          ++begun;
                          if (done >= total - 2) cancel = true;
                        },
                    .cancel = &cancel});
    REQUIRE_FALSE(stopped.has_value());
    CHECK(stopped.error().kind == ErrorKind::interrupted);
    CHECK(begun > 2);
    CHECK(files_below(scenario.path(folder)) == before);
    for (std::size_t i = 0; i < before.size(); ++i)
      CHECK(text_of(scenario.path(std::string(folder) + "/" + before[i])) == bytes[i]);
  }
}

}  // namespace sigs::test
