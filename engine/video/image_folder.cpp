// SPDX-License-Identifier: MIT
#include "video/image_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <vector>

#include "base/image_codecs.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// One channel for gray, else BGR, of 8 or 16 bits.
cv::Mat stored_image(const Frame& frame, int bit_depth) {
  cv::Mat image = bit_depth > 8 ? bgr16_of(frame) : bgr_of(frame);
  if (frame.layout == PixelLayout::gray) cv::extractChannel(image, image, 0);
  return image;
}

std::vector<int> parameters_of(const VideoFormat& format) {
  if (format.codec == VideoCodec::jpeg) return {cv::IMWRITE_JPEG_QUALITY, format.jpeg_quality};
  return {};
}

}  // namespace

bool writes_images(VideoCodec codec) {
  return *image_extension_of(codec) != '\0';
}

const char* image_extension_of(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::png:
      return ".png";
    case VideoCodec::tiff:
      return ".tiff";
    case VideoCodec::jpeg:
      return ".jpg";
    default:
      return "";
  }
}

Result<void> write_numbered_image(const fs::path& folder, const VideoFormat& format, const Frame& frame, int number) {
  const char* const extension = image_extension_of(format.codec);
  const int depth = std::min({frame.bit_depth, format.max_bit_depth, max_bit_depth(format.codec)});
  const fs::path path = folder / fmt::format("frame_{:06}{}", number, extension);
  std::vector<uchar> bytes;
  try {
    image_codecs::imencode(extension, stored_image(frame, depth), bytes, parameters_of(format));
  } catch (const cv::Exception& problem) {
    return fail(path.string(), fmt::format("cannot be written as an image ({}): {}", extension, problem.err),
                ErrorKind::write_failed);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return fail(path.string(), fmt::format("could not be written: {}", std::strerror(errno)), ErrorKind::write_failed);
  return {};
}

}  // namespace sigs
