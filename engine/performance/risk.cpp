// SPDX-License-Identifier: MIT
#include "performance/risk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/pose.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs {

namespace {

constexpr double kSigma95 = 1.959963984540054;
constexpr int kBatchesOfRound = 16;

EventSums sums_of(double weight, bool without, bool with) {
  const double square = weight * weight;
  return {.without = without ? weight : 0,
          .with = with ? weight : 0,
          .without_squares = without ? square : 0,
          .with_squares = with ? square : 0,
          .both_squares = without && with ? square : 0};
}

RiskTally tally_of(const FlownOutcome& outcome) {
  const double weight = outcome.weight;
  const bool failed = outcome.nmac_with && outcome.nmac_without;
  return {.encounters = 1,
          .weight = weight,
          .weight_squares = weight * weight,
          .nmac = sums_of(weight, outcome.nmac_without, outcome.nmac_with),
          .well_clear = sums_of(weight, outcome.lost_without, outcome.lost_with),
          .induced = outcome.nmac_with && !outcome.nmac_without ? weight : 0,
          .out_of_view = failed && !outcome.is_in_view ? weight : 0,
          .undeclared = failed && outcome.is_in_view && !outcome.is_declared ? weight : 0,
          .waiting = failed && outcome.is_declared && !outcome.is_manoeuvred ? weight : 0,
          .insufficient = failed && outcome.is_declared && outcome.is_manoeuvred ? weight : 0,
          .declared = outcome.is_declared ? weight : 0,
          .manoeuvred = outcome.is_manoeuvred ? weight : 0,
          .clear = outcome.lost_without ? 0 : weight,
          .unnecessary = outcome.is_manoeuvred && !outcome.lost_without ? weight : 0};
}

Result<RiskBatch> flown_batch(const RiskSettings& settings, std::int64_t number, const Logic& logic,
                              const std::atomic<bool>* cancel) {
  RiskBatch batch{.number = number, .tallies = {}};
  const std::int64_t first = number * kRiskBatch;
  const std::int64_t end = std::min(first + kRiskBatch, settings.count);
  for (std::int64_t i = first; i < end; ++i) {
    if (cancel && *cancel) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
    const Result<FlownOutcome> outcome = flown_encounter(settings, i, logic);
    if (!outcome) return fail(outcome.error());
    const RiskTally tally = tally_of(*outcome);
    batch.tallies[0].add(tally);
    batch.tallies[static_cast<std::size_t>(1 + static_cast<int>(outcome->geometry))].add(tally);
    batch.tallies[outcome->is_above ? 4 : 5].add(tally);
  }
  return batch;
}

bool is_precise(const RiskTallies& tallies, double until) {
  const RiskRatio ratio = risk_ratio(tallies[0].nmac);
  return ratio.ratio > 0 && (ratio.interval.high - ratio.interval.low) / 2 <= until * ratio.ratio;
}

}  // namespace

std::optional<ManoeuvreKind> manoeuvre_named(std::string_view name) {
  const auto found = std::ranges::find(kManoeuvreNames, name);
  if (found == kManoeuvreNames.end()) return std::nullopt;
  return static_cast<ManoeuvreKind>(found - kManoeuvreNames.begin());
}

std::array<double*, kTallySums> RiskTally::sums() {
  EventSums& a = nmac;
  EventSums& b = well_clear;
  return {&weight,         &weight_squares, &a.without,   &a.with,     &a.without_squares,
          &a.with_squares, &a.both_squares, &b.without,   &b.with,     &b.without_squares,
          &b.with_squares, &b.both_squares, &induced,     &declared,   &manoeuvred,
          &clear,          &unnecessary,    &out_of_view, &undeclared, &waiting,
          &insufficient};
}

void RiskTally::add(RiskTally other) {
  encounters += other.encounters;
  const auto others = other.sums();
  for (std::size_t i = 0; double* const sum : sums()) *sum += *others[i++];
}

