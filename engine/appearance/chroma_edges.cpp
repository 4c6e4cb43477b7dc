// SPDX-License-Identifier: MIT
#include "appearance/chroma_edges.h"

#include <algorithm>
#include <cmath>

#include "video/chroma.h"

namespace sigs {

namespace {

PlaneGrid chroma_grid(const Frame& frame) {
  const cv::Size step = chroma_step(frame.layout);
  PlaneGrid grid{.step_px = {step.width, step.height}};
  if (step.width == 2 && !chroma_on_luma_column(frame.color.chroma_site)) grid.offset_px.x = 0.5;
  if (step.height == 2 && !chroma_on_luma_row(frame.color.chroma_site)) grid.offset_px.y = 0.5;
  return grid;
}

// Mean of the bins beyond 6 px on one side, and how much they scatter.
std::optional<Fitted> side_of(const EdgeBins& bins, double sign) {
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < bins.code.size(); ++i) {
    if (sign * bins.distance_px[i] < 6) continue;
    n += bins.count[i];
    sum += bins.count[i] * bins.code[i];
    squares += bins.count[i] * bins.code[i] * bins.code[i];
  }
  if (n < 1) return std::nullopt;
  return Fitted{sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)))};
}

}  // namespace

std::vector<EdgeSample> chroma_samples(const Frame& frame, const StraightEdge& edge) {
  constexpr double kMinContrast = 12;
  constexpr double kMaxUnevenness = 0.1;
  constexpr double kBin_px = 0.5;
  std::vector<EdgeSample> samples;
  if (frame.layout == PixelLayout::gray || frame.layout == PixelLayout::rgb) return samples;
  const PlaneGrid grid = chroma_grid(frame);
  for (const int plane : {1, 2}) {
    EdgeSample sample{.bins = binned(frame.planes[plane], grid, edge.line, kEdgeHalfWidth_px, kBin_px),
                      .levels = {.transfer = TransferFunction::linear, .pixel_px = grid.step_px.x},
                      .normal = edge.line.normal};
    const std::optional<Fitted> dark = side_of(sample.bins, -1);
    const std::optional<Fitted> bright = side_of(sample.bins, 1);
    if (!dark || !bright) continue;
    const double contrast = std::abs(bright->value - dark->value);
    const double uneven = std::max({dark->sd, bright->sd, sample.bins.noise / 2});
    if (contrast < kMinContrast || uneven > kMaxUnevenness * contrast) continue;
    sample.tolerance = std::hypot(sample.bins.noise, 0.02 * contrast, 0.3);
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::optional<double> chroma_spread_px(const EdgeSample& chroma, double luma_sigma_px) {
  constexpr double kWidest_px = 5;  // luma samples; wider ones do not end within the profile
  const Fitted sigma = fitted_sigma(chroma, {.sigma_px = 2});
  if (sigma.value > kWidest_px || sigma.sd > 0.3 * sigma.value + 0.2) return std::nullopt;
  const double beyond = sigma.value * sigma.value - luma_sigma_px * luma_sigma_px;
  if (beyond < -0.3) return std::nullopt;
  return std::sqrt(std::max(0.0, beyond)) / chroma.levels.pixel_px;
}

}  // namespace sigs
