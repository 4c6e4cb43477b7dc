// SPDX-License-Identifier: MIT
#include "cli/detect_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/evaluation_folder.h"
#include "cli/options.h"
#include "cli/process.h"
#include "dataset/index.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

// A video of an index, where it has all that is needed.
Result<void> add_video(const fs::path& index, const nlohmann::json& video, const std::string& split,
                       std::vector<ClipFiles>& clips) {
  if (!video.is_object() || !video.contains("name") || !video["name"].is_string())
    return fail(index.string() + ": videos", "a video without a name");
  if (!split.empty() && (!video.contains("split") || video["split"] != split)) return {};
  const std::string name = video["name"];
  const fs::path labels = index.parent_path() / name / (name + ".xml");
  if (std::error_code code; !fs::exists(labels, code))
    return fail(labels.string(), "no such file; the dataset needs xml among its labels", ErrorKind::cannot_read);
  clips.push_back(
      {.name = name,
       .labels = labels,
       .results_name = name,
       .split = video.value("split", nlohmann::json()).is_string() ? video["split"] : nlohmann::json(""),
       .frames = video.value("frames", nlohmann::json()).is_number_integer() ? video["frames"].get<int>() : 0});
  const nlohmann::json tags = video.value("tags", nlohmann::json());
  for (const auto& [key, value] : tags.items())
    if (tags.is_object() && value.is_string()) clips.back().tags[key] = value;
  return {};
}

Result<void> check_labels(const fs::path& labels, const std::vector<ClipFiles>& before) {
  for (const ClipFiles& clip : before)
    if (std::error_code code; fs::equivalent(clip.labels, labels, code))
      return fail(labels.string(), "is named twice; each clip counts once", ErrorKind::usage);
  return {};
}

bool is_own_labels(const fs::path& path) {
  return !is_folder(path) && lower_extension(path) != ".json";
}

// The clips of another program's truth.
Result<void> add_truth(const fs::path& path, const TruthOptions& options, std::vector<ClipFiles>& clips,
                       std::vector<std::string>& names) {
  Result<std::vector<TruthClip>> truths = read_truth_clips(path, options);
  if (!truths) return fail(truths.error());
  for (TruthClip& truth : *truths) {
    names.push_back(free_name(truth.name, names));
    const std::string results_name = truth.name;
    clips.push_back({.name = names.back(), .labels = path, .truth = std::move(truth), .results_name = results_name});
  }
  return {};
}

Result<void> check_truth_options(const Paths& inputs, const TruthOptions& options) {
  const bool is_asked = !options.size_px.empty() || options.rate_hz > 0 || !options.classes.empty() || options.stills;
  if (is_asked && std::ranges::all_of(inputs, is_own_labels))
    return fail("--size, --rate, --classes, --stills", "go with truths of other programs; labels of SIGS say it all",
                ErrorKind::usage);
  return {};
}

Result<std::vector<ClipFiles>> clips_of(const Paths& inputs, const std::string& split, const TruthOptions& options) {
  const bool is_dataset = inputs.size() == 1 && is_dataset_folder(inputs.front());
  if (const Result<void> good = check_truth_options(is_dataset ? Paths() : inputs, options); !good)
    return fail(good.error());
  if (is_dataset) return clips_of_dataset(inputs.front(), split);
  if (!split.empty()) return fail("--split", "goes with a dataset's folder", ErrorKind::usage);
  std::vector<ClipFiles> clips;
  std::vector<std::string> names;
  for (const fs::path& labels : inputs) {
    if (is_dataset_folder(labels))  // it may have a folder labels/, as yolo has
      return fail(labels.string(), "is a dataset; name label files, or one dataset alone", ErrorKind::usage);
    if (const Result<void> good = check_labels(labels, clips); !good) return fail(good.error());
    if (!is_own_labels(labels)) {
      if (const Result<void> added = add_truth(labels, options, clips, names); !added) return fail(added.error());
      continue;
    }
    names.push_back(free_name(labels.stem().string(), names));
    clips.push_back({.name = names.back(), .labels = labels, .results_name = labels.stem().string()});
  }
  return clips;
}

// The extension of a missing file: that of the existing ones.
std::string endings_in(const Paths& there) {
  std::set<std::string> endings;
  for (const fs::path& path : there)
    if (const std::string ending = path.extension().string(); ending == ".csv" || ending == ".json" || ending == ".txt")
      endings.insert(ending);
  return endings.size() == 1 ? *endings.begin() : ".csv, .json or .txt";
}

Result<DetectInputs> by_folders(std::vector<ClipFiles> clips, const Paths& folders) {
  DetectInputs inputs{.clips = std::move(clips)};
  for (const fs::path& folder : folders) {
    inputs.detectors.push_back(free_name(name_of_folder(folder), inputs.detectors));
    for (ClipFiles& clip : inputs.clips) {
      if (clip.results_name != clip.name)
        return fail(clip.labels.string(), "another clip is called so too; name their results' files in order",
                    ErrorKind::usage);
      const Result<fs::path> file = results_in(folder, clip.results_name);
      if (!file) return fail(file.error());
      clip.results.push_back(*file);
    }
  }
  return inputs;
}

