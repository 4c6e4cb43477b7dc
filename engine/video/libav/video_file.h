// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "video/libav/encoding.h"
#include "video/libav/handles.h"

namespace sigs::libav {

struct OutputCloser {
  void operator()(AVFormatContext* context) const;
};
using OutputPtr = std::unique_ptr<AVFormatContext, OutputCloser>;

// One video stream in one container file. See video_writer.h for what it promises.
class VideoFile {
 public:
  [[nodiscard]] static Result<VideoFile> create(const std::filesystem::path& path, const VideoFormat& format);

  // Does now what the first images would wait for. No need to call it; the bytes are the same.
  void warm_up() { prepare_blanks(); }
  [[nodiscard]] Result<void> write(const Frame& frame);
  [[nodiscard]] Result<void> write_blank(double time_s);
  [[nodiscard]] Result<void> finish();

 private:
  VideoFile(std::filesystem::path path, VideoFormat format, Encoding encoding);

  [[nodiscard]] Result<void> begin();
  [[nodiscard]] Result<int64_t> next_stamp(double time_s);
  [[nodiscard]] FramePtr av_frame_of(const Frame& frame) const;
  [[nodiscard]] Result<void> encode(const AVFrame* image);
  [[nodiscard]] std::vector<uint8_t> packet_alone(const Frame& frame);
  void prepare_blanks();
  [[nodiscard]] Result<void> put(AVPacket& packet);
  [[nodiscard]] Result<void> put_known(const std::vector<uint8_t>& packet, double time_s);
  [[nodiscard]] Result<void> check(int result) const;
  [[nodiscard]] tl::unexpected<Error> encoding_failed(int error) const;

  std::filesystem::path path_;
  VideoFormat format_;
  Encoding encoding_;
  AVRational tick_{1, 1};  // of the time stamps that the encoder is given
  OutputPtr output_;
  CodecPtr encoder_;
  PacketPtr packet_ = new_packet();
  bool blanks_are_prepared_ = false;
  std::vector<uint8_t> blank_;  // what the encoder makes of a blank image, where that is always the same
  std::optional<double> first_time_s_;
  double last_time_s_ = 0;
  int64_t last_stamp_ = -1;
};

}  // namespace sigs::libav
