// SPDX-License-Identifier: MIT
// Errors of the airlight and of the sun's azimuth by shadows, on made footage (tests/appearance/made_scene.h) whose
// seeds no test uses, against processor time by image size and frames used. Prints two tables in Markdown.
//   bench_surroundings

#include <fmt/format.h>

#include <ctime>
#include <numbers>
#include <vector>

#include "appearance/made_scene.h"
#include "appearance/surroundings.h"

namespace {

using namespace sigs;
using namespace sigs::test;

constexpr int kSeeds = 3;
constexpr std::uint32_t kFirstSeed = 101;

// Absolute errors of several runs.
struct Errors {
  double sum = 0, worst = 0;
  double seconds = 0;  // of processor time
  int runs = 0, known = 0;

  void add(double error) {
    ++known;
    sum += error;
    worst = std::max(worst, error);
  }

  [[nodiscard]] std::string cells(int frames) const {
    return fmt::format("{} of {} | {:.1f} | {:.1f} | {:.1f}", known, runs, sum / std::max(known, 1), worst,
                       1000 * seconds / runs / frames);
  }
};

// The estimates from `frames` images of a scene; the camera moves on by step_m from each to the next.
template <class Light>
SurroundingsEstimate found_in(Light light, cv::Size size_px, const Attitude& attitude, int frames, double step_m,
                              double& seconds) {
  const Camera camera = wide_camera(size_px);
  const View view{.camera = &camera, .world_from_camera = rotation_of(attitude), .height_m = light.height_m};
  Surroundings surroundings;
  for (int i = 0; i < frames; ++i) {
    light.x_m = step_m * i;
    const Frame frame = frame_of(seen(camera, rotation_of(attitude), light));
    const std::clock_t before = std::clock();
    surroundings.add(frame, view);
    seconds += static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  }
  const std::clock_t before = std::clock();
  SurroundingsEstimate found = surroundings.finish();
  seconds += static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  return found;
}

// Largest of the three channels, code values.
Errors airlight_errors(cv::Size size_px, int frames) {
  Errors errors;
  for (const double visibility_m : {3500.0, 10000.0, 20000.0})
    for (std::uint32_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
      const HazyPlain plain{.visibility_m = visibility_m, .airlight = {0.55, 0.6, 0.7}, .seed = seed};
      const auto found = found_in(plain, size_px, {.roll_rad = -0.07, .pitch_rad = -0.05}, frames, 400, errors.seconds);
      ++errors.runs;
      double worst = 0;
      for (int k = 0; k < 3; ++k) {
        const Estimate& part = found.haze.airlight[static_cast<std::size_t>(k)];
        worst = part.is_known ? std::max(worst, std::abs(code_of(part.value) - code_of(plain.airlight[k]))) : 1e9;
      }
      if (worst < 1e9) errors.add(worst);
    }
  return errors;
}

// Of the azimuth, degrees.
Errors sun_errors(cv::Size size_px, int frames) {
  Errors errors;
  for (const double azimuth_deg : {-165.0, -110.0, -35.0, 60.0, 135.0})
    for (std::uint32_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
      const Posts posts{.azimuth_rad = rad_of_deg(azimuth_deg), .elevation_rad = 0.5, .seed = 100 * seed};
      const auto found =
          found_in(posts, size_px, {.roll_rad = -0.08, .pitch_rad = -0.6, .yaw_rad = 1.1}, frames, 60, errors.seconds);
      ++errors.runs;
      if (found.sun.evidence != SunEvidence::shadows) continue;
      const double off_rad = std::remainder(found.sun.azimuth_rad.value - posts.azimuth_rad, 2 * std::numbers::pi);
      errors.add(deg_of_rad(std::abs(off_rad)));
    }
  return errors;
}

template <class ErrorsOf>
void print_table(const char* title, const char* unit, const ErrorsOf& errors_of) {
  fmt::print(
      "| {} | frames used | known | mean error, {} | worst, {} | processor ms a frame |\n|---|---|---|---|---|---|\n",
      title, unit, unit);
  for (const cv::Size size_px : {cv::Size(320, 240), cv::Size(640, 480), cv::Size(960, 720)})
    for (const int frames : {1, 4})
      fmt::print("| {}x{} | {} | {} |\n", size_px.width, size_px.height, frames,
                 errors_of(size_px, frames).cells(frames));
}

}  // namespace

int main() {
  print_table("airlight", "codes", airlight_errors);
  fmt::print("\n");
  print_table("sun by shadows", "degrees", sun_errors);
}
