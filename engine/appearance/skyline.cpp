// SPDX-License-Identifier: MIT
#include "appearance/skyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/pose.h"

namespace sigs {

namespace {

constexpr int kBand = 3;               // cells above and below the edge, where the two are compared
constexpr double kLeastStep = 0.025;   // of luma, 6 codes of 8 bits
constexpr double kMostStep = 0.3;      // more does not count for more
constexpr double kLeastColumns = 0.6;  // share of the columns that the edge has to be in
constexpr double kRougher = 0.7;       // texture above, at most this share of that below
constexpr double kSmooth = 0.008;      // smooth, whatever is below
constexpr double kMaxRoll_rad = 0.79, kRollStep_rad = 0.06, kPitchStep_rad = 0.012, kMaxPitch_rad = 1.2;
constexpr double kRefined_rad = 0.0014;   // of a clean edge, a third of a cell
constexpr double kHills_rad = 0.004;      // by which the land's edge misses the level
constexpr double kAttitude_rad = 0.0005;  // of an attitude that is given

// The columns that are looked at, with sums of luma downwards.
struct Columns {
  std::vector<int> at;
  std::vector<std::vector<double>> sums;  // sums[i][y]: of the rows above y
  int rows = 0;

  // Luma above row y less that below it.
  [[nodiscard]] double step(std::size_t i, int y) const {
    const std::vector<double>& s = sums[i];
    return (s[y] - s[y - kBand] - (s[y + kBand] - s[y])) / kBand;
  }
};

Columns columns_of(const LightGrid& grid) {
  Columns columns;
  columns.rows = grid.size().height;
  const int spacing = std::max(1, grid.size().width / 40);
  for (int x = spacing / 2; x < grid.size().width; x += spacing) {
    std::vector<double> sums{0};
    for (int y = 0; y < columns.rows; ++y) sums.push_back(sums.back() + static_cast<double>(grid.luma(y, x)));
    columns.at.push_back(x);
    columns.sums.push_back(std::move(sums));
  }
  return columns;
}

// The first row of a column that lies below the plane; rows that the lens does not see count as above.
int crossing(const GridRays& rays, int column, int rows, const glm::dvec3& up) {
  int above = 0;
  int below = rows;
  while (above < below) {
    const int middle = (above + below) / 2;
    const glm::dvec3& ray = rays.at(column, middle);
    if (glm::dot(ray, ray) > 0 && glm::dot(ray, up) <= 0)
      below = middle;
    else
      above = middle + 1;
  }
  return below;
}

bool has_room(int row, int rows) {
  return row >= kBand && row + kBand <= rows;
}

glm::dvec3 up_of(double roll_rad, double pitch_rad) {
  return glm::conjugate(rotation_of({.roll_rad = roll_rad, .pitch_rad = pitch_rad})) * glm::dvec3(0, 0, -1);
}

// How much brighter it is above each row than below it, by column and row; 0 where there is no room for it.
std::vector<std::vector<double>> steps_of(const Columns& columns) {
  std::vector<std::vector<double>> steps(columns.at.size(),
                                         std::vector<double>(static_cast<std::size_t>(columns.rows) + 1));
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (int y = kBand; has_room(y, columns.rows); ++y)
      steps[i][static_cast<std::size_t>(y)] = std::clamp(columns.step(i, y), -kMostStep, kMostStep);
  return steps;
}

// The plane across which it is brighter above than below by most, on average over all columns.
glm::dvec3 best_plane(const Columns& columns, const SkylineFinder::Planes& planes) {
  const std::vector<std::vector<double>> steps = steps_of(columns);
  double best = -1;
  glm::dvec3 found = up_of(0, 0);
  const unsigned short* row = planes.crossings.data();
  for (const glm::dvec3& up : planes.ups) {
    double sum = 0;
    for (const std::vector<double>& step : steps) sum += step[*row++];
    const double contrast = sum / static_cast<double>(steps.size());
    if (contrast <= best) continue;
    best = contrast;
    found = up;
  }
  return found;
}

// A place on the edge in one column: the steepest fall of luma within a few rows of the plane, to parts of a row.
struct EdgePoint {
  glm::dvec3 ray;
  double step = 0;
  int column = 0, row = 0;
};

std::vector<EdgePoint> edge_points(const LightGrid& grid, const Columns& columns, const GridRays& rays,
                                   const glm::dvec3& up) {
  std::vector<EdgePoint> points;
  const auto fall = [&](int x, int y) { return static_cast<double>(grid.luma(y - 1, x) - grid.luma(y, x)); };
  for (std::size_t i = 0; i < columns.at.size(); ++i) {
    const int x = columns.at[i];
    const int middle = crossing(rays, x, columns.rows, up);
    if (!has_room(middle - 1, columns.rows) || !has_room(middle + 1, columns.rows)) continue;
    int y = middle;
    for (int other = middle - 2; other <= middle + 2; ++other)
      if (fall(x, other) > fall(x, y)) y = other;
    if (grid.hidden(y, x) != 0 || y < 2 || y + 1 >= columns.rows) continue;
    const double before = fall(x, y - 1), here = fall(x, y), after = fall(x, y + 1);
    const double bend = before - 2 * here + after;
    const double part = bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
    const glm::dvec3 ray = glm::mix(rays.at(x, y - 1), rays.at(x, y), 0.5 + part);
    points.push_back({glm::normalize(ray), columns.step(i, middle), x, y});
  }
  return points;
}

// The plane through points, by least squares on small turns of `up` about two axes. Points more than 2.5 times the
// median's distance away are left out.
glm::dvec3 fitted_plane(const std::vector<EdgePoint>& points, glm::dvec3 up) {
  for (int round = 0; round < 4; ++round) {
    std::vector<double> off;
    for (const EdgePoint& p : points) off.push_back(std::abs(glm::dot(p.ray, up)));
    std::vector<double> sorted = off;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double most = std::max(2.5 * sorted[sorted.size() / 2], 1e-4);
    const glm::dvec3 u = glm::normalize(glm::cross(up, glm::dvec3(0.01, 1, 0.02)));
    const glm::dvec3 v = glm::cross(up, u);
    double uu = 1e-12, uv = 0, vv = 1e-12, ue = 0, ve = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (off[i] > most) continue;
      const double a = glm::dot(points[i].ray, u), b = glm::dot(points[i].ray, v), e = glm::dot(points[i].ray, up);
      uu += a * a, uv += a * b, vv += b * b, ue += a * e, ve += b * e;
    }
    const double det = uu * vv - uv * uv;
    if (det <= 1e-15) return up;
    up = glm::normalize(up - u * ((vv * ue - uv * ve) / det) - v * ((uu * ve - uv * ue) / det));
  }
  return up;
}

// Mean difference between neighbouring cells at the same distance from the edge, on its side `way`.
double texture_beside(const LightGrid& grid, const std::vector<EdgePoint>& points, int way) {
  double sum = 0;
  int count = 0;
  for (const EdgePoint& p : points)
    for (int d = 2; d <= 6; ++d) {
      const int y = p.row + way * d;
      if (y < 0 || y >= grid.size().height || p.column + 1 >= grid.size().width) continue;
      sum += static_cast<double>(std::abs(grid.luma(y, p.column + 1) - grid.luma(y, p.column)));
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

bool is_skyline(const LightGrid& grid, const Columns& columns, const std::vector<EdgePoint>& points) {
  const auto strong =
      std::count_if(points.begin(), points.end(), [](const EdgePoint& p) { return p.step > kLeastStep; });
  if (static_cast<double>(strong) < kLeastColumns * static_cast<double>(columns.at.size())) return false;
  const double above = texture_beside(grid, points, -1), below = texture_beside(grid, points, 1);
  // Of an even slope of brightness, as a sky without ground has, every line is an edge; a real one stands out.
  double steepest = 0, whole = 0;
  for (std::size_t i = 0; i < columns.at.size(); ++i) {
    const std::vector<double>& s = columns.sums[i];
    const int quarter = std::max(1, columns.rows / 4);
    whole += std::abs(s[quarter] - (s[columns.rows] - s[columns.rows - quarter])) / quarter;
  }
  for (const EdgePoint& p : points) steepest += p.step;
  const double slope_alone = 2.0 * kBand / std::max(columns.rows, 1) * whole;
  return above <= std::max(kRougher * below, kSmooth) && steepest > 2 * slope_alone;
}

}  // namespace

void SkylineFinder::fit(const std::vector<int>& columns, int rows, const GridRays& rays) {
  if (rays.are_those_of(rays_) && columns == planes_.columns && rows == planes_.rows) return;
  rays_ = rays;
  planes_ = {.columns = columns, .rows = rows};
  for (double roll = -kMaxRoll_rad; roll <= kMaxRoll_rad; roll += kRollStep_rad)
    for (double pitch = -kMaxPitch_rad; pitch <= kMaxPitch_rad; pitch += kPitchStep_rad) {
      planes_.ups.push_back(up_of(roll, pitch));
      for (const int column : columns)
        planes_.crossings.push_back(static_cast<unsigned short>(crossing(rays, column, rows, planes_.ups.back())));
    }
}

std::optional<Skyline> SkylineFinder::find(const LightGrid& grid, const GridRays& rays, const View& view) {
  if (grid.empty()) return std::nullopt;
  if (rays.angles_are_known() && view.world_from_camera) {
    const glm::dvec3 up = glm::conjugate(*view.world_from_camera) * glm::dvec3(0, 0, -1);
    const double length = glm::length(up);
    if (std::isfinite(length) && length > 0) return Skyline{up / length, kAttitude_rad};
  }
  if (grid.size().height < 8 * kBand || grid.size().width < 16) return std::nullopt;
  const Columns columns = columns_of(grid);
  fit(columns.at, columns.rows, rays);
  const glm::dvec3 coarse = best_plane(columns, planes_);
  const std::vector<EdgePoint> points = edge_points(grid, columns, rays, coarse);
  if (points.size() < 8 || !is_skyline(grid, columns, points)) return std::nullopt;
  return Skyline{fitted_plane(points, coarse), std::hypot(kRefined_rad, kHills_rad), true};
}

}  // namespace sigs
