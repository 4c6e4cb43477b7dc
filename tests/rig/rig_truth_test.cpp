// SPDX-License-Identifier: MIT
#include "rig/rig_truth.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace sigs::test {
namespace {

constexpr double kFocal_px = 1000;

RigCameraGeometry camera_at(const std::string& name, const MountSettings& mount) {
  return {
      .name = name,
      .camera = {.lens = *Lens::make({.fx = kFocal_px, .fy = kFocal_px, .cx = 500, .cy = 400}), .size_px = {1001, 801}},
      .mount = mount,
      .clock = {},
      .video = name + ".mkv",
      .frames = {0, 9}};
}

// A frame in which the intruder is seen or not, at a place in the camera's axes.
FrameTruth truth_at(int frame, double time_s, bool is_visible, const glm::dvec3& p_in_camera = {100, 0, 0},
                    bool is_hidden = false) {
  FrameTruth truth{.index = frame, .time_s = time_s};
  IntruderTruth intruder{
      .position_m = p_in_camera, .in_image = is_visible || is_hidden, .visible_fraction = is_visible ? 0.5 : 0.0};
  if (is_visible) intruder.visible_box = cv::Rect(1, 2, 3, 4);
  truth.intruders.push_back(intruder);
  return truth;
}

// Frames at 10 Hz in which the intruder is seen from the first to the last of these, both included; -1: never.
void add_frames(RigTruth& rig, std::size_t camera, double start_s, int count, int first, int last) {
  for (int n = 0; n < count; ++n)
    rig.add(camera, truth_at(n, start_s + 0.1 * n, first >= 0 && n >= first && n <= last));
}

}  // namespace

TEST_CASE("an intruder goes from camera to camera, with and without a gap") {
  RigTruth rig({camera_at("a", {}), camera_at("b", {}), camera_at("c", {})}, {{.name = "airliner"}});
  add_frames(rig, 0, 0, 30, 2, 10);     // 0.2 to 1.0 s
  add_frames(rig, 1, 0.05, 30, 8, 15);  // 0.85 to 1.55 s
  add_frames(rig, 2, 0, 30, 20, 25);    // 2.0 to 2.5 s
  const std::vector<CameraView> views = rig.views(0);
  REQUIRE(views.size() == 3);
  CHECK(views[1].camera == 1);
  CHECK(views[1].first_s == doctest::Approx(0.85));
  CHECK(views[1].last_s == doctest::Approx(1.55));
  const std::vector<Handover> handovers = rig.handovers(0);
  REQUIRE(handovers.size() == 2);
  CHECK(handovers[0].from == 0);
  CHECK(handovers[0].to == 1);
  CHECK(handovers[0].time_s == doctest::Approx(1.0));
  CHECK(handovers[0].gap_s == doctest::Approx(-0.15));
  CHECK(handovers[1].to == 2);
  CHECK(handovers[1].gap_s == doctest::Approx(0.45));
}

TEST_CASE("a view within another one is no handover; one that comes back is") {
  RigTruth rig({camera_at("wide", {}), camera_at("narrow", {})}, {{.name = "airliner"}});
  for (int n = 0; n < 20; ++n) rig.add(0, truth_at(n, 0.1 * n, n < 8 || n >= 12));
  add_frames(rig, 1, 0, 20, 3, 5);
  const std::vector<Handover> handovers = rig.handovers(0);
  REQUIRE(handovers.size() == 1);
  CHECK(handovers[0].from == 0);
  CHECK(handovers[0].to == 0);
  CHECK(handovers[0].gap_s == doctest::Approx(0.5));
}

TEST_CASE("what is hidden for a while, and footage that ends, is no handover") {
  const auto frames_of = [](RigTruth& rig, std::size_t camera, int count, const std::string& seen) {
    for (int n = 0; n < count; ++n) {
      const char state = seen.at(static_cast<std::size_t>(n));  // v: visible, h: hidden in the image, other: not there
      rig.add(camera, truth_at(n, 0.1 * n, state == 'v', {100, 0, 0}, state == 'h'));
    }
  };
  RigTruth passing({camera_at("a", {}), camera_at("b", {})}, {{.name = "airliner"}});
  frames_of(passing, 0, 12, "vvvvhhvvvv..");  // something passes in front of it, then it leaves
  frames_of(passing, 1, 12, "..vvvvvvvvvv");
  REQUIRE(passing.handovers(0).size() == 1);
  CHECK(passing.handovers(0)[0].time_s == doctest::Approx(0.9));
  CHECK(passing.handovers(0)[0].gap_s == doctest::Approx(-0.7));
  CHECK(passing.views(0).size() == 3);  // times in which it is visible, without a break

  RigTruth hidden({camera_at("a", {}), camera_at("b", {})}, {{.name = "airliner"}});
  frames_of(hidden, 0, 12, "vvvvvhhhh...");  // it leaves behind the wing
  frames_of(hidden, 1, 12, "......vvvvvv");
  REQUIRE(hidden.handovers(0).size() == 1);
  CHECK(hidden.handovers(0)[0].time_s == doctest::Approx(0.4));
  CHECK(hidden.handovers(0)[0].gap_s == doctest::Approx(0.2));

  RigTruth ending({camera_at("a", {}), camera_at("b", {}), camera_at("c", {})}, {{.name = "airliner"}});
  frames_of(ending, 0, 6, "vvvvvv");  // its footage ends
  frames_of(ending, 1, 12, "..vvvvvv....");
  frames_of(ending, 2, 13, ".......vvvvvv");
  REQUIRE(ending.handovers(0).size() == 1);
  CHECK(ending.handovers(0)[0].from == 1);
  CHECK(ending.handovers(0)[0].to == 2);
  CHECK(ending.handovers(0)[0].time_s == doctest::Approx(0.7));

  RigTruth hidden_to_the_end({camera_at("a", {}), camera_at("b", {})}, {{.name = "airliner"}});
  frames_of(hidden_to_the_end, 0, 8, "vvvvvhhh");
  frames_of(hidden_to_the_end, 1, 9, "vvvvvvvvv");
  CHECK(hidden_to_the_end.handovers(0).empty());
}

