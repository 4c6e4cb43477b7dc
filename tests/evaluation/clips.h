// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "evaluation/clip_truth.h"
#include "evaluation/results.h"

namespace sigs::test {

// A clip of frames first_frame, ... at rate_hz with one target, which is as `target` says for frame 0, 1, ...
[[nodiscard]] ClipTruth clip_of(int frames, double rate_hz, const std::function<TargetFrame(int)>& target,
                                int first_frame = 0);

// Another target for a clip.
void add_target(ClipTruth& clip, const std::function<TargetFrame(int)>& target);

// Wholly visible in a box, at a distance.
[[nodiscard]] TargetFrame visible_at(const Box& box, double distance_m = 500);

// One report in a frame.
void report(Results& results, int frame, const Box& box, int track = 0, double score = 1);

[[nodiscard]] Box moved(const Box& box, double dx, double dy);

}  // namespace sigs::test
