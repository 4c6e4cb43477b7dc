// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "annotation/annotation.h"
#include "base/result.h"

namespace sigs {

// How a format calls the pictures of a sequence: 000001.png, 000002.png, ...
struct PictureNumbers {
  int first = 0;   // number of the film's first picture
  int digits = 6;  // with zeros in front
};

// Gives the pictures of all frames that the footage's range holds a second name in a folder, which is made. `pictures`
// holds them as picture_name() calls them; empty: there are none, and nothing is made. Errors cannot_create,
// write_failed.
[[nodiscard]] Result<void> link_numbered(const std::filesystem::path& pictures, const FootageTruth& footage,
                                         const std::filesystem::path& folder, PictureNumbers numbers);

}  // namespace sigs
