// SPDX-License-Identifier: MIT
#include "editor/views/world/curve_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <queue>

namespace sigs::editor {

namespace {

constexpr std::size_t kFirstPieces = 24;  // an S with its middle on its chord is not taken for straight

struct Piece {
  double first = 0;
  double last = 0;
  glm::dvec3 middle_m{0, 0, 0};
  double off_chord_m = 0;

  [[nodiscard]] double middle() const { return (first + last) / 2; }
  [[nodiscard]] bool operator<(const Piece& other) const { return off_chord_m < other.off_chord_m; }
};

std::vector<double> first_parameters(double first, double last, std::span<const double> through, std::size_t maximum) {
  std::vector<double> at;
  const std::size_t pieces = std::clamp<std::size_t>(kFirstPieces, 1, std::max<std::size_t>(1, maximum / 4));
  for (std::size_t i = 0; i <= pieces; ++i)
    at.push_back(std::lerp(first, last, static_cast<double>(i) / static_cast<double>(pieces)));
  for (const double parameter : through.first(std::min(through.size(), maximum / 2)))
    if (parameter > first && parameter < last) at.push_back(parameter);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

Piece piece_between(const std::function<glm::dvec3(double)>& curve, double first, const glm::dvec3& first_m,
                    double last, const glm::dvec3& last_m) {
  Piece piece{.first = first, .last = last};
  piece.middle_m = curve(piece.middle());
  piece.off_chord_m = glm::distance(piece.middle_m, (first_m + last_m) / 2.0);
  return piece;
}

}  // namespace

CurveSamples sampled_curve(const std::function<glm::dvec3(double)>& curve, double first, double last,
                           std::span<const double> through, double tolerance_m, std::size_t maximum) {
  if (!(last > first)) return {{first}, {curve(first)}};
  std::map<double, glm::dvec3> points;
  for (const double at : first_parameters(first, last, through, maximum)) points.emplace(at, curve(at));
  std::priority_queue<Piece> pieces;
  for (auto end = std::next(points.begin()); end != points.end(); ++end) {
    const auto begin = std::prev(end);
    pieces.push(piece_between(curve, begin->first, begin->second, end->first, end->second));
  }
  while (points.size() < maximum && !pieces.empty() && pieces.top().off_chord_m > tolerance_m) {
    const Piece piece = pieces.top();
    pieces.pop();
    const double middle = piece.middle();
    if (!(middle > piece.first && middle < piece.last)) continue;  // neighbours among the doubles
    points.emplace(middle, piece.middle_m);
    pieces.push(piece_between(curve, piece.first, points.at(piece.first), middle, piece.middle_m));
    pieces.push(piece_between(curve, middle, piece.middle_m, piece.last, points.at(piece.last)));
  }
  CurveSamples samples;
  for (const auto& [at, point_m] : points) {
    samples.at.push_back(at);
    samples.points_m.push_back(point_m);
  }
  return samples;
}

glm::dvec3 CurveSamples::point_at(double parameter) const {
  const auto after = std::upper_bound(at.begin(), at.end(), parameter);
  if (after == at.begin()) return points_m.front();
  if (after == at.end()) return points_m.back();
  const auto next = static_cast<std::size_t>(after - at.begin());
  const double share = (parameter - at[next - 1]) / (at[next] - at[next - 1]);
  return glm::mix(points_m[next - 1], points_m[next], share);
}

std::vector<glm::dvec3> stretch(const CurveSamples& samples, double from, double to) {
  if (samples.at.empty()) return {};
  from = std::max(from, samples.at.front());
  to = std::min(to, samples.at.back());
  if (!(from < to)) return {};
  std::vector<glm::dvec3> points_m{samples.point_at(from)};
  for (std::size_t i = 0; i < samples.at.size(); ++i)
    if (samples.at[i] > from && samples.at[i] < to) points_m.push_back(samples.points_m[i]);
  points_m.push_back(samples.point_at(to));
  return points_m;
}

}  // namespace sigs::editor
