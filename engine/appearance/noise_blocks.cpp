// SPDX-License-Identifier: MIT
#include "appearance/noise_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "video/frame_source.h"

namespace sigs {

namespace {

constexpr int kMaxBlocks = 6000;  // of a frame

constexpr int kSide = kNoiseBlock_px;

// Numbers of four blocks: each block is computed as if it were alone, four at a time.
constexpr int kTogether = 4;
using Four = float __attribute__((vector_size(kTogether * sizeof(float))));
using FourCorners = std::array<cv::Point, kTogether>;
using FourRests = std::array<Four, kSide * kSide>;  // by sample, row by row

FourRests samples_of(const cv::Mat& image, const FourCorners& corners) {
  FourRests samples;
  for (int y = 0; y < kSide; ++y) {
    std::array<const uchar*, kTogether> rows;
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = image.ptr<uchar>(corners[k].y + y) + corners[k].x;
    for (int x = 0; x < kSide; ++x)
      samples[y * kSide + x] = Four{static_cast<float>(rows[0][x]), static_cast<float>(rows[1][x]),
                                    static_cast<float>(rows[2][x]), static_cast<float>(rows[3][x])};
  }
  return samples;
}

// The levels of blocks; their planes are subtracted. Centred coordinates make level and slopes independent of each
// other.
Four take_planes(FourRests& blocks) {
  constexpr float kMiddle = 0.5F * (kSide - 1);
  Four sum{}, sum_x{}, sum_y{};
  for (int y = 0; y < kSide; ++y) {
    Four row_sum{};
    for (int x = 0; x < kSide; ++x) {
      row_sum += blocks[y * kSide + x];
      sum_x += (static_cast<float>(x) - kMiddle) * blocks[y * kSide + x];
    }
    sum += row_sum;
    sum_y += (static_cast<float>(y) - kMiddle) * row_sum;
  }
  constexpr float kSquares =
      kSide * kSide * (kSide * kSide - 1) / 12.0F;  // sum of squares of either coordinate over the block
  const Four level = sum / static_cast<float>(kSide * kSide), slope_x = sum_x / kSquares, slope_y = sum_y / kSquares;
  for (int y = 0; y < kSide; ++y) {
    const Four start = level + slope_y * (static_cast<float>(y) - kMiddle) - slope_x * kMiddle;
    for (int x = 0; x < kSide; ++x)
      blocks[y * kSide + x] = blocks[y * kSide + x] - start - slope_x * static_cast<float>(x);
  }
  return level;
}

Four covariances_of(const FourRests& a, const FourRests& b) {
  Four sum{};
  for (int i = 0; i < kSide * kSide; ++i) sum += a[i] * b[i];
  return sum / static_cast<float>(kSide * kSide - 3);
}

Four neighbours_of(const FourRests& rests) {
  Four across{}, down{};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x + 1 < kSide; ++x) across += rests[y * kSide + x] * rests[y * kSide + x + 1];
  for (int i = 0; i + kSide < kSide * kSide; ++i) down += rests[i] * rests[i + kSide];
  return (across + down) / static_cast<float>(2 * kSide * (kSide - 1));
}

// Of each column, whether one of the rows of blocks that begin at y is clipped there.
std::vector<uchar> clipped_columns(const cv::Mat& image, int y, uchar lowest, uchar highest) {
  std::vector<uchar> clipped(static_cast<std::size_t>(image.cols));
  for (int i = 0; i < kSide; ++i) {
    const uchar* const row = image.ptr<uchar>(y + i);
    for (std::size_t x = 0; x < clipped.size(); ++x) clipped[x] |= (row[x] <= lowest) | (row[x] >= highest);
  }
  return clipped;
}

// Blocks of one row of them, at most four, with their corners; unused places repeat the first block.
struct Group {
  FourCorners corners;
  std::size_t count = 0;

