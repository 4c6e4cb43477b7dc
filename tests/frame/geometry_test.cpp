// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "frame/opencv_reference.h"
#include "frame/synthetic_scenes.h"
#include "scene/scene_at.h"

namespace sigs::test {
namespace {

// The tolerance of the annotation: OpenCV projects the vertices alone,
// and close to a fold of the lens the edge between two of them bows out by some 4e-4 px. Elsewhere it is 1e-12 px.
constexpr double kAllowed_px = 0.5;
constexpr double kHeldTo_px = 1e-3;

constexpr int kWantedExtent_px = 40;

struct Calibration {
  std::string name;
  Camera camera;
};

// A calibration that states no size is taken to be made for the images that its origin shows.
std::optional<cv::Size> size_not_in_file(const std::string& name) {
  if (name == "opencv_doc_stereo_intrinsics_M1D1.yml") return cv::Size(640, 480);
  if (name == "opencv_doc_tutorial_camera_params.yml") return cv::Size(640, 480);
  if (name == "video2calibration_gopro_plain.yaml") return cv::Size(1280, 720);
  return std::nullopt;
}

std::vector<Calibration> real_calibrations() {
  std::vector<Calibration> all;
  for (const auto& entry : std::filesystem::directory_iterator(real_data() / "calibrations")) {
    const std::string name = entry.path().filename().string();
    const Result<Camera> camera = read_calibration(entry.path(), size_not_in_file(name));
    if (!camera) FAIL(camera.error().text());
    all.push_back({name, *camera});
  }
  std::sort(all.begin(), all.end(), [](const Calibration& a, const Calibration& b) { return a.name < b.name; });
  return all;
}

// The corners of an OBJ as its text has them, converted to body axes here: nose -X, up +Y, left wing +Z.
std::vector<cv::Vec3d> airliner_points(const std::filesystem::path& path) {
  std::vector<cv::Vec3d> points;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    cv::Vec3d p;
    if (words >> key && key == "v" && words >> p[0] >> p[1] >> p[2]) points.emplace_back(-p[0], -p[2], -p[1]);
  }
  return points;
}

struct TestModel {
  ModelSettings settings;
  std::vector<cv::Vec3d> points_in_body;
  double extent_m = 0;
};

TestModel scene_model(const Scenario& scenario) {
  TestModel model{.settings = {.file = "aircraft.obj", .forward = "+x", .up = "-z"}, .extent_m = 12};
  for (const glm::dvec3& p : write_obj(scenario.path("aircraft.obj"), aircraft(), 6))
    model.points_in_body.emplace_back(p.x, p.y, p.z);
  return model;
}

TestModel airliner() {
  const std::filesystem::path file = real_data() / "models/boeing737-300/boeing737-300.obj";
  return {.settings = {.file = file.string(), .forward = "-x", .up = "+y"},
          .points_in_body = airliner_points(file),
          .extent_m = 33.3};
}

// Directions in the camera frame: over the whole image up to its corners, and round the edge of the valid field.
std::vector<cv::Vec3d> directions_over(const Camera& camera) {
  std::vector<cv::Vec3d> directions;
  const double right = camera.size_px.width - 1;
  const double bottom = camera.size_px.height - 1;
  const double inset = 0.75 * kWantedExtent_px;
  for (const double y : {inset, 0.27 * bottom, 0.5 * bottom, bottom - inset})
    for (const double x : {inset, 0.3 * right, 0.52 * right, 0.8 * right, right - inset})
      if (const auto ray = camera.lens.ray({x, y})) directions.emplace_back(ray->x, ray->y, ray->z);
  for (const double corner_x : {3.0, right - 3})
    for (const double corner_y : {3.0, bottom - 3})
      if (const auto ray = camera.lens.ray({corner_x, corner_y})) directions.emplace_back(ray->x, ray->y, ray->z);
  for (const double share : {0.6, 0.9, 0.98})
    for (int i = 0; i < 8; ++i) {
      const double angle = std::min(share * camera.lens.valid_angle_rad(), 1.5);
      const double phi = 2 * CV_PI * (i + 0.3) / 8;
      const cv::Vec3d d(std::cos(angle), std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi));
      const auto pixel = camera.lens.pixel({d[0], d[1], d[2]});
      if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x > right || pixel->y > bottom) continue;
      directions.push_back(d);
    }
  return directions;
}

