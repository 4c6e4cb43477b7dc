// SPDX-License-Identifier: MIT
#include "appearance/edge_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace sigs {

namespace {

constexpr double kStep_px = 0.125;  // of the table; half way between two entries it is off by less than 0.002
constexpr double kReach_px = 12;
constexpr double kMinSigma_px = 0.02, kMaxSigma_px = 8;
constexpr double kMaxSharpening = 4;
constexpr double kMinSharpening_px = 0.5, kMaxSharpening_px = 3;

// The integral, from minus infinity, of the integral of the normal distribution's cumulative function of deviation s.
double twice_integrated_step(double x, double s) {
  const double z = x / s;
  const double below = 0.5 * std::erfc(-z / std::sqrt(2.0));
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * CV_PI);
  return 0.5 * ((x * x + s * s) * below + s * x * density);
}

// The step blurred by the Gaussian and averaged over a square of this width, whose sides are oblique to the edge:
// projected on the normal the square is a box of a = width * |cos| convolved with one of b = width * |sin|.
double light_share(double x, double sigma_px, double a, double b) {
  const auto f = [&](double at) { return twice_integrated_step(at, sigma_px); };
  return (f(x + (a + b) / 2) - f(x + (a - b) / 2) - f(x - (a - b) / 2) + f(x - (a + b) / 2)) / (a * b);
}

void sharpen(std::vector<double>& values, const EdgeShape& shape) {
  const int reach = static_cast<int>(std::ceil(3.5 * shape.sharpening_px / kStep_px));
  std::vector<double> kernel(reach + 1);
  double sum = 0;
  for (int k = 0; k <= reach; ++k) {
    kernel[k] = std::exp(-0.5 * std::pow(k * kStep_px / shape.sharpening_px, 2));
    sum += (k == 0 ? 1 : 2) * kernel[k];
  }
  const auto count = static_cast<int>(values.size());
  std::vector<double> padded(count + 2 * reach), blurred(count);
  for (int i = 0; i < count + 2 * reach; ++i) padded[i] = values[std::clamp(i - reach, 0, count - 1)];
  for (int i = 0; i < count; ++i) blurred[i] = kernel[0] * padded[i + reach];
  for (int k = 1; k <= reach; ++k) {
    const double weight = kernel[k];
    const double* const before = padded.data() + reach - k;
    const double* const after = padded.data() + reach + k;
    for (int i = 0; i < count; ++i) blurred[i] += weight * (before[i] + after[i]);
  }
  for (int i = 0; i < count; ++i) values[i] += shape.sharpening * (values[i] - blurred[i] / sum);
}

// The table of an EdgeCurve before sharpening.
std::vector<double> unsharpened(double sigma_px, const EdgeLevels& levels, glm::dvec2 normal) {
  constexpr int kHalf = static_cast<int>(kReach_px / kStep_px);
  constexpr double kNarrowest_px = 0.01;  // of a box, so that nothing is divided by zero
  const double a = levels.pixel_px * std::max(std::abs(normal.x), kNarrowest_px);
  const double b = levels.pixel_px * std::max(std::abs(normal.y), kNarrowest_px);
  sigma_px = std::max(sigma_px, kMinSigma_px);
  const double dark = linear_of_display(levels.transfer, levels.dark);
  const double bright = linear_of_display(levels.transfer, levels.bright);
  std::vector<double> values(2 * kHalf + 1);
  const double flat_px = 4 * sigma_px + levels.pixel_px;  // beyond it the share is 0 or 1 to 1e-4
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double x = i * kStep_px;
    double& value = values[i + kHalf];
    if (std::abs(x) > flat_px) {
      value = x < 0 ? 0 : 1;
      continue;
    }
    const double share = light_share(x, sigma_px, a, b);
    const double display = display_of_linear(levels.transfer, dark + share * (bright - dark));
    value = (display - levels.dark) / (levels.bright - levels.dark);
  }
  return values;
}

// Curves of one edge. The two last sigmas are kept: a fit moves sharpening while sigma stays, and where it moves sigma
// it comes back to the one before.
class RecentCurves {
 public:
  [[nodiscard]] EdgeCurve curve(const EdgeSample& edge, const EdgeShape& shape) {
    if (kept_[last_].values.empty() || kept_[last_].sigma_px != shape.sigma_px) last_ = 1 - last_;
    Kept& kept = kept_[last_];
    if (kept.values.empty() || kept.sigma_px != shape.sigma_px)
      kept = {shape.sigma_px, unsharpened(shape.sigma_px, edge.levels, edge.normal)};
    return {kept.values, shape};
  }

