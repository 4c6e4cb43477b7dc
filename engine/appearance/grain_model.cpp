// SPDX-License-Identifier: MIT
#include "appearance/grain_model.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace sigs {

namespace {

using Vector = std::vector<double>;

// Correlation of neighbours `apart` samples from each other: the Gaussian's with itself.
Vector correlations(double spread_px, int n) {
  constexpr int kReach = 40;
  Vector kernel(2 * kReach + 1);
  for (int k = -kReach; k <= kReach; ++k)
    kernel[k + kReach] = spread_px > 0 ? std::exp(-0.5 * k * k / (spread_px * spread_px)) : (k == 0 ? 1.0 : 0.0);
  Vector found(n);
  for (int apart = 0; apart < n; ++apart)
    for (std::size_t k = 0; k + apart < kernel.size(); ++k) found[apart] += kernel[k] * kernel[k + apart];
  for (int apart = n - 1; apart >= 0; --apart) found[apart] /= found[0];
  return found;
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The covariance of a row of noise, times a row.
Vector blurred(const Vector& row, const Vector& correlation) {
  const auto n = static_cast<int>(row.size());
  Vector result(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) result[i] += correlation[std::abs(i - j)] * row[j];
  return result;
}

// Each sample replaced by the mean of its two neighbours: x' shifted(y) is half the sum of x(i) y(i + 1) + x(i + 1)
// y(i).
Vector shifted(const Vector& row) {
  const std::size_t n = row.size();
  Vector result(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) result[i] += 0.5 * row[i - 1];
    if (i + 1 < n) result[i] += 0.5 * row[i + 1];
  }
  return result;
}

}  // namespace

// With C the covariance of the block's noise, P the projection on the plane (P = sum of p p' over three orthonormal p),
// Q = 1 - P and S the shift along rows, the expected sums are tr(Q C) and tr(S Q C Q). All but Q are products of a
// matrix along rows and one along columns, so only rows of n numbers are multiplied.
BlockRest block_rest(double spread_px, int n) {
  const Vector correlation = correlations(spread_px, n);
  const Vector level(n, 1 / std::sqrt(static_cast<double>(n)));
  Vector slope(n);
  for (int i = 0; i < n; ++i) slope[i] = i - 0.5 * (n - 1);
  const double length = std::sqrt(dot(slope, slope));
  for (double& value : slope) value /= length;
  struct Product {
    Vector along, down;  // factors along rows and columns
  };
  const std::array<Product, 3> plane{Product{level, level}, Product{slope, level}, Product{level, slope}};
  double in_plane = 0;
  double shifted_in_plane = 0;
  for (const Product& p : plane) {
    const Vector along = blurred(p.along, correlation), down = blurred(p.down, correlation);
    in_plane += dot(p.along, along) * dot(p.down, down);
    shifted_in_plane -= 2 * dot(shifted(p.along), along) * dot(p.down, down);
    for (const Product& q : plane) {
      const double covariance = dot(q.along, along) * dot(q.down, down);
      shifted_in_plane += covariance * dot(q.along, shifted(p.along)) * dot(q.down, p.down);
    }
  }
  const double count = n * n, pairs = n * (n - 1);
  return {(count - in_plane) / (count - 3), (pairs * correlation[1] + shifted_in_plane) / pairs};
}

double spread_of_ratio(double ratio, int n) {
  double low = 0, high = 4;
  for (int round = 0; round < 30; ++round) {
    const double middle = (low + high) / 2;
    const BlockRest rest = block_rest(middle, n);
    (rest.correlation / rest.variance < ratio ? low : high) = middle;
  }
  return low;
}

}  // namespace sigs
