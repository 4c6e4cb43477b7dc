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

// What the name of a video is made of.
struct NameParts {
  std::string background;
  std::string aircraft;
  std::string flight;
  int number = 1;  // from 1, among the videos of a group whose names differ by it alone
};

// The pattern with {background}, {aircraft}, {flight} and {number} filled in. Numbers have at least four digits, so
// that names sort, and adding videos renames none.
[[nodiscard]] std::string name_from(const std::string& pattern, const NameParts& parts);

// What is wrong with a pattern, as "has no such part: {plane}". Empty: nothing.
[[nodiscard]] std::string wrong_with_pattern(const std::string& pattern);

// What is wrong with the name of a video, which becomes that of a folder: what file_name_error() says, or that the
// name belongs to a file of the dataset itself. Empty: nothing.
[[nodiscard]] std::string wrong_with_video_name(const std::string& name);

// The folder of one video of a dataset, FOLDER/NAME/, which may not be there yet.
struct VideoFolder {
  std::filesystem::path dataset;  // absolute, without symbolic links
  const PlannedVideo* video = nullptr;

  [[nodiscard]] std::filesystem::path path() const { return dataset / video->name; }
};

struct VideoExport {
  std::string planned;  // its fingerprint
  int jobs = 1;         // frames composed in parallel
  std::function<void(int done, int total)> progress;
  std::function<void(const Warning&)> warn;
  const std::atomic<bool>* cancel = nullptr;
};

// Names of the files of a video's folder that its entry does not list: the entry and the project.
[[nodiscard]] std::vector<std::string> uncounted(const PlannedVideo& video);

// The text of the project file in the video's folder. Paths are relative to that folder, so that dataset and inputs can
// be moved together; the bytes therefore depend on where the dataset is.
[[nodiscard]] std::string project_text(const VideoFolder& folder);

// Writes project and entry where their text differs from the planned one. Errors cannot_create, write_failed.
[[nodiscard]] Result<void> update_metadata(const VideoFolder& folder, const VideoEntry& entry);

// Why the video's folder may not be replaced: it holds something that no dataset wrote. Empty: it may, or is not there.
[[nodiscard]] std::string not_replaceable(const VideoFolder& folder);

// Exports the video in the staging folder, and renames its folder to the final name when all of it is on the disk. An
// older folder of that name is replaced. Errors as export_project(); cannot_create as not_replaceable().
[[nodiscard]] Result<VideoEntry> make_video(const VideoFolder& folder, const VideoExport& request);

}  // namespace sigs
