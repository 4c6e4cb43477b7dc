// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace sigs::bench {

// Strips of enlarged frames, 60 frames apart, each around the same point of the background: above with the camera's
// attitude constant, below with the estimated one. One PNG for each distance, in the folder `images`. The strips show
// the footage, which need not be ours to publish.
void draw_strips(const std::string& clip, const std::filesystem::path& folder, const std::filesystem::path& images);

// The same of our own footage, for docs/images.
void draw_figure(const std::filesystem::path& folder, const std::filesystem::path& figure);

}  // namespace sigs::bench
