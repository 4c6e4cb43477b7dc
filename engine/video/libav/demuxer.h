// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The packets of a file's video stream, in the order in which they lie (decode order).
class Demuxer {
 public:
  // Errors: cannot_read (missing, not a video, no video stream), bad_data (an MP4 without its index).
  [[nodiscard]] static Result<Demuxer> open(const std::filesystem::path& path);

  [[nodiscard]] AVFormatContext& format() const { return *input_; }
  [[nodiscard]] AVStream& stream() const { return *input_->streams[stream_]; }

  // False at the end, or where the file cannot be read on; broke_off() tells the two apart.
  [[nodiscard]] bool next(AVPacket& packet);
  [[nodiscard]] bool broke_off() const { return broke_off_; }

  // Towards the keyframe at or before time (in the stream's ticks). Where it lands is for the caller to see.
  [[nodiscard]] bool seek(int64_t time);

 private:
  Demuxer(InputPtr input, int stream) : input_(std::move(input)), stream_(stream) {}

  InputPtr input_;
  int stream_ = 0;
  bool broke_off_ = false;
};

}  // namespace sigs::libav