  void add(cv::Point corner) {
    if (count == 0) corners.fill(corner);
    corners[count++] = corner;
  }
};

// Of as many samples as in luma.
void set_chroma(const Frame& frame, const Group& group, std::span<NoiseBlock> blocks) {
  const cv::Size step = chroma_step(frame.layout);
  Group inside;
  std::array<std::size_t, kTogether> places{};
  for (std::size_t k = 0; k < group.count; ++k) {
    const cv::Point at(group.corners[k].x / step.width, group.corners[k].y / step.height);
    if (at.x + kSide > frame.planes[1].cols || at.y + kSide > frame.planes[1].rows) continue;
    places[inside.count] = k;
    inside.add(at);
  }
  if (inside.count == 0) return;
  for (std::size_t k = 0; k < inside.count; ++k) blocks[places[k]].chroma = 0;
  for (const int plane : {1, 2}) {
    FourRests rests = samples_of(frame.planes[plane], inside.corners);
    take_planes(rests);
    const Four variances = covariances_of(rests, rests);
    for (std::size_t k = 0; k < inside.count; ++k) blocks[places[k]].chroma += static_cast<double>(variances[k]) / 2;
  }
}

// What luma shows of them, and chroma where there is any.
std::array<NoiseBlock, kTogether> measured(const Frame& frame, const cv::Mat& luma, const cv::Mat& next_luma,
                                           const Group& group) {
  std::array<NoiseBlock, kTogether> blocks;
  FourRests rests = samples_of(luma, group.corners);
  const Four levels = take_planes(rests), variances = covariances_of(rests, rests), neighbours = neighbours_of(rests);
  for (std::size_t k = 0; k < group.count; ++k)
    blocks[k] = {.mean = levels[k], .variance = variances[k], .neighbours = neighbours[k]};
  if (!next_luma.empty()) {
    FourRests later = samples_of(next_luma, group.corners);
    take_planes(later);
    const Four next_variances = covariances_of(later, later), covariances = covariances_of(rests, later);
    for (int i = 0; i < kSide * kSide; ++i) later[i] -= rests[i];
    const Four change = neighbours_of(later);
    for (std::size_t k = 0; k < group.count; ++k) {
      blocks[k].next_variance = next_variances[k];
      blocks[k].covariance = covariances[k];
      blocks[k].change_neighbours = static_cast<double>(change[k]) / 2;
    }
  }
  if (frame.layout != PixelLayout::gray && frame.layout != PixelLayout::rgb) set_chroma(frame, group, blocks);
  return blocks;
}

using Vector = std::vector<double>;

// Correlation of neighbours `apart` samples from each other: the Gaussian's with itself.
Vector correlations(double correlation_length_px, int n) {
  constexpr int kKernelReach = 40;
  Vector kernel(2 * kKernelReach + 1);
  for (int k = -kKernelReach; k <= kKernelReach; ++k)
    kernel[k + kKernelReach] = correlation_length_px > 0
                                   ? std::exp(-0.5 * k * k / (correlation_length_px * correlation_length_px))
                                   : (k == 0 ? 1.0 : 0.0);
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

std::vector<NoiseBlock> noise_blocks(const Frame& frame, const Frame* next) {
  const cv::Mat luma = luma_of(frame);
  const cv::Mat next_luma = next == nullptr ? cv::Mat() : luma_of(*next);
  const bool is_limited = frame.layout != PixelLayout::rgb && frame.color.range == ColorRange::limited;
  const uchar lowest = is_limited ? 16 : 0, highest = is_limited ? 235 : 255;
  const int rows = luma.rows / kSide, columns = luma.cols / kSide;
  const int every = std::max(1, rows * columns / kMaxBlocks);
  std::vector<NoiseBlock> blocks;
  for (int i = 0; i < rows; i += every) {
    const std::vector<uchar> clipped = clipped_columns(luma, i * kSide, lowest, highest);
    Group group;
    for (int j = 0; j < columns; ++j) {
      const auto first = clipped.begin() + static_cast<std::ptrdiff_t>(j) * kSide;
      if (std::find(first, first + kSide, 1) == first + kSide) group.add({j * kSide, i * kSide});
      if (group.count < kTogether && j + 1 < columns) continue;
      const std::array<NoiseBlock, kTogether> found = measured(frame, luma, next_luma, group);
      blocks.insert(blocks.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(group.count));
      group = {};
    }
  }
  return blocks;
}

NoiseLine line_through(const std::vector<NoiseLevel>& levels, bool is_level) {
  constexpr double kNarrow = 0.25;    // of the brightness
  constexpr double kMaxUnsure = 0.7;  // deviation of an end's variance, as a share of the mean of both
  double low = 1, high = 0;
  for (const NoiseLevel& level : levels) {
    low = std::min(low, level.brightness);
    high = std::max(high, level.brightness);
  }
  NoiseLine line{.is_level = is_level || high - low < kNarrow};
  std::vector<double> robust(levels.size(), 1.0);
  for (int round = 0; round < 4; ++round) {
    double aa = 0, ab = 0, bb = 0, ay = 0, by = 0, total = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double b = levels[i].brightness, a = 1 - b;
      const double w = levels[i].weight * robust[i] / std::pow(levels[i].variance + 0.02, 2);  // equal relative errors
      aa += w * a * a;
      ab += w * a * b;
      bb += w * b * b;
      ay += w * a * levels[i].variance;
      by += w * b * levels[i].variance;
      total += w;
    }
    const double determinant = aa * bb - ab * ab;
    if (line.is_level || !(determinant > 1e-6 * aa * bb)) {
      line.dark = line.bright = (ay + by) / total;
      line.is_level = true;
    } else {
      line.dark = std::max(0.0, (bb * ay - ab * by) / determinant);
      line.bright = std::max(0.0, (aa * by - ab * ay) / determinant);
      // A line that is negative at one end is 0 there.
      if (line.dark == 0) line.bright = by / bb;
      if (line.bright == 0) line.dark = ay / aa;
    }
    double squares = 0, n = 0, weights = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double fit = line.dark * (1 - levels[i].brightness) + line.bright * levels[i].brightness;
      const double off = (levels[i].variance - fit) / (fit + 0.02);
      robust[i] = 1 / (1 + std::pow(off / (off > 0 ? 0.15 : 0.4), 2));  // texture adds and never takes away
      squares += robust[i] * off * off;
      n += robust[i];
      weights += robust[i] * levels[i].weight;
    }
    const double scatter = std::max(0.04, std::sqrt(squares / std::max(n - 2, 1.0)));
    // Each level errs by the scatter, whatever its weight.
    const double usual_weight = weights / std::max(n, 1e-9);
    line.dark_sd = scatter * (line.is_level ? line.dark : std::sqrt(usual_weight * bb / determinant));
    line.bright_sd = scatter * (line.is_level ? line.bright : std::sqrt(usual_weight * aa / determinant));
  }
  const double sure = kMaxUnsure * (line.dark + line.bright) / 2 + 0.02;
  if (!line.is_level && std::max(line.dark_sd, line.bright_sd) > sure) return line_through(levels, true);
  return line;
}

