// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "video/libav/encoding.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// Makes FFV1's packets in place of FFmpeg's encoder, with the same bytes, in half of its time (video/ffv1_slice.h) and
// without the buffer of 148 bytes for each pixel that FFmpeg fills with zeros before the first packet. FFmpeg's encoder
// still gives the stream's header.
class Ffv1Packets {
 public:
  // Tries both encoders on a small image. None where their bytes differ, or where the stream's header is not that of
  // the small image: more than 8 bits, RGB, sizes that are not cut into 2 x 2 slices, another version of FFmpeg.
  //   encoder  opened for the images that are to be written
  [[nodiscard]] static std::optional<Ffv1Packets> like(const AVCodecContext& encoder, const VideoFormat& format,
                                                       const Encoding& encoding);

  // The packet of an image, which is a keyframe as all of them are.
  //   frame    as stored in the encoding
  //   threads  that code slices; the bytes do not depend on them
  [[nodiscard]] std::vector<std::uint8_t> packet_of(const Frame& frame, int threads);

 private:
  struct Slice {
    std::vector<std::uint8_t> header;  // the same in every image
    std::vector<std::uint8_t> bytes;   // of the last image; kept for its memory
  };
  [[nodiscard]] bool learn_headers(const std::vector<std::uint8_t>& packet, const Frame& frame);
  void code(std::size_t slice, const Frame& frame);

  std::array<Slice, 4> slices_;  // row by row
};

}  // namespace sigs::libav
