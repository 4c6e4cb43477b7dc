// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "dataset/footage_cache.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"

namespace sigs {

// The place of the background or aircraft of this name in its list; the size of the list where there is none.
template <class Named>
[[nodiscard]] std::size_t index_of(const std::vector<Named>& all, const std::string& name) {
  const auto place = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return static_cast<std::size_t>(place - all.begin());
}

// A video of a group: its name, and which of the recipe's backgrounds, aircraft and flights it is made of, by their
// places in the recipe's lists.
struct VideoSpec {
  std::size_t group = 0;
  std::string name;
  std::size_t background = 0;  // these three are replaced by sampled_spec() where the group samples them
  std::size_t aircraft = 0;
  std::size_t flight = 0;
};

// The spec with background, aircraft and flight sampled for it; unchanged where its group combines all of them. again:
// 0 for the first sample, increased by one each time the video is sampled again. Every sample depends on the seed, the
// video's name, the quantity and `again` alone.
[[nodiscard]] VideoSpec sampled_spec(const Recipe& recipe, VideoSpec spec, int again);

// The frame that an image of a group of images shows, of those of its background; none: it has not so many.
[[nodiscard]] std::optional<int> frame_of_image(const Recipe& recipe, const VideoSpec& spec, const FrameRange& frames);

// The video with all its quantities sampled, or the reason why there is no such video: one line that begins with the
// name of the quantity. estimator: measures the silhouettes of intruders that are placed by their size.
[[nodiscard]] Possible<PlannedVideo> sampled_video(const Recipe& recipe, const VideoSpec& spec,
                                                   const OpenedBackground& background, int again,
                                                   VideoVisibility& estimator);

}  // namespace sigs
