// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>

extern "C" {
#include <libavutil/opt.h>
}

#include "video/libav/color_tags.h"
#include "video/libav/encoding.h"

namespace sigs::libav {
namespace {

// The same for all machines: the results of x264's motion search and lookahead depend on the number of threads, and its
// hand-written routines differ in the last bit between processors unless cpu-independent is set.
constexpr int kH264Threads = 4;
constexpr int kAv1Threads = 4;
constexpr const char* kH264Parameters = "threads=4:lookahead-threads=1:sliced-threads=0:cpu-independent=1";
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

// The results of x265 depend on how many frames it codes at a time, so that their number is fixed. Without its
// statement of version and options, and without its messages.
constexpr const char* kHevcParameters = "pools=4:frame-threads=2:info=0:log-level=none";

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
  if (format.codec == VideoCodec::h264) set_up_h264(*context, format, encoding, &options);
  if (format.codec == VideoCodec::hevc) set_up_hevc(*context, format, &options);
  if (format.codec == VideoCodec::av1) set_up_av1(*context, format, encoding, &options);
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
