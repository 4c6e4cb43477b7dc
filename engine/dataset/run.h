// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/plan.h"

namespace sigs {

// Every part-th video of the plan, parts counted from 1.
struct Shard {
  int part = 1;
  int parts = 1;
};

struct DatasetRequest {
  std::filesystem::path folder;
  int jobs = 1;                // videos exported side by side; the bytes do not depend on it
  bool resume = false;         // keep videos that are complete and as planned; else the folder must hold no dataset
  std::optional<Shard> shard;  // only these videos, and no index
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
  std::vector<VideoFailure> failures;          // the others finished
  std::vector<std::filesystem::path> written;  // the index and its like; empty where failures or a shard left it out
};

struct DatasetControl {
  std::function<void(int done, int total)>
      progress;                              // frames, of all videos to be exported; from any thread, one at a time
  std::function<void(const Warning&)> warn;  // likewise
  std::function<void(const std::string& video)> finished;  // likewise
  const std::atomic<bool>* cancel = nullptr;               // set: stop soon, error interrupted; finished videos stay
};

// Exports a plan: FOLDER/NAME/ for each video, complete or not there at all; at the end FOLDER/index.json with
// checksums and, for the label formats that span videos, FOLDER/labels/. docs/dataset.md has the layout.
[[nodiscard]] Result<DatasetReport> make_dataset(const Plan& plan, const DatasetRequest& request,
                                                 const DatasetControl& control);

}  // namespace sigs