void name_by(const Paths& files, DetectInputs& inputs) {
  for (const fs::path& file : files) inputs.detectors.push_back(free_name(file.stem().string(), inputs.detectors));
}

// Each detector's file covers all clips: its image_id are those of the labels of all videos of the split together.
Result<DetectInputs> by_shared_files(std::vector<ClipFiles> clips, const Paths& files) {
  DetectInputs inputs{.clips = std::move(clips)};
  int images = 0;
  for (ClipFiles& clip : inputs.clips) {
    if (clip.split != inputs.clips.front().split)
      return fail("--results",
                  "one file for all clips is in COCO's layout with the image_id of one split; choose it with --split",
                  ErrorKind::usage);
    if (std::error_code code; !fs::exists(fs::path(clip.labels).replace_extension(".coco.json"), code))
      return fail(clip.labels.string(),
                  "has no coco labels beside it, so no image_id tells of it; name a file for each clip");
    clip.results = files;
    clip.first_image_id = images + 1;
    images += clip.frames;
  }
  for (ClipFiles& clip : inputs.clips) clip.last_image_id = images;
  name_by(files, inputs);
  return inputs;
}

Result<DetectInputs> by_files(std::vector<ClipFiles> clips, const Paths& files) {
  DetectInputs inputs{.clips = std::move(clips)};
  const bool is_one_truth = std::ranges::all_of(
      inputs.clips, [&](const ClipFiles& clip) { return clip.truth && clip.labels == inputs.clips.front().labels; });
  const bool is_json = std::ranges::all_of(files, [](const fs::path& file) { return file.extension() == ".json"; });
  const bool is_one_clip = inputs.clips.size() == 1;
  inputs.is_shared = !is_one_clip && files.size() != inputs.clips.size() && is_one_truth && is_json;
  if (is_one_clip || inputs.is_shared) {
    for (ClipFiles& clip : inputs.clips) clip.results = files;
    name_by(files, inputs);
    return inputs;
  }
  if (files.size() != inputs.clips.size() && inputs.clips.front().frames > 0 && is_json)
    return by_shared_files(std::move(inputs.clips), files);
  if (files.size() != inputs.clips.size())
    return fail("--results",
                fmt::format("there are {} clips and {} of results; name one for each, in order, or a folder for each "
                            "detector",
                            inputs.clips.size(), count_text(std::ssize(files), "file")),
                ErrorKind::usage);
  inputs.detectors = {name_of_folder(files.front().parent_path())};
  for (std::size_t i = 0; i < files.size(); ++i) inputs.clips[i].results = {files[i]};
  return inputs;
}

// The results of one detector on one clip.
Result<Results> results_of(const ClipFiles& files, const fs::path& file, const FootageTruth& footage,
                           ResultsFormat format) {
  Result<Results> results = read_results(file, footage,
                                         ResultsOptions{.format = format,
                                                        .multiple_per_frame = true,
                                                        .first_image_id = files.first_image_id,
                                                        .last_image_id = files.last_image_id,
                                                        .images = files.truth ? &files.truth->images : nullptr});
  if (results) warn_of_other_clip(*results, file, files.results_name);
  return results;
}

void warn_of_boxes_elsewhere(const Results& results, const fs::path& file) {
  if (results.boxes_elsewhere > 0)
    print_warning({file.string(), count_text(results.boxes_elsewhere, "report") +
                                      " of images that the truth does not have: left out"});
}

// Of detectors that have one file for all clips.
Result<std::vector<std::vector<DetectedClip>>> shared_clips(const DetectInputs& inputs, ResultsFormat format) {
  std::vector<const TruthClip*> truths;
  for (const ClipFiles& files : inputs.clips) truths.push_back(&*files.truth);
  std::vector<std::vector<DetectedClip>> clips;
  for (const fs::path& file : inputs.clips.front().results) {
    if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return fail(on.error());
    Result<std::vector<Results>> results = read_shared_results(file, truths, format);
    if (!results) return fail(results.error());
    warn_of_boxes_elsewhere(results->front(), file);
    clips.emplace_back();
    for (std::size_t i = 0; i < truths.size(); ++i)
      clips.back().push_back(
          {.name = inputs.clips[i].name, .truth = truths[i]->truth, .results = std::move((*results)[i])});
  }
  return clips;
}

}  // namespace

Result<std::vector<ClipFiles>> clips_of_dataset(const fs::path& folder, const std::string& split) {
  const fs::path index = folder / "index.json";
  if (std::error_code code; !fs::exists(index, code))
    return fail(
        index.string(),
        "no such file; a dataset has it when it is whole: sigs dataset RECIPE --out DIR with --resume makes what "
        "is missing, with --merge the index of what shards made",
        ErrorKind::cannot_read);
  const Result<std::string> text = read_text(index);
  if (!text) return fail(text.error());
  if (json_depth(*text) > kMaxNesting) return fail(index.string(), "is no index of a dataset");
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("sigs_dataset_index") || !json.contains("videos") ||
      !json["videos"].is_array())
    return fail(index.string(), "is no index of a dataset");
  std::vector<ClipFiles> clips;
  for (const nlohmann::json& video : json["videos"])
    if (const Result<void> added = add_video(index, video, split, clips); !added) return fail(added.error());
  if (clips.empty()) return fail(index.string(), split.empty() ? "names no video" : "has no video of split " + split);
  return clips;
}

