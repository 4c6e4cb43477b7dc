// SPDX-License-Identifier: MIT
#include "compositor/sharpen.h"

#include "compositor/gaussian_kernel.h"
#include "compositor/rgb_luma.h"

namespace sigs {

void sharpen(CodePatch& patch, double amount, double sigma_px) {
  if (amount == 0) return;
  if (patch.layout != PixelLayout::rgb) {
    add_change(patch.planes[0], amount * detail_of_layer(patch.planes[0], sigma_px));
    return;
  }
  const cv::Mat change = amount * detail_of_layer(luma_of_rgb(patch), sigma_px);
  for (PatchPlane& plane : patch.planes) add_change(plane, change);
}

int sharpening_margin_px(double amount, double sigma_px) {
  return amount == 0 ? 0 : blur_margin_px(sigma_px);
}

}  // namespace sigs
