// SPDX-License-Identifier: MIT
#include "base/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/image.h"
#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs {

Result<void> check_image_size(cv::Size size_px) {
  const bool is_large = std::max(size_px.width, size_px.height) > kMaxImageSide_px ||
                        std::int64_t{size_px.width} * size_px.height > kMaxImagePixels;
  if (!is_large) return {};
  return fail("", fmt::format("is {}; images of at most {} pixels a side and {} million in all are read",
                              image_size_text(size_px), kMaxImageSide_px, kMaxImagePixels / 1'000'000));
}

Result<cv::Mat> read_image_file(const std::filesystem::path& path, int flags) {
  if (const Result<void> file = check_input_file(path, "image"); !file) return fail(file.error());
  const std::optional<cv::Size> size_px = image_size_px(path);
  if (size_px)
    if (const Result<void> allowed = check_image_size(*size_px); !allowed)
      return fail(path.string(), allowed.error().what);
  try {
    cv::Mat image = size_px ? image_codecs::imread(path.string(), flags) : cv::Mat();
    if (!image.empty()) return image;
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;
  }
  return fail(path.string(), "is not an image that can be read (png, jpeg, bmp, tiff, webp, pnm)");
}

}  // namespace sigs
