// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "truth/annotation.h"

namespace sigs {

// ReportedBox::track of a reporter that follows nothing: each of its boxes stands for itself.
inline constexpr int kNoTrack = -1;

// What a tracker or detector says of one frame.
struct ReportedBox {
  Box box;           // edges, as base/image.h has them
  double score = 1;  // confidence; larger is surer
  int track = 0;     // the reporter's own number of what it follows, or kNoTrack
  int line = 0;      // of the file it came from, from 1; 0: from no file
};

// What one tracker or detector says of one clip.
struct Results {
  std::string name;                                // of the tracker, for tables and plots
  std::map<int, std::vector<ReportedBox>> frames;  // by the footage's frame number; absent: nothing reported there
  std::set<int> initializations;                   // frames in which it was given the truth (VOT's 1): not scored
  std::string clip;                                // that an aot file names, as folder of its images; empty: not said
  std::optional<double> frames_per_s;              // of the tracker alone, where it is known

  [[nodiscard]] const ReportedBox* best_at(int frame) const;  // highest score, first of equals; nullptr: none
};

// Layouts of result files (docs/evaluation.md): which frame a line belongs to, where pixels and frames are counted
// from.
enum class ResultsFormat { automatic, otb, vot, mot, csv, aot, coco };
[[nodiscard]] std::span<const std::string_view> results_format_names();  // in the order of the enum

struct ResultsOptions {
  ResultsFormat format = ResultsFormat::automatic;  // automatic: told by the file's name and first lines
  bool multiple_per_frame = false;                  // several boxes a frame, as a detector reports; else an error
  // Layouts with a line a frame (otb, vot) tell no frame numbers. They must have a line for each of the clip's frames,
  // or for each from this one on (the footage's number), the one the tracker was started in.
  std::optional<int> start_frame;
  // Layout coco: the image_id of the clip's first frame.
  int first_image_id = 1;
  // Layout coco, one file for several clips: the last image_id of all of them. Boxes of the other clips are passed
  // over. Any other layout is an error then.
  std::optional<int> last_image_id;
};

// Errors bad_data name file and line: a number of frames that is not the clip's, frames past its end, NaN or infinite
// numbers, coordinates beyond a billion pixels, widths or heights of zero or less, the same id twice in a frame, lines
// of another layout than the first. Error cannot_read.
[[nodiscard]] Result<Results> read_results(const std::filesystem::path& path, const FootageTruth& clip,
                                           const ResultsOptions& options = {});

// The tracker's name of a result file: its name without extension.
[[nodiscard]] std::string results_name(const std::filesystem::path& path);

}  // namespace sigs