double lasting_share(std::span<const NoiseBlock* const> blocks) {
  constexpr double kOfTexture = 0.7;   // what neighbours share of smooth texture, the plane being subtracted
  constexpr double kMaxOfNoise = 0.4;  // noise of which they share more is too much like texture
  constexpr double kOfRounding = 1.0 / 12;
  double variance = 0, change = 0, shared = 0, shared_change = 0;
  for (const NoiseBlock* const block : blocks) {
    variance += (block->variance + block->next_variance) / 2;
    change += block->change();
    shared += block->neighbours;
    shared_change += block->change_neighbours;
  }
  if (!(change > 0) || !(variance > change)) return 0;
  const double lasting = variance - change;
  const double noise_only = std::max(0.1 * change, change - kOfRounding * static_cast<double>(blocks.size()));
  const double of_noise = std::clamp(shared_change / noise_only, 0.0, 1.0);
  double lasting_noise = lasting;
  if (of_noise < kMaxOfNoise)
    lasting_noise *= std::clamp((kOfTexture - (shared - shared_change) / lasting) / (kOfTexture - of_noise), 0.0, 1.0);
  return lasting_noise / (lasting_noise + change);
}

// With C the covariance of the block's noise, P the projection on the plane (P = sum of p p' over three orthonormal p),
// Q = 1 - P and S the shift along rows, the expected sums are tr(Q C) and tr(S Q C Q). All but Q are products of a
// matrix along rows and one along columns, so only rows of n numbers are multiplied.
BlockRest block_rest(double correlation_length_px, int n) {
  const Vector correlation = correlations(correlation_length_px, n);
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
