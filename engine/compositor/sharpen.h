// SPDX-License-Identifier: MIT
#pragma once

#include "compositor/code_patch.h"

namespace sigs {

// Sharpens what a layer changed of luma, as cameras sharpen their whole image in code values (unsharp masking): adds
// amount times the detail that the layer brings, told by a Gaussian of sigma_px (detail_of_layer). The footage itself
// has been sharpened by its camera and is left as it is. Of R'G'B' the same is added to all three planes, by BT.709's
// luma. amount 0 leaves the patch as it is.
void sharpen(CodePatch& patch, double amount, double sigma_px);

// Pixels beyond the layer that sharpening can change.
[[nodiscard]] int sharpening_margin_px(double amount, double sigma_px);

}  // namespace sigs
