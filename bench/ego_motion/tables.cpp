// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include "attitude_flights/attitude_cases.h"
#include "base/pose.h"
#include "ego_motion/measures.h"

namespace sigs::bench {

namespace {

constexpr const char* kValues =
    "step_rms_px,drift_max_px,drift_rms_px,within_x,within_y,within_z,within_ellipsoid,error_mdeg,sd_mdeg,lost,"
    "features,"
    "run_s,decode_s,level_error_deg,level_sd_deg,offset_ms,offset_sd_ms,drift_ppm,fused";

std::string header_of(std::string keys) {
  return keys.append(kValues);
}

// The columns of kValues, after those that say what was measured.
std::string values_of(const Measured& result) {
  const made::SlipScore& score = result.score;
  const std::vector<EgoFrame>& frames = result.motion.frames;
  double lost = 0, features = 0, sd_rad = 0;
  for (const EgoFrame& frame : frames) {
    lost += frame.is_lost ? 1 : 0;
    features += frame.features / static_cast<double>(frames.size());
    sd_rad += glm::length(frame.sd_rad) / static_cast<double>(frames.size());
  }
  const GyroLink gyro = result.motion.gyro.value_or(GyroLink{});
  const double level_sd_rad = result.motion.level_sd_rad.value_or(-1);
  char text[512];
  std::snprintf(text, sizeof text,
                "%.4f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.2f,%.2f,%.0f,%.0f,%.2f,%.2f,%.3f,%.3f,%.2f,%.2f,%.0f,%d",
                score.step_rms_px, score.drift_max_px, score.drift_rms_px, score.within_2_sd.x, score.within_2_sd.y,
                score.within_2_sd.z, score.within_ellipsoid, 1000 * deg_of_rad(glm::length(score.error_rms_rad)),
                1000 * deg_of_rad(sd_rad), lost, features, result.run_s, result.decode_s,
                deg_of_rad(result.level_error_rad), level_sd_rad < 0 ? -1 : deg_of_rad(level_sd_rad),
                1000 * gyro.offset_s, 1000 * gyro.offset_sd_s, 1e6 * gyro.drift, gyro.is_fused ? 1 : 0);
  return text;
}

struct Variant {
  std::string name;
  EgoMotionSettings settings;
};

// Each setting alone is changed from its default.
std::vector<Variant> variants() {
  std::vector<Variant> all{{"default", {}}};
  for (const int features : {60, 120, 360, 480, 800})
    all.push_back({"features " + std::to_string(features), {.features = features}});
  for (const int width_px : {240, 320, 480})
    all.push_back({"width " + std::to_string(width_px), {.max_width_px = width_px}});
  for (const int key : {4, 16}) all.push_back({"key frames every " + std::to_string(key), {.key_every = key}});
  return all;
}

}  // namespace

void measure_cases(const accuracy::Call& call) {
  accuracy::Csv csv(call.folder / "cases.csv", header_of("case,seed,gyro,"));
  for (const std::uint32_t seed : {1U, 2U, 3U})
    for (const std::string& kind : made::case_names()) {
      const MadeFlight flight = made_flight(call, kind, seed);
      for (const bool with_gyro : {false, true})
        if (const auto result = measured(flight, with_gyro, {}))
          csv.row(kind, seed, with_gyro ? "yes" : "no", values_of(*result));
    }
}

void measure_sweep(const accuracy::Call& call) {
  accuracy::Csv csv(call.folder / "sweep.csv", header_of("variant,case,seed,gyro,"));
  for (const char* kind : {"vibrating", "clouds", "rolling shutter"}) {
    const MadeFlight flight = made_flight(call, kind, 1);
    for (const Variant& variant : variants())
      if (const auto result = measured(flight, false, variant.settings))
        csv.row(variant.name, kind, 1, "no", values_of(*result));
    if (const auto result = measured(made_flight(call, kind, 1, true), false, {}))
      csv.row("lossless footage", kind, 1, "no", values_of(*result));
  }
}

}  // namespace sigs::bench
