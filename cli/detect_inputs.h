// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/metrics/detection_score.h"
#include "evaluation/readers/results.h"
#include "evaluation/readers/truth_files.h"

namespace sigs::cli {

// A clip's labels and what each detector says of it.
struct ClipFiles {
  std::string name;  // no two are alike
  std::filesystem::path labels;
  std::optional<TruthClip> truth;                // read already, where the labels are another program's
  std::string results_name;                      // results' files are called so
  std::vector<std::filesystem::path> results;    // one for each detector
  std::string split;                             // of a dataset's clip
  int frames = 0;                                // of a dataset's clip; 0: not known
  std::map<std::string, std::string> tags = {};  // of a dataset's clip
  int first_image_id = 1;                        // see ResultsOptions, as the next
  std::optional<int> last_image_id;
};

struct DetectInputs {
  std::vector<std::string> detectors;  // no two are alike
  bool is_shared = false;              // each detector has one file of all clips, which names images as the truth does
  std::vector<ClipFiles> clips;
};

// Where labels and results come from, as the command line names them.
//   inputs   label files, truths of other programs (evaluation/readers/truth_files.h), or one folder of a dataset
//   results  a folder for each detector, in which NAME.csv or the like tells of the clip NAME; or, for label files, one
//            file for each in the same order; or, for one label file, a file for each detector; or, for one split of a
//            dataset, a file in COCO's layout for each detector, with the image_id of the split's coco labels; or, for
//            one truth of another program, a file for each detector that names images as the truth does
//   split    only these clips of a dataset; empty: all
//   size     of --size: of the truth's images; empty: not given
struct DetectSources {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::filesystem::path> results;
  std::string split = {};
  ResultsFormat format = ResultsFormat::automatic;
  TruthOptions truth = {};
  std::string size = {};
};

// Which results go with which labels. Errors name what is missing or left over.
[[nodiscard]] Result<DetectInputs> detect_inputs(const DetectSources& sources);

// Everything that is read: truths once, then the results of each detector on each clip.
[[nodiscard]] Result<std::vector<std::vector<DetectedClip>>> clips_by_detector(const DetectInputs& inputs,
                                                                               ResultsFormat format);

// Help of the options that differ from command to command.
struct SourceHelp {
  const char* labels;
  const char* results;
  const char* results_value;
};

// LABELS, --results, --split, --format, --size, --rate, --classes and --stills. The sources must outlive the command.
void add_source_options(CLI::App& command, DetectSources& sources, const SourceHelp& help);

// All files that an evaluation reads, which its outputs may not replace.
[[nodiscard]] std::vector<std::filesystem::path> files_read(const DetectSources& sources, const DetectInputs& clips);

// The index of a dataset: its clips, or those of one split; no results.
[[nodiscard]] Result<std::vector<ClipFiles>> clips_of_dataset(const std::filesystem::path& folder,
                                                              const std::string& split);

// The file in a tracker's or detector's folder that has the clip's name. Errors: none, or several.
[[nodiscard]] Result<std::filesystem::path> results_in(const std::filesystem::path& folder, const std::string& name);

// "runs/yolo/" has the name yolo.
[[nodiscard]] std::string name_of_folder(const std::filesystem::path& folder);

// A warning where results name a clip of another name. Layouts that name none say nothing.
void warn_of_other_clip(const Results& results, const std::filesystem::path& file, const std::string& clip);

// The name, or with a number behind it where it is taken.
[[nodiscard]] std::string free_name(const std::string& name, const std::vector<std::string>& taken);

}  // namespace sigs::cli
