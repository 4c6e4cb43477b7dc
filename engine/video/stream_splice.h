// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/result.h"
#include "video/frame.h"
#include "video/frame_source.h"

namespace sigs {

namespace libav {
struct Splice;
}

// A copy of a video in which some frames are other ones. Groups of pictures without such a frame keep their packets,
// byte by byte; the others are encoded as the stream is: codec, profile, level, sample format, keyframes, quantisers.
// The other streams (sound, telemetry) are copied. VideoWriter::open_splice() writes it.

// The frames of a range, by number from the first: whether each one changes.
struct ChangedFrames {
  int first = 0;
  std::vector<bool> changed;

  [[nodiscard]] int last() const { return first + static_cast<int>(changed.size()) - 1; }
};

struct SplicePlan {
  std::vector<bool> encoded;      // by number from the first of the range; VideoWriter needs these frames
  std::vector<Warning> warnings;  // a stream that the file has no place for; groups encoded though nothing changes
  std::shared_ptr<const libav::Splice> splice;
};

// Whether the footage is of a kind that can be spliced, as far as its container and headers tell. Errors: usage (what
// it has that cannot be, and the codec to use instead: no H.264, HEVC, MJPEG, FFV1 or ProRes; interlaced; another
// container than MP4, MOV, Matroska, or AVI of intra codecs; images), unavailable (no encoder), cannot_read,
// interrupted.
[[nodiscard]] Result<void> check_splice(const VideoInfo& footage, const std::atomic<bool>* cancel = nullptr);

// Groups with a changed frame, and those that the range cuts, are encoded, and those after them until a picture that
// decoding can begin at: an IDR or BLA picture, or a CRA of HEVC.
//   frames  of the footage, within it and not empty
//   cancel  while it is true, reading soon ends; null: none
// Errors: those of check_splice(), and usage for what only the packets show (pictures of neighbouring groups that are
// shown interleaved, an edit list within the clip).
[[nodiscard]] Result<SplicePlan> plan_splice(const VideoInfo& footage, const ChangedFrames& frames,
                                             const std::atomic<bool>* cancel = nullptr);

}  // namespace sigs
