// SPDX-License-Identifier: MIT
#include "video/libav/encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

extern "C" {
#include <libavutil/opt.h>
}

#include "base/ensure.h"
#include "base/text.h"
#include "video/chroma.h"
#include "video/frame.h"
#include "video/libav/planes.h"
#include "video/libav/stream_info.h"

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
  static constexpr std::array<const char*, 10> kEncoders{"ffv1",  "libx264", "libx265", "libaom-av1", "mjpeg",
                                                         nullptr, nullptr,   nullptr,   "rawvideo",   nullptr};
  const char* const name = kEncoders.at(static_cast<std::size_t>(codec));
  ENSURE(name != nullptr);
  return name;
}

AVPixelFormat jpeg_format(PixelLayout layout) {
  return layout == PixelLayout::yuv420   ? AV_PIX_FMT_YUVJ420P
         : layout == PixelLayout::yuv422 ? AV_PIX_FMT_YUVJ422P
                                         : AV_PIX_FMT_YUVJ444P;
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

constexpr int kAv1Threads = 4;
constexpr int kKeyInterval = 60;  // about two seconds: an editor scrubs through it

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

std::string crf_of(const VideoFormat& format) {
  return std::to_string(std::clamp(format.crf, 0, max_crf(format.codec)));
}

void set_up_h264(AVCodecContext& context, const VideoFormat& format, const Encoding& encoding, AVDictionary** options) {
  context.thread_count = kH264Threads;
  context.gop_size = kKeyInterval;
  if (format.container == Container::avi) context.max_b_frames = 0;  // AVI has no presentation times
  // Of more than 8 bits crf 0 is not yet lossless; a quantiser of 0 is.
  const bool is_deep_lossless = encoding.bit_depth > 8 && format.crf <= 0;
  av_dict_set(options, is_deep_lossless ? "qp" : "crf", crf_of(format).c_str(), 0);
  av_dict_set(options, "x264-params", kH264Parameters, 0);
}

void set_up_hevc(AVCodecContext& context, const VideoFormat& format, AVDictionary** options) {
  context.gop_size = kKeyInterval;
  std::string parameters = kHevcParameters;
  if (format.crf <= 0) parameters += ":lossless=1";
  if (format.crf > 0) av_dict_set(options, "crf", crf_of(format).c_str(), 0);
  av_dict_set(options, "x265-params", parameters.c_str(), 0);
}

// What AV1's stream says of the chroma site (AV1 specification, 6.4.2): vertical is left, colocated is top_left; it has
// no number for midway, which only Matroska states.
int av1_chroma_position(const Encoding& encoding) {
  if (encoding.layout != PixelLayout::yuv420 || encoding.color.chroma_site == ChromaSite::center) return 0;
  return encoding.color.chroma_site == ChromaSite::left ? 1 : 2;
}

// libaom's packets depend on whether there is more than one thread, so that the number is fixed. Speed 6 of 0 to 8.
void set_up_av1(AVCodecContext& context, const VideoFormat& format, const Encoding& encoding, AVDictionary** options) {
  context.gop_size = kKeyInterval;
  context.thread_count = kAv1Threads;
  av_dict_set(options, "crf", crf_of(format).c_str(), 0);
  av_dict_set(options, "cpu-used", "6", 0);
  av_dict_set(options, "row-mt", "1", 0);
  std::string parameters = fmt::format("chroma-sample-position={}", av1_chroma_position(encoding));
  if (format.crf <= 0) parameters += ":lossless=1";
  av_dict_set(options, "aom-params", parameters.c_str(), 0);
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

bool supports(const AVCodec& encoder, AVPixelFormat format) {
  for (const AVPixelFormat* known = encoder.pix_fmts; known != nullptr && *known != AV_PIX_FMT_NONE; ++known)
    if (*known == format) return true;
  return false;
}

Result<const AVCodec*> found_encoder(const char* name) {
  const AVCodec* const encoder = avcodec_find_encoder_by_name(name);
  if (encoder == nullptr) return fail("", fmt::format("this FFmpeg has no encoder {}", name), ErrorKind::unavailable);
  return encoder;
}

Result<CodecPtr> opened(const AVCodec& encoder, CodecPtr context, AVDictionary* options) {
  const int error = avcodec_open2(context.get(), &encoder, &options);
  av_dict_free(&options);
  check_memory(error);
  if (error < 0)
    return fail("", fmt::format("the encoder {} refuses: {}", encoder.name, text_of(error)), ErrorKind::unavailable);
  return context;
}

FramePtr new_image(const AVCodecContext& encoder) {
  FramePtr image = new_frame();
  image->format = encoder.pix_fmt;
  image->width = encoder.width;
  image->height = encoder.height;
  image->color_range = encoder.color_range;
  image->colorspace = encoder.colorspace;
  return image;
}

std::vector<std::uint8_t> packet_at_once(AVCodecContext& encoder, const AVFrame& image) {
  const PacketPtr packet = new_packet();
  if (avcodec_send_frame(&encoder, &image) < 0 || avcodec_receive_packet(&encoder, packet.get()) < 0) return {};
  return {packet->data, packet->data + packet->size};
}

Result<Encoding> encoding_for(const VideoFormat& format) {
  ENSURE(format.codec != VideoCodec::png && format.codec != VideoCodec::tiff && format.codec != VideoCodec::jpeg);
  if (const Result<void> pair = check_pair(format); !pair) return fail(pair.error());
  Encoding encoding{.encoder = encoder_of(format.codec), .layout = format.layout, .color = format.color};
  if (format.codec == VideoCodec::mjpeg)
    make_jpeg(encoding);
  else if (format.codec != VideoCodec::ffv1 && format.codec != VideoCodec::raw)
    make_playable(encoding);
  if (const Result<void> size = check_size(format, encoding); !size) return fail(size.error());
  const Result<const AVCodec*> encoder = found_encoder(encoding.encoder);
  if (!encoder) return fail(encoder.error());
  if (format.codec == VideoCodec::mjpeg) {
    encoding.pixel_format = jpeg_format(encoding.layout);
  } else if (format.codec == VideoCodec::raw) {
    choose_raw_format(encoding, std::min(format.bit_depth, format.max_bit_depth));
  } else {
    const int depth = std::min(format.bit_depth, format.max_bit_depth);
    if (const Result<void> chosen = choose_format(encoding, **encoder, depth); !chosen) return fail(chosen.error());
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

Result<CodecPtr> open_encoder(const VideoFormat& format, const Encoding& encoding, AVRational tick, bool headers) {
  const Result<const AVCodec*> codec = found_encoder(encoding.encoder);
  if (!codec) return fail(codec.error());
  CodecPtr context = new_context(*codec);
  set_up_frame(*context, format, encoding, tick);
  if (headers) context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  AVDictionary* options = nullptr;
  if (format.codec == VideoCodec::ffv1) set_up_ffv1(*context, format, &options);
  if (format.codec == VideoCodec::h264) set_up_h264(*context, format, encoding, &options);
  if (format.codec == VideoCodec::hevc) set_up_hevc(*context, format, &options);
  if (format.codec == VideoCodec::av1) set_up_av1(*context, format, encoding, &options);
  if (format.codec == VideoCodec::mjpeg) set_up_mjpeg(*context, format);
  return opened(**codec, std::move(context), options);
}

}  // namespace sigs::libav
