// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "realism/clips.h"
#include "realism/samples.h"

namespace sigs::bench {

// How bright an intruder is beside a real target of the same frame (mean contrast to the background), with the last of
// the settings and with the exposure that lit_like() (engine/comparison) finds by that target, in four views that
// lit_like() does not draw. Prints a table in Markdown: held-out clips, tuning clips.
void compare_lit(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs);

}  // namespace sigs::bench
