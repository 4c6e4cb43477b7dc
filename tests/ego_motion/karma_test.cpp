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
  const double length_s = 362 * 1001.0 / 30000;
  const Track gyro = karma_gyro(length_s);
  for (const bool fuse : {false, true}) {
  EgoMotionSettings settings;
  settings.use_gyro = fuse;
  const auto t0 = std::chrono::steady_clock::now();
  const Result<EgoMotion> motion = estimate_ego_motion(*footage, karma_camera(), {}, &gyro, settings, {});
  REQUIRE(motion);
  std::printf("took %.2f s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
  for (const Warning& w : motion->warnings) std::printf("%s\n", w.text().c_str());
  if (motion->gyro) std::printf("offset %.4f sd %.4f drift %g sd %g r %.4f slope %.4f\n", motion->gyro->offset_s, motion->gyro->offset_sd_s, motion->gyro->drift, motion->gyro->drift_sd, motion->gyro->correlation, motion->gyro->slope);
  if (motion->level_sd_rad) std::printf("level sd %.4f\n", *motion->level_sd_rad);
  for (std::size_t k = 0; k < motion->frames.size(); k += 30) {
    const EgoFrame& f = motion->frames[k];
    const Attitude a = attitude_of(f.world_from_camera);
    std::printf("%zu roll %.3f pitch %.3f yaw %.3f sd deg %.4f %.4f %.4f feats %d px sd %.3f\n", k, deg_of_rad(a.roll_rad), deg_of_rad(a.pitch_rad), deg_of_rad(a.yaw_rad), deg_of_rad(f.sd_rad.x), deg_of_rad(f.sd_rad.y), deg_of_rad(f.sd_rad.z), f.features, f.sd_rad.z * 563);
  }
  // per-axis correlations at -30 ms
  for (const double off : {-0.04, -0.03, -0.02})
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> seen, rec;
    for (std::size_t k = 1; k < motion->frames.size(); ++k) {
      const glm::dquat d = glm::conjugate(motion->frames[k - 1].world_from_camera) * motion->frames[k].world_from_camera;
      const double dt = motion->frames[k].time_s - motion->frames[k - 1].time_s;
      seen.push_back(2 * (axis == 0 ? d.x : axis == 1 ? d.y : d.z) * (d.w < 0 ? -1 : 1) / dt);
      double sum = 0; int n = 0;
      for (std::size_t i = 0; i < gyro.camera_rate_radps.values.size(); ++i) {
        const double t = gyro.camera_rate_radps.times_s[i] - off;
        if (t >= motion->frames[k - 1].time_s && t < motion->frames[k].time_s) sum += gyro.camera_rate_radps.values[i][axis], ++n;
      }
      rec.push_back(n ? sum / n : 0);
    }
    double slope = 0;
    const double r = correlation_of(seen, rec, slope);
    std::printf("off %.3f axis %d r %.4f slope %.4f\n", off, axis, r, slope);
  }
  }
  const auto t1 = std::chrono::steady_clock::now();
  Result<FrameSource> again = FrameSource::open(real_data() / "video/air_karma_gopro_coast.mp4");
  for (int n = 0; n < 362; ++n) REQUIRE(again->read(n));
  std::printf("decoding alone %.2f s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - t1).count());
}

}  // namespace sigs::test
