// SPDX-License-Identifier: MIT
#include "annotation/yolo.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_yolo(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "yolo labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
