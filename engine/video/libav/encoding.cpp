// SPDX-License-Identifier: MIT
#include "video/libav/encoding.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/ensure.h"
#include "base/text.h"
#include "video/bit_depth.h"
#include "video/chroma.h"
#include "video/libav/planes.h"

namespace sigs::libav {
namespace {

Result<void> check_pair(const VideoFormat& format) {
  if (format.codec == VideoCodec::ffv1 && format.container == Container::mp4)
    return fail("", "ffv1 does not go into mp4; choose mkv or avi, or the codec h264", ErrorKind::usage);
  const bool is_new = format.codec == VideoCodec::hevc || format.codec == VideoCodec::av1;
  if (is_new && format.container == Container::avi)
    return fail("", fmt::format("{} does not go into avi; choose mkv or mp4", name_of(format.codec)), ErrorKind::usage);
  return {};
}

// FFmpeg's FFV1 cuts every image into slices and does not restore those that are one sample wide or high.
constexpr int kSmallestFfv1_px = 4;

// H.264's and HEVC's 4:2:0 and 4:2:2 images are whole chroma samples wide and high.
Result<void> check_size(const VideoFormat& format, const Encoding& encoding) {
  if (format.size_px.width <= 0 || format.size_px.height <= 0)
    return fail("", "the image is empty: " + image_size_text(format.size_px), ErrorKind::usage);
  if (format.codec == VideoCodec::ffv1 && std::min(format.size_px.width, format.size_px.height) < kSmallestFfv1_px)
    return fail(
        "", fmt::format("ffv1 cannot hold an image as small as {}; 4x4 is the least", image_size_text(format.size_px)),
        ErrorKind::usage);
  if (format.codec != VideoCodec::h264 && format.codec != VideoCodec::hevc) return {};
  const cv::Size step = chroma_step(encoding.layout);
  if (format.size_px.width % step.width == 0 && format.size_px.height % step.height == 0) return {};
  return fail("",
              fmt::format("{} needs an even width and height, the image is {}; ffv1, av1, mjpeg and png take any size",
                          name_of(format.codec), image_size_text(format.size_px)),
              ErrorKind::usage);
}

// Gray and RGB as codecs for players store them.
void make_playable(Encoding& encoding) {
  if (encoding.layout == PixelLayout::gray) {
    encoding.layout = PixelLayout::yuv420;
  } else if (encoding.layout == PixelLayout::rgb) {
    encoding.layout = PixelLayout::yuv444;
    encoding.color.range = ColorRange::limited;
    encoding.color.matrix = ColorMatrix::bt709;
    encoding.color.range_stated = encoding.color.matrix_stated = true;
  }
}

void make_jpeg(Encoding& encoding) {
  if (encoding.layout == PixelLayout::gray) encoding.layout = PixelLayout::yuv420;
  if (encoding.layout == PixelLayout::rgb) encoding.layout = PixelLayout::yuv444;
  encoding.color.range = ColorRange::full;
  encoding.color.matrix = ColorMatrix::bt601;
  encoding.color.chroma_site = ChromaSite::center;
  encoding.color.range_stated = encoding.color.matrix_stated = true;
}

const char* encoder_of(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::ffv1:
      return "ffv1";
    case VideoCodec::h264:
      return "libx264";
    case VideoCodec::hevc:
      return "libx265";
    case VideoCodec::av1:
      return "libaom-av1";
    case VideoCodec::mjpeg:
      return "mjpeg";
    case VideoCodec::raw:
      return "rawvideo";
    case VideoCodec::png:
    case VideoCodec::tiff:
    case VideoCodec::jpeg:
      break;
  }
  ENSURE(false);
}

AVPixelFormat jpeg_format(PixelLayout layout) {
  return layout == PixelLayout::yuv420   ? AV_PIX_FMT_YUVJ420P
         : layout == PixelLayout::yuv422 ? AV_PIX_FMT_YUVJ422P
                                         : AV_PIX_FMT_YUVJ444P;
}

bool supports(const AVCodec& encoder, AVPixelFormat format) {
  for (const AVPixelFormat* known = encoder.pix_fmts; known != nullptr && *known != AV_PIX_FMT_NONE; ++known)
    if (*known == format) return true;
  return false;
}

// Sets the pixel format: of the wanted depth, else of the next higher that the encoder has, else of its highest.
Result<void> choose_format(Encoding& encoding, const AVCodec& encoder, int wanted_depth) {
  for (const int direction : {1, -1})
    for (int depth = wanted_depth; depth >= 8 && depth <= 16; depth += direction) {
      const AVPixelFormat format = pixel_format_of(encoding.layout, depth, /*packed_rgb=*/true);
      if (format == AV_PIX_FMT_NONE || !supports(encoder, format)) continue;
      encoding.bit_depth = depth;
      encoding.pixel_format = format;
      return {};
    }
  return fail("", fmt::format("the encoder {} of this FFmpeg has no format for such images", encoder.name),
              ErrorKind::unavailable);
}

// Planes as the footage has them, of the wanted depth or the next higher one that FFmpeg has; 8-bit RGB packed, which
// more programs read than its planes.
void choose_raw_format(Encoding& encoding, int wanted_depth) {
  for (encoding.bit_depth = wanted_depth; encoding.bit_depth <= 16; ++encoding.bit_depth) {
    const bool is_packed = encoding.layout == PixelLayout::rgb && encoding.bit_depth == 8;
    encoding.pixel_format = is_packed ? AV_PIX_FMT_RGB24 : pixel_format_of(encoding.layout, encoding.bit_depth);
    if (encoding.pixel_format != AV_PIX_FMT_NONE) return;
  }
  ENSURE(false);  // there is each layout of 16 bits
}

bool means_the_same(const ColorInfo& a, const ColorInfo& b, PixelLayout layout) {
  return a.range == b.range && a.matrix == b.matrix &&
         (a.chroma_site == b.chroma_site || layout == PixelLayout::yuv444);
}

Frame with_neutral_chroma(const Frame& gray, PixelLayout layout) {
  Frame frame = gray;
  frame.layout = layout;
  const double middle = 128 * codes_per_8_bit_step(gray.bit_depth);
  frame.planes[1] = cv::Mat(chroma_size(layout, gray.size_px()), plane_type(gray.bit_depth), cv::Scalar(middle));
  frame.planes[2] = frame.planes[1];
  return frame;
}

}  // namespace

