// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/image.h"
#include "video/frame.h"

namespace sigs::bench {

// The frame with a copy of the target that a loose box holds, moved by whole pixels (an even number both ways). What
// the target and the codec's traces within 10 px of it differ from the background there is put onto the background at
// the new place, with a soft edge; so the copy brings its own noise. A limit of what insertion can reach.
// None where target_silhouette() finds no target, or the copy would not lie within the frame.
[[nodiscard]] std::optional<Frame> with_target_moved(const Frame& frame, const Box& box, cv::Point shift);

}  // namespace sigs::bench
