// SPDX-License-Identifier: MIT
#include "ego_motion/project_motion.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/staged_outputs.h"
#include "project/project.h"
#include "scene/camera_track.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"
#include "sphere_footage.h"
#include "support/test_data.h"
#include "telemetry/track_csv.h"

using namespace sigs;
using namespace sigs::test;

namespace {

constexpr int kFrames = 75;
constexpr double kPitch_deg = -18;

// A camera that looks down by 18 degrees, pans and shakes, over textured ground below a plain sky.
struct SteepFlight {
  TemporaryFolder folder;
  std::vector<glm::dquat> world_from_camera;
  Project project;

  SteepFlight() {
    for (const glm::dquat& turn : shaken_pan(kFrames)) {
      const Attitude shaken = attitude_of(turn);
      world_from_camera.push_back(
          rotation_of({shaken.roll_rad, shaken.pitch_rad + rad_of_deg(kPitch_deg), shaken.yaw_rad}));
    }
    const Camera camera = sphere_camera(LensModel::brown_conrady);
    project.footage.video =
        sphere_footage(folder.path(), camera, world_from_camera, std::vector<int>(kFrames, -5)).filename().string();
    REQUIRE(write_text(folder / "lens.yml",
                       "%YAML:1.0\n---\nimage_width: 320\nimage_height: 240\ncamera_matrix: !!opencv-matrix\n"
                       "   rows: 3\n   cols: 3\n   dt: d\n   data: [250., 0., 159.5, 0., 250., 119.5, 0., 0., 1.]\n"
                       "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
                       "   data: [0., 0., 0., 0., 0.]\n",
                       true));
    project.file = folder / "p.json";
    project.footage.calibration = "lens.yml";
    project.camera.roll_deg = 0.2;  // as the horizon in a few frames shows it
    project.camera.pitch_deg = -18.3;
  }

  [[nodiscard]] ProjectMotion estimated() const {
    Result<ProjectMotion> found = estimated_project_motion(project, {});
    if (!found) FAIL(found.error().text());
    REQUIRE(write_text(folder / "a.csv", track_csv_text(found->track), true));
    found->found.file = "a.csv";
    return *std::move(found);
  }

  // All but intruders and light.
  [[nodiscard]] Scene scene_of(const Project& changed) const {
    const Result<FrameSource> footage = open_footage(changed);
    REQUIRE(footage);
    Scene scene = bare_scene(changed, shape_of(footage->info()));
    scene.last_frame = kFrames - 1;
    scene.camera = sphere_camera(LensModel::brown_conrady);
    SceneFiles files;
    Result<CameraFlight, Problem> flight = camera_flight(changed, scene.footage, {0, kFrames - 1}, files);
    if (!flight) FAIL(flight.error().field, ": ", flight.error().what);
    set_camera_motion(scene, *std::move(flight));
    return scene;
  }

  // The largest error of the camera's attitude over the frames, its heading at frame 0 being this one.
  [[nodiscard]] double error_deg(const Project& changed, double heading_deg = 0) const {
    const Scene scene = scene_of(changed);
    const double yaw_rad = attitude_of(world_from_camera.front()).yaw_rad - rad_of_deg(heading_deg);
    double most_rad = 0;
    for (int n = 0; n < kFrames; ++n) {
      const glm::dquat truth = rotation_of({0, 0, -yaw_rad}) * world_from_camera[static_cast<std::size_t>(n)];
      const glm::dquat off = glm::conjugate(truth) * camera_at(scene.motion, n / 25.0).rotation;
      most_rad = std::max(most_rad, 2 * std::atan2(glm::length(glm::dvec3(off.x, off.y, off.z)), std::abs(off.w)));
    }
    return deg_of_rad(most_rad);
  }

  [[nodiscard]] std::optional<Problem> contradiction(const Project& changed) const {
    Result<FrameSource> footage = open_footage(changed);
    REQUIRE(footage);
    const Scene scene = scene_of(changed);
    return level_contradiction(seen_horizons(*footage, scene, nullptr), changed, scene);
  }
};

}  // namespace

