// SPDX-License-Identifier: MIT
#include "performance/sensor_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sigs {

namespace {

constexpr double kQuantileLimit = 6;  // P within 1e-9 of 0 and 1
constexpr int kSegments = 5;          // of the range
constexpr int kFolds = 5;
constexpr int kDrawsOfCheck = 40;

enum Term { kHorizon = 1, kAspect = 2 };

using Encounters = std::vector<const ObservedEncounter*>;

// Frames of one class within 1 % of a range.
struct ModelCell {
  double log_range = 0;
  ViewClass at;
  double part = 0;
  double whole = 0;
};

std::vector<ModelCell> cells_of(const Encounters& encounters) {
  std::map<std::array<int, 3>, ModelCell> cells;
  for (const ObservedEncounter* encounter : encounters)
    for (const SeenFrame& frame : encounter->frames) {
      const ViewClass at = view_class_of(frame.horizon, frame.aspect_rad);
      const int number = static_cast<int>(std::floor(100 * std::log(frame.range_m)));
      ModelCell& cell = cells[{number, at.horizon, at.aspect}];
      cell.log_range = (number + 0.5) / 100;
      cell.at = at;
      cell.part += frame.is_detected ? 1 : 0;
      cell.whole += 1;
    }
  std::vector<ModelCell> list;
  for (const auto& [key, cell] : cells) list.push_back(cell);
  return list;
}

// --- The fit: a probit regression whose curve falls with range.

// The quantile at the first knot, how much it falls over each segment (at least 0), and what the classes add: on and
// below the horizon, from the side and from behind.
constexpr std::size_t kOfHorizon = kSegments + 1, kOfAspect = kSegments + 3, kParameters = kSegments + 5;
using Parameters = std::array<double, kParameters>;

using Knots = std::array<double, kSegments + 1>;  // logarithms of ranges

// By how much each parameter counts in a cell.
Parameters row_of(const ModelCell& cell, const Knots& knots, int terms) {
  Parameters row{};
  row[0] = 1;
  for (std::size_t i = 0; i < kSegments; ++i) {
    const double width = knots[i + 1] - knots[i];
    const double part = width > 0 ? (cell.log_range - knots[i]) / width : (cell.log_range > knots[i] ? 1.0 : 0.0);
    row[i + 1] = -std::clamp(part, 0.0, 1.0);
  }
  if ((terms & kHorizon) && cell.at.horizon > 0) row[kOfHorizon - 1 + static_cast<std::size_t>(cell.at.horizon)] = 1;
  if ((terms & kAspect) && cell.at.aspect > 0) row[kOfAspect - 1 + static_cast<std::size_t>(cell.at.aspect)] = 1;
  return row;
}

double probit_density(double x) {
  return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
}

Knots knots_of(const std::vector<ModelCell>& cells) {
  // Quantiles of the frames' ranges; of equal steps where many frames are alike.
  std::vector<ModelCell> sorted = cells;
  std::ranges::sort(sorted, {}, &ModelCell::log_range);
  double all = 0;
  for (const ModelCell& cell : sorted) all += cell.whole;
  Knots knots{};
  knots.front() = sorted.front().log_range;
  knots.back() = sorted.back().log_range;
  double sum = 0;
  std::size_t next = 1;
  for (const ModelCell& cell : sorted) {
    sum += cell.whole;
    while (next < kSegments && sum >= all * double(next) / kSegments) {
      const double equal = knots.front() + (knots.back() - knots.front()) * double(next) / kSegments;
      knots[next++] = (cell.log_range + equal) / 2;
    }
  }
  std::ranges::sort(knots);
  return knots;
}

Parameters fitted(const std::vector<ModelCell>& cells, const Knots& knots, int terms) {
  std::vector<Parameters> rows;
  for (const ModelCell& cell : cells) rows.push_back(row_of(cell, knots, terms));
  Parameters parameters{};
  std::vector<double> quantiles(cells.size());
  // One parameter at a time, by Fisher's scoring; a weak prior (that of one frame) holds what no frame tells.
  constexpr double kPrior = 1;
  for (int sweep = 0; sweep < 300; ++sweep) {
    double moved = 0;
    for (std::size_t j = 0; j < kParameters; ++j) {
      double slope = -kPrior * parameters[j], curvature = kPrior;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const double x = rows[i][j];
        if (x == 0) continue;
        const double q = std::clamp(quantiles[i], -kQuantileLimit, kQuantileLimit);
        const double p = std::clamp(normal_share_below(q), 1e-12, 1 - 1e-12);
        const double density = probit_density(q);
        slope += x * density * (cells[i].part - cells[i].whole * p) / (p * (1 - p));
        curvature += x * x * cells[i].whole * density * density / (p * (1 - p));
      }
      double step = std::clamp(slope / curvature, -1.0, 1.0);
      if (j >= 1 && j <= kSegments) step = std::max(step, -parameters[j]);
      parameters[j] += step;
      moved = std::max(moved, std::abs(step));
      for (std::size_t i = 0; i < cells.size(); ++i) quantiles[i] += rows[i][j] * step;
    }
    if (moved < 1e-6) break;
  }
  return parameters;
}

