// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "evaluation/metrics/slices.h"

namespace sigs {

// How sure figures are: intervals of shares and of rates, a curve that falls with range, distances of distributions.
// All intervals are 95 % ones. docs/performance.md gives the formulas.

// Of `part` successes in `whole` independent trials (Wilson 1927). NaN for no trials. Numbers need not be whole.
[[nodiscard]] Interval wilson_interval(double part, double whole);

// Of sum(part) / sum(whole), where the trials of a group resemble each other: Wilson's for as many independent trials
// as the groups are worth (Korn and Graubard 1998): the trials divided by the variance between groups, as a multiple of
// the binomial one, and by (t / 1.96)^2 of Student's t for so many groups less one. Where all or none succeed, nothing
// tells how alike the trials of a group are, and a group counts as one trial. Of one group: 0 to 1. NaN for none.
[[nodiscard]] Interval clustered_interval(std::span<const GroupShare> groups);

// Of the rate of a Poisson process with so many events in an exposure (Garwood 1936). For no events the upper end is
// the one-sided limit, 3.0 / exposure. NaN where the exposure is not above 0.
[[nodiscard]] Interval poisson_rate_interval(int events, double exposure);

// Trials at one place of an axis.
struct Trial {
  double at = 0;
  double part = 0;   // successes
  double whole = 1;  // of so many
};

// A curve that never rises: constant from each place to the next one with another value; below the first place the
// first value holds.
struct FallingCurve {
  std::vector<double> from;    // rising: the first place with trials of each value
  std::vector<double> until;   // the last one
  std::vector<double> values;  // falling

  [[nodiscard]] double at(double place) const;
  // The last place at which the value is at least this: half-way from the last trials that have it to the next ones. 0:
  // it never is; infinite: the last trials have it.
  [[nodiscard]] double last_with(double value) const;
};

// The curve that never rises and has the least squared error, or the greatest likelihood, of all such (isotonic
// regression by pooling adjacent violators: Ayer et al. 1955). Empty for no trials.
[[nodiscard]] FallingCurve falling_fit(std::vector<Trial> trials);

// Weights of independent groups, drawn anew so many times out of a fixed sequence (Bayesian bootstrap: Rubin 1981):
// exponential ones, and those of half a group that always fails and half a group that always succeeds. Of groups that
// fail or succeed as a whole, the share of weights then has the distribution of Jeffreys' interval: what has never
// failed in ten groups may still fail in the next.
struct GroupWeights {
  std::vector<double> groups;
  double failing = 0;
  double succeeding = 0;
};
void draw_weights(std::size_t groups, int draws, const std::function<void(const GroupWeights&)>& take);

// The middle 95 % of the figures of such draws, which may be infinite. NaN of fewer than two groups.
[[nodiscard]] Interval bootstrap_interval(std::vector<double> figures, std::size_t groups);

// The quantile of a sorted sample that may hold infinite values, which are not interpolated: the lower of two.
[[nodiscard]] double ranked_quantile(std::span<const double> sorted, double share);

// The greatest distance between two empirical distributions (Kolmogorov and Smirnov), 0..1, and the probability that
// two samples of one distribution are so far apart or farther (asymptotic, with Stephens' correction). NaN where one of
// them is empty. Values may be infinite.
struct DistributionDistance {
  double distance = 0;
  double p_value = 1;
};
[[nodiscard]] DistributionDistance distribution_distance(std::vector<double> first, std::vector<double> second);

// The standard normal distribution: its density is exp(-x^2/2) / sqrt(2 pi).
[[nodiscard]] double normal_share_below(double x);
[[nodiscard]] double normal_quantile(double share);  // 0 and 1: infinite

// The probability that two standard normal variables of this correlation, -1..1, are below a and b: Plackett's integral
// over the correlation, to 1e-9.
[[nodiscard]] double both_below(double a, double b, double correlation);

// Student's t distribution, the value that 97.5 % are below, to 1e-3; `freedom` at least 1.
[[nodiscard]] double student_t_975(double freedom);

}  // namespace sigs
