// SPDX-License-Identifier: MIT
#include "horizon/sky_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/statistics.h"

namespace sigs {

namespace {

constexpr float kDarker_codes = 14;
constexpr float kBrighter_codes = 42;
constexpr float kRough_codes = 2.5F;    // mean slope of luma within a cell, codes a pixel
constexpr float kBeside_codes = 5;      // between neighbours of which one is known as sky
constexpr float kFollowed = 0.12F;      // share by which the sky's luma follows each cell
constexpr int kLookAhead = 5;           // cells
constexpr int kUpperEnd = 2;            // cells: a column's sky begins within these
constexpr float kTopStep_codes = 10;    // between columns: where one part of the upper border ends
constexpr float kTopDarker_codes = 20;  // than the brightest part: ground that reaches the upper border
constexpr double kMinTopPart = 0.1;     // of the width, to be the brightest part
constexpr uchar kSky = 255, kPassed = 128;

struct Cells {
  cv::Mat luma;   // CV_32F, means
  cv::Mat slope;  // CV_32F, means of the gradient's magnitude, codes a pixel
  cv::Mat_<uchar> hidden;
};

Cells cells_of(const cv::Mat& reduced, const cv::Mat& own_body) {
  Cells cells;
  const cv::Size size(reduced.cols / SkyMap::kCell_px, reduced.rows / SkyMap::kCell_px);
  const cv::Mat whole = reduced(cv::Rect(0, 0, size.width * SkyMap::kCell_px, size.height * SkyMap::kCell_px));
  cv::Mat luma, smooth, right, down, slope;
  whole.convertTo(luma, CV_32F);
  cv::resize(luma, cells.luma, size, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(luma, smooth, {5, 5}, 1.2);
  constexpr double kPerPixel = 1.0 / 8;  // of Sobel's weights
  cv::Sobel(smooth, right, CV_32F, 1, 0, 3, kPerPixel);
  cv::Sobel(smooth, down, CV_32F, 0, 1, 3, kPerPixel);
  cv::magnitude(right, down, slope);
  cv::resize(slope, cells.slope, size, 0, 0, cv::INTER_AREA);
  cells.hidden = cv::Mat_<uchar>(size, uchar{0});
  if (own_body.empty()) return cells;
  cv::Mat share;
  cv::resize(own_body, share, size, 0, 0, cv::INTER_AREA);
  cells.hidden.setTo(255, share > 127);
  return cells;
}

// One column from the row `top` downwards.
void scan(const Cells& cells, int x, int top, cv::Mat_<uchar>& sky) {
  const int rows = sky.rows;
  float around = -1;  // luma of the sky so far
  const auto is_like = [&](int y) {
    const float luma = cells.luma.at<float>(y, x);
    return cells.slope.at<float>(y, x) <= kRough_codes &&
           (around < 0 || (luma > around - kDarker_codes && luma < around + kBrighter_codes));
  };
  for (int y = top; y < rows; ++y) {
    if (cells.hidden(y, x) != 0) continue;
    if (is_like(y)) {
      const float luma = cells.luma.at<float>(y, x);
      around = around < 0 ? luma : around + kFollowed * (luma - around);
      sky(y, x) = kSky;
      continue;
    }
    if (around < 0) return;
    int alike = 0, seen = 0;
    for (int below = y + 1; below <= std::min(y + kLookAhead, rows - 1); ++below)
      ++seen, alike += is_like(below) ? 1 : 0;
    if (2 * alike < std::max(seen, 1)) return;
    sky(y, x) = kPassed;
  }
}

// Of each column the row where what the own body leaves free begins: 0, or below a body that reaches down from the
// border, less the cell at its edge; the number of rows where it leaves none.
std::vector<int> uppermost_cells(const Cells& cells) {
  std::vector<int> rows(static_cast<std::size_t>(cells.hidden.cols));
  for (int x = 0; x < cells.hidden.cols; ++x) {
    int& row = rows[static_cast<std::size_t>(x)];
    while (row < cells.hidden.rows && cells.hidden(row, x) != 0) ++row;
    if (row > 0 && row < cells.hidden.rows) ++row;
  }
  return rows;
}

// Columns that begin with sky: parts of the upper border, or of what the own body leaves free below it, that are
// divided by steps of luma and are about as bright as the brightest. In a tilted image ground may reach the border
// beside the sky.
//   uppermost  uppermost_cells(cells)
std::vector<bool> top_columns(const Cells& cells, const std::vector<int>& uppermost) {
  struct Part {
    int from = 0, to = 0;
    float luma = 0;
  };
  std::vector<Part> parts;
  const int columns = cells.luma.cols;
  const auto is_free = [&](int x) { return uppermost[static_cast<std::size_t>(x)] < cells.luma.rows; };
  const auto luma = [&](int x) { return cells.luma.at<float>(uppermost[static_cast<std::size_t>(x)], x); };
  const auto is_smooth = [&](int x) {
    return cells.slope.at<float>(uppermost[static_cast<std::size_t>(x)], x) <= kRough_codes;
  };
  for (int x = 0; x < columns; ++x) {
    if (!is_free(x)) continue;
    const bool goes_on =
        !parts.empty() && parts.back().to == x && is_smooth(x) && std::abs(luma(x) - luma(x - 1)) <= kTopStep_codes;
    if (!goes_on) parts.push_back({.from = x, .to = x});
    ++parts.back().to;
    parts.back().luma += luma(x);
  }
  float brightest = 0;
  for (Part& part : parts) {
    part.luma /= static_cast<float>(part.to - part.from);
    if (part.to - part.from >= kMinTopPart * columns) brightest = std::max(brightest, part.luma);
  }
  std::vector<bool> is_top(static_cast<std::size_t>(columns));
  for (const Part& part : parts)
    for (int x = part.from; x < part.to; ++x)
      is_top[static_cast<std::size_t>(x)] = part.luma > brightest - kTopDarker_codes && is_smooth(x);
  return is_top;
}

// From cells of sky to their neighbours in the same row.
void spread(const Cells& cells, cv::Mat_<uchar>& sky) {
  const auto reach = [&](int y, int from, int to) {
    if (sky(y, to) == kSky || sky(y, from) != kSky || cells.slope.at<float>(y, to) > kRough_codes) return;
    if (std::abs(cells.luma.at<float>(y, to) - cells.luma.at<float>(y, from)) < kBeside_codes &&
        cells.hidden(y, to) == 0)
      sky(y, to) = kSky;
  };
  for (int y = 0; y < sky.rows; ++y) {
    for (int x = 1; x < sky.cols; ++x) reach(y, x - 1, x);
    for (int x = sky.cols - 1; x > 0; --x) reach(y, x, x - 1);
  }
}

constexpr int kWarmRows = 8;
constexpr double kWarmStep_codes = 40, kWarmer_codes = 25;
constexpr double kWarmColumns = 0.55, kWarmNear = 0.06;

// The row in which warm ground begins in a column of cells; 0: in none.
int warm_row(const cv::Mat& reduced, int column) {
  cv::Mat mean;
  cv::reduce(reduced.colRange(column * SkyMap::kCell_px, (column + 1) * SkyMap::kCell_px), mean, 1, cv::REDUCE_AVG,
             CV_64F);
  std::vector<double> sums{0};
  for (int y = 0; y < mean.rows; ++y) sums.push_back(sums.back() + mean.at<double>(y));
  double most = kWarmStep_codes * kWarmRows;
  int row = 0;
  for (auto y = static_cast<std::size_t>(kWarmRows); y + kWarmRows < sums.size(); ++y) {
    const double step = sums[y + kWarmRows] - 2 * sums[y] + sums[y - kWarmRows];
    if (step >= most) most = step, row = static_cast<int>(y);
  }
  return row;
}

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

// Where every other cell of a sky map looks.
class CellRays {
 public:
  struct Cell {
    glm::dvec3 ray;
    int column = 0;
    bool is_sky = false;
  };

  CellRays(const SkyMap& sky, double scale, const Camera& camera, const cv::Mat& own_body)
      : columns_((sky.sky.cols + kEvery - 1) / kEvery), width_px_(sky.sky.cols * SkyMap::kCell_px) {
    for (int y = 0; y < sky.sky.rows; y += kEvery)
      for (int x = 0; x < sky.sky.cols; x += kEvery) {
        const glm::dvec2 pixel((x + 0.5) * SkyMap::kCell_px * scale - 0.5, (y + 0.5) * SkyMap::kCell_px * scale - 0.5);
        if (is_own_body(own_body, pixel.x, pixel.y)) continue;
        if (const auto ray = camera.lens.ray(pixel)) cells_.push_back({*ray, x / kEvery, sky.sky(y, x) != 0});
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
std::optional<int> row_on(const glm::dvec3& up, int x, const cv::Mat& reduced, double scale, const Camera& camera) {
  const auto is_above = [&](int y) {
    const auto ray = camera.lens.ray({(x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5});
    return ray ? std::optional(glm::dot(up, *ray) > 0) : std::nullopt;
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
      const double off_rad = std::abs(glm::dot(edge.up, cell.ray));
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
    const double up_rad = glm::dot(edge.up, cell.ray);
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

bool SkyMap::is_sky(double x_px, double y_px) const {
  if (empty()) return false;
  const int x = std::clamp(static_cast<int>(x_px) / kCell_px, 0, sky.cols - 1);
  const int y = std::clamp(static_cast<int>(y_px) / kCell_px, 0, sky.rows - 1);
  return sky(y, x) == kSky;
}

int SkyMap::end_of(int column) const {
  for (int y = sky.rows; y > 0; --y)
    if (sky(y - 1, column) == kSky) return y;
  return 0;
}

SkyMap sky_map_of(const cv::Mat& reduced, const cv::Mat& own_body) {
  SkyMap map;
  if (reduced.cols < SkyMap::kCell_px || reduced.rows < SkyMap::kCell_px) return map;
  const Cells cells = cells_of(reduced, own_body);
  map.sky = cv::Mat_<uchar>(cells.luma.size(), uchar{0});
  const std::vector<int> uppermost = uppermost_cells(cells);
  const std::vector<bool> is_top = top_columns(cells, uppermost);
  for (int x = 0; x < map.sky.cols; ++x)
    if (is_top[static_cast<std::size_t>(x)]) scan(cells, x, uppermost[static_cast<std::size_t>(x)], map.sky);
  spread(cells, map.sky);
  const int free_cells = map.sky.rows * map.sky.cols - cv::countNonZero(cells.hidden);
  map.share = static_cast<double>(cv::countNonZero(map.sky)) / std::max(free_cells, 1);
  int tops = 0;
  for (int x = 0; x < map.sky.cols; ++x) {
    const int from = uppermost[static_cast<std::size_t>(x)];
    for (int y = from; y < std::min(map.sky.rows, from + kUpperEnd + 1); ++y)
      if (map.sky(y, x) != 0) {
        ++tops;
        break;
      }
  }
  map.columns = static_cast<double>(tops) / map.sky.cols;
  return map;
}

SkyMap sky_above_warm_ground(const cv::Mat& reduced) {
  const int columns = reduced.cols / SkyMap::kCell_px;
  std::vector<double> rows;
  std::vector<int> begins;
  for (int x = 0; x < columns; ++x) {
    begins.push_back(warm_row(reduced, x));
    if (begins.back() > 0) rows.push_back(begins.back());
  }
  if (rows.empty()) return {};
  const double middle = median(rows);
  for (int& row : begins)
    if (std::abs(row - middle) > kWarmNear * reduced.rows) row = 0;
  const auto near = static_cast<double>(columns - std::count(begins.begin(), begins.end(), 0));
  const int split = static_cast<int>(middle);
  if (near < kWarmColumns * columns ||
      cv::mean(reduced.rowRange(split, reduced.rows))[0] - cv::mean(reduced.rowRange(0, split))[0] < kWarmer_codes)
    return {};
  SkyMap map{.sky = cv::Mat_<uchar>(reduced.rows / SkyMap::kCell_px, columns, uchar{0}), .columns = near / columns};
  for (int x = 0; x < columns; ++x)
    map.sky.col(x).rowRange(0, begins[static_cast<std::size_t>(x)] / SkyMap::kCell_px).setTo(kSky);
  map.share = static_cast<double>(cv::countNonZero(map.sky)) / static_cast<double>(map.sky.total());
  return map;
}

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