 private:
  struct Kept {
    double sigma_px = 0;
    std::vector<double> values = {};
  };
  std::array<Kept, 2> kept_;
  std::size_t last_ = 0;
};

// Code = level + contrast * curve(d - shift), by weighted least squares.
struct Placed {
  double shift_px = 0;
  double level = 0;
  double contrast = 1;
};

double slope_of(const EdgeCurve& curve, double at) {
  return (curve(at + kStep_px) - curve(at - kStep_px)) / (2 * kStep_px);
}

// The normal equations' solution for level, contrast and contrast times shift, at the place that is known so far.
std::optional<cv::Vec3d> solved(const EdgeBins& bins, const EdgeCurve& curve, double shift_px) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right(0, 0, 0);
  for (std::size_t i = 0; i < bins.code.size(); ++i) {
    const double at = bins.distance_px[i] - shift_px;
    const cv::Vec3d row(1, curve(at), slope_of(curve, at));
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) normal(r, c) += bins.count[i] * row[r] * row[c];
      right[r] += bins.count[i] * row[r] * bins.code[i];
    }
  }
  cv::Vec3d solution;
  if (!cv::solve(normal, right, solution, cv::DECOMP_SVD)) return std::nullopt;
  return solution;
}

// The residuals in tolerances, the place of the edge and its levels being fitted.
std::vector<double> residuals_of(const EdgeSample& edge, const EdgeCurve& curve, Placed& placed) {
  const EdgeBins& bins = edge.bins;
  std::vector<double> residuals(bins.code.size());
  std::optional<cv::Vec3d> last;
  for (int round = 0; round < 3; ++round) {
    const std::optional<cv::Vec3d> solution = solved(bins, curve, placed.shift_px);
    if (!solution) break;
    last = solution;
    placed.level = (*solution)[0];
    placed.contrast = (*solution)[1];
    if (round < 2 && std::abs(placed.contrast) > 1e-6)
      placed.shift_px =
          std::clamp(placed.shift_px - std::clamp((*solution)[2] / placed.contrast, -0.5, 0.5), -2.0, 2.0);
  }
  if (!last) return residuals;
  for (std::size_t i = 0; i < bins.code.size(); ++i) {
    const double at = bins.distance_px[i] - placed.shift_px;
    const double model = (*last)[0] + (*last)[1] * curve(at) + (*last)[2] * slope_of(curve, at);
    residuals[i] = (bins.code[i] - model) * std::sqrt(bins.count[i]) / edge.tolerance;
  }
  return residuals;
}

std::vector<double> residuals_of(std::span<const EdgeSample> edges, const EdgeShape& shape,
                                 std::vector<RecentCurves>& recent) {
  std::vector<double> all;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Placed placed;
    const std::vector<double> one = residuals_of(edges[i], recent[i].curve(edges[i], shape), placed);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

double square_sum(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return sum;
}

// Parameters are logarithms, so that they stay positive; the sharpening's is of 1 + sharpening.
EdgeShape shape_of(const std::vector<double>& p, const EdgeShape& fixed) {
  EdgeShape shape = fixed;
  shape.sigma_px = std::clamp(std::exp(p[0]), kMinSigma_px, kMaxSigma_px);
  if (p.size() > 1) {
    shape.sharpening = std::clamp(std::exp(p[1]) - 1, 0.0, kMaxSharpening);
    shape.sharpening_px = std::clamp(std::exp(p[2]), kMinSharpening_px, kMaxSharpening_px);
  }
  return shape;
}

struct Minimum {
  std::vector<double> parameters;
  double squares = 0;
  double residual_count = 1;
  double first_curvature = 0;  // sum of squares of the derivatives by the first parameter
};

// Levenberg and Marquardt (Marquardt 1963), with differences as derivatives.
Minimum least_squares(std::vector<double> p,
                      const std::function<std::vector<double>(const std::vector<double>&)>& residuals) {
  constexpr double kDifference = 0.01;
  constexpr int kMaxRounds = 14;
  const auto size = static_cast<int>(p.size());
  double damping = 1e-2;
  std::vector<double> r = residuals(p);
  Minimum best{p, square_sum(r), static_cast<double>(r.size())};
  for (int round = 0; round < kMaxRounds; ++round) {
    cv::Mat_<double> jtj(size, size, 0.0), jtr(size, 1, 0.0);
    std::vector<std::vector<double>> columns;
    for (int k = 0; k < size; ++k) {
      std::vector<double> moved = p;
      moved[k] += kDifference;
      columns.push_back(residuals(moved));
      for (std::size_t i = 0; i < r.size(); ++i) columns[k][i] = (columns[k][i] - r[i]) / kDifference;
    }
    for (int a = 0; a < size; ++a) {
      for (int b = 0; b < size; ++b)
        for (std::size_t i = 0; i < r.size(); ++i) jtj(a, b) += columns[a][i] * columns[b][i];
      for (std::size_t i = 0; i < r.size(); ++i) jtr(a, 0) -= columns[a][i] * r[i];
    }
    best.first_curvature = jtj(0, 0);
    bool is_better = false;
    double gain = 0;
    for (int attempt = 0; attempt < 5 && !is_better; ++attempt) {
      cv::Mat_<double> damped = jtj.clone();
      for (int a = 0; a < size; ++a) damped(a, a) += damping * jtj(a, a) + 1e-9;
      cv::Mat_<double> step;
      if (!cv::solve(damped, jtr, step, cv::DECOMP_CHOLESKY)) break;
      std::vector<double> moved = p;
      for (int a = 0; a < size; ++a) moved[a] += std::clamp(step(a, 0), -0.7, 0.7);
      const std::vector<double> next = residuals(moved);
      const double squares = square_sum(next);
      is_better = squares < best.squares;
      damping *= is_better ? 0.3 : 6;
      if (!is_better) continue;
      gain = best.squares - squares;
      best.squares = squares;
      p = moved;
      r = next;
      best.parameters = p;
    }
    if (!is_better || gain < 1e-5 * best.squares) break;
  }
  return best;
}

}  // namespace

