// SPDX-License-Identifier: MIT
#include "ego_motion/time_offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ego_motion/sequence.h"
#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr double kStep_s = 0.005;
constexpr std::size_t kMinTurns = 20;
constexpr int kParts = 4;

struct Comparison {
  double correlation = 0;
  double slope = 0;
  std::size_t count = 0;
};

Comparison compared(std::span<const SeenTurn> turns, const RateIntegral& rates, double offset_s) {
  Eigen::Vector3d mean_seen = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_recorded = Eigen::Vector3d::Zero();
  std::vector<std::array<Eigen::Vector3d, 2>> both;
  for (const SeenTurn& turn : turns) {
    if (!rates.covers(turn.from_s + offset_s, turn.to_s + offset_s)) continue;
    const double length_s = turn.to_s - turn.from_s;
    both.push_back({turn.turn_rad / length_s, rates.between(turn.from_s + offset_s, turn.to_s + offset_s) / length_s});
    mean_seen += both.back()[0];
    mean_recorded += both.back()[1];
  }
  if (both.size() < kMinTurns) return {};
  mean_seen /= static_cast<double>(both.size());
  mean_recorded /= static_cast<double>(both.size());
  double seen2 = 0;
  double recorded2 = 0;
  double mixed = 0;
  for (const auto& [seen, recorded] : both) {
    seen2 += (seen - mean_seen).squaredNorm();
    recorded2 += (recorded - mean_recorded).squaredNorm();
    mixed += (seen - mean_seen).dot(recorded - mean_recorded);
  }
  if (!(seen2 > 0) || !(recorded2 > 0)) return {.count = both.size()};
  return {mixed / std::sqrt(seen2 * recorded2), mixed / recorded2, both.size()};
}

// Compares turns at offsets of one step, each once.
class OffsetSearch {
 public:
  OffsetSearch(std::span<const SeenTurn> turns, const RateIntegral& rates, double around_s, double range_s,
               const StepControl& control)
      : turns_(turns),
        rates_(rates),
        first_s_(around_s - range_s),
        count_(static_cast<std::size_t>(std::floor(2 * range_s / kStep_s + 1e-6)) + 1),
        control_(control) {}

  // The number of the offset with the highest correlation by all turns, the first of equal ones. None: at no offset
  // enough turns can be compared.
  [[nodiscard]] std::optional<std::size_t> best() {
    pick_some();
    by_some_.assign(count_, std::nullopt);
    for (std::size_t i = 0; i < count_ && !control_.is_cancelled(); i += stride_) compare_some(i);
    compare_around(good_enough(kCoarseShare, kCoarseMargin));
    return best_by_all(good_enough(1, kFineMargin));
  }

  [[nodiscard]] double offset_s(std::size_t i) const { return first_s_ + static_cast<double>(i) * kStep_s; }

 private:
  static constexpr std::size_t kSome = 1500;    // turns
  static constexpr std::size_t kMaxStride = 4;  // of 5 ms
  static constexpr double kCoarseShare = 0.6;
  static constexpr double kCoarseMargin = 0.1;
  static constexpr double kFineMargin = 0.1;     // four standard deviations of a correlation by 1500 turns
  static constexpr std::size_t kMaxByAll = 400;  // offsets

  // One of each group of neighbours, by chance: turns at equal distances could all be of one phase of a vibration.
  void pick_some() {
    some_.clear();
    Sequence chance;
    const std::size_t group = (turns_.size() + kSome - 1) / kSome;
    for (std::size_t i = 0; i < turns_.size(); i += group)
      some_.push_back(turns_[i + chance.below(std::min(group, turns_.size() - i))]);
    all_are_picked_ = group == 1;
    // A turn is the mean of the rates over a frame's interval, so that the peak is at least as wide as that on both
    // sides, and a quarter of it leaves three quarters of the height. Rates that change slowly have a wider peak.
    double length_s = std::numeric_limits<double>::infinity();
    for (const SeenTurn& turn : some_) length_s = std::min(length_s, turn.to_s - turn.from_s);
    stride_ = static_cast<std::size_t>(std::clamp(length_s / 2 / kStep_s, 1.0, static_cast<double>(kMaxStride)));
  }

