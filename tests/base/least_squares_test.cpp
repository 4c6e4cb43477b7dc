// SPDX-License-Identifier: MIT
#include "base/least_squares.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace sigs::test {

namespace {

constexpr int kUnknowns = 7;

struct Rows {
  cv::Mat_<double> slopes, residuals, weights;
};

Rows random_rows(unsigned seed, int count) {
  std::mt19937 chance(seed);
  std::normal_distribution<double> normal(0, 1);
  Rows rows{cv::Mat_<double>(count, kUnknowns), cv::Mat_<double>(count, 1), cv::Mat_<double>(count, 1)};
  for (double& slope : rows.slopes) slope = normal(chance);
  for (double& residual : rows.residuals) residual = normal(chance);
  for (double& weight : rows.weights) weight = 0.5 + std::abs(normal(chance));
  return rows;
}

NormalEquations equations_of(const Rows& rows) {
  NormalEquations equations(kUnknowns);
  for (int i = 0; i < rows.slopes.rows; ++i)
    equations.add({rows.slopes[i], static_cast<std::size_t>(kUnknowns)}, rows.residuals(i), rows.weights(i));
  return equations;
}

// By OpenCV's singular values of the weighted rows.
cv::Mat_<double> solution_by_rows(const Rows& rows) {
  cv::Mat_<double> slopes = rows.slopes.clone(), residuals = rows.residuals.clone(), solution;
  for (int i = 0; i < slopes.rows; ++i) {
    slopes.row(i) *= std::sqrt(rows.weights(i));
    residuals(i) *= std::sqrt(rows.weights(i));
  }
  cv::solve(slopes, residuals, solution, cv::DECOMP_SVD);
  return solution;
}

}  // namespace

TEST_CASE("the solution of normal equations is that of the rows by singular values") {
  const Rows rows = random_rows(1, 40);
  const std::vector<double> solved = equations_of(rows).solved();
  CHECK(cv::norm(cv::Mat(solved), solution_by_rows(rows)) < 1e-12);  // rounding, condition of some ten
}

TEST_CASE("unknowns that are eliminated first come out the same") {
  const Rows rows = random_rows(2, 40);
  const std::vector<double> solved = equations_of(rows).solved();
  for (const int own : {1, 3, kUnknowns}) {
    NormalEquations part = equations_of(rows);
    part.eliminate(own);
    NormalEquations common(kUnknowns - own);
    common.add(part);
    const std::vector<double> others = common.solved();
    std::vector<double> all = part.eliminated(others);
    all.insert(all.end(), others.begin(), others.end());
    CHECK(cv::norm(cv::Mat(all), cv::Mat(solved)) < 1e-12);
  }
}

TEST_CASE("the inverse is the covariance, also of what is left after elimination") {
  NormalEquations equations = equations_of(random_rows(3, 30));
  const cv::Mat_<double> matrix = equations.matrix(), inverse = equations.inverse();
  CHECK(cv::norm(matrix * inverse, cv::Mat_<double>::eye(kUnknowns, kUnknowns)) < 1e-12);
  CHECK(cv::norm(NormalEquations(matrix).inverse(), inverse) < 1e-15);
  equations.eliminate(3);
  const cv::Rect left(3, 3, kUnknowns - 3, kUnknowns - 3);
  CHECK(cv::norm(equations.inverse(), inverse(left)) < 1e-12);
}

TEST_CASE("equations are added by places, and unknowns without a place do not change") {
  const Rows rows = random_rows(4, 30);
  NormalEquations all(kUnknowns + 2);
  std::array<int, kUnknowns> places{};
  std::iota(places.begin(), places.end(), 2);
  all.add(equations_of(rows), places);
  NormalEquations by_rows(kUnknowns + 2);
  for (int i = 0; i < rows.slopes.rows; ++i)
    by_rows.add(places, {rows.slopes[i], static_cast<std::size_t>(kUnknowns)}, rows.residuals(i), rows.weights(i));
  CHECK(cv::norm(all.matrix(), by_rows.matrix()) < 1e-12);
  CHECK(cv::norm(all.right(), by_rows.right()) < 1e-12);
  const std::vector<double> solved = all.solved();
  CHECK(solved[0] == 0);  // of which nothing is known
  CHECK(solved[1] == 0);
  std::array<int, kUnknowns> held = places;
  held[0] = -1;
  NormalEquations without(kUnknowns + 2);
  without.add(equations_of(rows), held);
  CHECK(cv::norm(without.matrix().row(2)) == 0);
}

TEST_CASE("what is known beforehand holds an unknown, damping shortens the step, and what is no number stays none") {
  NormalEquations equations = equations_of(random_rows(5, 30));
  const std::vector<double> free = equations.solved();
  NormalEquations damped = equations;
  damped.damp(10, 0);
  CHECK(cv::norm(cv::Mat(damped.solved())) < cv::norm(cv::Mat(free)) / 5);
  equations.add_known(2, 1e9, 0.25);
  CHECK(equations.solved()[2] == doctest::Approx(0.25).epsilon(1e-6));
  equations.add_known(1, std::nan(""), 0);
  CHECK_FALSE(std::isfinite(equations.solved()[1]));
}

TEST_CASE("the axes of a sum of outer products are those of the points") {
  const std::array<glm::dvec3, 3> truth{glm::normalize(glm::dvec3(1, 2, 2)), glm::normalize(glm::dvec3(2, 1, -2)),
                                        glm::normalize(glm::dvec3(2, -2, 1))};
  glm::dmat3 sum(0);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& axis = truth[static_cast<std::size_t>(i)];
    sum += (1.0 + 3 * i) * glm::outerProduct(axis, axis);
  }
  const PrincipalAxes found = principal_axes(sum);
  for (int i = 0; i < 3; ++i) {
    CHECK(found.values[i] == doctest::Approx(1 + 3 * i).epsilon(1e-9));
    CHECK(std::abs(glm::dot(found.axes[static_cast<std::size_t>(i)], truth[static_cast<std::size_t>(i)])) > 1 - 1e-9);
  }
}

}  // namespace sigs::test
