// SPDX-License-Identifier: MIT
#include "annotation/coco.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_coco(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "coco labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
