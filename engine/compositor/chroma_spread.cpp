// SPDX-License-Identifier: MIT
#include "compositor/chroma_spread.h"

#include <algorithm>

#include "compositor/gaussian_kernel.h"
#include "compositor/rgb_luma.h"

namespace sigs {

namespace {

void spread_rgb(CodePatch& patch, double sigma_px) {
  const cv::Mat of_luma = detail_of_layer(luma_of_rgb(patch), sigma_px);
  for (PatchPlane& plane : patch.planes) add_change(plane, of_luma - detail_of_layer(plane, sigma_px));
}

}  // namespace

void spread_chroma(CodePatch& patch, double sigma_samples) {
  if (sigma_samples == 0 || patch.plane_count() == 1) return;
  if (patch.layout == PixelLayout::rgb) return spread_rgb(patch, sigma_samples);
  for (std::size_t plane = 1; plane < 3; ++plane)
    add_change(patch.planes[plane], -detail_of_layer(patch.planes[plane], sigma_samples));
}

int chroma_spread_margin_px(PixelLayout layout, double sigma_samples) {
  if (sigma_samples == 0 || layout == PixelLayout::gray) return 0;
  const cv::Size step = chroma_step(layout);
  return (blur_margin_px(sigma_samples) + 1) * std::max(step.width, step.height);
}

}  // namespace sigs