void set_curve(SensorModel& model, const Parameters& parameters, const Knots& knots) {
  model.range_m.clear();
  model.quantiles.clear();
  double quantile = parameters[0];
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (i > 0) quantile -= parameters[i];
    if (!model.range_m.empty() && !(std::exp(knots[i]) > model.range_m.back())) {
      model.quantiles.back() = quantile;
      continue;
    }
    model.range_m.push_back(std::exp(knots[i]));
    model.quantiles.push_back(quantile);
  }
  model.on_horizon = parameters[kOfHorizon];
  model.below_horizon = parameters[kOfHorizon + 1];
  model.from_side = parameters[kOfAspect];
  model.from_behind = parameters[kOfAspect + 1];
}

double loss_of(const std::vector<ModelCell>& cells, const SensorModel& model, double& frames) {
  double loss = 0;
  for (const ModelCell& cell : cells) {
    const HorizonSide side = cell.at.horizon == 2   ? HorizonSide::below
                             : cell.at.horizon == 1 ? HorizonSide::on
                                                    : HorizonSide::above;
    const double far = model.range_m.back();
    const double q =
        model.quantile_at(std::min(std::exp(cell.log_range), far), side, cell.at.aspect * std::numbers::pi / 2);
    const double p = std::clamp(normal_share_below(q), 1e-6, 1 - 1e-6);
    loss -= cell.part * std::log(p) + (cell.whole - cell.part) * std::log(1 - p);
    frames += cell.whole;
  }
  return loss;
}

// Calls visit(kept, held) with each fifth of the encounters held out, where neither part is empty.
template <class Visit>
void for_each_fold(const Performance& performance, const Visit& visit) {
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    Encounters kept, held;
    for (std::size_t i = 0; i < performance.encounters.size(); ++i)
      (i % kFolds == fold ? held : kept).push_back(&performance.encounters[i]);
    if (!kept.empty() && !held.empty()) visit(kept, held);
  }
}

SensorModel curve_of(const Encounters& encounters, int terms) {
  SensorModel model;
  const std::vector<ModelCell> cells = cells_of(encounters);
  const Knots knots = knots_of(cells);
  set_curve(model, fitted(cells, knots, terms), knots);
  return model;
}

double held_out_loss(const Performance& performance, int terms) {
  double loss = 0, frames = 0;
  for_each_fold(performance, [&](const Encounters& kept, const Encounters& held) {
    loss += loss_of(cells_of(held), curve_of(kept, terms), frames);
  });
  return frames > 0 ? loss / frames : std::numeric_limits<double>::quiet_NaN();
}

// --- How alike frames of an encounter are.

struct LagCorrelation {
  double lag_s = 0;
  double correlation = 0;
  double weight = 0;
};

// Pairs of frames so far apart, at most some thousand of them, evenly taken.
struct FramePair {
  double first = 0, second = 0;  // quantiles
  bool both = false;
};

