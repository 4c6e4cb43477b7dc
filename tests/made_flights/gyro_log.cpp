// SPDX-License-Identifier: MIT
#include "made_flights/gyro_log.h"

#include <fmt/format.h>

#include <fstream>

#include "made_flights/random.h"

namespace sigs::made {

std::vector<GyroSample> gyro_log(const Motion& motion, double duration_s, const GyroSettings& settings) {
  std::vector<GyroSample> samples;
  const int count = static_cast<int>((duration_s + settings.offset_s + 0.2) * settings.rate_hz);
  for (int i = 0; i < count; ++i) {
    const double stamp_s = i / settings.rate_hz;
    const double footage_s = (stamp_s - settings.offset_s) / (1 + settings.drift);
    glm::dvec3 rate_radps = motion.camera_rate_radps(footage_s) + settings.bias_radps;
    for (int axis = 0; axis < 3; ++axis) rate_radps[axis] += settings.noise_radps * normal(i, axis, settings.seed);
    samples.push_back({stamp_s, rate_radps});
  }
  return samples;
}

Result<void> write_gyro_log(const std::filesystem::path& file, const std::vector<GyroSample>& samples) {
  std::ofstream out(file);
  out << "time_s,camera_rate_x_radps,camera_rate_y_radps,camera_rate_z_radps\n";
  for (const GyroSample& sample : samples) {
    const glm::dvec3& rate = sample.camera_rate_radps;
    out << fmt::format("{:.6f},{:.7f},{:.7f},{:.7f}\n", sample.stamp_s, rate.x, rate.y, rate.z);
  }
  if (!out.flush()) return fail(file.string(), "cannot be written", ErrorKind::cannot_create);
  return {};
}

}  // namespace sigs::made