EdgeCurve::EdgeCurve(const EdgeShape& shape, const EdgeLevels& levels, glm::dvec2 normal)
    : EdgeCurve(unsharpened(shape.sigma_px, levels, normal), shape) {}

EdgeCurve::EdgeCurve(std::vector<double> unsharpened, const EdgeShape& shape) : values_(std::move(unsharpened)) {
  if (shape.sharpening != 0) sharpen(values_, shape);
}

double EdgeCurve::operator()(double distance_px) const {
  const auto last = static_cast<double>(values_.size() - 1);
  const double at = std::clamp((distance_px + kReach_px) / kStep_px, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(at), values_.size() - 2);
  const double share = at - static_cast<double>(i);
  return values_[i] + share * (values_[i + 1] - values_[i]);
}

Fitted fitted_sigma(const EdgeSample& edge, const EdgeShape& shape) {
  const auto residuals = [&](const std::vector<double>& p) {
    Placed placed;
    return residuals_of(edge, EdgeCurve(shape_of(p, shape), edge.levels, edge.normal), placed);
  };
  const Minimum found = least_squares({std::log(std::max(shape.sigma_px, 0.3))}, residuals);
  const double sigma_px = shape_of(found.parameters, shape).sigma_px;
  constexpr double kFittedToo = 4;  // sigma, place, level, contrast
  const double variance = found.squares / std::max(1.0, found.residual_count - kFittedToo);
  const double sd_log = std::sqrt(variance / std::max(found.first_curvature, 1e-12));
  return {sigma_px, std::min(sigma_px * sd_log, kMaxSigma_px)};
}

ShapeFit fitted_shape(std::span<const EdgeSample> edges, const EdgeShape& start, bool with_sharpening) {
  EdgeShape fixed = start;
  if (!with_sharpening) fixed.sharpening = 0;
  std::vector<RecentCurves> recent(edges.size());
  const auto residuals = [&](const std::vector<double>& p) { return residuals_of(edges, shape_of(p, fixed), recent); };
  std::vector<double> first{std::log(std::clamp(start.sigma_px, 0.1, kMaxSigma_px))};
  if (with_sharpening) {
    first.push_back(std::log(1 + start.sharpening));
    first.push_back(std::log(start.sharpening_px));
  }
  const Minimum found = least_squares(first, residuals);
  return {shape_of(found.parameters, fixed), found.squares / std::max(1.0, found.residual_count)};
}

AlignedProfile aligned_profile(const EdgeSample& edge, const EdgeShape& shape) {
  Placed placed;
  static_cast<void>(residuals_of(edge, EdgeCurve(shape, edge.levels, edge.normal), placed));
  AlignedProfile profile;
  for (std::size_t i = 0; i < edge.bins.code.size(); ++i) {
    profile.distance_px.push_back(edge.bins.distance_px[i] - placed.shift_px);
    profile.value.push_back((edge.bins.code[i] - placed.level) / placed.contrast);
  }
  return profile;
}

}  // namespace sigs
