// SPDX-License-Identifier: MIT
#include "annotation/csv.h"

namespace sigs {

Result<std::unique_ptr<LabelWriter>> open_csv(const std::filesystem::path& path, const LabelSequence&) {
  return fail(path.string(), "csv labels cannot be written yet", ErrorKind::unavailable);
}

}  // namespace sigs
