// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <tl/expected.hpp>

#include "dataset/footage_cache.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"

namespace sigs {

// A video of a group: its name, and what it is made of as numbers in the recipe's lists.
struct VideoSpec {
  std::size_t group = 0;
  std::string name;
  std::size_t background = 0;  // these three are sampled where the group says so
  std::size_t aircraft = 0;
  std::size_t flight = 0;
};

// The spec with background, aircraft and flight sampled for it; as it is where its group combines them. again: 0 for
// the first sample, counted up each time the video is sampled anew. Every sample depends on seed, video, quantity and
// `again` alone.
[[nodiscard]] VideoSpec sampled_spec(const Recipe& recipe, VideoSpec spec, int again);

// The video with all its quantities sampled, or why it cannot be: one line that begins with the quantity.
[[nodiscard]] tl::expected<PlannedVideo, std::string> sampled_video(const Recipe& recipe, const VideoSpec& spec,
                                                                    const OpenedBackground& background, int again);

}  // namespace sigs