std::vector<FramePair> pairs_at(const Encounters& encounters, const SensorModel& model, int lag) {
  std::vector<FramePair> pairs;
  for (const ObservedEncounter* encounter : encounters) {
    const std::vector<SeenFrame>& frames = encounter->frames;
    for (std::size_t i = 0, j = 0; i < frames.size(); ++i) {
      while (j < frames.size() && frames[j].frame < frames[i].frame + lag) ++j;
      if (j == frames.size()) break;
      if (frames[j].frame != frames[i].frame + lag) continue;
      const auto quantile = [&](const SeenFrame& f) { return model.quantile_at(f.range_m, f.horizon, f.aspect_rad); };
      pairs.push_back({quantile(frames[i]), quantile(frames[j]), frames[i].is_detected && frames[j].is_detected});
    }
  }
  constexpr std::size_t kMost = 1500;
  const std::size_t step = pairs.size() / kMost + 1;
  std::vector<FramePair> some;
  for (std::size_t i = 0; i < pairs.size(); i += step) some.push_back(pairs[i]);
  return some;
}

// The correlation that gives as many joint detections as there are.
double correlation_of(const std::vector<FramePair>& pairs) {
  double observed = 0;
  for (const FramePair& pair : pairs) observed += pair.both ? 1 : 0;
  const auto expected = [&](double correlation) {
    double sum = 0;
    for (const FramePair& pair : pairs) sum += both_below(pair.first, pair.second, correlation);
    return sum;
  };
  double low = -0.2, high = 0.999;
  if (expected(low) >= observed) return low;
  if (expected(high) <= observed) return high;
  for (int i = 0; i < 14; ++i) {
    const double middle = (low + high) / 2;
    (expected(middle) < observed ? low : high) = middle;
  }
  return (low + high) / 2;
}

void set_correlation(SensorModel& model, const Encounters& encounters) {
  std::vector<LagCorrelation> lags;
  int last = 0;
  for (double lag = 1; lag < 2000; lag = std::max(lag + 1, lag * 1.6)) {
    const int frames = static_cast<int>(lag);
    if (frames == last) continue;
    last = frames;
    const std::vector<FramePair> pairs = pairs_at(encounters, model, frames);
    if (pairs.size() < 100) break;
    lags.push_back({frames / model.rate_hz, correlation_of(pairs), std::sqrt(double(pairs.size()))});
  }
  if (lags.empty()) return;
  double best = std::numeric_limits<double>::infinity();
  for (int share = 0; share <= 19; ++share)
    for (int fading = 0; share + fading <= 20; ++fading)
      for (double time_s = 0.5 / model.rate_hz; time_s < 100; time_s *= 1.3) {
        double error = 0;
        for (const LagCorrelation& lag : lags) {
          const double is = share / 20.0 + fading / 20.0 * std::exp(-lag.lag_s / time_s);
          error += lag.weight * (is - lag.correlation) * (is - lag.correlation);
        }
        if (error >= best - 1e-9) continue;
        best = error;
        model.encounter_share = share / 20.0;
        model.fading_share = fading / 20.0;
        model.correlation_s = time_s;
        if (fading == 0) break;  // no time matters
      }
}

int best_terms(const Performance& performance, SensorFit& fit) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [terms, name] :
       {std::pair(0, "range"), std::pair(int(kHorizon), "range, horizon"), std::pair(int(kAspect), "range, aspect"),
        std::pair(kHorizon | kAspect, "range, horizon, aspect")}) {
    const double loss = held_out_loss(performance, terms);
    fit.choices.push_back({name, loss});
    if (!(loss < least)) continue;
    least = loss;
    best = terms;
    fit.chosen = name;
  }
  return best;
}

