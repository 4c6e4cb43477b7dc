// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/result.h"

// OpenCV's functions for image files, as opencv2/imgcodecs.hpp describes them. Their library needs 79 others that
// nothing else uses (GDAL, HDF5, clients of databases), which take longer to load than most commands take to run: so it
// is loaded at the first call that needs it: PNG files of 8 bits are read by IMREAD_UNCHANGED, and PNG is encoded
// without parameters, by libpng, with the same samples and bytes. Where loading fails, as when memory is short, they
// throw std::system_error (ELIBACC), which says why: it is no cv::Exception, by which callers know a damaged image.
// Other code calls these and not OpenCV's own, as the library would be linked, and loaded at each start, by one call.
namespace sigs::image_codecs {

[[nodiscard]] cv::Mat imread(const std::string& file, int flags = cv::IMREAD_COLOR);
[[nodiscard]] cv::Mat imdecode(cv::InputArray bytes, int flags);
bool imwrite(const std::string& file, cv::InputArray image, const std::vector<int>& parameters = {});
bool imencode(const std::string& extension, cv::InputArray image, std::vector<uchar>& bytes,
              const std::vector<int>& parameters = {});

}  // namespace sigs::image_codecs

namespace sigs {

// Images of strangers: how large they may be, and reading them as a whole.

// The largest images that are decoded, of footage as of files: a side, and pixels in all (docs/limits.md). With four
// samples of 16 bits a pixel they have a gigabyte.
inline constexpr int kMaxImageSide_px = 16384;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 27;

// Refuses larger ones, whatever a header claims, before memory is taken for them. Error bad_data with an empty place.
[[nodiscard]] Result<void> check_image_size(cv::Size size_px);

// The pixels of a file as cv::imread gives them. Of the kinds of image_size_px() (base/image.h) alone, since only there
// the size is known before anything is decoded.
//   flags  cv::IMREAD_...
// Errors: cannot_read (as check_input_file()), bad_data (no such image, damaged, larger than check_image_size()
// allows).
[[nodiscard]] Result<cv::Mat> read_image_file(const std::filesystem::path& path, int flags);

}  // namespace sigs
