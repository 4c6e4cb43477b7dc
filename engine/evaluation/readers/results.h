// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
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

// What trackers and detectors report, as read from their result files or returned by OpenCV's trackers.

// ReportedBox::track of a detector that does not track: its boxes are independent of each other.
inline constexpr int kNoTrack = -1;

// One box that a tracker or detector reports in a frame.
struct ReportedBox {
  Box box;                                // edges in pixels (base/image.h)
  double score = 1;                       // confidence; higher is more certain
  int track = 0;                          // the tracker's own number of the object, or kNoTrack
  int line = 0;                           // of the file, from 1; 0: not from a file
  std::optional<double> distance_m = {};  // from the camera, of reporters that state one
};

// All boxes of one tracker or detector on one clip.
struct Results {
  std::string name;                                // of the tracker, for tables and plots
  std::map<int, std::vector<ReportedBox>> frames;  // by the footage's frame number; no entry: nothing reported
  std::set<int> initializations;                   // frames in which it was given the truth (VOT's 1): not scored
  std::string clip;         // name of the clip according to a file, the folder of its images; empty: not given
  int boxes_elsewhere = 0;  // left out, since the truth does not have their images
  std::optional<double> frames_per_s;  // of the tracker alone, where it is known

  [[nodiscard]] const ReportedBox* best_at(int frame) const;  // highest score, first of equals; nullptr: none
};

// Layouts of result files. docs/evaluation-reference.md defines them: which frame a line belongs to, and whether pixels
// and frames count from 0 or 1.
enum class ResultsFormat { automatic, otb, vot, mot, csv, aot, coco };
[[nodiscard]] std::span<const std::string_view> results_format_names();  // in the order of the enum

// The frames of a clip by what a truth file calls their images (truth_files.h). Where such a file is the truth, results
// in the layouts aot and coco name images as it does.
struct FramesOfImages {
  // Names as the file has them, and without folder and extension where that is not ambiguous.
  std::map<std::string, int, std::less<>> by_name;
  std::map<int, int> by_id;  // by COCO's image_id; empty: the file has none
};

// How a file is to be read.
struct ResultsOptions {
  ResultsFormat format = ResultsFormat::automatic;  // automatic: recognized by the file's name and first line
  bool multiple_per_frame = false;                  // allow several boxes in a frame, as detectors report
  // Layouts otb and vot have a line for each frame and no frame numbers. A file must have a line for each of the clip's
  // frames, or for each from this one on (the footage's number), in which the tracker was started.
  std::optional<int> start_frame;
  // Layout coco: the image_id of the clip's first frame.
  int first_image_id = 1;
  // Layout coco, one file for several clips: the last image_id of all of them. Boxes of the other clips are ignored;
  // any other layout is an error.
  std::optional<int> last_image_id;
  // Layouts aot and coco: the clip's images. Boxes of others are left out and counted (Results::boxes_elsewhere).
  // null: images are numbered as above. Must outlive the call.
  const FramesOfImages* images = nullptr;
};

// Reads a result file of a clip. Errors: cannot_read; bad_data with file and line for a number of lines that does not
// match the clip, frames after its end, NaN or infinite numbers, coordinates beyond a billion pixels, widths or heights
// of zero or less, a track id used twice in a frame, and lines in another layout than the first.
[[nodiscard]] Result<Results> read_results(const std::filesystem::path& path, const FootageTruth& clip,
                                           const ResultsOptions& options = {});

// The name of the tracker that a result file is from: the file's name without extension.
[[nodiscard]] std::string results_name(const std::filesystem::path& path);

// Results in layout csv (ResultsFormat::csv), with a header and a line for each box, in order of frames.
[[nodiscard]] std::string csv_text(const Results& results);

}  // namespace sigs
