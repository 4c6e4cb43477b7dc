// SPDX-License-Identifier: MIT
#include "video/png_sequence.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace sigs {
namespace {

std::string image_name(int number) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%06d.png", number);
  return name.data();
}

cv::Mat av_frame_of(const Frame& frame) {
  cv::Mat image = bgr_of(frame);
  if (frame.layout == PixelLayout::gray) cv::extractChannel(image, image, 0);
  return image;
}

}  // namespace

Result<void> write_png(const std::filesystem::path& folder, const Frame& frame, int number) {
  const std::filesystem::path path = folder / image_name(number);
  std::vector<uchar> bytes;
  try {
    cv::imencode(".png", av_frame_of(frame), bytes);
  } catch (const cv::Exception& problem) {
    return fail(path.string(), "cannot be written as PNG: " + problem.err, ErrorKind::write_failed);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return fail(path.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return {};
}

}  // namespace sigs
