// SPDX-License-Identifier: MIT
#include "performance/performance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/statistics.h"
#include "encounter/well_clear.h"

namespace sigs {

namespace {

constexpr double kCell = 0.00995033085316808;  // log(1.01)
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr int kBandPlaces = 61;
constexpr std::array kRangeEdges_m{0.0,    100.0,  200.0,  300.0,  500.0,  700.0,   1000.0,
                                   1500.0, 2000.0, 3000.0, 5000.0, 7000.0, 10000.0, kEndless};

// Trials by range, in steps of 1 %, for fits of many drawings: frames of one encounter.
class RangeProfile {
 public:
  void add(double range_m, bool success) {
    RangeProfile one;
    one.first_ = static_cast<int>(std::floor(std::log(std::max(range_m, 1e-3)) / kCell));
    one.cells_ = {{success ? 1.0 : 0.0, 1, 1}};
    add(one);
  }
  void add(const RangeProfile& other, double weight = 1) {
    if (other.cells_.empty()) return;
    if (cells_.empty()) first_ = other.first_;
    if (other.first_ < first_) {
      cells_.insert(cells_.begin(), static_cast<std::size_t>(first_ - other.first_), Cell{});
      first_ = other.first_;
    }
    const auto offset = static_cast<std::size_t>(other.first_ - first_);
    if (cells_.size() < offset + other.cells_.size()) cells_.resize(offset + other.cells_.size());
    for (std::size_t i = 0; i < other.cells_.size(); ++i) {
      cells_[offset + i].part += weight * other.cells_[i].part;
      cells_[offset + i].whole += weight * other.cells_[i].whole;
      cells_[offset + i].groups += other.cells_[i].groups;
    }
  }
  // Half-groups of GroupWeights: at each place as many trials as a group that comes near it has there, in the mean.
  //   all  the sum of all groups
  void add_prior(const RangeProfile& all, double failing, double succeeding) {
    RangeProfile mean = all;
    for (Cell& cell : mean.cells_) {
      const double trials = cell.groups > 0 ? cell.whole / cell.groups : 0;
      cell = {.part = succeeding * trials, .whole = (failing + succeeding) * trials};
    }
    add(mean);
  }
  // What was added is of one group.
  void close_group() {
    if (cells_.empty()) return;
    constexpr int kNear = 20;  // cells to either side: a fifth of the range
    cells_.insert(cells_.begin(), kNear, Cell{});
    cells_.resize(cells_.size() + kNear);
    first_ -= kNear;
    const auto count = static_cast<int>(cells_.size());
    for (int i = 0; i < count; ++i) {
      if (!(cells_[static_cast<std::size_t>(i)].whole > 0)) continue;
      for (int k = std::max(0, i - kNear); k < std::min(count, i + kNear + 1); ++k)
        cells_[static_cast<std::size_t>(k)].groups = 1;
    }
  }
  [[nodiscard]] FallingCurve fit() const { return falling_fit(trials()); }
  [[nodiscard]] std::vector<Trial> trials() const {
    std::vector<Trial> trials;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (cells_[i].whole > 0)
        trials.push_back({std::exp((first_ + static_cast<double>(i) + 0.5) * kCell), cells_[i].part, cells_[i].whole});
    return trials;
  }
  [[nodiscard]] bool empty() const { return cells_.empty(); }

 private:
  struct Cell {
    double part = 0;
    double whole = 0;
    int groups = 0;  // with trials within a fifth of this range
  };
  int first_ = 0;  // number of the first cell
  std::vector<Cell> cells_;
};

std::vector<RangeBin> empty_bins() {
  std::vector<RangeBin> bins;
  for (std::size_t i = 0; i + 1 < kRangeEdges_m.size(); ++i)
    bins.push_back({.low_m = kRangeEdges_m[i], .high_m = kRangeEdges_m[i + 1], .interval = {}});
  return bins;
}

std::size_t bin_of(double range_m) {
  const auto next = std::ranges::upper_bound(kRangeEdges_m, range_m);
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(next - kRangeEdges_m.begin() - 1, 0, std::ssize(kRangeEdges_m) - 2));
}

// Intervals of the ranges and of the curve itself, of the same draws.
void set_intervals(RangeCurve& curve, const std::vector<RangeProfile>& profiles, int draws) {
  std::vector<std::vector<double>> ranges(curve.ranges.size());
  std::vector<std::vector<double>> values(curve.band_at_m.size());
  RangeProfile all;
  for (const RangeProfile& profile : profiles) all.add(profile);
  draw_weights(profiles.size(), draws, [&](const GroupWeights& weights) {
    RangeProfile sum;
    for (std::size_t i = 0; i < profiles.size(); ++i) sum.add(profiles[i], weights.groups[i]);
    sum.add_prior(all, weights.failing, weights.succeeding);
    const FallingCurve fit = sum.fit();
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i].push_back(fit.last_with(curve.ranges[i].probability));
    for (std::size_t i = 0; i < values.size(); ++i) values[i].push_back(fit.at(curve.band_at_m[i]));
  });
  for (std::size_t i = 0; i < ranges.size(); ++i)
    curve.ranges[i].interval = bootstrap_interval(std::move(ranges[i]), profiles.size());
  for (std::vector<double>& sample : values)
    curve.band.push_back(bootstrap_interval(std::move(sample), profiles.size()));
}

}  // namespace