  // Where too few of the picked turns lie in the log, by all.
  void compare_some(std::size_t i) {
    Comparison c = compared(some_, rates_, offset_s(i));
    if (c.count < kMinTurns && !all_are_picked_) c = compared(turns_, rates_, offset_s(i));
    by_some_[i] = c.count < kMinTurns ? kNothing : c.correlation;
    control_.report(kShareOfSome * static_cast<double>(++compared_) / static_cast<double>(count_));
  }

  // Offsets whose correlation by some turns is near the highest one.
  [[nodiscard]] std::vector<std::size_t> good_enough(double share, double margin) const {
    double highest = kNothing;
    for (const std::optional<double>& c : by_some_) highest = std::max(highest, c.value_or(kNothing));
    const double enough = (highest > 0 ? share * highest : highest) - margin;
    std::vector<std::size_t> good;
    for (std::size_t i = 0; i < count_; ++i)
      if (by_some_[i].value_or(kNothing) > kNothing && *by_some_[i] >= enough) good.push_back(i);
    return good;
  }

  void compare_around(const std::vector<std::size_t>& good) {
    const std::size_t beside = stride_ - 1;
    for (const std::size_t i : good)
      for (std::size_t k = i - std::min(i, beside); k <= std::min(count_ - 1, i + beside); ++k)
        if (!by_some_[k] && !control_.is_cancelled()) compare_some(k);
  }

  [[nodiscard]] std::optional<std::size_t> best_by_all(std::vector<std::size_t> good) const {
    if (good.size() > kMaxByAll) {
      std::stable_sort(good.begin(), good.end(),
                       [&](std::size_t a, std::size_t b) { return *by_some_[a] > *by_some_[b]; });
      good.resize(kMaxByAll);
      std::sort(good.begin(), good.end());
    }
    std::optional<std::size_t> best;
    double highest = kNothing;
    for (std::size_t n = 0; n < good.size() && !control_.is_cancelled(); ++n) {
      const Comparison c = all_are_picked_ ? Comparison{.correlation = *by_some_[good[n]], .count = kMinTurns}
                                           : compared(turns_, rates_, offset_s(good[n]));
      if (c.count >= kMinTurns && c.correlation > highest) {
        highest = c.correlation;
        best = good[n];
      }
      control_.report(kShareOfSome +
                      (1 - kShareOfSome) * static_cast<double>(n + 1) / static_cast<double>(good.size()));
    }
    return best;
  }

  static constexpr double kNothing = -2;  // below any correlation
  static constexpr double kShareOfSome = 0.5;

  std::span<const SeenTurn> turns_;
  const RateIntegral& rates_;
  double first_s_;
  std::size_t count_;
  const StepControl& control_;
  std::vector<SeenTurn> some_;
  bool all_are_picked_ = false;
  std::size_t stride_ = 1;                      // between offsets that are compared first
  std::vector<std::optional<double>> by_some_;  // correlations; kNothing: too few turns; none: not compared
  std::size_t compared_ = 0;
};

struct Peak {
  double offset_s = 0;
  double sd_s = std::numeric_limits<double>::infinity();
};

// The highest correlation near `around`, to parts of a step, and how sharp it is.
std::optional<Peak> peak(std::span<const SeenTurn> turns, const RateIntegral& rates, double around_s, double range_s,
                         const StepControl& control) {
  OffsetSearch search(turns, rates, around_s, range_s, control);
  const std::optional<std::size_t> at = search.best();
  if (!at || control.is_cancelled()) return std::nullopt;
  const double best_s = search.offset_s(*at);
  const double best = compared(turns, rates, best_s).correlation;
  constexpr double kWide_s = 2 * kStep_s;
  const double before = compared(turns, rates, best_s - kWide_s).correlation;
  const double after = compared(turns, rates, best_s + kWide_s).correlation;
  const double bend = (before - 2 * best + after) / (kWide_s * kWide_s);
  if (!(bend < 0)) return Peak{best_s};
  const double part_s = std::clamp((before - after) / (2 * kWide_s) / bend, -kWide_s, kWide_s);
  // The correlation falls by (1 - r^2) / (2 n) within one standard deviation of its maximum.
  const double noise = std::max(1e-6, 1 - best * best) / static_cast<double>(turns.size());
  return Peak{best_s + part_s, std::sqrt(noise / std::max(-bend * std::abs(best), 1e-12))};
}