RiskRatio risk_ratio(const EventSums& sums) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!(sums.without > 0)) return {kNone, {kNone, kNone}};
  const double ratio = sums.with / sums.without;
  if (!(sums.with > 0)) return {0, {0, 3 * sums.without_squares / (sums.without * sums.without)}};
  // Variance of a ratio of sums of independent terms (Cochran 1977, section 6.4).
  const double variance = (sums.with_squares - 2 * ratio * sums.both_squares + ratio * ratio * sums.without_squares) /
                          (sums.without * sums.without);
  const double log_sd = std::sqrt(std::max(0.0, variance)) / ratio;
  return {ratio, {ratio * std::exp(-kSigma95 * log_sd), ratio * std::exp(kSigma95 * log_sd)}};
}

RiskRatio weighted_share(double part, double whole, const RiskTally& tally) {
  const double effective = tally.weight_squares > 0 ? whole * tally.weight / tally.weight_squares : 0;
  const double share = whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
  return {share, wilson_interval(share * effective, effective)};
}

std::optional<RiskPair> risk_pair_of(const ClipTruth& clip, const TargetTruth& target, const std::string& name,
                                     double after_s) {
  const std::size_t count = clip.times_s.size();
  if (count < 2 || clip.camera_positions_m.size() != count) return std::nullopt;
  SampledTrack own{.name = "ownship", .samples = {}}, intruder{.name = target.name, .samples = {}};
  for (std::size_t i = 0; i < count; ++i) {
    if (!target.frames[i].offset_m) return std::nullopt;
    const glm::dvec3 camera_m = clip.camera_positions_m[i];
    own.samples.push_back({clip.times_s[i], {.position_m = camera_m}});
    intruder.samples.push_back({clip.times_s[i], {.position_m = camera_m + *target.frames[i].offset_m}});
  }
  // The last second's mean velocity carries both on.
  for (SampledTrack* track : {&own, &intruder}) {
    const TrackSample last = track->samples.back();
    const auto first =
        std::ranges::find_if(track->samples, [&](const TrackSample& s) { return s.time_s >= last.time_s - 1; });
    const TrackSample& before = first->time_s < last.time_s ? *first : track->samples[count - 2];
    const glm::dvec3 velocity_mps = (last.state.position_m - before.state.position_m) / (last.time_s - before.time_s);
    track->samples.push_back({last.time_s + after_s, {.position_m = last.state.position_m + after_s * velocity_mps}});
  }
  return RiskPair{.name = name, .own = track_of(std::move(own)), .intruder = track_of(std::move(intruder))};
}

RiskResult merged_risk(std::vector<RiskBatch> batches) {
  std::ranges::sort(batches, {}, &RiskBatch::number);
  RiskResult result;
  for (const RiskBatch& batch : batches)
    for (std::size_t i = 0; i < batch.tallies.size(); ++i) result.tallies[i].add(batch.tallies[i]);
  result.batches = std::move(batches);
  return result;
}

Result<RiskResult> simulated_risk(const RiskSettings& settings, const Logic& logic, const std::atomic<bool>* cancel,
                                  const std::function<void(std::int64_t)>& progress) {
  if (const Result<void> good = check_flights(settings.encounters); !good) return fail(good.error());
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = settings.shard - 1; number * kRiskBatch < settings.count; number += settings.shards)
    numbers.push_back(number);
  std::vector<RiskBatch> batches;
  std::atomic<std::int64_t> flown{0};
  // Whether to go on is asked after rounds of a fixed size, so that it does not depend on threads.
  for (std::size_t begin = 0; begin < numbers.size(); begin += kBatchesOfRound) {
    const auto size = std::min<std::size_t>(kBatchesOfRound, numbers.size() - begin);
    std::vector<RiskBatch> round(size);
    std::mutex mutex;
    std::optional<Error> error;
    parallel_for(static_cast<int>(size), settings.threads, [&](int i) {
      const auto index = static_cast<std::size_t>(i);
      Result<RiskBatch> batch = flown_batch(settings, numbers[begin + index], logic, cancel);
      if (!batch) {
        const std::lock_guard lock(mutex);
        if (!error) error = batch.error();
        return;
      }
      flown += batch->tallies[0].encounters;
      round[index] = *std::move(batch);
      if (progress) progress(flown);
    });
    if (error) return fail(*error);
    batches.insert(batches.end(), round.begin(), round.end());
    if (settings.until <= 0) continue;
    RiskResult so_far = merged_risk(batches);
    if (is_precise(so_far.tallies, settings.until)) return so_far;
  }
  RiskResult result = merged_risk(std::move(batches));
  result.is_precise = settings.until <= 0 || is_precise(result.tallies, settings.until);
  return result;
}