struct Placed {
  cv::Vec3d position_in_world;
  cv::Vec3d heading_in_world;
};

// The intruder's truth by projected().
struct Expected {
  cv::Vec3d position_in_camera;
  cv::Point2d center_px;
  std::optional<cv::Rect2d> box;  // of the points within the valid field
  bool whole = true;              // all points lie within it
};

Expected expected_of(const TestModel& model, const Placed& placed, const cv::Matx33d& world_from_camera,
                     const cv::Vec3d& camera_in_world, const Lens& lens) {
  const cv::Matx33d camera_from_world = world_from_camera.t();
  const cv::Matx33d world_from_body = flying_along(placed.heading_in_world);
  std::vector<cv::Vec3d> seen;
  Expected expected;
  for (const cv::Vec3d& p : model.points_in_body) {
    const cv::Vec3d in_camera = camera_from_world * (world_from_body * p + placed.position_in_world - camera_in_world);
    const double angle = std::atan2(std::hypot(in_camera[1], in_camera[2]), in_camera[0]);
    if (angle < std::min(lens.valid_angle_rad(), projects_up_to_rad(lens.parameters())))
      seen.push_back(in_camera);
    else
      expected.whole = false;
  }
  expected.position_in_camera = camera_from_world * (placed.position_in_world - camera_in_world);
  expected.center_px = projected(lens.parameters(), optical({expected.position_in_camera})).front();
  if (!seen.empty()) expected.box = around(projected(lens.parameters(), optical(seen)));
  return expected;
}

double apart(const Box& a, const cv::Rect2d& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.x + a.width - b.x - b.width),
                   std::abs(a.y + a.height - b.y - b.height)});
}

int apart(const cv::Rect& a, const cv::Rect& b) {
  return std::max(
      {std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.br().x - b.br().x), std::abs(a.br().y - b.br().y)});
}

cv::Rect grown(const cv::Rect& rect, int by) {
  return {rect.x - by, rect.y - by, rect.width + 2 * by, rect.height + 2 * by};
}

// Whether the lens gives every pixel in and around the box a ray, so that all of the intruder can be drawn.
bool all_reachable(const cv::Rect& box, const Lens& lens) {
  const cv::Rect around_it = grown(box, 2);
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      if (!lens.ray({around_it.x + around_it.width * i / 8.0, around_it.y + around_it.height * j / 8.0})) return false;
  return true;
}

// Worst differences over many scenes, and how many could be compared.
struct Tally {
  double center_px = 0;
  double silhouette_px = 0;
  double position_m = 0;
  int drawn_px = 0;
  int measured = 0;
  int drawn = 0;
};

void check_drawn(const ComposedFrame& frame, const Expected& expected, const Lens& lens, Tally& tally) {
  const cv::Rect image({0, 0}, frame.image.size_px());
  const cv::Rect box = box_of(frame.mask);
  const cv::Rect wanted = touched(*expected.box);
  if (!box.empty()) CHECK((grown(wanted, 1) & box) == box);
  if ((grown(wanted, 1) & image) != grown(wanted, 1) || !all_reachable(wanted, lens)) return;
  // Rounding to whole pixels: an edge that reaches a few hundredths into a pixel may meet none of its 16 samples, and
  // bilinear taps carry an edge a quarter of a pixel out. Both are less than a pixel.
  CHECK(apart(box, wanted) <= 1);
  const IntruderTruth& truth = frame.truth.intruders.front();
  REQUIRE(truth.visible_box);
  CHECK(apart(*truth.visible_box, wanted) <= 1);
  CHECK(truth.in_image);
  CHECK(truth.visible_fraction == doctest::Approx(1.0).epsilon(1e-6));
  tally.drawn_px = std::max(tally.drawn_px, apart(box, wanted));
  ++tally.drawn;
}

