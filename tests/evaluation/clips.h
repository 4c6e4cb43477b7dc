// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"

namespace sigs::test {

// A clip of frames first_frame, ... at rate_hz with one target, which is `target`(0), `target`(1), ...
[[nodiscard]] ClipTruth clip_of(int frames, double rate_hz, const std::function<TargetFrame(int)>& target,
                                int first_frame = 0);

// Adds another target to a clip.
void add_target(ClipTruth& clip, const std::function<TargetFrame(int)>& target);

// A target that is entirely visible, in a box and at a distance.
[[nodiscard]] TargetFrame visible_at(const Box& box, double distance_m = 500);

// Adds a report in a frame.
void report(Results& results, int frame, const Box& box, int track = 0, double score = 1);

[[nodiscard]] Box moved(const Box& box, double dx, double dy);

// The footage of a clip with frames 100 to 102 of 1280x960 pixels.
[[nodiscard]] FootageTruth three_frames();

}  // namespace sigs::test