TEST_CASE("a project whose pitch is by the horizon follows attitudes that are level by the same horizon, once") {
  const SteepFlight flight;
  const ProjectMotion found = flight.estimated();
  REQUIRE(found.motion.level_sd_rad);
  Project followed = flight.project;
  follow_attitudes(followed, found.found);
  CHECK(followed.camera.track.mount == TrackMountChoice::none);
  CHECK(std::abs(*followed.camera.pitch_deg - deg_of_rad(attitude_of(flight.world_from_camera.front()).pitch_rad)) < 1);
  // The level is that of an edge, to half a degree or so; counted twice it would be off by 18.
  CHECK(flight.error_deg(followed) < 1);
  CHECK_FALSE(flight.contradiction(followed));
  // The file alone says the same to a project that names it.
  Project named = flight.project;
  named.camera.track.file = "a.csv";
  CHECK(flight.error_deg(named) < 1);
  // A mount is taken by its word, and the horizon in sight contradicts it.
  named.camera.track.mount = TrackMountChoice::attitude_deg;
  CHECK(flight.error_deg(named) > 15);
  const std::optional<Problem> twice = flight.contradiction(named);
  REQUIRE(twice);
  CHECK(twice->field == "camera.track.mount");
  CHECK(twice->what.find("horizon in the image") != std::string::npos);
}

TEST_CASE("a rig whose first camera has a turned mount follows attitudes that are level by the horizon, once") {
  const SteepFlight flight;
  Project rig = flight.project;
  rig.camera.roll_deg = rig.camera.pitch_deg = 0;  // the aircraft's
  rig.cameras = {{.name = "front", .footage = rig.footage, .mount = {.pitch_deg = -18.3, .yaw_deg = 30}}};
  Project seen = seen_by(rig, 0);
  Result<ProjectMotion> found = estimated_project_motion(seen, {});
  REQUIRE(found);
  REQUIRE(found->motion.level_sd_rad);
  REQUIRE(write_text(flight.folder / "a.csv", track_csv_text(found->track), true));
  found->found.file = "a.csv";
  follow_attitudes(seen, found->found);
  CHECK(flight.error_deg(seen, 30) < 1);
  CHECK(flight.error_deg(seen_by(put_back(rig, seen), 0), 30) < 1);
}

TEST_CASE("an attitude that contradicts the horizon in sight is named, one that agrees or is not stated is not") {
  const SteepFlight flight;
  CHECK_FALSE(flight.contradiction(flight.project));
  Project wrong = flight.project;
  wrong.camera.pitch_deg = -36.9;
  const std::optional<Problem> problem = flight.contradiction(wrong);
  REQUIRE(problem);
  CHECK(problem->field == "camera.attitude_deg");
  wrong.camera.pitch_deg.reset();
  wrong.camera.roll_deg.reset();
  CHECK_FALSE(flight.contradiction(wrong));
}

TEST_CASE("what a project had of position, heading and mount stays right when it follows found attitudes") {
  Project project;
  project.camera.roll_deg = 2;
  project.camera.pitch_deg = -30;
  project.camera.yaw_deg = 10;
  project.camera.attitude_file = "old.csv";
  project.camera.track = {.file = "old.ulg", .offset_s = 3, .position = TrackPositionChoice::none};
  follow_attitudes(project, {.file = "a.csv",
                             .is_complete = false,
                             .stated_at_start = Attitude{0.1, -0.4, 0.2},
                             .heading_of_world_rad = 1.0});
  const CameraSettings& camera = project.camera;
  CHECK(camera.track.file == "a.csv");
  CHECK(camera.track.offset_s == 0);
  CHECK(camera.track.position == TrackPositionChoice::none);
  CHECK(camera.track.incomplete == IncompleteTrackChoice::use);
  CHECK(camera.attitude_file.empty());
  // Those of a mount on the old log's airframe are those of the camera at the start now.
  CHECK(camera.roll_deg == doctest::Approx(5.73));
  CHECK(camera.pitch_deg == doctest::Approx(-22.92));
  CHECK(camera.yaw_deg == doctest::Approx(11.46));
  CHECK(project.geo.heading_deg == doctest::Approx(57.3));
}

TEST_CASE("a motion of which most frames are not known is refused, with the numbers") {
  EgoMotion motion;
  motion.frames.resize(303);
  for (std::size_t k = 2; k < 303; ++k) motion.frames[k].sd_rad = glm::dvec3(kUnknownRotation_rad);
  CHECK(unknown_frames(motion) == 301);
  const Result<void> known = check_known(motion, "clip.mp4");
  REQUIRE_FALSE(known);
  CHECK(known.error().where == "clip.mp4");
  CHECK(known.error().what.find("301 of 303 frames") != std::string::npos);
  CHECK(check_known(motion, "clip.mp4", 1));
  for (std::size_t k = 2; k < 152; ++k) motion.frames[k].sd_rad = glm::dvec3(0.01);
  CHECK(check_known(motion, "clip.mp4"));
}
