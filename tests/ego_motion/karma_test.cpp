// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "support/test_data.h"

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

}  // namespace

TEST_CASE("the coast clip turns as its gyroscope says") {
  if (!has_real_data()) return;
  Result<FrameSource> footage = FrameSource::open(real_data() / "video/air_karma_gopro_coast.mp4");
  REQUIRE(footage);
  const Track gyro = karma_gyro(362 * 1001.0 / 30000);
  EgoMotionSettings settings;
  settings.use_gyro = false;
  const Result<EgoMotion> motion = estimate_ego_motion(*footage, karma_camera(), {}, &gyro, settings, {});
  REQUIRE(motion);
  REQUIRE(motion->frames.size() == 362);
  constexpr double kOffset_s = -0.030;  // of the catalogue of the data
  std::vector<double> seen;
  std::vector<double> recorded;
  for (std::size_t k = 1; k < motion->frames.size(); ++k) {
    CHECK_FALSE(motion->frames[k].is_lost);
    const EgoFrame& before = motion->frames[k - 1];
    const EgoFrame& after = motion->frames[k];
    const glm::dquat turn = glm::conjugate(before.world_from_camera) * after.world_from_camera;
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < gyro.camera_rate_radps.values.size(); ++i) {
      const double t = gyro.camera_rate_radps.times_s[i] - kOffset_s;
      if (t < before.time_s || t >= after.time_s) continue;
      sum += gyro.camera_rate_radps.values[i].z;
      ++count;
    }
    if (count == 0) continue;
    seen.push_back(2 * turn.z * (turn.w < 0 ? -1 : 1) / (after.time_s - before.time_s));
    recorded.push_back(sum / count);
  }
  double slope = 0;
  const double r = correlation_of(seen, recorded, slope);
  MESSAGE("r " << r << ", slope " << slope);
  CHECK(r > 0.99);
  CHECK(slope == doctest::Approx(1).epsilon(0.03));  // the focal length is known to some percent
}

}  // namespace sigs::test
