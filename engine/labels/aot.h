// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "labels/labels.h"

namespace sigs {

// Ground truth as the Airborne Object Tracking data set has it
// (https://registry.opendata.aws/airborne-object-tracking): one flight, whose entities are an object in a frame each,
// or a frame without any. docs/label-formats.md.
//   time      ns of the footage; blob.frame  the footage's frame; blob.range_distance_m  to the reference point
//   id        category and number from 1: Airplane1; bb  left, top, width, height, pixels from 0
//   labels.is_above_horizon  1 above, 0 on or unknown, -1 below
//   img_name  image_name() in its folder, NAME/frame_000123.png, so that it stays apart from other flights'
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_aot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
