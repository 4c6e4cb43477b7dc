// SPDX-License-Identifier: MIT
#include "base/least_squares.h"

#include <algorithm>

#include "base/ensure.h"

namespace sigs {

NormalEquations::NormalEquations(int unknowns)
    : size_(unknowns), values_(static_cast<std::size_t>(unknowns) * stride(), 0.0) {}

NormalEquations::NormalEquations(const cv::Mat_<double>& matrix) : NormalEquations(matrix.rows) {
  for (int i = 0; i < size_; ++i)
    for (int j = i; j < size_; ++j) row(i)[j] = matrix(i, j);
}

void NormalEquations::add(std::span<const double> slopes, double residual, double weight) {
  ENSURE(static_cast<int>(slopes.size()) == size_ && eliminated_ == 0);
  for (int i = 0; i < size_; ++i) {
    const double factor = weight * slopes[static_cast<std::size_t>(i)];
    double* const to = row(i);
    for (int j = i; j < size_; ++j) to[j] += factor * slopes[static_cast<std::size_t>(j)];
    to[size_] += factor * residual;
  }
}

void NormalEquations::add(std::span<const int> places, std::span<const double> slopes, double residual, double weight) {
  ENSURE(slopes.size() == places.size() && eliminated_ == 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double factor = weight * slopes[i];
    double* const to = row(places[i]);
    for (std::size_t j = i; j < places.size(); ++j) to[places[j]] += factor * slopes[j];
    to[size_] += factor * residual;
  }
}

void NormalEquations::add_known(int unknown, double weight, double change) {
  row(unknown)[unknown] += weight;
  row(unknown)[size_] += weight * change;
}

void NormalEquations::add(const NormalEquations& other, std::span<const int> places) {
  const int first = other.eliminated_, count = other.size_ - first;
  ENSURE(eliminated_ == 0 && static_cast<int>(places.size()) == (places.empty() ? 0 : count));
  for (int i = 0; i < count; ++i) {
    const int place = places.empty() ? i : places[static_cast<std::size_t>(i)];
    if (place < 0) continue;
    const double* const from = other.row(first + i) + first;
    double* const to = row(place);
    if (places.empty())
      for (int j = i; j < count; ++j) to[j] += from[j];
    else
      for (int j = i; j < count; ++j) to[places[static_cast<std::size_t>(j)]] += from[j];
    to[size_] += from[count];
  }
}

void NormalEquations::damp(double share, double floor) {
  for (int i = eliminated_; i < size_; ++i) row(i)[i] += share * row(i)[i] + floor;
}

void NormalEquations::eliminate(int count) {
  constexpr double kNothing = 1e-15;  // of what the unknown had before others were eliminated
  std::vector<double> before(static_cast<std::size_t>(count));
  for (int k = eliminated_; k < count; ++k) before[static_cast<std::size_t>(k)] = row(k)[k];
  for (int k = eliminated_; k < count; ++k) {
    double* const from = row(k);
    if (from[k] <= kNothing * before[static_cast<std::size_t>(k)]) {  // false for what is no number
      std::fill(from + k, from + size_ + 1, 0.0);
      continue;
    }
    for (int i = k + 1; i < size_; ++i) {
      const double factor = from[i] / from[k];
      double* const to = row(i);
      for (int j = i; j <= size_; ++j) to[j] -= factor * from[j];
    }
  }
  eliminated_ = std::max(eliminated_, count);
}

std::vector<double> NormalEquations::eliminated(std::span<const double> others) const {
  ENSURE(static_cast<int>(others.size()) == size_ - eliminated_);
  std::vector<double> all(static_cast<std::size_t>(size_), 0.0);
  std::copy(others.begin(), others.end(), all.begin() + eliminated_);
  for (int k = eliminated_; k-- > 0;) {
    const double* const from = row(k);
    if (from[k] == 0) continue;
    double left = from[size_];
    for (int j = k + 1; j < size_; ++j) left -= from[j] * all[static_cast<std::size_t>(j)];
    all[static_cast<std::size_t>(k)] = left / from[k];
  }
  all.resize(static_cast<std::size_t>(eliminated_));
  return all;
}

std::vector<double> NormalEquations::solved() const {
  NormalEquations all(size_ - eliminated_);
  all.add(*this);
  all.eliminate(all.size_);
  return all.eliminated({});
}

cv::Mat_<double> NormalEquations::matrix() const {
  const int count = size_ - eliminated_;
  cv::Mat_<double> all(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = i; j < count; ++j) all(i, j) = all(j, i) = row(eliminated_ + i)[eliminated_ + j];
  return all;
}

cv::Mat_<double> NormalEquations::right() const {
  cv::Mat_<double> side(size_ - eliminated_, 1);
  for (int i = 0; i < side.rows; ++i) side(i) = row(eliminated_ + i)[size_];
  return side;
}

cv::Mat_<double> NormalEquations::inverse() const {
  NormalEquations factors(size_ - eliminated_);
  factors.add(*this);
  const int count = factors.size_;
  factors.eliminate(count);
  cv::Mat_<double> all(cv::Mat_<double>::eye(count, count));
  for (int k = 0; k < count; ++k) {
    const double* const from = factors.row(k);
    if (from[k] == 0) continue;
    for (int i = k + 1; i < count; ++i)
      for (int j = 0; j <= k; ++j) all(i, j) -= from[i] / from[k] * all(k, j);
  }
  for (int k = count; k-- > 0;) {
    const double* const from = factors.row(k);
    for (int i = k + 1; i < count; ++i)
      for (int j = 0; j < count; ++j) all(k, j) -= from[i] * all(i, j);
    for (int j = 0; j < count; ++j) all(k, j) = from[k] == 0 ? 0 : all(k, j) / from[k];
  }
  return all;
}

PrincipalAxes principal_axes(const glm::dmat3& m) {
  cv::Vec3d values;
  cv::Matx33d vectors;  // rows, by falling value
  cv::eigen(cv::Matx33d(m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2]), values,
            vectors);
  PrincipalAxes found;
  for (int i = 0; i < 3; ++i) {
    found.values[i] = values[2 - i];
    found.axes[static_cast<std::size_t>(i)] = {vectors(2 - i, 0), vectors(2 - i, 1), vectors(2 - i, 2)};
  }
  return found;
}

}  // namespace sigs