Result<fs::path> results_in(const fs::path& folder, const std::string& name) {
  const Result<Paths> there = folder_contents(folder);
  if (!there) return fail(there.error());
  Paths found;
  for (const fs::path& path : *there)
    if (std::error_code code; path.stem() == name && fs::is_regular_file(path, code)) found.push_back(path);
  if (found.empty())
    return fail((folder / name).string() + endings_in(*there),
                "no results for this clip; where nothing was detected, they are a file without boxes",
                ErrorKind::cannot_read);
  if (found.size() > 1)
    return fail(folder.string(),
                fmt::format("has both {} and {}", found[0].filename().string(), found[1].filename().string()));
  return found.front();
}

std::string name_of_folder(const fs::path& folder) {
  const fs::path plain = folder.lexically_normal();
  const fs::path name = plain.has_filename() ? plain.filename() : plain.parent_path().filename();
  return name.empty() || name == "." || name == ".." ? "detector" : name.string();
}

void warn_of_other_clip(const Results& results, const fs::path& file, const std::string& clip) {
  if (!results.clip.empty() && results.clip != clip)
    print_warning({file.string(),
                   fmt::format("its img_name is of {}, the clip is {}: are these its results?", results.clip, clip)});
}

std::string free_name(const std::string& name, const std::vector<std::string>& taken) {
  std::string free = name;
  for (int n = 2; std::ranges::find(taken, free) != taken.end(); ++n) free = fmt::format("{} ({})", name, n);
  return free;
}

Result<DetectInputs> detect_inputs(const DetectSources& sources) {
  const Paths& results = sources.results;
  TruthOptions truth = sources.truth;
  const Result<std::optional<cv::Size>> size_px = size_of_option(sources.size);
  if (!size_px) return fail(size_px.error());
  truth.size_px = size_px->value_or(truth.size_px);
  for (const Paths* const paths : {&sources.inputs, &results})
    for (const fs::path& path : *paths)
      if (std::error_code code; !fs::exists(path, code))
        return fail(path.string(), "no such file or folder", ErrorKind::cannot_read);
  Result<std::vector<ClipFiles>> clips = clips_of(sources.inputs, sources.split, truth);
  if (!clips) return fail(clips.error());
  const auto folders = std::count_if(results.begin(), results.end(), is_folder);
  if (folders == static_cast<std::ptrdiff_t>(results.size())) return by_folders(std::move(*clips), results);
  if (folders > 0) return fail("--results", "are folders and files; name either", ErrorKind::usage);
  return by_files(std::move(*clips), results);
}

Result<std::vector<std::vector<DetectedClip>>> clips_by_detector(const DetectInputs& inputs, ResultsFormat format) {
  if (inputs.is_shared) return shared_clips(inputs, format);
  std::vector<std::vector<DetectedClip>> clips(inputs.detectors.size());
  for (const ClipFiles& files : inputs.clips) {
    if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return fail(on.error());
    const Result<ClipTruth> truth = files.truth ? Result<ClipTruth>(files.truth->truth) : read_truth(files.labels);
    if (!truth) return fail(truth.error());
    for (std::size_t i = 0; i < clips.size(); ++i) {
      Result<Results> results = results_of(files, files.results[i], truth->footage, format);
      if (!results) return fail(results.error());
      warn_of_boxes_elsewhere(*results, files.results[i]);
      clips[i].push_back({.name = files.name, .truth = *truth, .results = std::move(*results)});
    }
  }
  return clips;
}

std::vector<fs::path> files_read(const DetectSources& sources, const DetectInputs& clips) {
  std::vector<fs::path> read = sources.inputs;
  read.insert(read.end(), sources.results.begin(), sources.results.end());
  for (const ClipFiles& clip : clips.clips) {
    read.push_back(clip.labels);
    read.insert(read.end(), clip.results.begin(), clip.results.end());
  }
  return read;
}

void add_source_options(CLI::App& command, DetectSources& sources, const SourceHelp& help) {
  command.add_option("LABELS", sources.inputs, help.labels)->required()->check(not_empty());
  add_input(command, "--results", sources.results, help.results, help.results_value)->required();
  add_value(command, "--split", sources.split, "NAME", "only the clips of this split of a dataset");
  add_format_option(command, sources.format);
  TruthOptions& truth = sources.truth;
  add_value(command, "--size", sources.size, "WxH", "size of the images of a yolo truth; else read from the images");
  command.add_option("--rate", truth.rate_hz, "frames a second of another program's truth; else as it says")
      ->type_name("HZ")
      ->check(from_to(1e-3, 1e6));
  add_value(command, "--classes", truth.classes, "NAMES ...",
            "of another program's truth: only these classes count, boxes of others are ignored")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--stills", truth.stills, "images of a coco or yolo truth are no video: gaps are allowed");
}

}  // namespace sigs::cli
