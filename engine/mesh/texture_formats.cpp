// SPDX-License-Identifier: MIT
#include "mesh/materials.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <cstring>
#include <memory>
#include <new>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr std::size_t kHeader_bytes = 18;  // of Targa; what is needed of SGI's ends before

int byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

bool is_sgi(std::string_view bytes) {
  return byte_at(bytes, 0) == 0x01 && byte_at(bytes, 1) == 0xDA;
}

// Truevision, "TGA File Format Specification", version 2.0.
bool is_targa(std::string_view bytes) {
  const int type = byte_at(bytes, 2), depth = byte_at(bytes, 16);
  const bool is_known_type = (type >= 1 && type <= 3) || (type >= 9 && type <= 11);
  const bool is_known_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
  return byte_at(bytes, 1) <= 1 && is_known_type && is_known_depth;
}

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    kFree(&object);
  }
};
using Context = std::unique_ptr<AVCodecContext, Freed<avcodec_free_context>>;
using Packet = std::unique_ptr<AVPacket, Freed<av_packet_free>>;
using Decoded = std::unique_ptr<AVFrame, Freed<av_frame_free>>;

// An object of FFmpeg's, which are none where there is no memory.
template <class Owner>
Owner owned(Owner object) {
  if (!object) throw std::bad_alloc();
  return object;
}

Decoded decoded(std::string_view bytes, AVCodecID id) {
  const AVCodec* const codec = avcodec_find_decoder(id);
  if (codec == nullptr) return {};
  const auto context = owned(Context(avcodec_alloc_context3(codec)));
  const auto packet = owned(Packet(av_packet_alloc()));
  auto frame = owned(Decoded(av_frame_alloc()));
  context->thread_count = 1;
  context->log_level_offset = AV_LOG_TRACE;  // what is wrong is said by the caller
  if (av_new_packet(packet.get(), static_cast<int>(bytes.size())) < 0) throw std::bad_alloc();
  std::memcpy(packet->data, bytes.data(), bytes.size());
  const bool is_read = avcodec_open2(context.get(), codec, nullptr) >= 0 &&
                       avcodec_send_packet(context.get(), packet.get()) >= 0 &&
                       avcodec_receive_frame(context.get(), frame.get()) >= 0;
  return is_read ? std::move(frame) : Decoded();
}

cv::Mat as_image(const AVFrame& frame) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  const AVPixFmtDescriptor& layout = *av_pix_fmt_desc_get(format);
  const bool has_opacity = (layout.flags & (AV_PIX_FMT_FLAG_ALPHA | AV_PIX_FMT_FLAG_PAL)) != 0;
  const int channels = has_opacity ? 4 : layout.nb_components < 3 ? 1 : 3;
  const AVPixelFormat wanted = has_opacity ? AV_PIX_FMT_BGRA : channels == 1 ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_BGR24;
  cv::Mat image(frame.height, frame.width, CV_8UC(channels));
  const auto free_context = [](SwsContext* context) { sws_freeContext(context); };
  const std::unique_ptr<SwsContext, decltype(free_context)> converter(
      sws_getContext(frame.width, frame.height, format, frame.width, frame.height, wanted,
                     SWS_POINT | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr),
      free_context);
  if (!converter) throw std::bad_alloc();
  uint8_t* const rows[4]{image.data, nullptr, nullptr, nullptr};
  const int strides[4]{static_cast<int>(image.step), 0, 0, 0};
  sws_scale(converter.get(), frame.data, frame.linesize, 0, frame.height, rows, strides);
  return image;
}

}  // namespace

std::optional<cv::Size> texture_size_px(std::string_view bytes) {
  if (bytes.size() < kHeader_bytes) return std::nullopt;
  const auto pair_at = [&](std::size_t high, std::size_t low) {
    return 256 * byte_at(bytes, high) + byte_at(bytes, low);
  };
  const cv::Size size_px = is_sgi(bytes)     ? cv::Size(pair_at(6, 7), pair_at(8, 9))
                           : is_targa(bytes) ? cv::Size(pair_at(13, 12), pair_at(15, 14))
                                             : cv::Size();
  return size_px.empty() ? std::nullopt : std::optional(size_px);
}

cv::Mat decoded_texture(std::string_view bytes) {
  const std::optional<cv::Size> size_px = texture_size_px(bytes);
  if (!size_px) return {};
  const Decoded frame = decoded(bytes, is_sgi(bytes) ? AV_CODEC_ID_SGI : AV_CODEC_ID_TARGA);
  if (!frame || frame->width != size_px->width || frame->height != size_px->height) return {};
  return as_image(*frame);
}

}  // namespace sigs
