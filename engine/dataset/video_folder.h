// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/entry.h"
#include "dataset/plan.h"
#include "export/frame_renderer.h"

namespace sigs {

// The folder of one video of a dataset, FOLDER/NAME/, which may not be there yet.
struct VideoFolder {
  std::filesystem::path dataset;  // absolute, without symbolic links
  const PlannedVideo* video = nullptr;

  [[nodiscard]] std::filesystem::path path() const { return dataset / video->name; }
};

struct VideoExport {
  std::string planned;                // its fingerprint
  int jobs = 1;                       // frames composed in parallel
  FrameRenderer* renderer = nullptr;  // of a video of one frame: makes it, and keeps what it has opened; null: not used
  FrameSource* footage = nullptr;     // as ExportRequest::footage
  std::function<void(int done, int total)> progress;
  std::function<void(const Warning&)> warn;
  const std::atomic<bool>* cancel = nullptr;
};

// What the project file in a video's folder says of that video: of one of several cameras the file has all of them, and
// the video's tag "camera" says which.
[[nodiscard]] Project project_of_video(const Project& in_file, const std::map<std::string, std::string>& tags);

// Writes project and entry where their text differs from the planned one. Errors cannot_create, write_failed.
[[nodiscard]] Result<void> update_metadata(const VideoFolder& folder, const VideoEntry& entry);

// Exports the video in the staging folder, and renames its folder to the final name when all of it is on the disk. An
// older folder of that name is replaced. Errors as export_project();
// cannot_create where the folder holds something that no dataset wrote.
[[nodiscard]] Result<VideoEntry> make_video(const VideoFolder& folder, const VideoExport& request);

}  // namespace sigs
