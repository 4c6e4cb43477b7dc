// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"

namespace sigs {

// Reads when the images of a sequence were taken, from a text file with a line for each image. A line begins with a
// time and may go on, behind blanks or a comma, with the image's name; lines that begin with # and one heading are
// passed over. Times are seconds; nanoseconds where the heading says [ns], or where they are whole numbers of 18 digits
// or more, as in EuRoC and ASL data sets.
//   images  the sequence's files, in order. Where lines name images each image gets the time of its name, else the
//           lines are in the order of the images
// Result: seconds since the first image, rising, one for each image. Errors: cannot_read; bad_data with file and line:
// no number, times that do not rise, another number of lines than of images, an image without a line.
[[nodiscard]] Result<std::vector<double>> read_image_times(const std::filesystem::path& file,
                                                           const std::vector<std::filesystem::path>& images);

}  // namespace sigs
