// SPDX-License-Identifier: MIT
#include "editor/geometry/ground_grid.h"

#include <cmath>
#include <cstdio>

#include "editor/geometry/round_steps.h"

namespace sigs::editor {
namespace {

constexpr double kMinGapPx = 40;
constexpr int kStepsEachWay = 49;       // 99 lines each way
constexpr double kMaxGroundLooks = 20;  // the ground counts as seen up to so many times the eye's distance

glm::dvec3 middle_of_ground(const OrbitCamera& camera) {
  const glm::dvec3 forward = camera.forward();
  const double along_m = -camera.target_m.z / forward.z;  // from the target
  if (std::isfinite(along_m) && std::abs(along_m) < kMaxGroundLooks * camera.distance_m && along_m > -camera.distance_m)
    return camera.target_m + forward * along_m;
  return {camera.target_m.x, camera.target_m.y, 0};
}

// How many steps make a bold one: 10 of 1, 5 of 2, 10 of 5.
long long steps_a_bold(double step_m) {
  const double mantissa = step_m / std::pow(10.0, std::floor(std::log10(step_m) + 1e-9));
  return std::lround(mantissa) == 2 ? 5 : 10;
}

}  // namespace

GroundGrid ground_grid(const OrbitCamera& camera, const ScreenRect& rect) {
  const glm::dvec3 middle_m = middle_of_ground(camera);
  GroundGrid grid{.step_m = round_step(kMinGapPx / camera.pixels_per_metre(middle_m, rect))};
  const long long bold = steps_a_bold(grid.step_m);
  const std::array<long long, 2> middle{std::llround(middle_m.x / grid.step_m), std::llround(middle_m.y / grid.step_m)};
  for (const int axis : {0, 1}) {
    const int other = 1 - axis;
    for (long long n = middle[axis] - kStepsEachWay; n <= middle[axis] + kStepsEachWay; ++n) {
      const double at_m = static_cast<double>(n) * grid.step_m;
      GridLine line{.ends_m = {}, .bold = n % bold == 0, .at_m = at_m, .is_of_x = axis == 0};
      for (const int end : {0, 1}) {
        line.ends_m[end] = {0, 0, 0};
        line.ends_m[end][axis] = at_m;
        line.ends_m[end][other] = static_cast<double>(middle[other] + (2 * end - 1) * kStepsEachWay) * grid.step_m;
      }
      grid.lines.push_back(line);
    }
  }
  return grid;
}

std::string round_distance_text(double distance_m) {
  std::array<char, 48> text{};
  if (distance_m == 0) return "0";
  const bool far = std::abs(distance_m) >= 1000;
  std::snprintf(text.data(), text.size(), far ? "%.6g km" : "%.6g m", far ? distance_m / 1000 : distance_m);
  return text.data();
}

}  // namespace sigs::editor
