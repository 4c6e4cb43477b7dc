// SPDX-License-Identifier: MIT
#include "video/libav/encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>

extern "C" {
#include <libavutil/opt.h>
}

#include "base/ensure.h"
#include "base/text.h"
#include "video/chroma.h"
#include "video/libav/color_tags.h"

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
    case VideoCodec::tiff:
      return "tiff";
    case VideoCodec::jpeg:
      return "jpeg";
    case VideoCodec::raw:
      return "raw";
  }
  return "";
}

Result<void> check_pair(const VideoFormat& format) {
  if (format.codec == VideoCodec::ffv1 && format.container == Container::mp4)
    return fail("", "ffv1 does not go into mp4; choose mkv or avi, or the codec h264", ErrorKind::usage);
  return {};
}

// FFmpeg's FFV1 cuts every image into slices and does not restore those that are one sample wide or high.
constexpr int kSmallestFfv1_px = 4;

// H.264's 4:2:0 and 4:2:2 images are whole chroma samples wide and high.
Result<void> check_size(const VideoFormat& format, const Encoding& encoding) {
  if (format.size_px.width <= 0 || format.size_px.height <= 0)
    return fail("", "the image is empty: " + image_size_text(format.size_px), ErrorKind::usage);
  if (format.codec == VideoCodec::ffv1 && std::min(format.size_px.width, format.size_px.height) < kSmallestFfv1_px)
    return fail(
        "", fmt::format("ffv1 cannot hold an image as small as {}; 4x4 is the least", image_size_text(format.size_px)),
        ErrorKind::usage);
  if (format.codec != VideoCodec::h264) return {};
  const cv::Size step = chroma_step(encoding.layout);
  if (format.size_px.width % step.width == 0 && format.size_px.height % step.height == 0) return {};
  return fail("",
              fmt::format("{} needs an even width and height, the image is {}; ffv1, mjpeg and png take any size",
                          name_of(format.codec), image_size_text(format.size_px)),
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

// Planes as the footage has them; RGB packed, which more programs read than its planes.
Encoding raw_encoding(const VideoFormat& format) {
  Encoding encoding = ffv1_encoding(format);
  encoding.encoder = "rawvideo";
  if (format.layout == PixelLayout::rgb) encoding.pixel_format = AV_PIX_FMT_RGB24;
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

// The same for all machines: the results of x264's motion search and lookahead depend on the number of threads, and its
// hand-written routines differ in the last bit between processors unless cpu-independent is set.
constexpr int kH264Threads = 4;
constexpr const char* kH264Parameters = "threads=4:lookahead-threads=1:sliced-threads=0:cpu-independent=1";
constexpr int kH264KeyInterval = 60;  // about two seconds: an editor scrubs through it

constexpr int kMjpegQuality = 2;  // the finest scale that FFmpeg's rate control takes

int frame_threads(int wanted) {
  return std::max(wanted, 1);
}

void set_up_ffv1(AVCodecContext& context, const VideoFormat& format, AVDictionary** options) {
  context.level = 3;  // slices with checksums
  context.gop_size = 1;
  context.slices = 0;  // chosen by the encoder from the image's size alone: four, more where that is not possible
  context.thread_count = frame_threads(format.threads);
  context.thread_type = FF_THREAD_SLICE;
  av_dict_set(options, "slicecrc", "1", 0);
}

void set_up_h264(AVCodecContext& context, const VideoFormat& format, AVDictionary** options) {
  context.thread_count = kH264Threads;
  context.gop_size = kH264KeyInterval;
  if (format.container == Container::avi) context.max_b_frames = 0;  // AVI has no presentation times
  av_dict_set(options, "crf", std::to_string(std::clamp(format.crf, 0, 51)).c_str(), 0);
  av_dict_set(options, "x264-params", kH264Parameters, 0);
}

void set_up_mjpeg(AVCodecContext& context, const VideoFormat& format) {
  context.flags |= AV_CODEC_FLAG_QSCALE;
  context.global_quality = FF_QP2LAMBDA * kMjpegQuality;
  context.qmin = context.qmax = kMjpegQuality;
  // Slices would change the bytes; images do not depend on one another.
  context.thread_count = frame_threads(format.threads);
  context.thread_type = FF_THREAD_FRAME;
}

void set_up_frame(AVCodecContext& context, const VideoFormat& format, const Encoding& encoding, AVRational tick) {
  context.width = format.size_px.width;
  context.height = format.size_px.height;
  context.pix_fmt = encoding.pixel_format;
  context.time_base = tick;
  context.framerate = {format.frame_rate_num, format.frame_rate_den};
  context.sample_aspect_ratio = {format.pixel_aspect_num, format.pixel_aspect_den};
  context.flags |= AV_CODEC_FLAG_BITEXACT;
  tag(context, encoding.color, encoding.layout);
}

}  // namespace

Result<Encoding> encoding_for(const VideoFormat& format) {
  ENSURE(format.codec != VideoCodec::png && format.codec != VideoCodec::tiff && format.codec != VideoCodec::jpeg);
  if (const Result<void> pair = check_pair(format); !pair) return fail(pair.error());
  const Encoding encoding = format.codec == VideoCodec::ffv1   ? ffv1_encoding(format)
                            : format.codec == VideoCodec::raw  ? raw_encoding(format)
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

Result<CodecPtr> open_encoder(const VideoFormat& format, const Encoding& encoding, AVRational tick, bool headers) {
  const AVCodec* codec = avcodec_find_encoder_by_name(encoding.encoder);
  if (codec == nullptr)
    return fail("", fmt::format("this FFmpeg has no encoder {}", encoding.encoder), ErrorKind::unavailable);
  CodecPtr context(avcodec_alloc_context3(codec));
  if (context == nullptr) throw std::bad_alloc();
  set_up_frame(*context, format, encoding, tick);
  if (headers) context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  AVDictionary* options = nullptr;
  if (format.codec == VideoCodec::ffv1) set_up_ffv1(*context, format, &options);
  if (format.codec == VideoCodec::h264) set_up_h264(*context, format, &options);
  if (format.codec == VideoCodec::mjpeg) set_up_mjpeg(*context, format);
  const int error = avcodec_open2(context.get(), codec, &options);
  av_dict_free(&options);
  check_memory(error);
  if (error < 0)
    return fail("", fmt::format("the encoder {} refuses: {}", encoding.encoder, text_of(error)),
                ErrorKind::unavailable);
  return context;
}

}  // namespace sigs::libav
