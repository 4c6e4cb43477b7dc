// SPDX-License-Identifier: MIT
#include "appearance/light_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "base/statistics.h"
#include "video/color_space.h"

namespace sigs {

namespace {

constexpr int kMaxCells = 320;

// The transfer function by table, from black to a tenth above white, in steps finer than an 8-bit code.
class LightTable {
 public:
  explicit LightTable(const ColorInfo& color) {
    const TransferFunction function = transfer_function_of(color.transfer).value_or(TransferFunction::srgb);
    for (int i = 0; i <= kSteps; ++i)
      values_.push_back(static_cast<float>(linear_of_display(function, kMost * i / kSteps)));
  }

  [[nodiscard]] float operator()(float display) const {
    const float at = std::clamp(display, 0.0F, static_cast<float>(kMost)) * static_cast<float>(kSteps / kMost);
    const auto i = std::min(static_cast<std::size_t>(at), values_.size() - 2);
    return values_[i] + (at - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 1100;
  static constexpr double kMost = 1.1;
  std::vector<float> values_;
};

cv::Mat reduced(const cv::Mat& plane, cv::Size size) {
  cv::Mat cells;
  cv::resize(plane, cells, size, 0, 0, cv::INTER_AREA);
  cells.convertTo(cells, CV_32F);
  return cells;
}

cv::Size grid_size(cv::Size frame_px) {
  const int longest = std::max(frame_px.width, frame_px.height);
  const double scale = std::min(1.0, static_cast<double>(kMaxCells) / longest);
  return {std::max(1, cvRound(frame_px.width * scale)), std::max(1, cvRound(frame_px.height * scale))};
}

cv::Mat_<uchar> hidden_cells(const cv::Mat& own_body, cv::Size frame_px, cv::Size size) {
  cv::Mat_<uchar> hidden(size, uchar{0});
  if (own_body.type() != CV_8UC1 || own_body.size() != frame_px) return hidden;
  cv::Mat share;
  cv::resize(own_body, share, size, 0, 0, cv::INTER_AREA);
  hidden.setTo(255, share > 2);
  return hidden;
}

constexpr int kBand = 3;              // cells above and below the edge, where the two are compared
constexpr double kMinStep = 0.025;    // of luma, 6 codes of 8 bits
constexpr double kMaxEdgeStep = 0.3;  // more does not count for more
constexpr double kMinColumns = 0.6;   // share of the columns that the edge has to be in
constexpr double kRougher = 0.7;      // texture above, at most this share of that below
constexpr double kSmoothSky = 0.008;  // smooth, whatever is below
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
      steps[i][static_cast<std::size_t>(y)] = std::clamp(columns.step(i, y), -kMaxEdgeStep, kMaxEdgeStep);
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
    const double most = std::max(2.5 * median(off), 1e-4);
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
  const auto strong = std::count_if(points.begin(), points.end(), [](const EdgePoint& p) { return p.step > kMinStep; });
  if (static_cast<double>(strong) < kMinColumns * static_cast<double>(columns.at.size())) return false;
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
  return above <= std::max(kRougher * below, kSmoothSky) && steepest > 2 * slope_alone;
}

cv::Mat_<float> elevations_of(const LightImage& image) {
  cv::Mat_<float> elevations(image.grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < elevations.rows; ++y)
    for (int x = 0; x < elevations.cols; ++x) {
      const glm::dvec3& ray = image.rays.at(x, y);
      if (image.grid.hidden(y, x) != 0 || glm::dot(ray, ray) <= 0) continue;
      elevations(y, x) = static_cast<float>(std::asin(std::clamp(glm::dot(ray, image.skyline->up), -1.0, 1.0)));
    }
  return elevations;
}

}  // namespace

glm::dvec2 LightGrid::pixel_of(double column, double row) const {
  return {(column + 0.5) * frame_px.width / light.cols - 0.5, (row + 0.5) * frame_px.height / light.rows - 0.5};
}

LightGrid light_grid_of(const Frame& frame, const View& view) {
  LightGrid grid;
  grid.frame_px = frame.size_px();
  if (frame.planes[0].empty()) return grid;
  const cv::Size size = grid_size(grid.frame_px);
  std::array<cv::Mat, 3> codes;
  for (int k = 0; k < frame.plane_count(); ++k) {
    if (frame.planes[k].empty()) return grid;
    codes[k] = reduced(frame.planes[k], size);
  }
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color, frame.bit_depth);
  const cv::Matx33f bt709(cv::Matx33d(from_bt709(frame.color.primaries).value_or(cv::Matx33d::eye())).inv());
  const LightTable linear(frame.color);
  grid.light.create(size);
  grid.luma.create(size);
  grid.hidden = hidden_cells(view.own_body, grid.frame_px, size);
  const bool is_bt709 = bt709 == cv::Matx33f::eye();
  for (int y = 0; y < size.height; ++y) {
    std::array<const float*, 3> rows{};
    for (int k = 0; k < frame.plane_count(); ++k) rows[k] = codes[k].ptr<float>(y);
    cv::Vec3f* const light_row = grid.light[y];
    float* const luma_row = grid.luma[y];
    for (int x = 0; x < size.width; ++x) {
      cv::Vec3f code = map.offset;
      for (int k = 0; k < frame.plane_count(); ++k) code[k] = rows[k][x];
      const cv::Vec3f rgb = map.to_rgb * (code - map.offset);
      cv::Vec3f light(linear(rgb[0]), linear(rgb[1]), linear(rgb[2]));
      if (!is_bt709) light = bt709 * light;
      for (int k = 0; k < 3; ++k) light_row[x][k] = std::max(light[k], 0.0F);
      luma_row[x] = 0.2126F * rgb[0] + 0.7152F * rgb[1] + 0.0722F * rgb[2];
    }
  }
  return grid;
}

void GridRays::fit(const LightGrid& grid, const Camera* camera) {
  const Camera* usable = camera != nullptr && camera->size_px == grid.frame_px ? camera : nullptr;
  if (rays_ != nullptr && usable == camera_ && grid.frame_px == frame_px_) return;
  camera_ = usable;
  frame_px_ = grid.frame_px;
  size_ = grid.size();
  angles_are_known_ = usable != nullptr;
  std::vector<glm::dvec3> rays;
  const double focal_px = 0.5 * frame_px_.width / std::tan(std::numbers::pi / 6);
  const glm::dvec2 middle_px(0.5 * (frame_px_.width - 1), 0.5 * (frame_px_.height - 1));
  for (int row = 0; row < size_.height; ++row)
    for (int column = 0; column < size_.width; ++column) {
      const glm::dvec2 pixel = grid.pixel_of(column, row);
      const glm::dvec2 off = (pixel - middle_px) / focal_px;
      rays.push_back(usable != nullptr ? usable->lens.ray(pixel).value_or(glm::dvec3(0))
                                       : glm::normalize(glm::dvec3(1, off.x, off.y)));
    }
  rays_ = std::make_shared<const std::vector<glm::dvec3>>(std::move(rays));
}

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

std::optional<double> LightImage::elevation_rad(int column, int row) const {
  if (elevations_rad.data == nullptr) return std::nullopt;
  const float elevation_rad = elevations_rad(row, column);
  if (std::isnan(elevation_rad)) return std::nullopt;
  return static_cast<double>(elevation_rad);
}

LightImage LightImageReader::read(const Frame& frame, const View& view) {
  LightImage image;
  image.grid = light_grid_of(frame, view);
  image.view = view;
  if (image.empty()) return image;
  rays_.fit(image.grid, view.camera);
  image.rays = rays_;
  image.skyline = skylines_.find(image.grid, image.rays, view);
  if (image.skyline) image.elevations_rad = elevations_of(image);
  return image;
}

}  // namespace sigs
