// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace sigs {

// Weighted least squares by normal equations, for fits of few unknowns to many residuals. A fit that is not linear adds
// its residuals at the values that it has, changes them by solved(), and goes on until nothing changes (Gauss and
// Newton), with damp() where steps must be shorter (Levenberg and Marquardt).
//
// Unknowns that each appear in a part of the residuals alone, as the pose of a board in one image, come first in the
// equations of that part, from which they are eliminated; what is left is added to the equations of the others (Triggs
// et al., Bundle Adjustment - A Modern Synthesis, 1999, section 6):
//   NormalEquations part(own + common);  part.add(...);  part.eliminate(own);  all.add(part, places of the common
//   ones); const std::vector<double> changes = all.solved();    part.eliminated(changes) are those of the part's own
class NormalEquations {
 public:
  explicit NormalEquations(int unknowns = 0);
  explicit NormalEquations(const cv::Mat_<double>& matrix);  // symmetric; with a right side of 0

  [[nodiscard]] int size() const { return size_; }

  // A residual, measured less predicted, with the slopes of the prediction by the unknowns.
  //   slopes  of all unknowns, or of those in `places` (rising)
  void add(std::span<const double> slopes, double residual, double weight = 1);
  void add(std::span<const int> places, std::span<const double> slopes, double residual, double weight = 1);

  // What is known of one unknown beforehand: that it changes by `change`, with the weight 1 / variance.
  void add_known(int unknown, double weight, double change = 0);

  // The sums of other equations, of which the first unknowns may be eliminated. `places`: where each of those left is
  // here, rising; the first ones may be negative, as they do not change. Empty: both have the same unknowns.
  void add(const NormalEquations& other, std::span<const int> places = {});

  // Multiplies the diagonal by 1 + share and adds the floor to it.
  void damp(double share, double floor);

  // Eliminates the first unknowns. Nothing can be added any more.
  void eliminate(int count);

  // The changes of the eliminated unknowns by those of the others.
  [[nodiscard]] std::vector<double> eliminated(std::span<const double> others) const;

  // The changes of all with which the weighted sum of squares is least. Of which nothing is known, does not change.
  [[nodiscard]] std::vector<double> solved() const;

  // Of the unknowns that are not eliminated: the matrix of the equations, and their right side as a column.
  [[nodiscard]] cv::Mat_<double> matrix() const;
  [[nodiscard]] cv::Mat_<double> right() const;

  // The inverse of that matrix: the covariance, where weights are 1 / variance. 0 of what nothing is known.
  [[nodiscard]] cv::Mat_<double> inverse() const;

 private:
  [[nodiscard]] double* row(int i) { return values_.data() + static_cast<std::size_t>(i) * stride(); }
  [[nodiscard]] const double* row(int i) const { return values_.data() + static_cast<std::size_t>(i) * stride(); }
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(size_) + 1; }

  int size_ = 0;
  int eliminated_ = 0;
  std::vector<double>
      values_;  // rows of the upper triangle, each followed by its right side; once a row is eliminated,
                // that of Cholesky's U = D L^T (Golub, Van Loan: Matrix Computations, section 4.1.2)
};

// Numbers without order, the same each time, for fits that try a few of the data at a time (Numerical Recipes' quick
// generator).
class Sequence {
 public:
  // 0 to count - 1; count > 0.
  std::size_t below(std::size_t count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>(state_ >> 33) % count;
  }

 private:
  std::uint64_t state_ = 1;
};

// Three rows and columns of a symmetric matrix, from number `first` on.
[[nodiscard]] inline glm::dmat3 block_of(const cv::Mat_<double>& symmetric, int first) {
  glm::dmat3 block;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block[i][j] = symmetric(first + i, first + j);
  return block;
}

// Weight by Geman and McClure of a residual: 1 at 0, a quarter at the scale, falling with the fourth power beyond.
[[nodiscard]] inline double geman_mcclure(double squared, double scale_squared) {
  const double root = 1 / (1 + squared / scale_squared);
  return root * root;
}

// The standard deviation in one direction of normal errors in two, whose median length is 1.
constexpr double kSigmaOfMedianLength = 0.8493218;  // 1 / sqrt(2 ln 2)

// The square of a vector's length; whether all of its numbers are finite.
template <glm::length_t N>
[[nodiscard]] double squared_length(const glm::vec<N, double>& v) {
  return glm::dot(v, v);
}
template <glm::length_t N>
[[nodiscard]] bool is_finite(const glm::vec<N, double>& v) {
  return std::isfinite(squared_length(v));
}

// Eigenvalues of a symmetric matrix, rising, with their unit vectors: the first is the normal of the plane through
// points whose outer products were summed up.
struct PrincipalAxes {
  glm::dvec3 values;
  std::array<glm::dvec3, 3> axes;
};
[[nodiscard]] PrincipalAxes principal_axes(const glm::dmat3& symmetric);

}  // namespace sigs
