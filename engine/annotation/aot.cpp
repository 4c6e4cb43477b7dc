// SPDX-License-Identifier: MIT
#include "annotation/aot.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_aot(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "aot labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