Result<Encoding> encoding_for(const VideoFormat& format) {
  ENSURE(format.codec != VideoCodec::png && format.codec != VideoCodec::tiff && format.codec != VideoCodec::jpeg);
  if (const Result<void> pair = check_pair(format); !pair) return fail(pair.error());
  Encoding encoding{.encoder = encoder_of(format.codec), .layout = format.layout, .color = format.color};
  if (format.codec == VideoCodec::mjpeg)
    make_jpeg(encoding);
  else if (format.codec != VideoCodec::ffv1 && format.codec != VideoCodec::raw)
    make_playable(encoding);
  if (const Result<void> size = check_size(format, encoding); !size) return fail(size.error());
  const AVCodec* const encoder = avcodec_find_encoder_by_name(encoding.encoder);
  if (encoder == nullptr)
    return fail("", fmt::format("this FFmpeg has no encoder {}", encoding.encoder), ErrorKind::unavailable);
  if (format.codec == VideoCodec::mjpeg) {
    encoding.pixel_format = jpeg_format(encoding.layout);
  } else if (format.codec == VideoCodec::raw) {
    choose_raw_format(encoding, std::min(format.bit_depth, format.max_bit_depth));
  } else {
    const int depth = std::min(format.bit_depth, format.max_bit_depth);
    if (const Result<void> chosen = choose_format(encoding, *encoder, depth); !chosen) return fail(chosen.error());
  }
  return encoding;
}

Frame stored(const Frame& frame, const Encoding& encoding) {
  const bool gray = frame.layout == PixelLayout::gray && encoding.layout != PixelLayout::gray;
  if (frame.layout == encoding.layout && (frame.layout == PixelLayout::gray || frame.layout == PixelLayout::rgb ||
                                          means_the_same(frame.color, encoding.color, encoding.layout)))
    return with_bit_depth(frame, encoding.bit_depth);
  if (gray && frame.color.range == encoding.color.range)
    return with_neutral_chroma(with_bit_depth(frame, encoding.bit_depth), encoding.layout);
  const cv::Mat bgr = frame.bit_depth > 8 ? bgr16_of(frame) : bgr_of(frame);
  return frame_of_bgr(bgr, encoding.layout, encoding.color, encoding.bit_depth);
}

}  // namespace sigs::libav
