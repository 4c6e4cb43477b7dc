// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "dataset/entry.h"
#include "dataset/plan.h"

namespace pugi {
class xml_node;
}

namespace sigs {

// What a dataset holds besides the folders of its videos: splits/, labels/, SHA256SUMS and index.json. Which files in
// splits/ and labels/ a dataset has written is known from SHA256SUMS, which is written before them and removed after
// them, and from the index, which is written last and removed first.

inline constexpr const char* kIndexName = "index.json";
inline constexpr const char* kChecksumsName = "SHA256SUMS";
inline constexpr const char* kSharedFolders[] = {"splits", "labels"};

// Whether each of these is missing or was written by a dataset. Error cannot_create names the first file that was not.
[[nodiscard]] Result<void> check_shared_files(const std::filesystem::path& dataset);

// Removes them, before the dataset changes. None of them need be there. Errors of check_shared_files(), and then
// nothing is removed; cannot_create.
[[nodiscard]] Result<void> remove_index(const std::filesystem::path& dataset);

// What a dataset was made from.
struct DatasetSource {
  std::string program;  // "sigs 0.1.0"; videos made by another one are not kept
  std::uint64_t seed = 0;
  std::string recipe;                 // its text; empty: there is none
  std::vector<std::string> settings;  // KEY=VALUE given beside the recipe
};

struct FinishedVideo {
  const PlannedVideo* video = nullptr;
  VideoEntry entry;
};

// Whether a folder is a dataset's, whole or not: it has an index, the staging folder of a run, or the folder of a video
// that is complete. The folder of a single video, and one that cannot be read, is none.
[[nodiscard]] bool is_dataset_folder(const std::filesystem::path& folder);

// The name that lists and labels use for a video's split: "all" where it has none.
[[nodiscard]] std::string split_of(const PlannedVideo& video);

// The names of all splits, in the order of the videos.
[[nodiscard]] std::vector<std::string> splits_of(const std::vector<FinishedVideo>& videos);

struct DatasetIndex {
  std::vector<std::filesystem::path> written;  // index.json, SHA256SUMS and the folders that are there
  std::string checksum;                        // of SHA256SUMS, so the same for the same dataset
};

// Writes FOLDER/splits/, FOLDER/labels/, FOLDER/SHA256SUMS and, when all of them are on the disk, FOLDER/index.json.
// The same videos give the same bytes. videos: all of the plan, in its order. Errors as check_shared_files() and
// merge_labels(), but write_failed where a file of the videos is gone meanwhile; cannot_create, write_failed,
// interrupted.
[[nodiscard]] Result<DatasetIndex> make_index(const Plan& plan, const DatasetSource& source,
                                              const std::filesystem::path& dataset,
                                              const std::vector<FinishedVideo>& videos,
                                              const std::atomic<bool>* cancel);

// A video of a dataset that has been made, as the index and the video's project tell it.
struct IndexedVideo {
  std::string name;                               // a name that is allowed (recipe.h)
  std::string split;                              // empty: none
  std::map<std::string, std::string> tags;        // background, aircraft, flight and those of the recipe
  std::map<std::string, double> sampled;          // numbers that were sampled for it ("drawn")
  std::map<std::string, std::string> categories;  // of its intruders, by id; empty: NAME/NAME.json cannot be read
};

// Calls `visit` for each video of FOLDER/index.json, in its order, with the element "sigs" of its annotations,
// NAME/NAME.xml. Returns the index. Errors: cannot_read, of annotations with a word on export.labels; bad_data, which
// names the file: it is no JSON, has no list of videos, or one without an allowed name; no annotations; interrupted;
// that of `visit`, which ends it.
[[nodiscard]] Result<Json> for_each_indexed_video(
    const std::filesystem::path& folder, const std::atomic<bool>* cancel,
    const std::function<Result<void>(const IndexedVideo&, pugi::xml_node)>& visit);

// A number of an annotation; not a number (NaN) where it is missing or no number.
[[nodiscard]] double attribute_of(pugi::xml_node node, const char* name);

}  // namespace sigs
