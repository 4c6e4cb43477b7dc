// SPDX-License-Identifier: MIT
#pragma once

#include "compositor/code_patch.h"

namespace sigs {

// Spreads the colours of a layer as the footage's camera and codec did: a Gaussian over the samples of the chroma
// planes (as they are stored: of 4:2:0 a sample is two pixels wide) takes away the detail that the layer brings into
// them (detail_of_layer). Luma stays as it is. Of R'G'B' the differences from luma are spread, over pixels. Gray has no
// chroma. sigma 0 leaves the patch as it is.
void spread_chroma(CodePatch& patch, double sigma_samples);

// Pixels beyond the layer whose chroma this can change.
[[nodiscard]] int chroma_spread_margin_px(PixelLayout layout, double sigma_samples);

}  // namespace sigs