void check_frame(const ComposedFrame& frame, const Expected& expected, const Lens& lens, Tally& tally) {
  const IntruderTruth& truth = frame.truth.intruders.front();
  const cv::Vec3d position(truth.position_m.x, truth.position_m.y, truth.position_m.z);
  tally.position_m = std::max(tally.position_m, cv::norm(position - expected.position_in_camera));
  const auto center = lens.pixel(truth.position_m);
  REQUIRE(center);
  tally.center_px =
      std::max(tally.center_px, std::hypot(center->x - expected.center_px.x, center->y - expected.center_px.y));
  REQUIRE(truth.amodal_box.has_value() == expected.box.has_value());
  if (!expected.box) return;
  ++tally.measured;
  const Box& silhouette = *truth.amodal_box;
  if (!expected.whole) {  // edges beyond the last point that has an image count too: edges_test.cpp
    const cv::Rect2d box(silhouette.x - kHeldTo_px, silhouette.y - kHeldTo_px, silhouette.width + 2 * kHeldTo_px,
                         silhouette.height + 2 * kHeldTo_px);
    CHECK((box & *expected.box) == *expected.box);
    return;
  }
  const double silhouette_px = apart(silhouette, *expected.box);
  CHECK(silhouette_px < kAllowed_px);
  tally.silhouette_px = std::max(tally.silhouette_px, silhouette_px);
  check_drawn(frame, expected, lens, tally);
}

Trajectory straight_flight(const Placed& placed) {
  const auto at = [&placed](double t_s) {
    const cv::Vec3d p = placed.position_in_world + placed.heading_in_world * ((t_s - 0.04) * 50);
    return TimedWaypoint{t_s, {p[0], p[1], p[2]}};
  };
  Result<Trajectory> flight = Trajectory::make({at(0), at(0.08)}, {});
  REQUIRE(flight.has_value());
  return *flight;
}

const std::array<cv::Vec3d, 3> kHeadings{cv::Vec3d(0.2, 1, -0.1), cv::Vec3d(-1, 0.3, 0.4), cv::Vec3d(0.5, -0.7, -0.6)};

Tally tally_of(Scenario& scenario, const Calibration& calibration, const TestModel& model) {
  scenario.project.footage.calibration = (real_data() / "calibrations" / calibration.name).string();
  scenario.project.camera = {
      .position_m = {40, -30, -150}, .roll_deg = 4, .pitch_deg = -7, .yaw_deg = 25, .speed_mps = 30};
  scenario.project.compositing.method = MethodChoice::direct;
  scenario.project.intruders.clear();
  scenario.add(model.settings.file, {500, 0, -150}).model = model.settings;
  Scene scene = scenario.opened();
  const Lens& lens = calibration.camera.lens;
  const cv::Matx33d world_from_camera = turned(4, -7, 25);
  const cv::Vec3d camera_in_world(40 + 30 * 0.04, -30, -150);  // frame 1 of 25 a second
  const Frame background = even_frame(scene.footage.size_px, 120, PixelLayout::gray);
  ComposeContext context;
  Tally tally;
  int number = 0;
  for (const cv::Vec3d& direction : directions_over(calibration.camera)) {
    const double distance_m = model.extent_m * lens.parameters().fx / kWantedExtent_px;
    const Placed placed{camera_in_world + world_from_camera * (direction * distance_m),
                        kHeadings[static_cast<std::size_t>(number++) % kHeadings.size()]};
    scene.intruders.front().trajectory = straight_flight(placed);
    const Result<ComposedFrame> frame = compose_frame(scene, 1, background, context);
    if (!frame) FAIL(frame.error().text());
    CAPTURE(calibration.name);
    CAPTURE(direction);
    check_frame(*frame, expected_of(model, placed, world_from_camera, camera_in_world, lens), lens, tally);
  }
  return tally;
}

