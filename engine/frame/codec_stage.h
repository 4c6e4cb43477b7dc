// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "camera/lens.h"
#include "compositor/codec_match.h"
#include "frame/intruder_layers.h"
#include "scene/scene.h"

namespace sigs {

// The codec match of a frame as the scene's settings (appearance.codec) ask for it, to be made before the layers are
// blended and applied after; nothing where there is none to be done: it is not asked for, the method is not direct, the
// footage has more than 8 bits, its codec keeps every sample, or no intruder reaches the image.
//   frame  number of the frame in the footage
//   lens   that the scene is composited with
[[nodiscard]] std::optional<CodecMatch> codec_match_for(const Frame& background, const Scene& scene, int frame,
                                                        const Lens& lens, const std::vector<IntruderLayers>& layers);

}  // namespace sigs
