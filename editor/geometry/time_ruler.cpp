// SPDX-License-Identifier: MIT
#include "editor/geometry/time_ruler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "editor/geometry/round_steps.h"

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

}  // namespace

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
  std::array<char, 48> text{};
  if (hours > 0)
    std::snprintf(text.data(), text.size(), "%s%lld:%02lld:%02lld.%02lld", sign, hours, minutes % 60, seconds % 60,
                  hundredths % 100);
  else
    std::snprintf(text.data(), text.size(), "%s%lld:%02lld.%02lld", sign, minutes, seconds % 60, hundredths % 100);
  return text.data();
}

}  // namespace sigs::editor
