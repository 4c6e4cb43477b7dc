// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"

namespace sigs {

// A video in images, one file for each frame: a folder of images, or a path with a place for a number
// (base/numbered_files.h). Nothing is opened here: 100,000 files are listed in a moment.

// When the images of a sequence were taken, since their files do not say. Videos have their own times.
struct SequenceTiming {
  double frame_rate_hz = 0;          // 0: not known, kDefaultSequenceRate_hz is taken with a warning
  std::filesystem::path times_file;  // a line for each image (read_image_times()); empty: evenly spaced

  [[nodiscard]] bool operator==(const SequenceTiming&) const = default;
};
inline constexpr double kDefaultSequenceRate_hz = 25;

struct ImageSequence {
  std::vector<std::filesystem::path> files;  // of frames 0, 1, ...; never empty
  std::vector<double> times_s;               // of each, 0 for the first
  int frame_rate_num = 25;                   // nominal
  int frame_rate_den = 1;
  bool variable_frame_rate = false;
  std::vector<Warning> warnings;
};

// Whether a path names images and not a video: it is a folder, or a pattern of numbers that is no file.
[[nodiscard]] bool is_image_sequence(const std::filesystem::path& path);

// The files alone. Of a folder its PNG, TIFF and JPEG files (by extension, hidden ones left out) in natural order of
// their names; they are of one kind. Of a pattern files_of_pattern(): a missing number is an error.
// Errors: cannot_read (no folder, no images), bad_data (a missing number, images of several kinds).
[[nodiscard]] Result<std::vector<std::filesystem::path>> files_of_sequence(const std::filesystem::path& path);

// The files with their times. A folder in which a few numbers are missing gives a warning: names may be times.
// Errors: as above, and those of read_image_times().
[[nodiscard]] Result<ImageSequence> listed_sequence(const std::filesystem::path& path, const SequenceTiming& timing);

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
