// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "video/frame.h"
#include "video/libav/handles.h"
#include "video/libav/nal_units.h"
#include "video/libav/stream_info.h"

namespace sigs::libav {

// Encodes groups of pictures for a stream that exists already, so that its other packets can stay beside them.

// What the groups have in common with the stream.
struct GroupFormat {
  const AVCodecParameters* stream = nullptr;  // outlives the encoder
  AVRational tick{1, 1};                      // of its time stamps, s
  AVRational frame_rate{25, 1};
  Orientation orientation;     // how its images become upright
  int reorder_depth = 0;       // at most
  int most_bidirectional = 0;  // in a row; 0: none
  bool is_intra_only = false;
  int sequence_set = 0;  // numbers for parameter sets, unlike those of the stream
  int picture_set = 0;
  int video_set = 0;
};

// What pictures are quantised by, where the codec has that: H.264's QP or HEVC's of each type; tables of JPEG.
struct GroupQuality {
  double qp_intra = 23;
  double qp_predicted = 23;
  double qp_bidirectional = 25;
  JpegTables tables{};  // all 0: as fine as the encoder gives
};

// What the first pictures of a group were quantised by in the footage, as frames state it. None where they do not and
// the codec needs it (H.264, HEVC).
[[nodiscard]] std::optional<GroupQuality> stated_quality(const std::vector<Frame>& first, const GroupFormat& format);

// The quality by which the first pictures of a group take so many bytes. Errors as of GroupEncoder.
[[nodiscard]] Result<GroupQuality> quality_by_size(const std::vector<Frame>& first, double bytes,
                                                   const GroupFormat& format);

struct EncodedPacket {
  Bytes bytes;  // as the stream's other packets: with lengths or start codes
  std::int64_t pts = 0;
  bool key = false;
};

// One closed group of pictures.
class GroupEncoder {
 public:
  // Errors: unavailable (FFmpeg lacks the encoder, or it refuses what the stream has).
  [[nodiscard]] static Result<GroupEncoder> open(const GroupFormat& format, const GroupQuality& quality);

  // The header's parameter sets under the numbers of the format (H.264, HEVC).
  [[nodiscard]] std::vector<Bytes> parameter_sets() const;

  // Gives the encoder the next picture, upright as frames are; the packets that it has finished are appended.
  // Error write_failed.
  [[nodiscard]] Result<void> add(const Frame& frame, std::int64_t pts, std::vector<EncodedPacket>& packets);

  // The same for what it still has. Nothing can be added afterwards.
  [[nodiscard]] Result<void> finish(std::vector<EncodedPacket>& packets);

 private:
  GroupEncoder(GroupFormat format, CodecPtr encoder) : format_(format), encoder_(std::move(encoder)) {}
  [[nodiscard]] Result<void> encode(const AVFrame* image, std::vector<EncodedPacket>& packets);
  [[nodiscard]] Bytes stream_bytes(ByteSpan packet) const;

  GroupFormat format_;
  CodecPtr encoder_;
  PacketPtr packet_ = new_packet();
  bool has_begun_ = false;
};

// Whether there is an encoder for a stream's codec and pixel format. Error usage: says why not, and what to use
// instead.
[[nodiscard]] Result<void> check_group_codec(const AVCodecParameters& stream);

// What undoes an orientation.
[[nodiscard]] Orientation inverse(const Orientation& orientation);

}  // namespace sigs::libav
