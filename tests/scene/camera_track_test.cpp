// SPDX-License-Identifier: MIT
#include "scene/camera_track.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "scene/scene_at.h"

namespace sigs {
namespace {

constexpr double kFrames_hz = 25;
const GeodeticPosition kStart{33.126, -117.3315, 40};

FootageShape ten_seconds() {
  FootageShape footage{.size_px = {640, 480}, .frame_interval_s = 1 / kFrames_hz};
  for (int i = 0; i <= 250; ++i) footage.times_s.push_back(i / kFrames_hz);
  return footage;
}

Project with_log() {
  Project project;
  project.camera.position_m = {3, -4, -150};
  project.camera.track.file = "flight.csv";
  return project;
}

// A metre eastwards, by the radius of curvature of the prime vertical (a / sqrt(1 - e^2 sin^2 latitude)).
double degrees_of_east(double metres, const GeodeticPosition& at) {
  const double latitude = rad_of_deg(at.latitude_deg);
  const double e2 = 0.00669437999014;
  const double radius_m = 6378137.0 / std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
  return deg_of_rad(metres / ((radius_m + at.height_m) * std::cos(latitude)));
}

// Eastwards at 20 m/s and climbing at 2 m/s, from log time 0 to 10 s.
Track eastwards() {
  Track track{.file = "flight.csv", .format = "CSV"};
  track.position.source = "position";
  for (int i = 0; i <= 100; ++i) {
    const double t = i * 0.1;
    track.position.times_s.push_back(t);
    track.position.values.push_back(
        {kStart.latitude_deg, kStart.longitude_deg + degrees_of_east(20 * t, kStart), kStart.height_m + 2 * t});
  }
  return track;
}

void add_airframe(Track& track, const Attitude& at_start, double yaw_rate_radps) {
  track.ned_from_airframe.source = "attitude";
  for (int i = 0; i <= 1000; ++i) {
    const double t = i * 0.01;
    track.ned_from_airframe.times_s.push_back(t);
    track.ned_from_airframe.values.push_back(
        rotation_of({at_start.roll_rad, at_start.pitch_rad, at_start.yaw_rad + yaw_rate_radps * t}));
  }
}

// Of a log without attitude, a project has to say that it needs none.
Project accepting(Project project, const Track& track) {
  if (track.ned_from_airframe.empty() && track.ned_from_camera.empty())
    project.camera.track.attitude = TrackAttitudeChoice::none;
  return project;
}

CameraFlight flown(const Project& project, const Track& track) {
  const Result<CameraFlight, Problem> flight = flight_by_log(accepting(project, track), track, ten_seconds(), {0, 250});
  if (!flight) FAIL(flight.error().field, ": ", flight.error().what);
  return *flight;
}

std::string problem_of(const Project& project, const Track& track, const FrameRange& range = {0, 250}) {
  const Result<CameraFlight, Problem> flight = flight_by_log(project, track, ten_seconds(), range);
  return flight ? "no problem" : flight.error().field + ": " + flight.error().what;
}

double angle_of(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = glm::conjugate(a) * b;
  return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

bool has_warning(const CameraFlight& flight, const std::string& word) {
  for (const Warning& warning : flight.warnings)
    if (warning.what.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("the exposure time is the project's, else the log's at the frame's time, else none") {
  Track track = eastwards();
  CHECK(flown(with_log(), track).motion.exposures.empty());
  CHECK(exposure_at({}, 3) == 0);
  track.exposure_s = {.source = "SHUT", .times_s = {1, 2, 3, 4}, .values = {0.01, 0.02, -1, 0.004}};
  Project project = with_log();
  project.camera.track.incomplete = IncompleteTrackChoice::use;
  project.camera.track.offset_s = 0.5;  // the log's 1 s is the footage's 0.5 s
  const CameraFlight flight = flown(project, track);
  const std::vector<ExposureTime>& exposures = flight.motion.exposures;
  REQUIRE(exposures.size() == 3);  // the negative one is none
  CHECK(exposure_at(exposures, 0) == doctest::Approx(0.01));
  CHECK(exposure_at(exposures, 1) == doctest::Approx(0.015));
  CHECK(exposure_at(exposures, 2.5) == doctest::Approx(0.012));
  CHECK(exposure_at(exposures, 100) == doctest::Approx(0.004));
  project.camera.exposure_s = 0.002;
  CHECK(exposure_at(flown(project, track).motion.exposures, 1) == 0.002);
  project.camera.exposure_s = 0;
  CHECK(exposure_at(flown(project, track).motion.exposures, 1) == 0);
}

TEST_CASE("without attitude, world X is the course over ground and the camera starts at its position") {
  const CameraFlight flight = flown(with_log(), eastwards());
  CHECK(has_warning(flight, "course over ground"));
  for (const double t : {0.0, 0.33, 4.0, 9.9}) {
    const glm::dvec3 at = camera_at(flight.motion, t).translation_m;
    // The parallel bends away from the tangent by d^2 / 2r: 3 mm at 200 m.
    CHECK(glm::distance(at, glm::dvec3(3 + 20 * t, -4, -150 - 2 * t)) < 0.005);
  }
  REQUIRE(flight.earth);
  CHECK(flight.earth->heading_rad() == doctest::Approx(rad_of_deg(90)).epsilon(1e-4));
  const GeodeticPosition place = flight.earth->place_of({3, -4, -150});
  CHECK(place.latitude_deg == doctest::Approx(kStart.latitude_deg).epsilon(1e-12));
  CHECK(place.longitude_deg == doctest::Approx(kStart.longitude_deg).epsilon(1e-12));
  CHECK(place.height_m == doctest::Approx(kStart.height_m).epsilon(1e-9));
  CHECK(flight.motion.source.position == "CSV: position");
  CHECK_FALSE(flight.horizon_is_known);
}

TEST_CASE("the log's attitude stands left of the mount's angles, and world X is its heading at frame 0") {
  Track track = eastwards();
  add_airframe(track, {0.1, 0.05, rad_of_deg(60)}, 0.2);
  Project project = with_log();
  project.camera.roll_deg = 2;
  project.camera.pitch_deg = -30;
  project.camera.yaw_deg = 15;
  const CameraFlight flight = flown(project, track);
  CHECK(flight.horizon_is_known);
  for (const double t : {0.0, 1.234, 8.0}) {
    const glm::dquat expected =
        rotation_of({0.1, 0.05, 0.2 * t}) * rotation_of({rad_of_deg(2), rad_of_deg(-30), rad_of_deg(15)});
    CHECK(angle_of(camera_at(flight.motion, t).rotation, expected) < 1e-9);
  }
  // East lies 30 degrees to the right of world X.
  const glm::dvec3 moved = camera_at(flight.motion, 5).translation_m - camera_at(flight.motion, 0).translation_m;
  CHECK(std::atan2(moved.y, moved.x) == doctest::Approx(rad_of_deg(30)).epsilon(1e-4));
}

TEST_CASE("a camera's attitude comes before an airframe's unless the other is asked for") {
  Track track = eastwards();
  add_airframe(track, {}, 0);
  track.ned_from_camera = {
      .source = "gimbal", .times_s = {0, 10}, .values = {rotation_of({0, -0.5, 0}), rotation_of({0, -0.5, 0})}};
  Project project = with_log();
  CHECK(flown(project, track).motion.source.attitude == "CSV: gimbal");
  CHECK(attitude_of(camera_at(flown(project, track).motion, 1).rotation).pitch_rad == doctest::Approx(-0.5));
  project.camera.track.attitude = TrackAttitudeChoice::airframe;
  CHECK(flown(project, track).motion.source.attitude == "CSV: attitude");
  project.camera.track.attitude = TrackAttitudeChoice::none;
  CHECK(flown(project, track).motion.attitudes.empty());
}

TEST_CASE("the offset is the log's time at frame 0") {
  Track track = eastwards();
  add_airframe(track, {}, 0.1);
  Project project = with_log();
  project.camera.track.offset_s = 2;
  const Result<CameraFlight, Problem> flight = flight_by_log(project, track, ten_seconds(), {0, 150});
  REQUIRE(flight);
  const glm::dvec3 at_0 = camera_at(flight->motion, 0).translation_m;
  CHECK(glm::distance(at_0, project.camera.position_m) < 1e-6);
  // World X is the heading at frame 0, log time 2 s.
  CHECK(attitude_of(camera_at(flight->motion, 3).rotation).yaw_rad == doctest::Approx(0.3).epsilon(1e-9));
}

TEST_CASE("where the world's place is stated, the log's positions are absolute") {
  Project project = with_log();
  project.geo = {.latitude_deg = kStart.latitude_deg - 0.01,
                 .longitude_deg = kStart.longitude_deg,
                 .height_m = 10,
                 .heading_deg = 0};
  const CameraFlight flight = flown(project, eastwards());
  const glm::dvec3 at = camera_at(flight.motion, 0).translation_m;
  // A hundredth of a degree of latitude at 33.1 degrees: 1109.1 m by the meridian's radius of curvature.
  const double e2 = 0.00669437999014;
  const double s = std::sin(rad_of_deg(kStart.latitude_deg - 0.005));
  const double arc_m = rad_of_deg(0.01) * 6378137.0 * (1 - e2) / std::pow(1 - e2 * s * s, 1.5);
  CHECK(at.x == doctest::Approx(arc_m).epsilon(1e-5));
  CHECK(std::abs(at.y) < 1e-3);
  CHECK(at.z == doctest::Approx(-30 + arc_m * arc_m / (2 * 6.371e6)).epsilon(1e-3));
}

TEST_CASE("a local position from an arbitrary origin moves the camera from its own start") {
  Track track{.file = "flight.ulg", .format = "PX4 ULog"};
  track.local_position_ned_m = {
      .source = "local", .times_s = {0, 5, 10}, .values = {{100, 200, -30}, {150, 200, -30}, {200, 200, -30}}};
  const CameraFlight flight = flown(with_log(), track);
  CHECK(glm::distance(camera_at(flight.motion, 10).translation_m, glm::dvec3(103, -4, -150)) < 1e-9);
  CHECK_FALSE(flight.earth);
}

TEST_CASE("yaw that is not against north counts from frame 0, with its deviation") {
  Track track{.file = "attitude.csv", .format = "CSV", .heading_is_north = false};
  const double unknown = std::numeric_limits<double>::infinity();
  track.ned_from_camera = {.source = "camera",
                           .times_s = {0, 5, 10},
                           .values = {rotation_of({0, 0, 1}), rotation_of({0, 0, 1.5}), rotation_of({0, 0, 2})}};
  track.camera_attitude_sd_rad = {
      .source = "sd", .times_s = {0, 5, 10}, .values = {{0.1, 0, 0}, {0.3, 0, 0}, {unknown, unknown, unknown}}};
  const CameraFlight flight = flown(with_log(), track);
  CHECK(attitude_of(camera_at(flight.motion, 5).rotation).yaw_rad == doctest::Approx(0.5));
  CHECK(attitude_sd_at(flight.motion.deviations, 2.5)->x == doctest::Approx(0.2));
  CHECK(attitude_sd_at(flight.motion.deviations, 5)->x == doctest::Approx(0.3));
  CHECK(attitude_sd_at(flight.motion.deviations, 7)->x == unknown);
  CHECK_FALSE(attitude_sd_at({}, 7));
  CHECK(glm::distance(camera_at(flight.motion, 5).translation_m, glm::dvec3(3, -4, -150)) == 0);
}

TEST_CASE("turns since the first sample stand right of the attitude at the start, and say nothing of the horizon") {
  Track track{.file = "attitude.csv", .format = "images", .heading_is_north = false, .level_is_known = false};
  const glm::dquat turn = rotation_of({0.1, -0.2, 0.7});
  track.ned_from_camera = {
      .source = "ego-motion", .times_s = {0, 5, 10}, .values = {glm::dquat(1, 0, 0, 0), turn, turn}};
  Project project = with_log();
  CHECK_FALSE(flown(project, track).horizon_is_known);
  CHECK(has_warning(flown(project, track), "counts as level"));
  project.camera.roll_deg = 5;
  project.camera.pitch_deg = -25;
  const CameraFlight flight = flown(project, track);
  CHECK(flight.horizon_is_known);
  const glm::dquat start = rotation_of({rad_of_deg(5), rad_of_deg(-25), 0});
  CHECK(angle_of(camera_at(flight.motion, 0).rotation, start) < 1e-9);
  CHECK(angle_of(camera_at(flight.motion, 5).rotation, start * turn) < 1e-9);
}

TEST_CASE("a log that does not cover the frames, or is damaged, is refused by name unless the project allows it") {
  Track track = eastwards();
  Project project = accepting(with_log(), track);
  project.camera.track.offset_s = 4;
  CHECK(problem_of(project, track).find("covers 0.000 to 10.000 s") != std::string::npos);
  CHECK(problem_of(project, track, {0, 150}) == "no problem");
  project.camera.track.incomplete = IncompleteTrackChoice::use;
  CHECK(problem_of(project, track) == "no problem");
  CHECK(has_warning(*flight_by_log(project, track, ten_seconds(), {0, 250}), "flies straight on"));
  project.camera.track.offset_s = 1000;
  CHECK(problem_of(project, track).find("offset_s") != std::string::npos);

  project = accepting(with_log(), track);
  track.damaged = true;
  CHECK(problem_of(project, track).find("damaged") != std::string::npos);
  project.camera.track.incomplete = IncompleteTrackChoice::use;
  CHECK(problem_of(project, track) == "no problem");
}

TEST_CASE("what the project asks for and the log has not is named") {
  Project project = with_log();
  project.camera.track.attitude = TrackAttitudeChoice::camera;
  CHECK(problem_of(project, eastwards()).find("no attitude of the camera") != std::string::npos);
  project.camera.track.attitude = TrackAttitudeChoice::automatic;
  project.camera.track.position = TrackPositionChoice::log;
  Track track{.file = "a.csv", .format = "CSV"};
  add_airframe(track, {}, 0);
  CHECK(problem_of(project, track).find("no position") != std::string::npos);
  project.camera.track.position = TrackPositionChoice::none;
  project.camera.track.attitude = TrackAttitudeChoice::none;
  CHECK(problem_of(project, track).find("neither attitude nor position") != std::string::npos);
}

TEST_CASE("a camera at rest with equal stamps and places gives finite numbers") {
  Track track{.file = "a.csv", .format = "CSV"};
  track.position = {.source = "gps", .times_s = {0, 0, 1, 10}, .values = {kStart, kStart, kStart, kStart}};
  const CameraFlight flight = flown(with_log(), track);
  CHECK(has_warning(flight, "hardly moves"));
  CHECK(glm::distance(camera_at(flight.motion, 3).translation_m, glm::dvec3(3, -4, -150)) < 1e-6);
}

TEST_CASE("the readout is the project's, else the log's") {
  Project project = with_log();
  Track track = eastwards();
  track.readout_s = 0.0166;
  CHECK(flown(project, track).motion.readout_s == 0.0166);
  project.camera.readout_s = 0;
  CHECK(flown(project, track).motion.readout_s == 0);
}

TEST_CASE("an attitude that is the camera's own is not turned by camera.attitude_deg, which is that of the start") {
  // As the images of a camera that looks down by 18 degrees give it, with a horizon in sight.
  Track track{.file = "attitude.csv", .format = "images", .heading_is_north = false, .attitude_is_whole = true};
  const glm::dquat at_start = rotation_of({0.02, rad_of_deg(-18), 0.3});
  const glm::dquat later = rotation_of({0.05, rad_of_deg(-10), 0.8});
  track.ned_from_camera = {.source = "ego-motion", .times_s = {0, 5, 10}, .values = {at_start, later, later}};
  Project project = with_log();
  project.camera.roll_deg = 1;
  project.camera.pitch_deg = -18;
  project.camera.yaw_deg = 25;
  const auto pitch_deg = [&](TrackMountChoice mount) {
    project.camera.track.mount = mount;
    return deg_of_rad(attitude_of(camera_at(flown(project, track).motion, 0).rotation).pitch_rad);
  };
  CHECK(pitch_deg(TrackMountChoice::automatic) == doctest::Approx(-18));
  CHECK(pitch_deg(TrackMountChoice::none) == doctest::Approx(-18));
  CHECK(pitch_deg(TrackMountChoice::attitude_deg) == doctest::Approx(-34.5).epsilon(0.05));  // yaw and roll share in it
  // The heading at the start, which the images do not know, stays where waypoints were placed by it.
  project.camera.track.mount = TrackMountChoice::automatic;
  for (const auto& [time_s, rotation] : {std::pair(0.0, at_start), std::pair(5.0, later)})
    CHECK(angle_of(camera_at(flown(project, track).motion, time_s).rotation,
                   rotation_of({0, 0, rad_of_deg(25) - 0.3}) * rotation) < 1e-9);
  // A file that does not say so is turned, as it was before there was such a statement.
  track.attitude_is_whole = false;
  CHECK(pitch_deg(TrackMountChoice::automatic) == pitch_deg(TrackMountChoice::attitude_deg));
  // With a heading against north nothing of camera.attitude_deg is left.
  track.heading_is_north = true;
  project.camera.track.mount = TrackMountChoice::none;
  CHECK(angle_of(camera_at(flown(project, track).motion, 5).rotation, rotation_of({0, 0, -0.3}) * later) < 1e-9);
}

TEST_CASE("a log without any attitude is refused with what it has, unless none is asked for") {
  Track track = eastwards();
  track.camera_rate_radps = {.source = "GPMF GYRO", .times_s = {0, 10}, .values = {{0, 0, 0}, {0, 0, 0}}};
  const Result<CameraFlight, Problem> flight = flight_by_log(with_log(), track, ten_seconds(), {0, 250});
  REQUIRE_FALSE(flight);
  CHECK(flight.error().field == "camera.track.file");
  for (const char* const words : {"position (position)", "angular rates of the camera (GPMF GYRO)", "sigs ego-motion",
                                  "camera.track.attitude to none"})
    CHECK_MESSAGE(flight.error().what.find(words) != std::string::npos, words);
  CHECK(problem_of(accepting(with_log(), track), track) == "no problem");
}

TEST_CASE("a log that does not know the attitude in most of the frames is refused, one that knows most says so first") {
  Track track{.file = "attitude.csv", .format = "images", .heading_is_north = false};
  const glm::dvec3 unknown(3.14159265358979);
  const auto log_until = [&](int known) {
    track.ned_from_camera = {.source = "ego-motion"};
    track.camera_attitude_sd_rad = {.source = "ego-motion"};
    for (int i = 0; i <= 250; ++i) {
      track.ned_from_camera.times_s.push_back(i / kFrames_hz);
      track.ned_from_camera.values.push_back(glm::dquat(1, 0, 0, 0));
      track.camera_attitude_sd_rad.times_s.push_back(i / kFrames_hz);
      track.camera_attitude_sd_rad.values.push_back(i < known ? glm::dvec3(0.001) : unknown);
    }
    return track;
  };
  Project project = with_log();
  CHECK(problem_of(project, log_until(2)).find("in 249 of the project's 251 frames") != std::string::npos);
  project.camera.track.incomplete = IncompleteTrackChoice::use;
  CHECK(flown(project, log_until(2)).warnings.front().what.find("in 249 of") != std::string::npos);
  project.camera.track.incomplete = IncompleteTrackChoice::refuse;
  CHECK(flown(project, log_until(200)).warnings.front().what.find("in 51 of") != std::string::npos);
  CHECK_FALSE(has_warning(flown(project, log_until(251)), "does not know the camera's attitude"));
}

}  // namespace sigs