RangeCurve range_curve(const std::vector<ObservedEncounter>& encounters,
                       const std::function<bool(const SeenFrame&)>& success,
                       const std::function<bool(const ObservedEncounter&, const SeenFrame&)>& chosen, int draws) {
  RangeCurve curve{.interval = {}};
  std::vector<RangeBin> bins = empty_bins();
  std::vector<std::vector<GroupShare>> by_bin(bins.size());
  std::vector<GroupShare> groups;
  std::vector<RangeProfile> profiles;
  double nearest_m = kEndless;
  for (const ObservedEncounter& encounter : encounters) {
    RangeProfile profile;
    GroupShare group;
    std::vector<GroupShare> in_bins(bins.size());
    for (const SeenFrame& frame : encounter.frames) {
      if (!chosen(encounter, frame)) continue;
      const bool is_success = success(frame);
      profile.add(frame.range_m, is_success);
      for (GroupShare* share : {&group, &in_bins[bin_of(frame.range_m)]}) {
        share->part += is_success ? 1 : 0;
        share->whole += 1;
      }
      bins[bin_of(frame.range_m)].mean_m += frame.range_m;
      nearest_m = std::min(nearest_m, frame.range_m);
      curve.farthest_m = std::max(curve.farthest_m, frame.range_m);
    }
    if (profile.empty()) continue;
    profile.close_group();
    profiles.push_back(std::move(profile));
    groups.push_back(group);
    for (std::size_t i = 0; i < bins.size(); ++i)
      if (in_bins[i].whole > 0) by_bin[i].push_back(in_bins[i]);
  }
  RangeProfile sum;
  for (const RangeProfile& profile : profiles) sum.add(profile);
  curve.fit = sum.fit();
  curve.encounters = static_cast<int>(profiles.size());
  for (const GroupShare& group : groups) {
    curve.frames += static_cast<int>(group.whole);
    curve.successes += static_cast<int>(group.part);
  }
  curve.interval = clustered_interval(groups);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (by_bin[i].empty()) continue;
    for (const GroupShare& share : by_bin[i]) {
      bins[i].frames += static_cast<int>(share.whole);
      bins[i].detected += static_cast<int>(share.part);
    }
    bins[i].encounters = static_cast<int>(by_bin[i].size());
    bins[i].mean_m /= bins[i].frames;
    bins[i].interval = clustered_interval(by_bin[i]);
    curve.bins.push_back(bins[i]);
  }
  for (const double probability : kProbabilities)
    curve.ranges.push_back({.probability = probability,
                            .range_m = curve.frames > 0 ? curve.fit.last_with(probability) : kUnknown,
                            .interval = {kUnknown, kUnknown}});
  if (profiles.empty()) return curve;
  const double step = std::log(std::max(curve.farthest_m / std::max(nearest_m, 1e-3), 1 + 1e-9)) / (kBandPlaces - 1);
  for (int i = 0; i < kBandPlaces; ++i) curve.band_at_m.push_back(std::max(nearest_m, 1e-3) * std::exp(step * i));
  set_intervals(curve, profiles, draws);
  return curve;
}

Spread spread_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  Spread spread{.count = static_cast<int>(values.size()),
                .least = kUnknown,
                .p05 = kUnknown,
                .median = kUnknown,
                .p95 = kUnknown,
                .greatest = kUnknown};
  if (values.empty()) return spread;
  const auto [least, greatest] = std::ranges::minmax(values);
  return {spread.count, least, quantile(values, 0.05), quantile(values, 0.5), quantile(values, 0.95), greatest};
}

