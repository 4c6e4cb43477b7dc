// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/time_offset.h"
#include "support/test_data.h"
#include "synthetic_rays.h"

namespace sigs::test {

namespace {

// The recorded rates, columns z, x, y of the file, evenly over the clip as its recorder writes them.
Track karma_gyro(double length_s) {
  Track track{.format = "CSV", .on_footage_time = true};
  std::ifstream in(real_data() / "telemetry/gopro/karma_gyro.csv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string field;
    glm::dvec4 row(0);
    for (int i = 0; i < 4 && std::getline(fields, field, ','); ++i) row[i] = std::stod(field);
    // x to the right, y forward, z up.
    track.camera_rate_radps.values.emplace_back(row[3], row[2], -row[1]);
  }
  const std::size_t count = track.camera_rate_radps.values.size();
  for (std::size_t i = 0; i < count; ++i)
    track.camera_rate_radps.times_s.push_back(length_s * static_cast<double>(i) / static_cast<double>(count));
  track.camera_rate_radps.source = "GPMF GYRO";
  return track;
}

Camera karma_camera() {
  // A lens of an even scale: 563 px a radian at 854 px width.
  return {.lens = *Lens::make({.model = LensModel::kannala_brandt,
                               .fx = 562.8,
                               .fy = 562.8,
                               .cx = 426.5,
                               .cy = 239.5,
                               .coefficients = {0, 0, 0, 0}}),
          .size_px = {854, 480}};
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b, double& slope) {
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / double(a.size()), mb += b[i] / double(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  slope = ab / bb;
  return ab / std::sqrt(aa * bb);
}

// The yaw rate that the log has at a time, by linear interpolation.
double recorded_at(const Channel<glm::dvec3>& log, double t) {
  const auto after = std::upper_bound(log.times_s.begin(), log.times_s.end(), t);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - log.times_s.begin(), 1, std::ptrdiff_t(log.times_s.size()) - 1));
  const double share = (t - log.times_s[i - 1]) / (log.times_s[i] - log.times_s[i - 1]);
  return log.values[i - 1].z + share * (log.values[i].z - log.values[i - 1].z);
}

// Its mean over an interval.
double recorded_mean(const Channel<glm::dvec3>& log, double from_s, double to_s) {
  constexpr int kParts = 32;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) sum += recorded_at(log, from_s + (to_s - from_s) * (i + 0.5) / kParts);
  return sum / kParts;
}

// Motion in x of the whole image between successive frames, px: the peak of the phase correlation.
std::vector<double> motion_in_x(FrameSource& footage) {
  std::vector<double> motion_px;
  cv::Mat before;
  cv::Mat window;
  cv::createHanningWindow(window, footage.info().size_px, CV_32F);
  for (int n = 0; n < footage.info().frame_count(); ++n) {
    const auto frame = footage.read(n);
    REQUIRE(frame);
    cv::Mat luma;
    frame->planes[0].convertTo(luma, CV_32F);
    if (n > 0) motion_px.push_back(cv::phaseCorrelate(before, luma, window).x);
    before = luma;
  }
  return motion_px;
}

// The lag, seconds, at which the log sampled at time + lag follows the motion best; motions from frame k - 1 to k are
// dated `share` of the interval before frame k.
double best_lag_s(const std::vector<double>& motion_px, const std::vector<double>& times_s,
                  const Channel<glm::dvec3>& log, double share) {
  double best = 0;
  double best_s = 0;
  for (int lag_ms = -90; lag_ms <= 60; ++lag_ms) {
    std::vector<double> recorded;
    std::vector<double> seen;
    for (std::size_t k = 4; k + 4 < times_s.size(); ++k) {
      seen.push_back(motion_px[k - 1]);
      const double length_s = times_s[k] - times_s[k - 1];
      const double middle_s = times_s[k] - share * length_s + 1e-3 * lag_ms;
      recorded.push_back(recorded_mean(log, middle_s - length_s / 2, middle_s + length_s / 2));
    }
    double slope = 0;
    const double r = std::abs(correlation_of(seen, recorded, slope));
    if (r <= best) continue;
    best = r;
    best_s = 1e-3 * lag_ms;
  }
  return best_s;
}

Result<EgoMotion> karma_motion(const Track& gyro, bool use_gyro) {
  Result<FrameSource> footage = FrameSource::open(real_data() / "video/air_karma_gopro_coast.mp4");
  REQUIRE(footage);
  return estimate_ego_motion(*footage, karma_camera(), {}, &gyro, {.use_gyro = use_gyro}, {});
}