Result<Logic> logic_table(const std::string& text, const std::string& file) {
  struct Row {
    std::array<std::optional<double>, 6> limits;
    ManoeuvreKind kind = ManoeuvreKind::none;
  };
  constexpr std::array kLimits{"bearing_min_deg",   "bearing_max_deg", "elevation_min_deg",
                               "elevation_max_deg", "rate_max_deg_s",  "range_max_m"};
  std::vector<Row> rows;
  std::vector<std::string> names;
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view content = trimmed(next_line(rest));
    const auto wrong = [&](const std::string& what) { return fail(fmt::format("{}: line {}", file, line), what); };
    if (content.empty() || content.starts_with('#')) continue;
    const std::vector<std::string_view> fields = csv_fields(content);
    if (names.empty()) {
      names.assign(fields.begin(), fields.end());
      for (const std::string& name : names)
        if (name != "manoeuvre" && std::ranges::find(kLimits, name) == kLimits.end())
          return wrong(fmt::format("no column is called \"{}\"; there are {} and manoeuvre", name, listed(kLimits)));
      if (std::ranges::find(names, "manoeuvre") == names.end()) return wrong("has no column manoeuvre");
      continue;
    }
    if (fields.size() != names.size())
      return wrong(fmt::format("has {} values, the first line names {}", fields.size(), names.size()));
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string_view field = trimmed(fields[i]);
      if (names[i] == "manoeuvre") {
        const std::optional<ManoeuvreKind> kind = manoeuvre_named(field);
        if (!kind)
          return wrong(fmt::format("no manoeuvre is called \"{}\"; there are {}", field, listed(kManoeuvreNames)));
        row.kind = *kind;
      } else if (!field.empty()) {
        const std::optional<double> number = finite_number(field);
        if (!number) return wrong(fmt::format("{} \"{}\" is no number", names[i], field));
        row.limits[static_cast<std::size_t>(std::ranges::find(kLimits, names[i]) - kLimits.begin())] = number;
      }
    }
    rows.push_back(row);
  }
  if (rows.empty()) return fail(file, "has no rules: a line of columns, then a line for each rule");
  return Logic([rows](const ThreatView& view) -> Result<ManoeuvreKind> {
    const double bearing = deg_of_rad(view.bearing_rad), elevation = deg_of_rad(view.elevation_rad);
    for (const Row& row : rows) {
      if (row.limits[0] && bearing < *row.limits[0]) continue;
      if (row.limits[1] && bearing > *row.limits[1]) continue;
      if (row.limits[2] && elevation < *row.limits[2]) continue;
      if (row.limits[3] && elevation > *row.limits[3]) continue;
      const double rate = deg_of_rad(std::hypot(view.bearing_rate_radps, view.elevation_rate_radps));
      if (row.limits[4] && rate > *row.limits[4]) continue;
      if (row.limits[5] && !(view.range_m && *view.range_m <= *row.limits[5])) continue;
      return row.kind;
    }
    return ManoeuvreKind::none;
  });
}

}  // namespace sigs
