// SPDX-License-Identifier: MIT
#include "calibration/lens_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "ego_motion/sequence.h"

namespace sigs {

namespace {

constexpr double kNoError = std::numeric_limits<double>::infinity();
constexpr int kSets = 24;
constexpr std::size_t kSetSize = 3;
constexpr double kBestShare = 0.4;       // of the views, by which a set is judged
constexpr double kFirstHuber_px = 1;     // of a first fit
constexpr double kReferenceShare = 0.3;  // of the views, by whose error the others are judged
constexpr double kLargestError = 2.5;    // of that
constexpr double kSmallError_px = 0.1;   // no view below is left out
constexpr double kCornerDeviations = 5;
constexpr double kSmallResidual_px = 0.3;  // no corner below is left out
constexpr double kMaxCornersLeftOut = 0.25;
constexpr int kMaxRounds = 8;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return kNoError;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

std::vector<double> lengths(std::span<const Eigen::Vector2d> residuals) {
  std::vector<double> all;
  for (const Eigen::Vector2d& residual : residuals) all.push_back(residual.norm());
  return all;
}

std::vector<std::size_t> chosen_set(std::size_t views, Sequence& numbers) {
  std::vector<std::size_t> set;
  while (set.size() < std::min(kSetSize, views)) {
    const std::size_t view = numbers.below(views);
    if (std::ranges::find(set, view) == set.end()) set.push_back(view);
  }
  return set;
}

// Focal length and the first two coefficients: the principal point of three views is uncertain.
FreeIntrinsics first_free() {
  FreeIntrinsics free = FreeIntrinsics::Zero(intrinsic_count(FitModel::kannala_brandt), 3);
  free(0, 0) = free(1, 0) = free(4, 1) = free(5, 2) = 1;
  return free;
}

// Fits a set from one focal length; nothing where the views have no pose with it.
std::optional<LensFit> fit_of_set(std::span<const FitView> views, cv::Size size_px, double half_diagonal_rad) {
  LensFit fit{.model = FitModel::kannala_brandt, .intrinsics = Intrinsics::Zero(8)};
  const double focal_px = std::hypot(size_px.width, size_px.height) / 2 / half_diagonal_rad;
  fit.intrinsics.head<4>() << focal_px, focal_px, (size_px.width - 1) / 2.0, (size_px.height - 1) / 2.0;
  const FitLimits quick{.huber_px = 3, .iterations = 12};
  for (const FitView& view : views) {
    const std::optional<BoardPose> pose = pose_seen(fit.model, fit.intrinsics, view, quick);
    if (!pose) return std::nullopt;
    fit.poses.push_back(*pose);
  }
  const FreeIntrinsics focal_alone = focal_length_alone(fit.model);
  fit = refined(views, std::move(fit), focal_alone, quick);
  fit = refined(views, std::move(fit), first_free(), {.huber_px = kFirstHuber_px, .iterations = 25});
  return std::isfinite(fit.cost) ? std::optional(fit) : std::nullopt;
}

std::optional<LensFit> best_of_focal_lengths(std::span<const FitView> views, cv::Size size_px) {
  constexpr std::array kHalfDiagonals_deg{8.0, 18.0, 32.0, 50.0, 72.0, 95.0};
  std::optional<LensFit> best;
  for (const double angle_deg : kHalfDiagonals_deg) {
    std::optional<LensFit> fit = fit_of_set(views, size_px, angle_deg * std::numbers::pi / 180);
    if (fit && (!best || fit->cost < best->cost)) best = std::move(fit);
  }
  return best;
}

// The lens with a pose for each of the views; where there is none, the error is infinite.
double score_of(LensFit& fit, std::span<const FitView> views) {
  std::vector<double> errors_px;
  fit.poses.clear();
  for (const FitView& view : views) {
    const std::optional<BoardPose> pose =
        pose_seen(fit.model, fit.intrinsics, view, {.huber_px = kFirstHuber_px, .iterations = 10});
    fit.poses.push_back(pose.value_or(BoardPose{}));
    errors_px.push_back(pose ? quantile(lengths(residuals_px(fit.model, fit.intrinsics, *pose, view)), 0.5) : kNoError);
  }
  return quantile(std::move(errors_px), kBestShare);
}

// The largest angle from the axis at which the fit has a corner.
double largest_angle_rad(const LensFit& fit, std::span<const FitView> views) {
  double largest = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
    for (const Eigen::Vector3d& on_board : views[v].on_board_m) {
      const Eigen::Vector3d p = fit.poses[v] * on_board;
      largest = std::max(largest, std::atan2(p.head<2>().norm(), p.z()));
    }
  return largest;
}

// The poses of all views for this lens. A view that the lens cannot have keeps its pose.
void refine_poses(LensFit& fit, std::span<const FitView> views) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    LensFit one{.model = fit.model, .intrinsics = fit.intrinsics, .poses = {fit.poses[v]}};
    one = refined(views.subspan(v, 1), std::move(one), none_free(fit.model),
                  {.huber_px = kFirstHuber_px, .iterations = 15});
    fit.poses[v] = one.poses.front();
  }
}

