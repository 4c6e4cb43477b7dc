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

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

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

// These throw std::bad_alloc where there is no memory; guarded() (base/guarded.h) makes an error of it.
[[nodiscard]] PacketPtr new_packet();
[[nodiscard]] FramePtr new_frame();

// Throws std::bad_alloc where that is what the error code says. A picture that could not be decoded for want of memory
// is not a damaged one.
void check_memory(int error);

// FFmpeg's words for one of its error codes.
[[nodiscard]] std::string text_of(int error);

// The path as FFmpeg takes it literally: "a:b.mkv" is a file, not a protocol.
[[nodiscard]] std::string url_of(const std::filesystem::path& path);

// FFmpeg reports to stderr, which belongs to the program's own log and progress. Errors come back as values; those a
// decoder only talks of raise the flag that its context's `opaque` points to, if any.
using Complaint = std::atomic<bool>;
void silence();

}  // namespace sigs::libav
