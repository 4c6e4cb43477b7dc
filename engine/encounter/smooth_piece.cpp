// SPDX-License-Identifier: MIT
#include "encounter/smooth_piece.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sigs {

namespace {

constexpr std::size_t kN = kPieceNodes;
constexpr double kShortest_s = 1e-3;
constexpr double kLongest_s = 20;  // of a piece, where there are not more than kMaxPieces of that length
constexpr double kMaxPieces = 1e5;
constexpr double kCubic_m = 1e-8;
constexpr double kRounding = 1e-13;
constexpr double kUnitRounding = 1.2e-16;  // of a number, relative

using Coefficients = std::array<double, kN>;

// Places in (0, 1), those of Chebyshev's polynomial.
const std::array<double, kN>& node_places() {
  static const std::array<double, kN> kPlaces = [] {
    std::array<double, kN> places{};
    for (std::size_t i = 0; i < kN; ++i)
      places[i] = (1 - std::cos(3.14159265358979323846 * (2.0 * static_cast<double>(i) + 1) / (2.0 * kN))) / 2;
    return places;
  }();
  return kPlaces;
}

// --- Pieces.

double component(const RelativeState& state, int index) {
  if (index == 2) return state.vertical_m;
  if (index == 5) return state.vertical_mps;
  return index < 3 ? state.horizontal_m[index] : state.horizontal_mps[index - 3];
}

// The value at `place` of the polynomial through four of the values, those of the nodes 0, 3, 7 and 10.
constexpr std::array<std::size_t, 4> kFitted{0, 3, 7, 10};
double fitted(const std::array<double, 4>& values, double place) {
  double sum = 0;
  for (std::size_t i = 0; i < kFitted.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < kFitted.size(); ++j)
      if (j != i)
        weight *= (place - node_places()[kFitted[j]]) / (node_places()[kFitted[i]] - node_places()[kFitted[j]]);
    sum += weight * values[i];
  }
  return sum;
}

// The least and the greatest of a component.
std::pair<double, double> extent(const SmoothPiece& piece, int index) {
  std::pair all{component(piece.nodes[0], index), component(piece.nodes[0], index)};
  for (const RelativeState& node : piece.nodes) {
    all.first = std::min(all.first, component(node, index));
    all.second = std::max(all.second, component(node, index));
  }
  return all;
}

// How far a component may be from its cubic: kCubic_m, and what rounding does, of the numbers and of the nodes' times
// (seconds since 1970 have steps of 2.4e-7).
double allowed_deviation(const SmoothPiece& piece, int index, double rounding_m) {
  const double length_s = piece.end_s - piece.begin_s;
  const double time_rounding_s = 4 * kUnitRounding * std::max(std::abs(piece.begin_s), std::abs(piece.end_s));
  const auto [low, high] = extent(piece, index);
  const double rate = (high - low) / length_s;  // about; of a position its velocity
  const double rounding = 1e-13 * std::max(std::abs(low), std::abs(high)) + rate * time_rounding_s;
  // A velocity that is wrong by this much moves the position by kCubic_m.
  return rounding + (index < 3 ? kCubic_m + rounding_m : kCubic_m / std::min(1.0, length_s));
}

bool is_cubic(const SmoothPiece& piece, double rounding_m) {
  for (int c = 0; c < 6; ++c) {
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < 4; ++i) values[i] = component(piece.nodes[kFitted[i]], c);
    const double allowed = allowed_deviation(piece, c, rounding_m);
    for (std::size_t i = 0; i < kN; ++i)
      if (std::abs(fitted(values, node_places()[i]) - component(piece.nodes[i], c)) > allowed) return false;
  }
  return true;
}

SmoothPiece piece_between(const RelativeMotionAt& motion, double begin_s, double end_s) {
  SmoothPiece piece{.begin_s = begin_s, .end_s = end_s};
  for (std::size_t i = 0; i < kN; ++i) piece.nodes[i] = motion(begin_s + node_places()[i] * (end_s - begin_s));
  return piece;
}

void visit_halves(const RelativeMotionAt& motion, double begin_s, double end_s, double rounding_m,
                  const std::function<void(const SmoothPiece&)>& visit) {
  const SmoothPiece piece = piece_between(motion, begin_s, end_s);
  const double shortest_s = std::max(kShortest_s, 256 * kUnitRounding * std::max(std::abs(begin_s), std::abs(end_s)));
  if (end_s - begin_s <= shortest_s || is_cubic(piece, rounding_m)) return visit(piece);
  const double middle_s = begin_s + (end_s - begin_s) / 2;
  visit_halves(motion, begin_s, middle_s, rounding_m, visit);
  visit_halves(motion, middle_s, end_s, rounding_m, visit);
}

// --- Sign changes.

// Bernstein's coefficients of the polynomial with values at the nodes: the inverse of the matrix of Bernstein's
// polynomials there, by Gauss and Jordan, once.
using Matrix = std::array<std::array<double, kN>, kN>;

Matrix bernstein_at_nodes() {
  Matrix matrix{};
  for (std::size_t i = 0; i < kN; ++i) {
    double binomial = 1;
    const double x = node_places()[i];
    for (std::size_t k = 0; k < kN; ++k) {
      matrix[i][k] = binomial * std::pow(x, static_cast<double>(k)) * std::pow(1 - x, static_cast<double>(kN - 1 - k));
      binomial *= static_cast<double>(kN - 1 - k) / static_cast<double>(k + 1);
    }
  }
  return matrix;
}

