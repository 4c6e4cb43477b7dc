// SPDX-License-Identifier: MIT
#include "encounter/encounter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "encounter/smooth_piece.h"

namespace sigs {

namespace {

double square(double x) {
  return x * x;
}

double dot(const RelativeState& r) {
  return r.horizontal_m.x * r.horizontal_mps.x + r.horizontal_m.y * r.horizontal_mps.y;
}

double size_of_dot(const RelativeState& r) {
  return std::abs(r.horizontal_m.x * r.horizontal_mps.x) + std::abs(r.horizontal_m.y * r.horizontal_mps.y);
}

double square_of(const glm::dvec2& v) {
  return v.x * v.x + v.y * v.y;
}

TermSum horizontal_rate(const RelativeState& r) {
  return {dot(r), size_of_dot(r)};
}

// Functions whose signs alone decide whether well clear is lost: between two of their sign changes it is lost always or
// never. Each is a polynomial of degree 10 at most where the flights are cubic.
std::vector<MotionFunction> functions_of(const WellClearVolume& volume) {
  const double d2 = square(volume.dmod_m);
  const double h2 = square(volume.hmd_m);
  const double t = volume.tau_mod_s;
  const auto height = [](double sign, double limit_m, double tcoa_s) {
    return [=](const RelativeState& r) {
      const double flown_m = tcoa_s * r.vertical_mps;
      return TermSum{r.vertical_m + flown_m - sign * limit_m, std::abs(r.vertical_m) + std::abs(flown_m) + limit_m};
    };
  };
  std::vector<MotionFunction> all{height(1, volume.zthr_m, 0), height(-1, volume.zthr_m, 0),
                                  [=](const RelativeState& r) {
                                    return TermSum{square_of(r.horizontal_m) - d2, square_of(r.horizontal_m) + d2};
                                  }};
  if (t > 0) {
    all.emplace_back(horizontal_rate);
    all.emplace_back([=](const RelativeState& r) {
      return TermSum{square_of(r.horizontal_m) + t * dot(r) - d2, square_of(r.horizontal_m) + t * size_of_dot(r) + d2};
    });
    all.emplace_back([=](const RelativeState& r) {
      const double a = r.horizontal_m.x * r.horizontal_mps.y;
      const double b = r.horizontal_m.y * r.horizontal_mps.x;
      const double limit = h2 * square_of(r.horizontal_mps);
      return TermSum{square(a - b) - limit, square(std::abs(a) + std::abs(b)) + limit};
    });
  }
  if (volume.tcoa_s > 0) {
    all.push_back(height(0, 0, volume.tcoa_s));
    all.push_back(height(0, 0, 0));
    all.emplace_back([](const RelativeState& r) { return TermSum{r.vertical_mps, std::abs(r.vertical_mps)}; });
  }
  return all;
}

// Losses for one volume, put together from piece to piece.
class LossSearch {
 public:
  explicit LossSearch(const WellClearVolume& volume) : volume_(volume), functions_(functions_of(volume)) {}

  void visit(const SmoothPiece& piece, const RelativeMotionAt& motion) {
    times_s_.clear();
    for (const MotionFunction& function : functions_) append_sign_changes(piece, motion, function, times_s_);
    std::sort(times_s_.begin(), times_s_.end());
    times_s_.push_back(piece.end_s);
    double from_s = piece.begin_s;
    for (const double to_s : times_s_) {
      if (!(to_s > from_s)) continue;
      if (has_lost_well_clear(motion(from_s + (to_s - from_s) / 2), volume_)) add({from_s, to_s});
      from_s = to_s;
    }
  }

  [[nodiscard]] const std::vector<TimeInterval>& losses() const { return losses_; }

 private:
  void add(const TimeInterval& part) {
    if (!losses_.empty() && losses_.back().end_s == part.begin_s)
      losses_.back().end_s = part.end_s;
    else
      losses_.push_back(part);
  }

  WellClearVolume volume_;
  std::vector<MotionFunction> functions_;
  std::vector<double> times_s_;
  std::vector<TimeInterval> losses_;
};

NearestMoment moment_at(const RelativeMotionAt& motion, double time_s) {
  const RelativeState r = motion(time_s);
  const double horizontal_m = std::hypot(r.horizontal_m.x, r.horizontal_m.y);
  return {time_s, std::hypot(horizontal_m, r.vertical_m), horizontal_m, r.vertical_m};
}

// The least of a distance: at the ends of the pieces or where its rate changes its sign.
class NearestSearch {
 public:
  NearestSearch(double NearestMoment::*distance, MotionFunction rate, const NearestMoment& first)
      : distance_(distance), rate_(std::move(rate)), nearest_(first) {}

