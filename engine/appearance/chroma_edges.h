// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "appearance/edge_fit.h"
#include "appearance/straight_edges.h"
#include "video/frame.h"

namespace sigs {

// The profiles of the chroma planes across an edge that was found in luma: of each plane whose sides differ by at least
// 12 codes and are even. Empty for gray and RGB. Code values are fitted, not light: chroma is spread after the transfer
// curve, by the conversion to fewer samples and by the codec.
[[nodiscard]] std::vector<EdgeSample> chroma_samples(const Frame& frame, const StraightEdge& edge);

// The blur of chroma beyond that of luma, in samples of the chroma planes. Nothing where the fit has failed: chroma
// that is sharper than luma or wider than the profile.
//   luma_sigma_px  of the same edge
[[nodiscard]] std::optional<double> chroma_spread_px(const EdgeSample& chroma, double luma_sigma_px);

}  // namespace sigs