Matrix inverse_of(Matrix a) {
  Matrix inverse{};
  for (std::size_t i = 0; i < kN; ++i) inverse[i][i] = 1;
  for (std::size_t column = 0; column < kN; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column; row < kN; ++row)
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    std::swap(a[pivot], a[column]);
    std::swap(inverse[pivot], inverse[column]);
    const double factor = 1 / a[column][column];
    for (std::size_t k = 0; k < kN; ++k) {
      a[column][k] *= factor;
      inverse[column][k] *= factor;
    }
    for (std::size_t row = 0; row < kN; ++row) {
      if (row == column) continue;
      const double times = a[row][column];
      for (std::size_t k = 0; k < kN; ++k) {
        a[row][k] -= times * a[column][k];
        inverse[row][k] -= times * inverse[column][k];
      }
    }
  }
  return inverse;
}

Coefficients coefficients_of(const std::array<double, kN>& values) {
  static const Matrix kInverse = inverse_of(bernstein_at_nodes());
  Coefficients coefficients{};
  for (std::size_t i = 0; i < kN; ++i)
    for (std::size_t k = 0; k < kN; ++k) coefficients[i] += kInverse[i][k] * values[k];
  return coefficients;
}

struct Halves {
  Coefficients left;
  Coefficients right;
};

// de Casteljau.
Halves halves_of(Coefficients c) {
  Halves halves;
  for (std::size_t level = 0; level < kN; ++level) {
    halves.left[level] = c[0];
    halves.right[kN - 1 - level] = c[kN - 1 - level];
    for (std::size_t k = 0; k + 1 < kN - level; ++k) c[k] = (c[k] + c[k + 1]) / 2;
  }
  return halves;
}

// What isolates sign changes: one function in one piece.
class Isolation {
 public:
  Isolation(const RelativeMotionAt& motion, const MotionFunction& function, double rounding, std::vector<double>& times)
      : motion_(motion), function_(function), rounding_(rounding), times_s_(times) {}

  void search(double begin_s, double end_s, const Coefficients& c) {
    int changes = 0;
    double last = 0;  // the last coefficient that is more than rounding
    for (const double number : c) {
      if (std::abs(number) <= rounding_) continue;
      if (last != 0 && (last < 0) != (number < 0)) ++changes;
      last = number;
    }
    if (changes == 0) return;
    const bool ends_differ =
        std::abs(c.front()) > rounding_ && std::abs(c.back()) > rounding_ && (c.front() < 0) != (c.back() < 0);
    if (changes == 1 && ends_differ) return times_s_.push_back(refined(begin_s, end_s, c.front() < 0));
    const double middle_s = begin_s + (end_s - begin_s) / 2;
    if (end_s - begin_s < 1e-9 || middle_s <= begin_s || middle_s >= end_s) return times_s_.push_back(middle_s);
    const Halves halves = halves_of(c);
    // A change at the very middle belongs to neither half.
    if (std::abs(halves.left.back()) <= rounding_) times_s_.push_back(middle_s);
    search(begin_s, middle_s, halves.left);
    search(middle_s, end_s, halves.right);
  }

 private:
  // By halving, with the function itself.
  [[nodiscard]] double refined(double begin_s, double end_s, bool begins_negative) const {
    for (int step = 0; step < 200; ++step) {
      const double middle_s = begin_s + (end_s - begin_s) / 2;
      if (middle_s <= begin_s || middle_s >= end_s || end_s - begin_s < 1e-11) break;
      const bool is_negative = function_(motion_(middle_s)).value < 0;
      (is_negative == begins_negative ? begin_s : end_s) = middle_s;
    }
    return begin_s + (end_s - begin_s) / 2;
  }

  const RelativeMotionAt& motion_;
  const MotionFunction& function_;
  double rounding_;
  std::vector<double>& times_s_;
};

}  // namespace

void for_each_smooth_piece(const RelativeMotionAt& motion, double begin_s, double end_s,
                           const std::vector<double>& knots_s, double rounding_m,
                           const std::function<void(const SmoothPiece&)>& visit) {
  const double longest_s = std::max(kLongest_s, (end_s - begin_s) / kMaxPieces);
  const auto cut_evenly = [&](double from_s, double to_s) {
    const auto parts = static_cast<int>(std::ceil((to_s - from_s) / longest_s));
    for (int i = 0; i < parts; ++i)
      visit_halves(motion, from_s + i * ((to_s - from_s) / parts),
                   i + 1 == parts ? to_s : from_s + (i + 1) * ((to_s - from_s) / parts), rounding_m, visit);
  };
  double from_s = begin_s;
  for (const double knot_s : knots_s) {
    if (!(knot_s > from_s) || knot_s >= end_s) continue;
    cut_evenly(from_s, knot_s);
    from_s = knot_s;
  }
  if (end_s > from_s) cut_evenly(from_s, end_s);
}

void append_sign_changes(const SmoothPiece& piece, const RelativeMotionAt& motion, const MotionFunction& function,
                         std::vector<double>& times_s) {
  std::array<double, kN> values{};
  double size = 0;
  for (std::size_t i = 0; i < kN; ++i) {
    const TermSum sum = function(piece.nodes[i]);
    values[i] = sum.value;
    size = std::max(size, sum.size);
  }
  Isolation(motion, function, kRounding * size, times_s).search(piece.begin_s, piece.end_s, coefficients_of(values));
}

}  // namespace sigs
