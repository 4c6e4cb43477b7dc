// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"
#include "video/libav/encoding.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// An encoder set up so that its bytes do not depend on the machine or the number of threads.
//   tick     of the time stamps it will be given
//   headers  the container wants the codec's parameters once, not in the stream
// Error unavailable: FFmpeg was built without it, or it refuses.
[[nodiscard]] Result<CodecPtr> open_encoder(const VideoFormat& format, const Encoding& encoding, AVRational tick,
                                            bool headers);

}  // namespace sigs::libav
