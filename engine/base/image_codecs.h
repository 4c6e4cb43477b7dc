// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

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
