// SPDX-License-Identifier: MIT
#pragma once

// Private to this room: the FFmpeg libraries' types with owners. Nothing outside engine/video includes
// engine/video/libav.

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
#include <string>
#include <vector>

namespace sigs::libav {

struct Deleter {
  void operator()(AVFormatContext* context) const;  // of an input
  void operator()(AVCodecContext* context) const;
  void operator()(AVPacket* packet) const;
  void operator()(AVFrame* frame) const;
  void operator()(SwsContext* context) const;
};

using InputPtr = std::unique_ptr<AVFormatContext, Deleter>;
using CodecPtr = std::unique_ptr<AVCodecContext, Deleter>;
using PacketPtr = std::unique_ptr<AVPacket, Deleter>;
using FramePtr = std::unique_ptr<AVFrame, Deleter>;
using ScalerPtr = std::unique_ptr<SwsContext, Deleter>;

// These throw std::bad_alloc where there is no memory; guarded() (base/threads.h) makes an error of it.
[[nodiscard]] PacketPtr new_packet();
[[nodiscard]] FramePtr new_frame();

// Throws std::bad_alloc where that is what the error code says. An image that could not be decoded for want of memory
// is not a damaged one.
void check_memory(int error);

// FFmpeg's words for one of its error codes.
[[nodiscard]] std::string text_of(int error);

// The path as FFmpeg takes it literally: "a:b.mkv" is a file, not a protocol.
[[nodiscard]] std::string url_of(const std::filesystem::path& path);

// FFmpeg reports to stderr, which belongs to the program's own log and progress. silence() turns that off; what a
// decoder reports goes to the DecoderErrors of the packet it is about, if any.
void silence();

// The packets of which a decoder reports that something is wrong with them. Its worker threads report too.
class DecoderErrors {
 public:
  // Forgets all. first: ordinal of the packet that decoding begins at; what is missing before it is not missed.
  void restart(int first);

  // To be a decoder's `opaque` while a packet goes into it, so that reports name the packet. FFmpeg hands it on to the
  // thread that decodes that packet.
  [[nodiscard]] void* tag_of(int ordinal);

  // The ordinals of the packets complained of since the last call.
  [[nodiscard]] std::vector<int> taken();

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
