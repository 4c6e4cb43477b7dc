// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/index.h"

namespace sigs {

struct MergeRequest {
  std::filesystem::path dataset;  // its videos' folders lie there
  std::filesystem::path folder;   // to fill; empty at first
  std::string name;               // the dataset's
  const std::atomic<bool>* cancel = nullptr;
};

// Whether the labels of all videos can be put together: each format that counts categories counts the same ones, and
// names stay different where a format narrows them. Error bad_data.
[[nodiscard]] Result<void> check_labels_agree(const Plan& plan);

// Labels of all videos together, a set for each split, in the formats that span videos; docs/dataset.md lists what is
// written. A format counts where any video has it. Errors: bad_data where labels are not as this program writes them;
// cannot_create, write_failed, interrupted.
[[nodiscard]] Result<void> merge_labels(const MergeRequest& request, const std::vector<FinishedVideo>& videos);

}  // namespace sigs