void check_tally(const Tally& tally, const std::string& name, const std::string& model) {
  CAPTURE(name);
  CAPTURE(model);
  MESSAGE(name << ", " << model << ": " << tally.measured << " places, off by at most " << tally.center_px
               << " px (centre), " << tally.silhouette_px << " px (silhouette), " << tally.drawn_px
               << " px (drawn box, of " << tally.drawn << ")");
  CHECK(tally.measured >= 20);
  CHECK(tally.drawn >= 12);
  CHECK(tally.center_px < kHeldTo_px);
  CHECK(tally.silhouette_px < kHeldTo_px);
  CHECK(tally.position_m < 1e-9 * 1e4);  // doubles, some 1e4 m from the origin
}

}  // namespace

TEST_CASE("a synthetic aircraft lies where OpenCV projects it through every real calibration") {
  if (!has_real_data()) return;
  for (const Calibration& calibration : real_calibrations()) {
    Scenario scenario(calibration.camera.size_px);
    check_tally(tally_of(scenario, calibration, scene_model(scenario)), calibration.name, "made aircraft");
  }
}

TEST_CASE("a real airliner lies where OpenCV projects it through every real calibration") {
  if (!has_real_data()) return;
  const TestModel model = airliner();
  for (const Calibration& calibration : real_calibrations()) {
    Scenario scenario(calibration.camera.size_px);
    check_tally(tally_of(scenario, calibration, model), calibration.name, "airliner");
  }
}

TEST_CASE("boxes and areas without rotors are those of the aircraft whose rotors are taken off; images stay") {
  const std::filesystem::path model = source_dir() / "assets" / "models" / "helicopter";
  Scenario scenario;
  // The helicopter's file without the faces of its rotors.
  std::ifstream whole(model / "helicopter.obj");
  std::ofstream bare(scenario.path("bare.obj"));
  bool is_rotor = false;
  int rotors = 0;
  for (std::string line; std::getline(whole, line);) {
    if (line.starts_with("usemtl")) rotors += (is_rotor = line.ends_with("_rotor")) ? 1 : 0;
    if (!is_rotor || !line.starts_with("f ")) bare << line << '\n';
  }
  bare.close();
  REQUIRE(rotors >= 2);
  for (const auto& entry : std::filesystem::directory_iterator(model))
    if (entry.path().extension() != ".obj")
      std::filesystem::copy_file(entry.path(), scenario.path(entry.path().filename().string()));

  scenario.project.compositing.supersampling = 8;  // views with and without rotors have other samples
  scenario.add((model / "helicopter.obj").string(), {45, 4, -151});
  const ComposedFrame seen = composed(scenario);
  scenario.project.output.label_rotors = LabelRotorsChoice::none;
  const ComposedFrame body = composed(scenario);
  scenario.project.intruders[0].model.file = scenario.path("bare.obj").string();
  const ComposedFrame taken_off = composed(scenario);

  for (std::size_t i = 0; i < seen.image.planes.size(); ++i)
    CHECK(cv::norm(seen.image.planes[i], body.image.planes[i], cv::NORM_INF) == 0);
  CHECK(cv::norm(seen.mask, body.mask, cv::NORM_INF) == 0);
  const IntruderTruth& with = seen.truth.intruders.at(0);
  const IntruderTruth& without = body.truth.intruders.at(0);
  const IntruderTruth& expected = taken_off.truth.intruders.at(0);
  REQUIRE((with.visible_box && without.visible_box && expected.visible_box));
  CHECK(*without.visible_box == *expected.visible_box);
  CHECK(*without.amodal_box == *expected.amodal_box);
  CHECK(without.visible_fraction == doctest::Approx(expected.visible_fraction).epsilon(1e-6));
  CHECK(without.visible_pixels == expected.visible_pixels);
  CHECK(with.amodal_box->width > without.amodal_box->width + 5);  // the disc is wider than the fuselage is long
  CHECK(with.visible_box->width > without.visible_box->width);
  CHECK(without.position_m == with.position_m);
}

}  // namespace sigs::test