namespace {

ErrorSpread error_spread_of(const std::vector<double>& errors) {
  ErrorSpread spread{.count = static_cast<int>(errors.size()),
                     .bias = mean(errors),
                     .standard_deviation = standard_deviation(errors),
                     .p95 = kUnknown};
  std::vector<double> sizes;
  for (const double error : errors) sizes.push_back(std::abs(error));
  spread.p95 = quantile(std::move(sizes), 0.95);
  return spread;
}

bool is_detected(const SeenFrame& frame) {
  return frame.is_detected;
}

// What makes a frame part of a condition.
struct ConditionRule {
  std::string by;
  std::string name;
  std::function<bool(const ObservedEncounter&, const SeenFrame&)> has;
};

ConditionRule between_limits(const char* by, const char* name, double low, double high, double SeenFrame::*value,
                             double unit = 1) {
  return {by, name, [=](const ObservedEncounter&, const SeenFrame& frame) {
            return frame.*value / unit >= low && frame.*value / unit < high;
          }};
}

std::vector<ConditionRule> condition_rules(const std::vector<ObservedEncounter>& encounters) {
  constexpr double kDegrees = std::numbers::pi / 180;
  const auto lies = [](const char* name, HorizonSide side) {
    return ConditionRule{"horizon", name,
                         [side](const ObservedEncounter&, const SeenFrame& frame) { return frame.horizon == side; }};
  };
  std::vector<ConditionRule> rules{
      lies("above", HorizonSide::above),
      lies("on", HorizonSide::on),
      lies("below", HorizonSide::below),
      between_limits("aspect", "head-on (below 45 deg)", 0, 45, &SeenFrame::aspect_rad, kDegrees),
      between_limits("aspect", "from the side", 45, 135, &SeenFrame::aspect_rad, kDegrees),
      between_limits("aspect", "from behind (over 135 deg)", 135, 181, &SeenFrame::aspect_rad, kDegrees),
      between_limits("size", "below 4 px", 0, 4, &SeenFrame::size_px),
      between_limits("size", "4 to 8 px", 4, 8, &SeenFrame::size_px),
      between_limits("size", "8 to 16 px", 8, 16, &SeenFrame::size_px),
      between_limits("size", "16 to 32 px", 16, 32, &SeenFrame::size_px),
      between_limits("size", "from 32 px", 32, kEndless, &SeenFrame::size_px),
      between_limits("contrast", "below 0.05", 0, 0.05, &SeenFrame::contrast),
      between_limits("contrast", "0.05 to 0.1", 0.05, 0.1, &SeenFrame::contrast),
      between_limits("contrast", "0.1 to 0.2", 0.1, 0.2, &SeenFrame::contrast),
      between_limits("contrast", "from 0.2", 0.2, kEndless, &SeenFrame::contrast),
      between_limits("visible", "below half", 0, 0.5, &SeenFrame::visible_fraction),
      between_limits("visible", "from half", 0.5, kEndless, &SeenFrame::visible_fraction)};
  std::set<std::pair<std::string, std::string>> tags;
  std::map<std::string, int> values;
  for (const ObservedEncounter& encounter : encounters) tags.insert(encounter.tags.begin(), encounter.tags.end());
  for (const auto& [key, value] : tags) ++values[key];
  for (const auto& [key, value] : tags) {
    // A tag that all have says nothing, nor does one with a value for each video.
    if (values[key] < 2 || values[key] > 20) continue;
    rules.push_back({key, value, [key = key, value = value](const ObservedEncounter& encounter, const SeenFrame&) {
                       const auto found = encounter.tags.find(key);
                       return found != encounter.tags.end() && found->second == value;
                     }});
  }
  return rules;
}

void set_spreads(Performance& performance) {
  std::vector<double> ranges, left, latencies, right, up, range, gaps;
  for (int cause = 0; cause < kDropOutCauses; ++cause)
    performance.drop_outs.push_back({.cause = static_cast<DropOutCause>(cause)});
  for (const ObservedEncounter& encounter : performance.encounters) {
    if (encounter.declared) {
      ranges.push_back(encounter.declared->range_m);
      performance.declared_at_once += encounter.is_declared_at_once ? 1 : 0;
      left.push_back(encounter.declared->time_left_s);
    }
    if (encounter.latency_s) latencies.push_back(*encounter.latency_s);
    for (const SeenFrame& frame : encounter.frames) {
      if (frame.angle_error_rad) {
        right.push_back(frame.angle_error_rad->x);
        up.push_back(frame.angle_error_rad->y);
      }
      if (frame.range_error) range.push_back(*frame.range_error);
    }
    for (const DropOut& gap : encounter.drop_outs) {
      if (!gap.is_last) gaps.push_back(gap.length_s);
      DropOutCount& count = performance.drop_outs[static_cast<std::size_t>(gap.cause)];
      ++count.count;
      count.seconds += gap.length_s;
    }
  }
  performance.encounters_declared = static_cast<int>(ranges.size());
  performance.declaration_range_m = spread_of(std::move(ranges));
  performance.time_left_s = spread_of(std::move(left));
  performance.latency_s = spread_of(std::move(latencies));
  performance.bearing_rad = error_spread_of(right);
  performance.elevation_rad = error_spread_of(up);
  performance.range = error_spread_of(range);
  performance.drop_out_s = spread_of(std::move(gaps));
}

}  // namespace

