// SPDX-License-Identifier: MIT
#include "video/libav/encoding.h"

#include <algorithm>
#include <string>

#include "base/ensure.h"
#include "video/chroma.h"

namespace sigs::libav {
namespace {

const char* name_of(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::ffv1:
      return "ffv1";
    case VideoCodec::h264:
      return "h264";
    case VideoCodec::mjpeg:
      return "mjpeg";
    case VideoCodec::png:
      return "png";
  }
  return "";
}

Result<void> check_pair(const VideoFormat& format) {
  if (format.codec == VideoCodec::ffv1 && format.container == Container::mp4)
    return fail("", "ffv1 does not go into mp4; choose mkv or avi, or the codec h264", ErrorKind::usage);
  return {};
}

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// FFmpeg's FFV1 cuts every image into slices and does not give back those that are one sample wide or high.
constexpr int kSmallestFfv1_px = 4;

// H.264's 4:2:0 and 4:2:2 images are whole chroma samples wide and high.
Result<void> check_size(const VideoFormat& format, const Encoding& encoding) {
  if (format.size_px.width <= 0 || format.size_px.height <= 0)
    return fail("", "the image is empty: " + size_text(format.size_px), ErrorKind::usage);
  if (format.codec == VideoCodec::ffv1 && std::min(format.size_px.width, format.size_px.height) < kSmallestFfv1_px)
    return fail("", "ffv1 cannot hold an image as small as " + size_text(format.size_px) + "; 4x4 is the least",
                ErrorKind::usage);
  if (format.codec != VideoCodec::h264) return {};
  const cv::Size step = chroma_step(encoding.layout);
  if (format.size_px.width % step.width == 0 && format.size_px.height % step.height == 0) return {};
  return fail("",
              std::string(name_of(format.codec)) + " needs an even width and height, the image is " +
                  size_text(format.size_px) + "; ffv1, mjpeg and png take any size",
              ErrorKind::usage);
}

Encoding ffv1_encoding(const VideoFormat& format) {
  Encoding encoding{.encoder = "ffv1", .layout = format.layout, .color = format.color};
  switch (format.layout) {
    case PixelLayout::gray:
      encoding.pixel_format = AV_PIX_FMT_GRAY8;
      break;
    case PixelLayout::yuv420:
      encoding.pixel_format = AV_PIX_FMT_YUV420P;
      break;
    case PixelLayout::yuv422:
      encoding.pixel_format = AV_PIX_FMT_YUV422P;
      break;
    case PixelLayout::yuv444:
      encoding.pixel_format = AV_PIX_FMT_YUV444P;
      break;
    case PixelLayout::rgb:
      encoding.pixel_format = AV_PIX_FMT_0RGB32;
      break;
  }
  return encoding;
}

Encoding h264_encoding(const VideoFormat& format) {
  Encoding encoding{.encoder = "libx264", .layout = format.layout, .color = format.color};
  if (format.layout == PixelLayout::gray) {
    encoding.layout = PixelLayout::yuv420;
  } else if (format.layout == PixelLayout::rgb) {
    encoding.layout = PixelLayout::yuv444;
    encoding.color.range = ColorRange::limited;
    encoding.color.matrix = ColorMatrix::bt709;
    encoding.color.range_stated = encoding.color.matrix_stated = true;
  }
  encoding.pixel_format = encoding.layout == PixelLayout::yuv420   ? AV_PIX_FMT_YUV420P
                          : encoding.layout == PixelLayout::yuv422 ? AV_PIX_FMT_YUV422P
                                                                   : AV_PIX_FMT_YUV444P;
  return encoding;
}

Encoding mjpeg_encoding(const VideoFormat& format) {
  Encoding encoding{.encoder = "mjpeg", .layout = format.layout, .color = format.color};
  if (format.layout == PixelLayout::gray) encoding.layout = PixelLayout::yuv420;
  if (format.layout == PixelLayout::rgb) encoding.layout = PixelLayout::yuv444;
  encoding.color.range = ColorRange::full;
  encoding.color.matrix = ColorMatrix::bt601;
  encoding.color.chroma_site = ChromaSite::center;
  encoding.color.range_stated = encoding.color.matrix_stated = true;
  encoding.pixel_format = encoding.layout == PixelLayout::yuv420   ? AV_PIX_FMT_YUVJ420P
                          : encoding.layout == PixelLayout::yuv422 ? AV_PIX_FMT_YUVJ422P
                                                                   : AV_PIX_FMT_YUVJ444P;
  return encoding;
}

bool means_the_same(const ColorInfo& a, const ColorInfo& b, PixelLayout layout) {
  return a.range == b.range && a.matrix == b.matrix &&
         (a.chroma_site == b.chroma_site || layout == PixelLayout::yuv444);
}

Frame with_neutral_chroma(const Frame& gray, PixelLayout layout) {
  Frame frame = gray;
  frame.layout = layout;
  frame.planes[1] = cv::Mat(chroma_size(layout, gray.size_px()), CV_8UC1, cv::Scalar(128));
  frame.planes[2] = frame.planes[1];
  return frame;
}

}  // namespace

Result<Encoding> encoding_for(const VideoFormat& format) {
  ENSURE(format.codec != VideoCodec::png);
  if (const Result<void> pair = check_pair(format); !pair) return fail(pair.error());
  const Encoding encoding = format.codec == VideoCodec::ffv1   ? ffv1_encoding(format)
                            : format.codec == VideoCodec::h264 ? h264_encoding(format)
                                                               : mjpeg_encoding(format);
  if (const Result<void> size = check_size(format, encoding); !size) return fail(size.error());
  return encoding;
}

Frame stored(const Frame& frame, const Encoding& encoding) {
  const bool gray = frame.layout == PixelLayout::gray && encoding.layout != PixelLayout::gray;
  if (frame.layout == encoding.layout && (frame.layout == PixelLayout::gray || frame.layout == PixelLayout::rgb ||
                                          means_the_same(frame.color, encoding.color, encoding.layout)))
    return frame;
  if (gray && frame.color.range == encoding.color.range) return with_neutral_chroma(frame, encoding.layout);
  return frame_of_bgr(bgr_of(frame), encoding.layout, encoding.color);
}

}  // namespace sigs::libav
