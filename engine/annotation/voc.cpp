// SPDX-License-Identifier: MIT
#include "annotation/voc.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_voc(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "voc labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
