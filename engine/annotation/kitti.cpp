// SPDX-License-Identifier: MIT
#include "annotation/kitti.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_kitti(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "kitti labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
