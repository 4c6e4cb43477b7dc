// SPDX-License-Identifier: MIT
#include "evaluation/metrics/slices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "base/ensure.h"
#include "base/random.h"
#include "base/statistics.h"

namespace sigs {

namespace {

constexpr int kDraws = 2000;

constexpr Interval kNoInterval{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

// The middle 95 % of what `figure` gives for groups drawn anew.
Interval interval_of(std::size_t groups, const std::function<double(std::span<const std::size_t>)>& figure) {
  if (groups < 2) return kNoInterval;
  std::vector<double> figures;
  std::vector<std::size_t> drawn(groups);
  std::uint64_t state = 1;
  for (int i = 0; i < kDraws; ++i) {
    for (std::size_t& group : drawn) group = splitmix64(state += kSplitMixStep) % groups;
    if (const double value = figure(drawn); std::isfinite(value)) figures.push_back(value);
  }
  return {quantile(figures, 0.025), quantile(figures, 0.975)};
}

double share_of(const std::vector<GroupShare>& groups, std::span<const std::size_t> drawn) {
  GroupShare sum;
  for (const std::size_t i : drawn) {
    sum.part += groups[i].part;
    sum.whole += groups[i].whole;
  }
  return sum.whole > 0 ? sum.part / sum.whole : std::nan("");
}

SliceRule between(const char* by, const char* name, double low, double high,
                  const std::function<double(const TargetFrame&)>& quantity) {
  return {by, name, [=](const TargetFrame& frame) {
            const double value = quantity(frame);
            return value >= low && value < high;
          }};
}

}  // namespace

std::vector<SliceRule> slice_rules() {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const auto range_m = [](const TargetFrame& frame) { return frame.distance_m; };
  const auto size_px = [](const TargetFrame& frame) { return std::max(frame.visible->width, frame.visible->height); };
  const auto contrast = [](const TargetFrame& frame) { return frame.rms_contrast.value_or(std::nan("")); };
  const auto visible = [](const TargetFrame& frame) { return frame.visible_fraction; };
  const auto lies = [](const char* name, HorizonSide side) {
    return SliceRule{"horizon", name, [side](const TargetFrame& frame) { return frame.horizon == side; }};
  };
  return {SliceRule{"all", "any", [](const TargetFrame&) { return true; }},
          between("range", "below 100 m", 0, 100, range_m),
          between("range", "100 to 300 m", 100, 300, range_m),
          between("range", "300 to 700 m", 300, 700, range_m),
          between("range", "700 to 1500 m", 700, 1500, range_m),
          between("range", "from 1500 m", 1500, kAny, range_m),
          between("size", "below 8 px", 0, 8, size_px),
          between("size", "8 to 16 px", 8, 16, size_px),
          between("size", "16 to 32 px", 16, 32, size_px),
          between("size", "32 to 64 px", 32, 64, size_px),
          between("size", "from 64 px", 64, kAny, size_px),
          between("contrast", "below 0.05", 0, 0.05, contrast),
          between("contrast", "0.05 to 0.1", 0.05, 0.1, contrast),
          between("contrast", "0.1 to 0.2", 0.1, 0.2, contrast),
          between("contrast", "from 0.2", 0.2, kAny, contrast),
          lies("above", HorizonSide::above),
          lies("on", HorizonSide::on),
          lies("below", HorizonSide::below),
          between("visible", "below half", 0, 0.5, visible),
          between("visible", "half to 0.95", 0.5, 0.95, visible),
          between("visible", "from 0.95", 0.95, kAny, visible)};
}

Interval share_interval(const std::vector<GroupShare>& groups) {
  const auto told = std::count_if(groups.begin(), groups.end(), [](const GroupShare& one) { return one.whole > 0; });
  if (told < 2) return kNoInterval;
  const Interval drawn =
      interval_of(groups.size(), [&](std::span<const std::size_t> of) { return share_of(groups, of); });
  if (drawn.low < drawn.high || (drawn.low > 0 && drawn.high < 1)) return drawn;
  constexpr double kZ = 1.959964;  // Wilson's interval of as many trials as groups
  const double beyond = kZ * kZ / (static_cast<double>(told) + kZ * kZ);
  return drawn.low > 0 ? Interval{1 - beyond, 1} : Interval{0, beyond};
}

Interval difference_interval(const std::vector<GroupShare>& first, const std::vector<GroupShare>& second) {
  ENSURE(first.size() == second.size());
  return interval_of(first.size(), [&](std::span<const std::size_t> drawn) {
    return share_of(first, drawn) - share_of(second, drawn);
  });
}

std::vector<FrameSlice> frame_slices(const std::vector<DetectedClip>& clips, const DetectionPolicy& policy) {
  const std::vector<SliceRule> rules = slice_rules();
  std::vector<FrameSlice> slices;
  for (const SliceRule& rule : rules) slices.push_back({.by = rule.by, .name = rule.name});
  std::vector<std::vector<GroupShare>> flights(rules.size());
  for (const DetectedClip& clip : clips) {
    const ClipMatches matches = matches_of(clip, policy);
    for (std::size_t t = 0; t < clip.truth.targets.size(); ++t) {
      std::vector<GroupShare> flight(rules.size());
      for (std::size_t f = 0; f < clip.truth.targets[t].frames.size(); ++f) {
        const TargetFrame& frame = clip.truth.targets[t].frames[f];
        if (!frame.visible) continue;
        for (std::size_t s = 0; s < rules.size(); ++s) {
          if (!rules[s].has(frame)) continue;
          flight[s].whole += 1;
          flight[s].part += matches.tracks[t][f].empty() ? 0 : 1;
        }
      }
      for (std::size_t s = 0; s < rules.size(); ++s)
        if (flight[s].whole > 0) flights[s].push_back(flight[s]);
    }
  }
  for (std::size_t s = 0; s < rules.size(); ++s) {
    for (const GroupShare& flight : flights[s]) {
      slices[s].frames += static_cast<int>(flight.whole);
      slices[s].matched += static_cast<int>(flight.part);
    }
    slices[s].rate = share_interval(flights[s]);
  }
  return slices;
}

}  // namespace sigs
