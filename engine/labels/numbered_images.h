// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"
#include "truth/annotation.h"

namespace sigs {

// How a format calls the images of a sequence: 000001.png, 000002.png, ...
struct ImageNumbers {
  int first = 0;   // number of the clip's first image
  int digits = 6;  // with zeros in front
};

// Gives the images of all frames that the footage's range holds a second name in a folder, which is made. `images`
// holds them as image_name() calls them; empty: there are none, and nothing is made. Errors cannot_create,
// write_failed.
[[nodiscard]] Result<void> link_numbered_images(const std::filesystem::path& images, const FootageTruth& footage,
                                                const std::filesystem::path& folder, ImageNumbers numbers);

}  // namespace sigs