// By the errors that the fit has.
Agreement agreement_of(const LensFit& fit, std::span<const FitView> views) {
  Agreement agreement;
  std::vector<std::vector<double>> residuals;
  std::vector<double> medians;
  for (std::size_t v = 0; v < views.size(); ++v) {
    residuals.push_back(lengths(residuals_px(fit.model, fit.intrinsics, fit.poses[v], views[v])));
    medians.push_back(quantile(residuals.back(), 0.5));
  }
  // The median length of two independent errors is 1.1774 standard deviations (Rayleigh).
  const double deviation_px = quantile(medians, 0.5) / 1.1774;
  const double largest_px = std::max(kSmallResidual_px, kCornerDeviations * deviation_px);
  std::vector<double> left_out;
  for (const std::vector<double>& view : residuals) {
    double squares = 0;
    double count = 0;
    agreement.corner.emplace_back();
    for (const double residual_px : view) {
      agreement.corner.back().push_back(residual_px <= largest_px);
      if (!agreement.corner.back().back()) continue;
      squares += residual_px * residual_px;
      ++count;
    }
    left_out.push_back(1 - count / static_cast<double>(view.size()));
    agreement.error_px.push_back(count > 0 ? std::sqrt(squares / count) : kNoError);
  }
  const double most_px = std::max(kSmallError_px, kLargestError * quantile(agreement.error_px, kReferenceShare));
  for (std::size_t v = 0; v < views.size(); ++v)
    agreement.view.push_back(agreement.error_px[v] <= most_px && left_out[v] <= kMaxCornersLeftOut);
  return agreement;
}

// Fits the views that count; the others get the poses that suit the lens.
LensFit fitted(LensFit fit, std::span<const FitView> views, const Agreement& agreement) {
  const std::vector<FitView> counting = agreeing(views, agreement);
  LensFit some{.model = fit.model, .intrinsics = fit.intrinsics};
  for (std::size_t v = 0; v < views.size(); ++v)
    if (agreement.view[v]) some.poses.push_back(fit.poses[v]);
  some = refined(counting, std::move(some), all_free(fit.model), {});
  fit.intrinsics = some.intrinsics;
  fit.cost = some.cost;
  std::size_t next = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
    if (agreement.view[v]) fit.poses[v] = some.poses[next++];
  refine_poses(fit, views);
  next = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
    if (agreement.view[v]) fit.poses[v] = some.poses[next++];
  return fit;
}

// Radius in focal lengths at an angle, by a lens that is fitted.
double radius_of(const LensFit& fit, double angle_rad) {
  Intrinsics centred = fit.intrinsics;
  centred[2] = centred[3] = 0;
  const auto at = pixel_of(fit.model, centred, {std::sin(angle_rad), 0, std::cos(angle_rad)});
  return at ? at->x() / centred[0] : 0;
}

}  // namespace

