// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/output_stream.h"
#include "base/result.h"
#include "video/libav/encoding.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// An output stream below a container, with the first error of writing to it.
struct StreamBelow {
  OutputStream out;
  std::optional<Error> error;
};

// Closes the file, or frees the buffer above a stream, and frees the context.
struct OutputCloser {
  void operator()(AVFormatContext* context) const;
};
using OutputPtr = std::unique_ptr<AVFormatContext, OutputCloser>;

// FFmpeg's name of what writes a container.
[[nodiscard]] const char* muxer_of(Container container);

// Writes one video stream to one container file; the part of VideoWriter (video_writer.h) that uses FFmpeg. Functions
// and errors are those of VideoWriter.
class VideoFile {
 public:
  // Creates the file and writes the container's header.
  [[nodiscard]] static Result<VideoFile> create(const std::filesystem::path& path, const VideoFormat& format);

  // The same to a stream, whose bytes leave the process with each packet.
  [[nodiscard]] static Result<VideoFile> create(OutputStream out, const VideoFormat& format);

  // Does in advance what the first image would have to wait for. Optional: the bytes are the same without it.
  void warm_up();

  // Encodes a frame, or one whose samples are all 0, and writes the packets that the encoder returns.
  [[nodiscard]] Result<void> write(const Frame& frame);
  [[nodiscard]] Result<void> write_blank(double time_s);

  // Writes the packets that the encoder still has, and the end of the container.
  [[nodiscard]] Result<void> finish();

 private:
  VideoFile(std::filesystem::path path, VideoFormat format, Encoding encoding);

  [[nodiscard]] static Result<VideoFile> begun(VideoFile file);
  [[nodiscard]] Result<void> begin();
  [[nodiscard]] Result<void> open_output();
  // The time stamp of a frame, in ticks from the first one.
  [[nodiscard]] Result<int64_t> next_stamp(double time_s);
  // The frame as FFmpeg's image, without a copy of its samples where the codec allows it.
  [[nodiscard]] FramePtr av_frame_of(const Frame& frame) const;
  [[nodiscard]] Result<void> encode(const AVFrame* image);
  [[nodiscard]] Result<void> put(AVPacket& packet);
  [[nodiscard]] Result<void> put_known(const std::vector<uint8_t>& packet, double time_s);
  [[nodiscard]] Result<void> check(int result) const;
  [[nodiscard]] Result<void> close_output();
  [[nodiscard]] tl::unexpected<Error> encoding_failed(int error) const;

  std::filesystem::path path_;
  VideoFormat format_;
  Encoding encoding_;
  AVRational tick_{1, 1};                // unit of the time stamps that the encoder is given, s
  std::unique_ptr<StreamBelow> stream_;  // none: a file. It outlives the container, which writes to it
  OutputPtr output_;                     // the container
  CodecPtr encoder_;
  PacketPtr packet_ = new_packet();  // for encoded packets, reused
  bool is_warm_ = false;
  std::optional<Ffv1Packets> ffv1_;     // makes the packets in place of encoder_; none: encoder_ does
  std::vector<uint8_t> blank_;          // the packet of a blank image, where it is always the same
  std::optional<double> first_time_s_;  // of the first frame; none before it
  double last_time_s_ = 0;
  int64_t last_stamp_ = -1;  // in ticks
  int64_t images_ = 0;       // that the encoder has been given
};

}  // namespace sigs::libav
