// SPDX-License-Identifier: MIT
#include "calibration/model_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace sigs {

namespace {

constexpr std::size_t kGroups = 5;

// The lens without the views of one group.
LensFit fit_without(std::span<const FitView> views, const LensFit& fit, std::size_t group, std::size_t groups) {
  std::vector<FitView> others;
  LensFit start{.model = fit.model, .intrinsics = fit.intrinsics};
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (v % groups == group) continue;
    others.push_back(views[v]);
    start.poses.push_back(fit.poses[v]);
  }
  return refined(others, std::move(start), all_free(fit.model), {.iterations = 20});
}

double square_of(const FitView& view, const BoardPose& start, const LensFit& lens) {
  LensFit one{.model = lens.model, .intrinsics = lens.intrinsics, .poses = {start}};
  one = refined(std::span(&view, 1), std::move(one), none_free(lens.model), {.iterations = 20});
  const double freedom = 2 * static_cast<double>(view.size()) - 6;
  return freedom > 0 ? 2 * one.cost / freedom : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<double> held_out_squares(std::span<const FitView> views, const LensFit& fit) {
  std::vector<double> squares(views.size(), std::numeric_limits<double>::infinity());
  const std::size_t groups = std::min(kGroups, views.size());
  if (groups < 2) return squares;
  for (std::size_t group = 0; group < groups; ++group) {
    const LensFit lens = fit_without(views, fit, group, groups);
    for (std::size_t v = group; v < views.size(); v += groups) squares[v] = square_of(views[v], fit.poses[v], lens);
  }
  return squares;
}

double held_out_px(std::span<const double> squares) {
  double sum = 0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

bool is_clearly_better(std::span<const double> squares, std::span<const double> than_these) {
  constexpr double kGain = 0.02;
  constexpr double kSmallest_px2 = 1e-8;  // beneath it errors are those of the solver
  if (!(held_out_px(squares) < (1 - kGain) * held_out_px(than_these))) return false;
  std::vector<double> gains;
  for (std::size_t v = 0; v < squares.size(); ++v) {
    const double gain = std::log(std::max(than_these[v], kSmallest_px2) / std::max(squares[v], kSmallest_px2));
    if (std::isfinite(gain)) gains.push_back(gain);
  }
  if (gains.size() < 2) return true;  // the other cannot have these views
  const auto count = static_cast<double>(gains.size());
  double mean = 0;
  for (const double gain : gains) mean += gain / count;
  double variance = 0;
  for (const double gain : gains) variance += std::pow(gain - mean, 2) / (count - 1);
  return mean > 2 * std::sqrt(variance / count);
}

}  // namespace sigs
