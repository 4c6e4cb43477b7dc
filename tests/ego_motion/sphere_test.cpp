// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "base/least_squares.h"
#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "ego_motion/rotation_fit.h"
#include "sphere_footage.h"
#include "support/test_data.h"

namespace sigs::test {

namespace {

Result<EgoMotion> motion_of(const std::filesystem::path& path, const Camera& camera, const Track* track,
                            const EgoMotionControl& control) {
  Result<FrameSource> footage = FrameSource::open(path);
  REQUIRE(footage);
  return estimate_ego_motion(*footage, camera, {}, track, {}, control);
}

bool warns(const EgoMotion& motion, const std::string& part) {
  for (const Warning& warning : motion.warnings)
    if (warning.what.find(part) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("a camera that turns before a world at infinity is followed to a tenth of a pixel, within its deviation") {
  const std::vector<glm::dquat> truth = shaken_pan(60);
  for (const LensModel model : {LensModel::brown_conrady, LensModel::kannala_brandt}) {
    const TemporaryFolder folder;
    const Camera camera = sphere_camera(model);
    const auto motion =
        motion_of(sphere_footage(folder.path(), camera, truth, std::vector<int>(truth.size(), 1)), camera, nullptr, {});
    REQUIRE(motion);
    REQUIRE(motion->frames.size() == truth.size());
    double squares = 0;
    int outside = 0;
    for (std::size_t n = 1; n < truth.size(); ++n) {
      const EgoFrame& frame = motion->frames[n];
      CHECK_FALSE(frame.is_lost);
      // Both against frame 0.
      const glm::dquat found = glm::conjugate(motion->frames[0].world_from_camera) * frame.world_from_camera;
      const glm::dquat exact = glm::conjugate(truth[0]) * truth[n];
      const glm::dvec3 error_rad = vector_of(glm::conjugate(exact) * found);
      squares += squared_length(error_rad) / 3 / static_cast<double>(truth.size());
      for (int axis = 0; axis < 3; ++axis) outside += std::abs(error_rad[axis]) > 3 * frame.sd_rad[axis] ? 1 : 0;
    }
    CHECK(250 * std::sqrt(squares) < 0.1);
    CHECK(outside < static_cast<int>(truth.size()) / 20);
  }
}

TEST_CASE("where two scenes are joined there is a cut, from which on nothing is known against frame 0") {
  const TemporaryFolder folder;
  const Camera camera = sphere_camera(LensModel::brown_conrady);
  std::vector<int> seeds(20, 1);
  seeds.insert(seeds.end(), 20, 2);
  const auto motion = motion_of(sphere_footage(folder.path(), camera, shaken_pan(40), seeds), camera, nullptr, {});
  REQUIRE(motion);
  for (std::size_t n = 0; n < 40; ++n) {
    CHECK(motion->frames[n].is_cut == (n == 20));
    CHECK(motion->frames[n].is_lost == (n == 20));
    for (int axis = 0; axis < 3; ++axis)
      CHECK((motion->frames[n].sd_rad[axis] > 3) == (n >= 20));  // pi: nothing is known
  }
  CHECK(warns(*motion, "cut"));
}

TEST_CASE("footage that its camera stabilized is said to be") {
  const TemporaryFolder folder;
  const Camera camera = sphere_camera(LensModel::brown_conrady);
  const std::filesystem::path path = sphere_footage(folder.path(), camera, shaken_pan(12), std::vector<int>(12, 1));
  for (const double turned_deg : {0.0, 0.5}) {
    Track track{.format = "GPMF", .on_footage_time = true};
    for (int n = 0; n < 12; ++n) {
      track.camera_from_image.times_s.push_back(n / 25.0);
      track.camera_from_image.values.push_back(rotation_of({.yaw_rad = rad_of_deg(turned_deg * std::sin(n))}));
    }
    const auto motion = motion_of(path, camera, &track, {});
    REQUIRE(motion);
    CHECK(motion->is_stabilized == (turned_deg > 0));
    CHECK(warns(*motion, "stabilized") == (turned_deg > 0));
  }
}

TEST_CASE("an estimation that is cancelled half way ends as interrupted") {
  const TemporaryFolder folder;
  const Camera camera = sphere_camera(LensModel::brown_conrady);
  std::atomic<bool> cancel = false;
  int last = 0;
  const EgoMotionControl control{.progress =
                                     [&](int done, int total) {
                                       CHECK(total == 30);
                                       last = done;
                                       if (done == 15) cancel = true;
                                     },
                                 .cancel = &cancel};
  const auto motion = motion_of(sphere_footage(folder.path(), camera, shaken_pan(30), std::vector<int>(30, 1)), camera,
                                nullptr, control);
  REQUIRE_FALSE(motion);
  CHECK(motion.error().kind == ErrorKind::interrupted);
  CHECK(last == 15);
}

TEST_CASE("an estimation can be cancelled after all frames are decoded, with a log and a rolling shutter too") {
  const TemporaryFolder folder;
  const Camera camera = sphere_camera(LensModel::brown_conrady);
  const std::vector<glm::dquat> turns = shaken_pan(60);
  const auto path = sphere_footage(folder.path(), camera, turns, std::vector<int>(60, 1));
  Track log{.format = "CSV", .on_footage_time = true, .readout_s = 0.02};
  for (std::size_t k = 1; k < turns.size(); ++k) {
    log.camera_rate_radps.times_s.push_back((static_cast<double>(k) - 0.5) / 25);
    const glm::dquat turn = glm::conjugate(turns[k - 1]) * turns[k];
    log.camera_rate_radps.values.push_back(2.0 * 25.0 * glm::dvec3(turn.x, turn.y, turn.z) * (turn.w < 0 ? -1.0 : 1.0));
  }
  for (const Track* const track : {static_cast<const Track*>(nullptr), static_cast<const Track*>(&log)}) {
    std::vector<int> reports;
    REQUIRE(motion_of(path, camera, track, {.progress = [&](int done, int total) {
                        CHECK(total == 60);
                        reports.push_back(done);
                      }}));
    CHECK(std::is_sorted(reports.begin(), reports.end()));
    CHECK(reports.back() == 60);
    REQUIRE(reports.size() > 61);  // one for each frame decoded
    for (const std::size_t last : {std::size_t{59}, std::size_t{60}, reports.size() - 2}) {
      std::atomic<bool> cancel = false;
      std::size_t count = 0;
      const auto motion = motion_of(path, camera, track,
                                    {.progress =
                                         [&](int, int) {
                                           if (count++ == last) cancel = true;
                                         },
                                     .cancel = &cancel});
      CAPTURE(last);
      REQUIRE_FALSE(motion);
      CHECK(motion.error().kind == ErrorKind::interrupted);
      CHECK(count == last + 1);  // nothing goes on
    }
  }
}

}  // namespace sigs::test
