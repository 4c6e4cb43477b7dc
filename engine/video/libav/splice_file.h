// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "video/libav/frame_decoder.h"
#include "video/libav/group_encoder.h"
#include "video/libav/nal_units.h"
#include "video/libav/video_file.h"
#include "video/stream_splice.h"

namespace sigs::libav {

// Which packets of a video stay, and which frames are encoded anew, where some of its frames change.

// Frames that are encoded as one closed group of pictures.
struct EncodedGroup {
  int first = 0;  // numbers in the footage
  int last = 0;
};

// Groups that follow one another, between packets that are copied.
struct EncodedPart {
  std::vector<EncodedGroup> groups;
  std::vector<int> replaced;      // ordinals of the packets that show their frames, ascending
  std::vector<std::int64_t> dts;  // for their packets, in order, in the stream's ticks
  int next = 0;                   // the ordinal with which copying goes on; that of no packet: it does not
};

struct SpliceLayout {
  std::set<int> broken_links;      // ordinals of CRA pictures that copying goes on with: they become BLA ones
  std::vector<bool> is_copied;     // by ordinal
  std::vector<std::int64_t> pts;   // by frame of the footage
  std::vector<std::int64_t> dts;   // by ordinal
  std::vector<int> ordinals;       // by frame of the footage
  std::vector<int> bytes;          // of the packets, by ordinal
  std::vector<EncodedPart> parts;  // in order
  std::int64_t shift = 0;          // taken from all time stamps, so that the first frame of the range is at 0
  int reorder_depth = 0;           // of the stream
  int most_bidirectional = 0;      // of its pictures, one after the other
  int first_frame = 0;             // of the range
  int last_frame = 0;
  bool is_intra_only = false;  // each packet is a group of its own
};

// Groups with a changed frame, and those that the range cuts, are encoded. After an encoded group copying goes on where
// decoding can begin: at an IDR or BLA picture, or at a CRA of HEVC, whose leading pictures are then encoded too; until
// there, groups are encoded whether they change or not.
//   reader  of the same file as the table, for a look at keyframes
// Error bad_data: frames of neighbouring groups are shown interleaved; the stream's packets lack time stamps.
[[nodiscard]] Result<SpliceLayout> splice_layout(const PacketTable& table, const FrameOrder& order,
                                                 const ChangedFrames& frames, const AVCodecParameters& stream,
                                                 PacketReader& reader);

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

// The part of VideoWriter (video_writer.h) that writes the copy. Functions and errors are those of VideoWriter.
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