std::vector<SeenTurn> turns_of(const EgoMotion& motion) {
  std::vector<SeenTurn> turns;
  for (std::size_t k = 1; k < motion.frames.size(); ++k) {
    const EgoFrame& before = motion.frames[k - 1];
    const EgoFrame& after = motion.frames[k];
    const glm::dquat turn = glm::conjugate(before.world_from_camera) * after.world_from_camera;
    turns.push_back({before.time_s, after.time_s, vector_of(turn)});
  }
  return turns;
}

// Up in camera axes of a sea's horizon through two points of the image.
glm::dvec3 up_of_line(const glm::dvec2& left_px, const glm::dvec2& right_px) {
  const Camera camera = karma_camera();
  return glm::normalize(glm::cross(*camera.lens.ray(right_px), *camera.lens.ray(left_px)));
}

}  // namespace

TEST_CASE("the coast clip turns as its gyroscope says, with the offset that the motion of the whole image has") {
  if (!has_real_data()) return;
  const Track gyro = karma_gyro(362 * 1001.0 / 30000);
  const Result<EgoMotion> motion = karma_motion(gyro, false);
  REQUIRE(motion);
  REQUIRE(motion->frames.size() == 362);
  Result<FrameSource> footage = FrameSource::open(real_data() / "video/air_karma_gopro_coast.mp4");
  REQUIRE(footage);
  const std::vector<double> motion_px = motion_in_x(*footage);
  const std::vector<double>& times_s = footage->info().times_s;
  // The catalogue of the data has -30 ms with motions dated at the later frame. A motion over an interval belongs to
  // its middle, half a frame earlier.
  CHECK(std::abs(best_lag_s(motion_px, times_s, gyro.camera_rate_radps, 0) + 0.030) < 0.005);
  const double lag_s = best_lag_s(motion_px, times_s, gyro.camera_rate_radps, 0.5);
  const Result<EgoMotion> with_gyro = karma_motion(gyro, true);
  REQUIRE(with_gyro);
  REQUIRE(with_gyro->gyro);
  CHECK(std::abs(with_gyro->gyro->offset_s - lag_s) < 0.005);

  // Coarse to fine finds what the comparison of all offsets finds, over ten seconds to both sides.
  const std::vector<SeenTurn> turns = turns_of(*motion);
  const RateIntegral rates(gyro.camera_rate_radps);
  const auto found = time_offset(turns, rates, 10);
  REQUIRE(found);
  CHECK(std::abs(found->offset_s - exhaustive_offset(turns, rates, 10).offset_s) < 1e-6);

  std::vector<double> seen;
  std::vector<double> recorded;
  for (std::size_t k = 4; k + 4 < motion->frames.size(); ++k) {
    CHECK_FALSE(motion->frames[k].is_lost);
    const EgoFrame& before = motion->frames[k - 1];
    const EgoFrame& after = motion->frames[k];
    const glm::dquat turn = glm::conjugate(before.world_from_camera) * after.world_from_camera;
    seen.push_back(2 * turn.z * (turn.w < 0 ? -1 : 1) / (after.time_s - before.time_s));
    recorded.push_back(recorded_mean(gyro.camera_rate_radps, before.time_s + lag_s, after.time_s + lag_s));
  }
  double slope = 0;
  const double r = correlation_of(seen, recorded, slope);
  CAPTURE(r);
  CAPTURE(slope);
  CHECK(r > 0.99);
  CHECK(slope == doctest::Approx(1).epsilon(0.02));  // the focal length is known to some percent
}

TEST_CASE("the coast clip's sea horizon gives the roll that a ruler gives") {
  if (!has_real_data()) return;
  Result<EgoMotion> motion = karma_motion({.on_footage_time = true}, false);
  REQUIRE(motion);
  REQUIRE(motion->level_sd_rad);
  CHECK(deg_of_rad(*motion->level_sd_rad) < 0.6);
  struct Line {
    std::size_t frame;
    glm::dvec2 left_px, right_px;  // where the horizon meets the left border and the cliff, to 1 px
  };
  for (const Line& line :
       {Line{0, {0, 235}, {360, 249.5}}, {180, {0, 233}, {360, 233}}, {340, {0, 232.5}, {368, 222}}}) {
    const glm::dvec3 found = glm::conjugate(motion->frames[line.frame].world_from_camera) * glm::dvec3(0, 0, -1);
    const glm::dvec3 measured = up_of_line(line.left_px, line.right_px);
    CAPTURE(line.frame);
    CHECK(std::abs(deg_of_rad(std::atan2(found.y, -found.z) - std::atan2(measured.y, -measured.z))) < 0.5);
    CHECK(std::abs(deg_of_rad(found.x - measured.x)) < 0.5);  // pitch
  }
}

}  // namespace sigs::test