void add_drift(TimeOffset& offset, std::span<const SeenTurn> turns, const RateIntegral& rates, CancelFlag cancel) {
  double s = 0;
  double st = 0;
  double stt = 0;
  double so = 0;
  double sto = 0;
  const std::size_t length = turns.size() / kParts;
  if (length < 2 * kMinTurns) {
    offset.drift_sd = std::numeric_limits<double>::infinity();
    return;
  }
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::span<const SeenTurn> some = turns.subspan(part * length, length);
    const std::optional<Peak> found = peak(some, rates, offset.offset_s, 0.1, {.cancel = cancel});
    if (!found || !std::isfinite(found->sd_s)) continue;
    const double weight = 1 / (found->sd_s * found->sd_s + 1e-6);
    const double t = (some.front().from_s + some.back().to_s) / 2 - offset.middle_s;
    s += weight;
    st += weight * t;
    stt += weight * t * t;
    so += weight * found->offset_s;
    sto += weight * t * found->offset_s;
  }
  const double determinant = s * stt - st * st;
  offset.drift_sd = determinant > 0 ? std::sqrt(s / determinant) : std::numeric_limits<double>::infinity();
  const double drift = determinant > 0 ? (s * sto - st * so) / determinant : 0;
  if (std::abs(drift) > 3 * offset.drift_sd) offset.drift = drift;
}

}  // namespace

RateIntegral::RateIntegral(const Channel<glm::dvec3>& rates) {
  const std::size_t count = std::min(rates.times_s.size(), rates.values.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d rate = eigen_of(rates.values[i]);
    if (!rate.allFinite() || !std::isfinite(rates.times_s[i])) continue;
    if (!times_s_.empty() && !(rates.times_s[i] > times_s_.back())) continue;
    sums_.push_back(times_s_.empty() ? Eigen::Vector3d(0, 0, 0)
                                     : Eigen::Vector3d(sums_.back() + (rates_.back() + rate) / 2 *
                                                                          (rates.times_s[i] - times_s_.back())));
    times_s_.push_back(rates.times_s[i]);
    rates_.push_back(rate);
  }
}

bool RateIntegral::covers(double from_s, double to_s) const {
  return !empty() && from_s >= first_s() && to_s <= last_s();
}

Eigen::Vector3d RateIntegral::between(double from_s, double to_s) const {
  if (empty()) return Eigen::Vector3d::Zero();
  return up_to(to_s) - up_to(from_s);
}

Eigen::Vector3d RateIntegral::up_to(double time_s) const {
  if (time_s <= first_s()) return Eigen::Vector3d::Zero();
  if (time_s >= last_s()) return sums_.back();
  const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), time_s);
  const auto i = static_cast<std::size_t>(after - times_s_.begin()) - 1;
  const double part_s = time_s - times_s_[i];
  const double share = part_s / (times_s_[i + 1] - times_s_[i]);
  return sums_[i] + part_s * (rates_[i] + 0.5 * share * (rates_[i + 1] - rates_[i]));
}

std::optional<TimeOffset> time_offset(std::span<const SeenTurn> turns, const RateIntegral& rates, double max_offset_s,
                                      const StepControl& control) {
  if (turns.size() < kMinTurns || rates.empty()) return std::nullopt;
  const std::optional<Peak> found = peak(turns, rates, 0, max_offset_s, control);
  if (!found) return std::nullopt;
  const Comparison at_peak = compared(turns, rates, found->offset_s);
  TimeOffset offset{.offset_s = found->offset_s,
                    .offset_sd_s = found->sd_s,
                    .middle_s = (turns.front().from_s + turns.back().to_s) / 2,
                    .correlation = at_peak.correlation,
                    .slope = at_peak.slope};
  add_drift(offset, turns, rates, control.cancel);
  return offset;
}

}  // namespace sigs
