// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "base/result.h"
#include "video/libav/frame_decoder.h"
#include "video/libav/frame_order.h"
#include "video/libav/nal_units.h"
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

}  // namespace sigs::libav
