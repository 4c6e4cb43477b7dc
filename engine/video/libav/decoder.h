// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"
#include "video/libav/handles.h"

namespace sigs::libav {

struct DecoderSettings {
  int threads = 1;
  int reorder_depth = 0;  // how many images can overtake another, where the time stamps tell more than the stream
};

// Errors: cannot_read (no decoder for this codec, or it refuses the stream).
[[nodiscard]] Result<CodecPtr> open_decoder(const AVCodecParameters& parameters, const DecoderSettings& settings);

// What the decoder says of an image.
[[nodiscard]] bool is_damaged(const AVFrame& frame);
[[nodiscard]] bool is_key(const AVFrame& frame);

[[nodiscard]] bool is_intra_only(AVCodecID codec);

// Whether images of this codec are decoded several at a time.
[[nodiscard]] bool decodes_ahead(AVCodecID codec);

}  // namespace sigs::libav