SensorModel model_of(const Performance& performance, const Encounters& encounters, int terms) {
  SensorModel model = curve_of(encounters, terms);
  model.detector = performance.detector;
  model.encounters = static_cast<int>(encounters.size());
  for (const ObservedEncounter* encounter : encounters) model.frames += static_cast<int>(encounter->frames.size());
  model.rate_hz = performance.rate_hz;
  model.declare_hits = performance.policy.declare_hits;
  model.declare_window = performance.policy.declare_window;
  model.latency_s = performance.policy.latency_s;
  set_correlation(model, encounters);
  return model;
}

// The range at which the model declares on an encounter as it was flown; 0: never.
double drawn_declaration_m(const SensorModel& model, const ObservedEncounter& encounter, Random& random) {
  SensorDraw draw(model, random);
  const SeenFrame* before = nullptr;
  for (const SeenFrame& frame : encounter.frames) {
    // Frames in which it is not visible are not detected.
    for (int skipped = before ? frame.frame - before->frame - 1 : 0; skipped > 0; --skipped)
      (void)draw.is_declared(false);
    const double step_s = before ? frame.time_s - before->time_s : 0;
    before = &frame;
    const double quantile =
        model.quantile_at(std::min(frame.range_m, model.range_m.back()), frame.horizon, frame.aspect_rad);
    if (!draw.is_declared(draw.detects(quantile, step_s, random))) continue;
    // With the latency, on the way that it was flown.
    const double time_s = frame.time_s + model.latency_s;
    double range_m = frame.range_m;
    for (const SeenFrame& later : encounter.frames)
      if (later.time_s <= time_s) range_m = later.range_m;
    return range_m;
  }
  return 0;
}

}  // namespace

Result<SensorFit> fitted_sensor_model(const Performance& performance, const std::optional<FieldOfView>& field_of_view) {
  if (performance.encounters.size() < 2)
    return fail("sensor model",
                fmt::format("needs at least two encounters in view, there are {}", performance.encounters.size()));
  SensorFit fit;
  const int terms = best_terms(performance, fit);
  Encounters all;
  for (const ObservedEncounter& encounter : performance.encounters) all.push_back(&encounter);
  fit.model = model_of(performance, all, terms);
  SensorModel& model = fit.model;
  if (field_of_view) model.field_of_view = *field_of_view;
  model.is_field_known = field_of_view.has_value();
  if (performance.bearing_rad.count > 1) {
    model.bearing_bias_rad = performance.bearing_rad.bias;
    model.bearing_sd_rad = performance.bearing_rad.standard_deviation;
    model.elevation_bias_rad = performance.elevation_rad.bias;
    model.elevation_sd_rad = performance.elevation_rad.standard_deviation;
  }
  if (performance.range.count > 1) model.range_sd = performance.range.standard_deviation;
  const FalseTracks& empty = performance.false_empty.hours > 0 ? performance.false_empty : performance.false_all;
  if (empty.hours > 0) model.false_tracks_per_hour = empty.declared / empty.hours;
  return fit;
}

SensorModelCheck checked_sensor_model(const Performance& performance) {
  SensorModelCheck check;
  SensorFit fit;
  const int terms = best_terms(performance, fit);
  for_each_fold(performance, [&](const Encounters& kept, const Encounters& held) {
    const SensorModel model = model_of(performance, kept, terms);
    for (const ObservedEncounter* encounter : held) {
      check.images_m.push_back(encounter->declared ? encounter->declared->range_m : 0);
      for (int i = 0; i < kDrawsOfCheck; ++i) {
        Random random(static_cast<std::uint64_t>(i), check.images_m.size());
        check.model_m.push_back(drawn_declaration_m(model, *encounter, random));
      }
    }
  });
  // So many draws stand for the model's own distribution: the number of the images' encounters decides.
  check.distance = distribution_distance(check.images_m, check.model_m);
  const auto share = [](const std::vector<double>& ranges) {
    return ranges.empty()
               ? 0.0
               : double(std::ranges::count_if(ranges, [](double r) { return r > 0; })) / double(ranges.size());
  };
  check.declared_images = share(check.images_m);
  check.declared_model = share(check.model_m);
  return check;
}

}  // namespace sigs
