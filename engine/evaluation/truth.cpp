// SPDX-License-Identifier: MIT
#include "evaluation/truth.h"

namespace sigs {

TargetFrame target_frame_of(const IntruderTruth&) {
  return {};
}

Result<void> add_frame(FilmTruth&, const FrameTruth&) {
  return fail("", "not yet", ErrorKind::unavailable);
}

Result<FilmTruth> read_truth(const std::filesystem::path& path) {
  return fail(path.string(), "cannot be read yet", ErrorKind::unavailable);
}

}  // namespace sigs
