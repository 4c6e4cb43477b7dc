// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "horizon/horizon.h"

namespace sigs {

namespace {

constexpr double kMinSkyAbove = 0.7;                 // share of what lies above the plane
constexpr double kMaxSkyBelow = 0.15;                // share of what lies below the plane
constexpr double kMaxSkyUnder = 0.3;                 // columns with sky below the plane, of those with the edge
constexpr double kNearPlane_rad = 0.012;             // nearer to the plane, cells may hold some of both sides
constexpr double kMinWide = 0.9, kMinArea = 0.15;    // of the image: across it, or so much on both sides
constexpr int kWaterBand_px = 8, kWaterFar_px = 44;  // rows whose mean luma is compared; how far below the edge
constexpr double kWaterDarkens_codes = 3;            // from the edge to there
constexpr int kMinWaterColumns = 6;
constexpr int kWaterEvery_px = 5;       // between columns where water is looked for
constexpr int kOffEdge_px = 4;          // from the edge to what is compared
constexpr double kWaterStep_codes = 4;  // by which the sky is brighter than water below it

Eigen::Vector3d vector_of(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

// Where every other cell of a sky map looks.
class CellRays {
 public:
  struct Cell {
    Eigen::Vector3d ray;
    int column = 0;
    bool is_sky = false;
  };

  CellRays(const SkyMap& sky, double scale, const Camera& camera, const cv::Mat& own_body)
      : columns_((sky.sky.cols + kEvery - 1) / kEvery), width_px_(sky.sky.cols * SkyMap::kCell_px) {
    for (int y = 0; y < sky.sky.rows; y += kEvery)
      for (int x = 0; x < sky.sky.cols; x += kEvery) {
        const glm::dvec2 pixel((x + 0.5) * SkyMap::kCell_px * scale - 0.5, (y + 0.5) * SkyMap::kCell_px * scale - 0.5);
        if (is_own_body(own_body, pixel.x, pixel.y)) continue;
        if (const auto ray = camera.lens.ray(pixel))
          cells_.push_back({vector_of(*ray), x / kEvery, sky.sky(y, x) != 0});
      }
  }

  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] double column_px() const { return static_cast<double>(width_px_) / columns_; }

 private:
  static constexpr int kEvery = 2;
  std::vector<Cell> cells_;
  int columns_ = 0, width_px_ = 0;
};

// The row of the reduced image at which a plane crosses a column; nothing where it does not.
std::optional<int> row_on(const Eigen::Vector3d& up, int x, const cv::Mat& reduced, double scale,
                          const Camera& camera) {
  const auto is_above = [&](int y) {
    const auto ray = camera.lens.ray({(x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5});
    return ray ? std::optional(up.dot(vector_of(*ray)) > 0) : std::nullopt;
  };
  int from = 0, to = reduced.rows - 1;
  if (is_above(from) != true || is_above(to) != false) return std::nullopt;
  while (to - from > 1) {
    const int middle = (from + to) / 2;
    const auto above = is_above(middle);
    if (!above) return std::nullopt;
    (*above ? from : to) = middle;
  }
  return to;
}

// Water that is as smooth as the sky.
struct Water {
  bool is_there = false;
  std::vector<bool> columns;  // by kWaterEvery_px: where the edge has it below
};

// Water is darker than the sky above its edge and darkens downwards: low in it the sky's brightest part is mirrored,
// nearer to the camera higher and darker ones. Clear sky below a cloud brightens downwards.
Water water_below(const cv::Mat& reduced, double scale, const Camera& camera, const SkyMap& sky, const SkyEdge& edge) {
  const int count = reduced.cols / kWaterEvery_px;
  Water water{.columns = std::vector<bool>(static_cast<std::size_t>(count))};
  double step = 0, darkens = 0;
  int seen = 0;
  for (int i = 1; i < count; ++i) {
    const int x = i * kWaterEvery_px;
    const std::optional<int> row = row_on(edge.up, x, reduced, scale, camera);
    if (!row) continue;
    const auto mean = [&](int from) { return cv::mean(reduced(cv::Rect(x - 2, *row + from, 5, kWaterBand_px)))[0]; };
    const int far_px = std::min(kWaterFar_px, reduced.rows - *row - kWaterBand_px);
    if (*row < 2 * kWaterBand_px || far_px < 2 * kWaterBand_px) continue;
    const double below = mean(kOffEdge_px), own_step = mean(-kOffEdge_px - kWaterBand_px) - below;
    const bool is_on_edge = x >= edge.first_px && x <= edge.last_px;
    water.columns[static_cast<std::size_t>(i)] = is_on_edge || own_step >= kWaterStep_codes;
    if (!sky.is_sky(x, *row + kOffEdge_px + kWaterBand_px)) continue;
    step += own_step;
    darkens += below - mean(far_px);
    ++seen;
  }
  water.is_there = seen >= kMinWaterColumns && step >= kWaterStep_codes * seen && darkens >= kWaterDarkens_codes * seen;
  return water;
}

// Above a horizon is sky, but for what stands on the ground, and below it is none. The edge of a roof goes on as a line
// below which there is sky, and one that only cuts a corner of the image is not told from a roof.
//   water  what is smooth below it and is no sky
bool divides(const CellRays& rays, const SkyEdge& edge, const Water& water) {
  int above = 0, sky_above = 0, below = 0, sky_below = 0;
  const auto columns = static_cast<std::size_t>(rays.columns());
  std::vector<bool> has_above(columns), has_below(columns), has_sky_below(columns), is_edge(columns);
  if (water.is_there) {
    // Beside the edge it lies behind what stands in front of it: there the sky ends before.
    std::vector<double> nearest_rad(columns, 1);
    for (const CellRays::Cell& cell : rays.cells()) {
      const auto column = static_cast<std::size_t>(cell.column);
      const double off_rad = std::abs(edge.up.dot(cell.ray));
      if (off_rad >= nearest_rad[column]) continue;
      nearest_rad[column] = off_rad;
      is_edge[column] = !cell.is_sky;
    }
    for (std::size_t i = 0; i < columns; ++i) {
      const auto column = static_cast<std::size_t>((static_cast<double>(i) + 0.5) * rays.column_px() / kWaterEvery_px);
      if (column < water.columns.size() && water.columns[column]) is_edge[i] = true;
    }
  }
  for (const CellRays::Cell& cell : rays.cells()) {
    const double up_rad = edge.up.dot(cell.ray);
    const auto column = static_cast<std::size_t>(cell.column);
    (up_rad > 0 ? has_above : has_below)[column] = true;
    if (std::abs(up_rad) < kNearPlane_rad) continue;
    ++(up_rad > 0 ? above : below);
    if (!cell.is_sky || (up_rad < 0 && is_edge[column])) continue;
    ++(up_rad > 0 ? sky_above : sky_below);
    if (up_rad < 0) has_sky_below[column] = true;
  }
  int across = 0, sky_under = 0;
  for (std::size_t i = 0; i < columns; ++i) {
    across += has_above[i] && has_below[i] ? 1 : 0;
    sky_under += has_above[i] && has_sky_below[i] ? 1 : 0;
  }
  const double cells = static_cast<double>(rays.cells().size());
  const bool is_wide = across >= kMinWide * rays.columns() || std::min(above, below) >= kMinArea * cells;
  return is_wide && sky_above >= kMinSkyAbove * above && sky_below <= kMaxSkyBelow * below &&
         sky_under * rays.column_px() <= kMaxSkyUnder * edge.seen_px;
}

}  // namespace

bool is_own_body(const cv::Mat& own_body, double x, double y) {
  if (own_body.empty()) return false;
  const int column = std::clamp(static_cast<int>(std::lround(x)), 0, own_body.cols - 1);
  const int row = std::clamp(static_cast<int>(std::lround(y)), 0, own_body.rows - 1);
  return own_body.at<uchar>(row, column) > 127;
}

bool divides_sky(const SkyEdge& edge, const SkyMap& sky, const cv::Mat& reduced, double scale, const Camera& camera,
                 const cv::Mat& own_body) {
  return divides(CellRays(sky, scale, camera, own_body), edge, water_below(reduced, scale, camera, sky, edge));
}

}  // namespace sigs
