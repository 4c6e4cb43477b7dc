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
#include "video/frame_source.h"

namespace sigs {

struct DatasetRequest {
  std::filesystem::path folder;
  DatasetSource source;
  int jobs = 0;  // videos exported in parallel, 0: as schedule_of() (schedule.h) chooses; bytes do not depend on it
  bool resume = false;         // keep videos that are complete and as planned; false: the folder must hold no dataset
  std::optional<Shard> shard;  // make only these videos, and no index
  bool index = true;           // false: make no index, since the plan is only a part of the dataset's
  bool merge_only = false;     // export nothing, only make the index; a missing video is an error
};

struct DatasetReport {
  int exported = 0;
  int kept = 0;    // were complete before
  int frames = 0;  // exported
  double seconds = 0;
  std::vector<VideoFailure> failures;          // in the plan's order; all other videos are complete
  std::vector<std::filesystem::path> written;  // folders of exported videos, and what make_index() wrote
  std::string checksum;                        // of the whole dataset; empty where there is no index
};

// Callbacks are called from any thread, never two at a time.
struct DatasetControl {
  std::function<void(int done, int total)> progress;  // frames, of all videos to be exported
  // Before the videos, where footage is measured (matched_look.h): parts of that, and the file that is looked at.
  std::function<void(int done, int total, const std::string& clip)> measuring;
  std::function<void(const Warning&)> warn;
  std::function<void(const std::string& video)> finished;
  const std::atomic<bool>* cancel = nullptr;  // when set: stops soon with error interrupted; finished videos are kept
};

// Exports a plan: FOLDER/NAME/ for each video, complete or not there at all, and at the end the index (index.h).
// docs/dataset.md has the layout. Whenever the program is stopped, complete videos stay, and a later call with `resume`
// makes the others. A video that fails is a VideoFailure in the report, not an error, and then there is no index.
// Errors: cannot_create (the folder holds a dataset and resume is false; another run makes the same videos),
// bad_data (merge_only: videos are missing or not as planned), interrupted.
[[nodiscard]] Result<DatasetReport> make_dataset(const Plan& plan, const DatasetRequest& request,
                                                 const DatasetControl& control);

}  // namespace sigs
