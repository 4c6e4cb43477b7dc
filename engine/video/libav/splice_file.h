// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "video/libav/group_encoder.h"
#include "video/libav/splice_layout.h"
#include "video/libav/video_file.h"
#include "video/stream_splice.h"

namespace sigs::libav {

// Everything that is known of a splice before its file is written.
struct Splice {
  std::filesystem::path input;
  std::string muxer;  // FFmpeg's name
  SpliceLayout layout;
  GroupFormat format;                 // without the stream
  std::vector<Bytes> parameter_sets;  // of encoded groups
  Bytes header;                       // the stream's with those of encoded groups; empty: as it is
  bool writes_time_code = false;      // FFmpeg makes a stream of it
  std::vector<int> streams;           // of the input that are written, ascending
};

// Fills Splice::streams with those that the container has a place for; a warning for each other one.
// Error: the container has no place for the video itself.
[[nodiscard]] Result<void> choose_streams(Splice& splice, std::vector<Warning>& warnings,
                                          const std::atomic<bool>* cancel);

// The part of SpliceWriter that uses FFmpeg. Functions and errors are those of SpliceWriter.
class SpliceFile {
 public:
  [[nodiscard]] static Result<SpliceFile> create(const std::filesystem::path& path,
                                                 std::shared_ptr<const Splice> splice, const std::atomic<bool>* cancel);
  [[nodiscard]] Result<void> write(const Frame& frame, int number);
  [[nodiscard]] Result<void> finish();

 private:
  SpliceFile(std::filesystem::path path, std::shared_ptr<const Splice> splice, const std::atomic<bool>* cancel)
      : path_(std::move(path)), splice_(std::move(splice)), cancel_(cancel) {}

  [[nodiscard]] Result<void> begin();
  [[nodiscard]] const EncodedPart& part() const { return splice_->layout.parts[part_]; }
  [[nodiscard]] Result<void> copy_up_to(std::optional<int> ordinal);
  [[nodiscard]] Result<void> copy_video();
  [[nodiscard]] Result<void> copy_other();
  [[nodiscard]] Result<void> put(AVPacket& packet, int output, AVRational tick);
  [[nodiscard]] Result<void> encode_waiting();
  [[nodiscard]] Result<GroupQuality> quality_of_waiting();
  [[nodiscard]] Result<void> put_encoded(const std::vector<EncodedPacket>& packets);
  [[nodiscard]] Result<void> put_encoded(const EncodedPacket& encoded);
  [[nodiscard]] Result<void> end_group();
  [[nodiscard]] Result<void> verify() const;
  [[nodiscard]] Result<void> check(int result) const;

  std::filesystem::path path_;
  std::shared_ptr<const Splice> splice_;
  const std::atomic<bool>* cancel_ = nullptr;
  InputPtr input_;
  OutputPtr output_;
  int video_ = 0;             // stream of the input
  std::vector<int> outputs_;  // stream of the output by that of the input; -1: none
  PacketPtr packet_ = new_packet();
  int next_ordinal_ = 0;  // of the video packet that is read next

  std::size_t part_ = 0;
  std::size_t group_ = 0;  // of the part
  GroupFormat format_;
  std::optional<GroupEncoder> encoder_;  // of the group; none: its first frames wait
  std::vector<Frame> waiting_;           // for what they are quantised by to be known
  std::optional<GroupQuality> quality_;  // where the stream does not tell: of this part
  std::size_t encoded_ = 0;              // packets of the part that are written
};

}  // namespace sigs::libav