Performance performance_of(Observations observations, const PerformancePolicy& policy, int min_encounters) {
  Performance performance{.detector = observations.detector,
                          .policy = policy,
                          .min_encounters = min_encounters,
                          .has_tracks = observations.has_tracks,
                          .rate_hz = observations.rate_hz,
                          .detected = {},
                          .declared = {},
                          .false_all = observations.all,
                          .false_empty = observations.empty,
                          .encounters = std::move(observations.encounters)};
  const auto any = [](const ObservedEncounter&, const SeenFrame&) { return true; };
  performance.detected = range_curve(performance.encounters, is_detected, any);
  performance.declared = range_curve(
      performance.encounters, [](const SeenFrame& frame) { return frame.is_declared; }, any);
  for (const ConditionRule& rule : condition_rules(performance.encounters)) {
    RangeCurve curve = range_curve(performance.encounters, is_detected, rule.has, 400);
    if (curve.frames == 0) continue;
    const bool is_too_few = curve.encounters < min_encounters;
    performance.conditions.push_back({rule.by, rule.name, std::move(curve), is_too_few});
  }
  set_spreads(performance);
  performance.false_per_hour_all = poisson_rate_interval(performance.false_all.declared, performance.false_all.hours);
  performance.false_per_hour_empty =
      poisson_rate_interval(performance.false_empty.declared, performance.false_empty.hours);
  return performance;
}

const char* name_of(Geometry geometry) {
  constexpr std::array kNames{"head-on", "crossing", "overtaking"};
  return kNames.at(static_cast<std::size_t>(geometry));
}

std::vector<NeededRange> needed_ranges(const Performance& performance, const AirSpeeds& speeds,
                                       const NeededTimes& times) {
  constexpr double kWithin = std::numbers::pi / 6;
  std::vector<NeededRange> needed;
  const double seconds = times.latency_s + times.decide_s + times.manoeuvre_s;
  for (const Geometry geometry : {Geometry::head_on, Geometry::crossing, Geometry::overtaking}) {
    const double closing_mps = geometry == Geometry::head_on    ? speeds.own_mps + speeds.intruder_mps
                               : geometry == Geometry::crossing ? std::hypot(speeds.own_mps, speeds.intruder_mps)
                                                                : std::max(0.0, speeds.own_mps - speeds.intruder_mps);
    const double aspect = geometry == Geometry::head_on    ? 0
                          : geometry == Geometry::crossing ? std::atan2(speeds.own_mps, speeds.intruder_mps)
                                                           : std::numbers::pi;
    const RangeCurve curve = range_curve(
        performance.encounters, [](const SeenFrame& frame) { return frame.is_declared; },
        [&](const ObservedEncounter&, const SeenFrame& frame) {
          return std::abs(frame.aspect_rad - aspect) <= kWithin;
        });
    for (const auto& [name, protect_m] :
         {std::pair("well clear", well_clear_volume("small-uas")->hmd_m), std::pair("NMAC", nmac_volume().hmd_m)}) {
      NeededRange one{.geometry = geometry,
                      .volume = name,
                      .closing_speed_mps = closing_mps,
                      .needed_m = closing_mps > 0 ? protect_m + closing_mps * seconds : 0,
                      .encounters = curve.encounters,
                      .reached = curve.ranges.back(),
                      .is_too_few = curve.encounters < performance.min_encounters};
      const double reached_m = std::min(one.reached.range_m, curve.farthest_m);
      if (closing_mps > 0 && curve.encounters > 0 && (reached_m >= one.needed_m || std::isfinite(one.reached.range_m)))
        one.suffices = reached_m >= one.needed_m;
      needed.push_back(one);
    }
  }
  return needed;
}

}  // namespace sigs
