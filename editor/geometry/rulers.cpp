// SPDX-License-Identifier: MIT
#include "editor/geometry/rulers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace sigs::editor {

namespace {

constexpr double kMinFrames = 4;
constexpr double kMinTickGapPx = 6;

// Within the footage; footage shorter than the strip is wholly in it.
TimeRuler kept_over_footage(TimeRuler ruler, int frame_count) {
  const double spare = frame_count - ruler.count;
  ruler.first = std::clamp(ruler.first, std::min(0.0, spare), std::max(0.0, spare));
  return ruler;
}

// The smallest of 1, 2, 5, 10 ... frames that divides the labels' step and is wide enough to see.
double tick_step(double label_step, double px_per_frame) {
  double step = round_step(std::max(1.0, kMinTickGapPx / px_per_frame));
  while (step < label_step && std::fmod(label_step, step) != 0) step = round_step(step * 1.5);
  return std::min(step, label_step);
}

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

double round_step(double minimum) {
  if (!std::isfinite(minimum) || minimum <= 0) return 1;
  const double decade = std::pow(10.0, std::floor(std::log10(minimum)));
  // What a logarithm misses by its last digit: 0.30000000000000004 / 0.1 is a 3, 999.9999999999999 a 1000.
  const double mantissa = minimum / decade * (1 - 1e-12);
  for (const double step : {1.0, 2.0, 5.0})
    if (mantissa <= step) return step * decade;
  return 10 * decade;
}

double rounded_to(double value, double step) {
  const double steps = std::round(value / step);
  const double inverse = std::round(1 / step);
  const bool divides_one = inverse >= 1 && std::abs(inverse * step - 1) < 1e-9;
  return divides_one ? std::round(value * inverse) / inverse : steps * step;
}

double TimeRuler::x_of(double frame) const {
  return left_x + (frame - first) / count * width;
}

double TimeRuler::frame_at(double x) const {
  return width > 0 ? first + (x - left_x) / width * count : first;
}

int TimeRuler::nearest_frame(double x, int lowest, int highest) const {
  const double frame = frame_at(x);
  if (!(frame > lowest)) return lowest;  // NaN too
  if (frame >= highest) return highest;
  const int cell = static_cast<int>(std::floor(frame));
  if (!(width > 0)) return cell;
  // Mapping there and back may lose the last digit, which decides at the edge of a cell.
  if (x >= x_of(cell + 1)) return std::min(cell + 1, highest);
  return x < x_of(cell) ? std::max(cell - 1, lowest) : cell;
}

TimeRuler zoomed(const TimeRuler& ruler, double factor, double fixed_x, int frame_count) {
  if (!(factor > 0) || !std::isfinite(fixed_x) || !(ruler.width > 0)) return kept_over_footage(ruler, frame_count);
  const double maximum = std::max(kMinFrames, frame_count * (4.0 / 3));
  TimeRuler result = ruler;
  result.count = std::clamp(ruler.count / factor, kMinFrames, maximum);
  result.first = ruler.frame_at(fixed_x) - (fixed_x - ruler.left_x) / ruler.width * result.count;
  return kept_over_footage(result, frame_count);
}

TimeRuler panned(const TimeRuler& ruler, double by_frames, int frame_count) {
  TimeRuler result = ruler;
  if (!std::isnan(by_frames)) result.first += by_frames;
  return kept_over_footage(result, frame_count);
}

TimeRuler with_frame_in_sight(const TimeRuler& ruler, double frame, int frame_count) {
  if (std::isnan(frame)) return ruler;
  const double shown = std::clamp(frame, 0.0, std::max(0.0, frame_count - 1.0));
  TimeRuler result = ruler;
  if (shown + 1 > ruler.first + ruler.count) result.first = shown + 1 - ruler.count;
  if (shown < result.first) result.first = shown;
  return result;
}

std::vector<Tick> ticks(const TimeRuler& ruler, double label_width) {
  const double px_per_frame = ruler.width / ruler.count;
  if (!(px_per_frame > 0) || !std::isfinite(px_per_frame) || !std::isfinite(ruler.first)) return {};
  const double label_px = std::max(kMinTickGapPx, std::isfinite(label_width) ? label_width : 0);
  const double label_step = round_step(std::max(1.0, label_px / px_per_frame));
  const double step = tick_step(label_step, px_per_frame);
  const double first_step = std::ceil(ruler.first / step);
  const double steps = std::floor((ruler.first + ruler.count) / step) - first_step;
  std::vector<Tick> result;
  for (int i = 0; i <= steps; ++i) {
    const double frame = (first_step + i) * step;
    result.push_back({frame, std::fmod(frame, label_step) == 0});
  }
  return result;
}

std::string time_text(double time_s) {
  if (!(std::abs(time_s) < 1e12)) return "--:--.--";
  const long long hundredths = std::llround(std::abs(time_s) * 100);
  const char* sign = time_s < 0 && hundredths > 0 ? "-" : "";
  const long long seconds = hundredths / 100;
  const long long minutes = seconds / 60;
  const long long hours = minutes / 60;
  const std::string clock = hours > 0 ? fmt::format("{}:{:02}", hours, minutes % 60) : fmt::format("{}", minutes);
  return fmt::format("{}{}:{:02}.{:02}", sign, clock, seconds % 60, hundredths % 100);
}

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
  if (distance_m == 0) return "0";
  const bool far = std::abs(distance_m) >= 1000;
  return fmt::format("{:.6g} {}", far ? distance_m / 1000 : distance_m, far ? "km" : "m");
}

}  // namespace sigs::editor
