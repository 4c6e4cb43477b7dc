// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The packets of a file's video stream, in the order in which they lie (decode order).
class Demuxer {
 public:
  // Reads that one regular file and nothing else: no play lists, no network.
  //   cancel  set: opening, reading and seeking end soon; null or longer alive than this
  // Errors: cannot_read (missing, a device or pipe, not a video, a play list, no video stream), bad_data (an MP4
  // without its index), interrupted.
  [[nodiscard]] static Result<Demuxer> open(const std::filesystem::path& path, const std::atomic<bool>* cancel);

  [[nodiscard]] AVFormatContext& format() const { return *input_; }
  [[nodiscard]] AVStream& stream() const { return *input_->streams[stream_]; }

  // False at the end, or where the file cannot be read on; broke_off() tells the two apart.
  [[nodiscard]] bool next(AVPacket& packet);
  [[nodiscard]] bool broke_off() const { return broke_off_; }

  // Error interrupted once `cancel` is set: that next() found an end may mean no more than this.
  [[nodiscard]] Result<void> check_interrupt() const;

  // The same file from its start, by the same rules.
  [[nodiscard]] Result<Demuxer> reopened(const std::filesystem::path& path) const { return open(path, cancel_); }

  // Towards the keyframe at or before time (in the stream's ticks). Where it lands is for the caller to see.
  [[nodiscard]] bool seek(int64_t time);

 private:
  Demuxer(InputPtr input, int stream, const std::atomic<bool>* cancel)
      : input_(std::move(input)), stream_(stream), cancel_(cancel) {}

  InputPtr input_;
  int stream_ = 0;
  const std::atomic<bool>* cancel_ = nullptr;
  bool broke_off_ = false;
};

}  // namespace sigs::libav
