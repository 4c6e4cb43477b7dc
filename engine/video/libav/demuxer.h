// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The error of work that `cancel` has ended.
[[nodiscard]] tl::unexpected<Error> interrupted();

// Opens one regular file as a container and looks at its streams; no playlists, no network. Which streams are there is
// the caller's to see: a file of sound or of data alone opens too.
//   cancel  while it is true, opening, reading and seeking soon end; null, or outlives the input
// Errors: cannot_read (missing, a device or pipe, no container, a playlist), bad_data (an MP4 without its index, images
// that check_image_size() refuses), interrupted.
[[nodiscard]] Result<InputPtr> open_input(const std::filesystem::path& path, const std::atomic<bool>* cancel);

// The stream whose images are the file's video, as FrameSource reads it: no cover image, no text drawn as images.
// Negative: there is none.
[[nodiscard]] int video_stream_of(AVFormatContext& input);

// Whether the container's time stamps and key flags are those of the file rather than guesses: MP4 and Matroska.
[[nodiscard]] bool has_true_time_stamps(const AVFormatContext& format);

// Reads the packets of a file's video stream, in the order in which they are stored (order of decoding).
class Demuxer {
 public:
  // Opens one regular file and nothing else: no playlists, no network.
  //   cancel  while it is true, opening, reading and seeking soon end; null, or outlives the demuxer
  // Errors: cannot_read (missing, a device or pipe, not a video, a playlist, no video stream), bad_data (an MP4
  // without its index), interrupted.
  [[nodiscard]] static Result<Demuxer> open(const std::filesystem::path& path, const std::atomic<bool>* cancel);

  [[nodiscard]] AVFormatContext& format() const { return *input_; }
  [[nodiscard]] AVStream& stream() const { return *input_->streams[stream_]; }

  // Reads the next packet. False at the end, or where the file cannot be read on: then broke_off() is true.
  [[nodiscard]] bool next(AVPacket& packet);
  [[nodiscard]] bool broke_off() const { return broke_off_; }

  // Error interrupted once `cancel` is set. next() then returns false although the file goes on.
  [[nodiscard]] Result<void> check_interrupt() const;

  // The same file opened again, at its start.
  [[nodiscard]] Result<Demuxer> reopened(const std::filesystem::path& path) const { return open(path, cancel_); }

  // Seeks to the keyframe at or before a time in the stream's ticks, as the container knows it. The caller checks where
  // the next packet lies. False: the container cannot seek.
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
