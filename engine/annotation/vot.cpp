// SPDX-License-Identifier: MIT
#include "annotation/vot.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_vot(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "vot labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
