// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

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

// Leaves the packets of all other streams out of reading.
void keep_only(AVFormatContext& input, int index);

// Reads the next packet of a stream; a few that cannot be read are passed over.
enum class Step { packet, end, broke_off };
[[nodiscard]] Step next_packet(AVFormatContext& input, int index, AVPacket& packet);

// The presentation time of a packet, else its time of decoding; AV_NOPTS_VALUE: it has none.
[[nodiscard]] std::int64_t stamp_of(const AVPacket& packet);

// The presentation time of frame 0 on the container's clock, in seconds: the least among the first packets that are
// shown. Where the file may begin in the middle of a group of images, decoders give none before the first keyframe.
// Reads packets from where the input stands, those of the video alone from then on. None: there is no video.
[[nodiscard]] std::optional<double> time_of_frame_0(AVFormatContext& input);

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

// One packet of the video stream as the container describes it; AV_NOPTS_VALUE and -1 where it states nothing.
struct PacketMark {
  int64_t pts = AV_NOPTS_VALUE;  // presentation time, in the stream's ticks
  int64_t dts = AV_NOPTS_VALUE;  // decoding time
  int64_t file_position = -1;
  int size = 0;            // bytes
  bool key = false;        // decoding can begin here, according to the container
  bool discarded = false;  // decoded but not shown: an edit list starts after it
  bool corrupt = false;    // according to the container or a checksum
};

// All packets of a video stream in order of decoding. A packet's index in the table is its *ordinal*, by which all of
// libav/ refers to it.
class PacketTable {
 public:
  // Reads the file to its end.
  [[nodiscard]] static PacketTable read(Demuxer& demuxer);

  [[nodiscard]] int size() const { return static_cast<int>(marks_.size()); }
  [[nodiscard]] const PacketMark& operator[](int ordinal) const { return marks_[static_cast<size_t>(ordinal)]; }
  [[nodiscard]] bool any_corrupt() const;
  [[nodiscard]] bool broke_off() const { return broke_off_; }  // the file ends before its index does

  // The ordinal of a packet that was read after a seek, by its file position, size and time stamp. Nothing where they
  // do not identify it.
  [[nodiscard]] std::optional<int> ordinal_of(const AVPacket& packet) const;

  // Whether the packet is certainly the one of this ordinal: the file position is known and agrees.
  [[nodiscard]] bool matches(int ordinal, const AVPacket& packet) const;

  // Whether the packet can be the one of this ordinal; for use where the file position may be unknown.
  [[nodiscard]] bool looks_like(int ordinal, const AVPacket& packet) const;

 private:
  void sort_by_position();

  std::vector<PacketMark> marks_;
  std::vector<int> by_position_;  // ordinals
  bool broke_off_ = false;
};

}  // namespace sigs::libav