TEST_CASE("nothing is seen: no views, no handovers; no frames: no rows") {
  RigTruth rig({camera_at("a", {}), camera_at("b", {})}, {{.name = "airliner"}});
  CHECK(rig.rows().empty());
  add_frames(rig, 0, 0, 5, -1, -1);
  CHECK(rig.views(0).empty());
  CHECK(rig.handovers(0).empty());
  const std::vector<RigRow> rows = rig.rows();
  REQUIRE(rows.size() == 5);
  CHECK_FALSE(rows[0].visible_fraction[1].has_value());
  CHECK_FALSE(rows[0].stereo.has_value());
}

TEST_CASE("bearing, elevation and range are in the aircraft's axes") {
  // A camera that looks to the left and 30 degrees up.
  RigTruth rig({camera_at("left", {.position_m = {1, -2, 0.5}, .pitch_deg = 30, .yaw_deg = -90})},
               {{.name = "airliner"}});
  rig.add(0, truth_at(7, 0.28, true, {200, 0, 0}));
  const RigRow row = rig.rows().at(0);
  const glm::dvec3 p{1, -2 - 200 * std::cos(std::acos(-1) / 6), 0.5 - 100};
  CHECK(row.frame == 7);
  CHECK(row.range_m == doctest::Approx(glm::length(p)).epsilon(1e-12));
  CHECK(row.bearing_rad == doctest::Approx(std::atan2(p.y, p.x)).epsilon(1e-12));
  CHECK(row.elevation_rad == doctest::Approx(std::asin(-p.z / glm::length(p))).epsilon(1e-12));
}

TEST_CASE("other cameras count by their frame that is nearest in time, if one is near") {
  RigTruth rig({camera_at("a", {}), camera_at("b", {})}, {{.name = "airliner"}});
  add_frames(rig, 0, 0, 10, 0, 9);
  add_frames(rig, 1, 0.33, 4, 1, 1);  // frames at 0.33, 0.43, 0.53, 0.63 s; seen at 0.43
  const std::vector<RigRow> rows = rig.rows();
  for (std::size_t n = 0; n < rows.size(); ++n) {
    CAPTURE(n);
    CHECK(rows[n].is_visible[1] == (n == 4));
    CHECK(rows[n].visible_fraction[1].has_value() == (n >= 3 && n <= 7));
  }
}

TEST_CASE("the error of a triangulated range is that of a rectified pair: Z^2 / (b f)") {
  const RigCameraGeometry left = camera_at("left", {.position_m = {0, -0.4, 0}});
  const RigCameraGeometry right = camera_at("right", {.position_m = {0, 0.4, 0}});
  for (const double z_m : {20.0, 300.0, 5000.0, 1e5}) {
    // On the first camera's axis, so that the distance is Z.
    const std::optional<double> error = range_error_m_per_px(left, right, {z_m, -0.4, 0});
    REQUIRE(error.has_value());
    CHECK(*error == doctest::Approx(z_m * z_m / (0.8 * kFocal_px)).epsilon(2e-6));
  }
}

TEST_CASE("on the line through both cameras, and behind one of them, no range can be triangulated") {
  const RigCameraGeometry front = camera_at("front", {.position_m = {1, 0, 0}});
  const RigCameraGeometry rear = camera_at("rear", {.position_m = {0, 0, 0}});
  CHECK_FALSE(range_error_m_per_px(front, rear, {500, 0, 0}).has_value());
  CHECK_FALSE(range_error_m_per_px(front, rear, {-500, 3, 0}).has_value());
  CHECK_FALSE(range_error_m_per_px(front, rear, {1, 0, 0}).has_value());
  CHECK_FALSE(range_error_m_per_px(front, front, {500, 20, 0}).has_value());
}

TEST_CASE("the pair with the least error is named, and the tables read back") {
  RigTruth rig({camera_at("left", {.position_m = {0, -1, 0}}), camera_at("middle", {.position_m = {0, -0.5, 0}}),
                camera_at("right", {.position_m = {0, 1, 0}})},
               {{.name = "say \"hi\", airliner"}});
  rig.add(0, truth_at(0, 0, true, {400, 1, 0}));
  rig.add(1, truth_at(0, 0, true, {400, 0.5, 0}));
  rig.add(2, truth_at(0, 0, true, {400, -1, 0}));
  const RigRow row = rig.rows().at(0);
  REQUIRE(row.stereo.has_value());
  CHECK(row.stereo->first == 0);
  CHECK(row.stereo->second == 2);

  const nlohmann::json json = nlohmann::json::parse(rig.json("encounter"));
  CHECK(json["cameras"][2]["mount"]["position_m"][1] == 1.0);
  CHECK(json["intruders"][0]["views"].size() == 3);
  std::istringstream lines(rig.csv());
  std::string header;
  std::string line;
  std::getline(lines, header);
  std::getline(lines, line);
  CHECK(header.find("left_visible_fraction") != std::string::npos);
  CHECK(line.find("left+middle+right,left+right,") != std::string::npos);
  CHECK(line.find("\"say \"\"hi\"\", airliner\"") != std::string::npos);
}

}  // namespace sigs::test
