// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/dataset_lock.h"
#include "dataset/index.h"
#include "dataset/plan.h"

namespace sigs {

struct DatasetRequest {
  std::filesystem::path folder;
  DatasetSource source;
  int jobs = 0;         // videos exported side by side, 0: as the processor asks for; the bytes do not depend on it
  bool resume = false;  // keep videos that are complete and as planned; else the folder must hold no dataset
  std::optional<Shard> shard;  // only these videos, and no index
  bool index = true;           // false: the plan is only a part of the dataset's; a shard never has one
  bool merge_only = false;     // export nothing: make the index of what is there; a missing video is an error
};

struct VideoFailure {
  std::string video;
  Error error;
};

struct DatasetReport {
  int exported = 0;
  int kept = 0;    // complete before
  int frames = 0;  // exported
  double seconds = 0;
  std::vector<VideoFailure> failures;          // in the plan's order; the others finished
  std::vector<std::filesystem::path> written;  // videos' folders, and the index and its like; these are left out where
                                               // there are failures or a shard
  std::string checksum;                        // of the whole dataset; empty where there is no index
};

// Each may be called from any thread, but never two at a time.
struct DatasetControl {
  std::function<void(int done, int total)> progress;  // frames, of all videos to be exported
  std::function<void(const Warning&)> warn;
  std::function<void(const std::string& video)> finished;
  const std::atomic<bool>* cancel = nullptr;  // set: stop soon, error interrupted; finished videos stay
};

// Exports a plan: FOLDER/NAME/ for each video, complete or not there at all; at the end FOLDER/index.json with
// checksums and, for the label formats that span videos, FOLDER/labels/. docs/dataset.md has the layout.
// Errors: cannot_create (the folder holds a dataset and resume is false; another run makes the same videos),
// bad_data (merge_only: videos are missing or not as planned), interrupted.
[[nodiscard]] Result<DatasetReport> make_dataset(const Plan& plan, const DatasetRequest& request,
                                                 const DatasetControl& control);

// How many frames an export of the project has. Opens the footage only where the project does not say.
[[nodiscard]] Result<int> frames_of(const Project& project, const std::atomic<bool>* cancel = nullptr);

}  // namespace sigs
