// SPDX-License-Identifier: MIT
#include "video/y4m_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "video/bit_depth.h"

namespace sigs {

namespace {

static_assert(std::endian::native == std::endian::little, "y4m has words with the low byte first");

// The depth in which frames are written: y4m has 8, 9, 10, 12, 14 and 16 bits, of grey 8, 9, 10, 12 and 16.
int stored_depth(const VideoFormat& format) {
  const int wanted = std::min(format.bit_depth, format.max_bit_depth);
  if (wanted == 11) return 12;
  if (wanted == 13) return format.layout == PixelLayout::gray ? 16 : 14;
  return wanted == 15 || (wanted == 14 && format.layout == PixelLayout::gray) ? 16 : wanted;
}

// The name of a layout of more than 8 bits: "C420p10", "Cmono10".
std::string deep_layout_text(PixelLayout layout, int bit_depth) {
  switch (layout) {
    case PixelLayout::gray:
      return fmt::format("Cmono{}", bit_depth);
    case PixelLayout::yuv420:
      return fmt::format("C420p{}", bit_depth);
    case PixelLayout::yuv422:
      return fmt::format("C422p{}", bit_depth);
    case PixelLayout::yuv444:
      return fmt::format("C444p{}", bit_depth);
    case PixelLayout::rgb:
      break;
  }
  return {};
}

// The name of a layout, as FFmpeg writes and reads it. Only 4:2:0 of 8 bits has chroma sites.
std::string layout_text(const VideoFormat& format) {
  if (const int depth = stored_depth(format); depth > 8) return deep_layout_text(format.layout, depth);
  switch (format.layout) {
    case PixelLayout::gray:
      return "Cmono";
    case PixelLayout::yuv422:
      return "C422";
    case PixelLayout::yuv444:
      return "C444";
    case PixelLayout::yuv420:
      break;
    case PixelLayout::rgb:
      return {};
  }
  switch (format.color.chroma_site) {
    case ChromaSite::center:
      return "C420jpeg";
    case ChromaSite::top_left:
      return "C420paldv";
    case ChromaSite::left:
      break;
  }
  return "C420mpeg2";
}

// Frames are progressive ("Ip"). The range is stated even where the footage does not: it is what was assumed of it.
std::string first_line(const VideoFormat& format, const std::string& layout) {
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A{}:{} {} XCOLORRANGE={}\n", format.size_px.width,
                     format.size_px.height, format.frame_rate_num, format.frame_rate_den, format.pixel_aspect_num,
                     format.pixel_aspect_den, layout, format.color.range == ColorRange::full ? "FULL" : "LIMITED");
}

}  // namespace

Result<Y4mFile> Y4mFile::begin(OutputStream out, const VideoFormat& format) {
  const std::string layout = layout_text(format);
  if (layout.empty())
    return fail(out.name(), "y4m has no place for RGB images; use the container nut", ErrorKind::usage);
  Y4mFile file(std::move(out), stored_depth(format));
  if (const Result<void> begun = file.out_.write(first_line(format, layout)); !begun) return fail(begun.error());
  return file;
}

Result<void> Y4mFile::write(const Frame& frame) {
  const Frame stored = with_bit_depth(frame, bit_depth_);
  bytes_ = "FRAME\n";
  for (int i = 0; i < stored.plane_count(); ++i) {
    const cv::Mat& plane = stored.planes[static_cast<std::size_t>(i)];
    for (int y = 0; y < plane.rows; ++y)
      bytes_.append(plane.ptr<char>(y), static_cast<std::size_t>(plane.cols) * plane.elemSize());
  }
  return out_.write(bytes_);
}

}  // namespace sigs
