// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "base/result.h"
#include "made_flights/motion.h"

namespace sigs::made {

// A rate gyroscope fixed to the camera, with the faults of cheap ones.
struct GyroSettings {
  std::uint32_t seed = 1;
  double rate_hz = 400;
  double noise_radps = 0.005;  // standard deviation of each sample and axis
  glm::dvec3 bias_radps{0.01, -0.01, 0.01};
  double offset_s = 0.037;  // stamp at the footage's time 0
  double drift = 50e-6;     // the log's clock runs faster than the footage's by this share
};

// One sample: stamp = footage time * (1 + drift) + offset_s.
struct GyroSample {
  double stamp_s = 0;
  glm::dvec3 camera_rate_radps{0};
};

// The log of a flight: stamps from 0, until shortly after the footage's end.
[[nodiscard]] std::vector<GyroSample> gyro_log(const Motion& motion, double duration_s, const GyroSettings& settings);

// Writes it as CSV with the columns time_s, camera_rate_x_radps, camera_rate_y_radps, camera_rate_z_radps.
// Error cannot_create.
[[nodiscard]] Result<void> write_gyro_log(const std::filesystem::path& file, const std::vector<GyroSample>& samples);

}  // namespace sigs::made
