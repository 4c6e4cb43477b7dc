// SPDX-License-Identifier: MIT
#include "video/y4m_file.h"

#include <fmt/format.h>

#include <utility>

namespace sigs {

namespace {

// The name of a layout, as FFmpeg writes and reads it.
std::string layout_text(const VideoFormat& format) {
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
  Y4mFile file(std::move(out));
  if (const Result<void> begun = file.out_.write(first_line(format, layout)); !begun) return fail(begun.error());
  return file;
}

Result<void> Y4mFile::write(const Frame& frame) {
  bytes_ = "FRAME\n";
  for (int i = 0; i < frame.plane_count(); ++i) {
    const cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    for (int y = 0; y < plane.rows; ++y)
      bytes_.append(plane.ptr<char>(y), static_cast<std::size_t>(plane.cols) * plane.elemSize());
  }
  return out_.write(bytes_);
}

}  // namespace sigs
