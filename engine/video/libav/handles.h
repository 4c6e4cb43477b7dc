// SPDX-License-Identifier: MIT
#pragma once

// Owners for the types of the FFmpeg libraries, and their errors and reports. Private to the module: nothing outside
// engine/video includes engine/video/libav.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/frame.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs::libav {

struct Deleter {
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(SwsContext* context) const { sws_freeContext(context); }
};

using InputPtr = std::unique_ptr<AVFormatContext, Deleter>;
using CodecPtr = std::unique_ptr<AVCodecContext, Deleter>;
using PacketPtr = std::unique_ptr<AVPacket, Deleter>;
using FramePtr = std::unique_ptr<AVFrame, Deleter>;
using ScalerPtr = std::unique_ptr<SwsContext, Deleter>;

// These throw std::bad_alloc where there is no memory; guarded() (base/threads.h) makes an error of it.
[[nodiscard]] PacketPtr new_packet();
[[nodiscard]] PacketPtr new_packet(std::string_view bytes);  // a copy
[[nodiscard]] FramePtr new_frame();
[[nodiscard]] CodecPtr new_context(const AVCodec* codec);

// Memory that an image needs, 1 or more.
[[nodiscard]] std::size_t bytes_of(const AVFrame& frame);

// Throws std::bad_alloc where the error code means a lack of memory: an image that could not be decoded for that reason
// is not a damaged one.
void check_memory(int error);

// FFmpeg's text for one of its error codes.
[[nodiscard]] std::string text_of(int error);

// The error with the file's path where it names no place yet. An interruption is not about a file.
[[nodiscard]] Error named(Error error, const std::filesystem::path& path);

// The URL by which FFmpeg takes a path literally: "a:b.mkv" is a file, not a protocol.
[[nodiscard]] std::string url_of(const std::filesystem::path& path);

// Stops FFmpeg from writing to stderr, which belongs to the program's own messages. What a decoder reports goes to the
// DecoderErrors of the packet that it concerns, if any.
void silence();

// Collects the packets for which a decoder reports an error. It may be called from the decoder's worker threads.
class DecoderErrors {
 public:
  // Clears the collection.
  //   first  ordinal of the packet at which decoding begins; that images before it are missing is no error
  void restart(int first);

  // The value for a decoder's `opaque` while a packet is given to it, by which reports identify the packet. FFmpeg
  // passes it on to the thread that decodes the packet.
  [[nodiscard]] void* tag_of(int ordinal);

  // The ordinals of the packets reported since the last call.
  [[nodiscard]] std::vector<int> taken();

  // Called by the log of FFmpeg.
  //   tag       from tag_of()
  //   of_a_gap  the report is about a missing reference image
  static void report(void* tag, bool of_a_gap);

 private:
  struct Tag {
    DecoderErrors* decoder_errors = nullptr;
    int ordinal = 0;
  };
  std::array<Tag, 64> tags_;  // more than a decoder has threads
  int first_ = 0;
  std::mutex mutex_;
  std::vector<int> ordinals_;
};

}  // namespace sigs::libav