int Agreement::view_count() const {
  return static_cast<int>(std::ranges::count(view, true));
}

std::optional<LensFit> first_fit(std::span<const FitView> views, cv::Size size_px) {
  std::optional<LensFit> best;
  double best_px = kNoError;
  Sequence numbers;
  const int sets = views.size() <= kSetSize ? 1 : kSets;
  for (int i = 0; i < sets; ++i) {
    std::vector<FitView> set;
    for (const std::size_t v : chosen_set(views.size(), numbers)) set.push_back(views[v]);
    std::optional<LensFit> fit = best_of_focal_lengths(set, size_px);
    if (!fit) continue;
    const double score_px = score_of(*fit, views);
    if (score_px >= best_px) continue;
    best_px = score_px;
    best = std::move(fit);
  }
  return best;
}

std::vector<FitView> agreeing(std::span<const FitView> views, const Agreement& agreement) {
  std::vector<FitView> kept;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!agreement.view[v]) continue;
    FitView view;
    for (std::size_t i = 0; i < views[v].size(); ++i) {
      if (!agreement.corner[v][i]) continue;
      view.on_board_m.push_back(views[v].on_board_m[i]);
      view.at_px.push_back(views[v].at_px[i]);
    }
    kept.push_back(std::move(view));
  }
  return kept;
}

Intrinsics converted(const LensFit& from, FitModel to, double largest_angle_rad) {
  constexpr double kWidestTangent_rad = 1.25;  // beyond, tangents grow without bound
  constexpr int kSteps = 40;
  Intrinsics lens = Intrinsics::Zero(intrinsic_count(to));
  lens.head<4>() = from.intrinsics.head<4>();
  if (to == from.model) return from.intrinsics;
  const double end_rad = std::clamp(largest_angle_rad, 0.05, kWidestTangent_rad);
  // Least squares of r(angle) = f (t + k1 t^3 + k2 t^5 ...), as a0 t + a1 t^3 + a2 t^5.
  const int terms = to == FitModel::pinhole ? 1 : 3;
  Eigen::MatrixXd rows(kSteps, terms);
  Eigen::VectorXd radii(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double angle_rad = end_rad * (i + 1) / kSteps;
    const double t = to == FitModel::kannala_brandt ? angle_rad : std::tan(angle_rad);
    for (int k = 0; k < terms; ++k) rows(i, k) = std::pow(t, 2 * k + 1);
    radii[i] = radius_of(from, angle_rad);
  }
  const Eigen::VectorXd a = rows.colPivHouseholderQr().solve(radii);
  if (!a.allFinite() || !(a[0] > 0)) return lens;
  lens[0] *= a[0];
  lens[1] *= a[0];
  for (int k = 1; k < terms; ++k) lens[3 + k] = a[k] / a[0];
  return lens;
}

std::optional<RobustFit> robust_fit(FitModel model, std::span<const FitView> views, const LensFit& start) {
  constexpr int kFewest = 3;
  LensFit fit = start;
  fit.model = model;
  fit.intrinsics = converted(start, model, largest_angle_rad(start, views));
  refine_poses(fit, views);
  Agreement agreement = agreement_of(fit, views);
  for (int round = 0; round < kMaxRounds; ++round) {
    if (agreement.view_count() < kFewest) return std::nullopt;
    fit = fitted(std::move(fit), views, agreement);
    if (!std::isfinite(fit.cost)) return std::nullopt;
    Agreement next = agreement_of(fit, views);
    const bool is_same = next.view == agreement.view && next.corner == agreement.corner;
    agreement = std::move(next);
    if (is_same) break;
  }
  if (agreement.view_count() < kFewest) return std::nullopt;
  return RobustFit{.fit = std::move(fit), .agreement = std::move(agreement)};
}

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
