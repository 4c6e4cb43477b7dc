// SPDX-License-Identifier: MIT
#include "annotation/cvat.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_cvat(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "cvat labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
