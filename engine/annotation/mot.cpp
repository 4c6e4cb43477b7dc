// SPDX-License-Identifier: MIT
#include "annotation/mot.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_mot(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "mot labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