  void visit(const SmoothPiece& piece, const RelativeMotionAt& motion) {
    times_s_.clear();
    append_sign_changes(piece, motion, rate_, times_s_);
    times_s_.push_back(piece.end_s);
    std::sort(times_s_.begin(), times_s_.end());
    for (const double time_s : times_s_) {
      const NearestMoment moment = moment_at(motion, time_s);
      // Equal but for rounding is not nearer.
      if (moment.*distance_ < nearest_.*distance_ * (1 - 1e-14)) nearest_ = moment;
    }
  }

  [[nodiscard]] const NearestMoment& nearest() const { return nearest_; }

 private:
  double NearestMoment::*distance_;
  MotionFunction rate_;
  NearestMoment nearest_;
  std::vector<double> times_s_;
};

TermSum slant_rate(const RelativeState& r) {
  const double vertical = r.vertical_m * r.vertical_mps;
  return {dot(r) + vertical, size_of_dot(r) + std::abs(vertical)};
}

// Of the positions' difference: some units in the last place of the largest coordinate, as some instants have it.
double rounding_of(const EncounterTrack& own, const EncounterTrack& intruder, double first_s, double last_s) {
  constexpr int kInstants = 64;
  double largest_m = 0;
  for (int i = 0; i <= kInstants; ++i) {
    const double time_s = i == kInstants ? last_s : first_s + i * ((last_s - first_s) / kInstants);
    for (const glm::dvec3& place : {own.at(time_s).position_m, intruder.at(time_s).position_m})
      for (int axis = 0; axis < 3; ++axis) largest_m = std::max(largest_m, std::abs(place[axis]));
  }
  return 1e-15 * largest_m;
}

// By slant and by horizontal range, and what else looks at each smooth piece of the motion.
NearestMoments nearest_of(const EncounterTrack& own, const EncounterTrack& intruder, const RelativeMotionAt& motion,
                          const std::function<void(const SmoothPiece&)>& visit) {
  const double first_s = std::max(own.first_s, intruder.first_s);
  const double last_s = std::min(own.last_s, intruder.last_s);
  const NearestMoment first = moment_at(motion, first_s);
  NearestSearch slant(&NearestMoment::range_m, slant_rate, first);
  NearestSearch horizontal(&NearestMoment::horizontal_m, horizontal_rate, first);
  std::vector<double> knots_s;
  std::merge(own.knots_s.begin(), own.knots_s.end(), intruder.knots_s.begin(), intruder.knots_s.end(),
             std::back_inserter(knots_s));
  for_each_smooth_piece(motion, first_s, last_s, knots_s, rounding_of(own, intruder, first_s, last_s),
                        [&](const SmoothPiece& piece) {
                          slant.visit(piece, motion);
                          horizontal.visit(piece, motion);
                          visit(piece);
                        });
  return {slant.nearest(), horizontal.nearest()};
}

// The greatest severity within a loss, into the outcome if it is greater than what is there.
void find_worst(const TimeInterval& loss, const RelativeMotionAt& motion, VolumeOutcome& outcome) {
  const double length_s = loss.end_s - loss.begin_s;
  const int count = static_cast<int>(std::clamp(length_s / 0.05, 64.0, 20000.0));
  const double step_s = length_s / count;
  const auto at = [&](double time_s) { return loss_severity(motion(time_s), outcome.volume); };
  double best_s = loss.begin_s + step_s / 2;
  for (int i = 0; i < count; ++i)
    if (const double time_s = loss.begin_s + (i + 0.5) * step_s; at(time_s) > at(best_s)) best_s = time_s;
  double low_s = std::max(loss.begin_s, best_s - step_s);
  double high_s = std::min(loss.end_s, best_s + step_s);
  constexpr double kGolden = 0.3819660112501051;
  for (int i = 0; i < 60 && high_s - low_s > 1e-9; ++i) {
    const double a_s = low_s + kGolden * (high_s - low_s);
    const double b_s = high_s - kGolden * (high_s - low_s);
    (at(a_s) < at(b_s) ? low_s : high_s) = at(a_s) < at(b_s) ? a_s : b_s;
  }
  if (const double refined_s = (low_s + high_s) / 2; at(refined_s) > at(best_s)) best_s = refined_s;
  if (const double severity = at(best_s); !outcome.worst_s || severity > outcome.worst_severity) {
    outcome.worst_severity = severity;
    outcome.worst_s = best_s;
  }
}

VolumeOutcome outcome_of(const WellClearVolume& volume, const std::vector<TimeInterval>& losses,
                         const RelativeMotionAt& motion) {
  VolumeOutcome outcome{.volume = volume, .losses = losses};
  for (const TimeInterval& loss : losses) find_worst(loss, motion, outcome);
  return outcome;
}

RowOfVolume row_of(const RelativeState& state, const WellClearVolume& volume) {
  return {has_lost_well_clear(state, volume), tau_mod_s(state, volume.dmod_m), loss_severity(state, volume),
          predicted_loss(state, volume)};
}

void count_row(VolumeOutcome& outcome, bool is_lost, std::size_t row) {
  if (!is_lost) return;
  ++outcome.rows_lost;
  if (!outcome.first_row_lost) outcome.first_row_lost = row;
  outcome.last_row_lost = row;
}

void add_rows(EncounterSummary& summary, const EncounterTrack& own, const EncounterTrack& intruder,
              std::vector<double> times_s) {
  std::sort(times_s.begin(), times_s.end());
  for (const double time_s : times_s) {
    if (!(time_s >= summary.first_s) || time_s > summary.last_s) continue;
    EncounterRow row{.time_s = time_s, .own = own.at(time_s), .intruder = intruder.at(time_s)};
    const RelativeState state = relative_state(row.own, row.intruder);
    row.quantities = relative_quantities(row.own, row.intruder);
    const std::size_t index = summary.rows.size();
    for (VolumeOutcome& outcome : summary.volumes) {
      row.of_volumes.push_back(row_of(state, outcome.volume));
      count_row(outcome, row.of_volumes.back().is_lost, index);
    }
    count_row(summary.nmac, has_lost_well_clear(state, summary.nmac.volume), index);
    if (!summary.nearest_row ||
        row.quantities.horizontal_range_m < summary.rows[*summary.nearest_row].quantities.horizontal_range_m)
      summary.nearest_row = index;
    summary.rows.push_back(std::move(row));
  }
}

Result<void> check(const EncounterTrack& own, const EncounterTrack& intruder, const EncounterSettings& settings) {
  for (const WellClearVolume& volume : settings.volumes)
    if (const Result<void> sound = check_volume(volume); !sound) return sound;
  const double first_s = std::max(own.first_s, intruder.first_s);
  if (!(first_s <= std::min(own.last_s, intruder.last_s)))
    return fail(intruder.name,
                fmt::format("flies from {} to {} s, {} from {} to {} s: there is no time that both share",
                            short_number_text(intruder.first_s), short_number_text(intruder.last_s), own.name,
                            short_number_text(own.first_s), short_number_text(own.last_s)));
  for (const double time_s : {first_s, std::min(own.last_s, intruder.last_s)})
    if (!is_finite(relative_state(own.at(time_s), intruder.at(time_s))))
      return fail(intruder.name, fmt::format("has, or {} has, a place or a velocity at {} s that is not finite",
                                             own.name, short_number_text(time_s)));
  return {};
}

}  // namespace

Result<EncounterSummary> encounter_of(const EncounterTrack& own, const EncounterTrack& intruder,
                                      const EncounterSettings& settings) {
  if (const Result<void> sound = check(own, intruder, settings); !sound) return fail(sound.error());
  EncounterSummary summary{.own_name = own.name,
                           .intruder_name = intruder.name,
                           .first_s = std::max(own.first_s, intruder.first_s),
                           .last_s = std::min(own.last_s, intruder.last_s)};
  const RelativeMotionAt motion = [&](double time_s) { return relative_state(own.at(time_s), intruder.at(time_s)); };
  std::vector<LossSearch> searches(settings.volumes.begin(), settings.volumes.end());
  searches.emplace_back(nmac_volume());
  const NearestMoments nearest = nearest_of(own, intruder, motion, [&](const SmoothPiece& piece) {
    for (LossSearch& search : searches) search.visit(piece, motion);
  });
  summary.nearest = nearest.slant;
  summary.nearest_horizontal = nearest.horizontal;
  for (std::size_t i = 0; i < settings.volumes.size(); ++i)
    summary.volumes.push_back(outcome_of(settings.volumes[i], searches[i].losses(), motion));
  summary.nmac = outcome_of(nmac_volume(), searches.back().losses(), motion);
  add_rows(summary, own, intruder, settings.row_times_s);
  return summary;
}

Result<NearestMoments> nearest_moments(const EncounterTrack& own, const EncounterTrack& intruder) {
  if (const Result<void> sound = check(own, intruder, {}); !sound) return fail(sound.error());
  const RelativeMotionAt motion = [&](double time_s) { return relative_state(own.at(time_s), intruder.at(time_s)); };
  return nearest_of(own, intruder, motion, [](const SmoothPiece&) {});
}

Result<NearestMoment> nearest_horizontal_moment(const EncounterTrack& own, const EncounterTrack& intruder) {
  const Result<NearestMoments> nearest = nearest_moments(own, intruder);
  if (!nearest) return fail(nearest.error());
  return nearest->horizontal;
}

}  // namespace sigs
