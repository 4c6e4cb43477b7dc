// SPDX-License-Identifier: MIT
#include "dataset/run.h"

namespace sigs {

Result<DatasetReport> make_dataset(const Plan&, const DatasetRequest& request, const DatasetControl&) {
  return fail(request.folder.string(), "cannot be made yet", ErrorKind::unavailable);
}

}  // namespace sigs
