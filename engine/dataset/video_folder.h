// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/entry.h"
#include "dataset/plan.h"

namespace sigs {

// One video of a dataset: FOLDER/NAME/, where it is or will be.
struct VideoFolder {
  std::filesystem::path dataset;  // absolute, without symbolic links
  const PlannedVideo* video = nullptr;

  [[nodiscard]] std::filesystem::path path() const { return dataset / video->name; }
};

struct VideoExport {
  std::string planned;  // its fingerprint
  int jobs = 1;         // frames composed side by side
  std::function<void(int done, int total)> progress;
  std::function<void(const Warning&)> warn;
  const std::atomic<bool>* cancel = nullptr;
};

// Names of what does not count among the files of a video's folder: the entry and the project.
[[nodiscard]] std::vector<std::string> uncounted(const PlannedVideo& video);

// The project as it stands in the video's folder: paths from there, so that both can move together. It says where its
// inputs are on this machine, so its bytes are the same only where the dataset lies at the same place beside them.
[[nodiscard]] std::string project_text(const VideoFolder& folder);

// Writes project and entry where they are not as they should be.
[[nodiscard]] Result<void> update_metadata(const VideoFolder& folder, const VideoEntry& entry);

// Why a folder may not be replaced: it holds what no sigs dataset wrote. Empty: it may, or is not there.
[[nodiscard]] std::string not_replaceable(const VideoFolder& folder);

// Exports the video in the staging folder and gives the folder its name when all of it is on the disk; an older one
// goes.
[[nodiscard]] Result<VideoEntry> make_video(const VideoFolder& folder, const VideoExport& request);

}  // namespace sigs
