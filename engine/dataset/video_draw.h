// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <tl/expected.hpp>

#include "dataset/footage_book.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"

namespace sigs {

// A video of a group: its name, and what it is made of as numbers in the recipe's lists.
struct Cast {
  std::size_t group = 0;
  std::string name;
  std::size_t background = 0;  // these three are drawn where the group says so
  std::size_t aircraft = 0;
  std::size_t flight = 0;
};

// The cast with background, aircraft and flight drawn for it; as it is where its group combines them. again: 0 for the
// first draw, counted up each time the video is drawn anew. Every draw depends on seed, video, quantity and `again`
// alone.
[[nodiscard]] Cast drawn_cast(const Recipe& recipe, Cast cast, int again);

// The video with all its quantities drawn, or why it cannot be: one line that begins with the quantity.
[[nodiscard]] tl::expected<PlannedVideo, std::string> drawn_video(const Recipe& recipe, const Cast& cast,
                                                                  const OpenedBackground& background, int again);

}  // namespace sigs
