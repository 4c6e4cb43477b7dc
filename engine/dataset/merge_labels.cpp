// SPDX-License-Identifier: MIT
#include "dataset/merge_labels.h"
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"
#include "dataset/video_folder.h"
#include "labels/label_files.h"
#include "labels/label_text.h"
#include "labels/labels.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

bool has_labels(const PlannedVideo& video, std::string_view format) {
  const std::vector<std::string>& labels = video.project.output.labels;
  return std::find(labels.begin(), labels.end(), format) != labels.end();
}

std::string category_list(const Project& project) {
  const std::vector<std::string> categories = categories_of(project);
  return categories.empty() ? "none" : listed(categories);
}

Result<void> check_categories(const Plan& plan) {
  const PlannedVideo* first = nullptr;
  for (const PlannedVideo& video : plan.videos) {
    const auto counts = [&](std::string_view format) { return has_labels(video, format); };
    constexpr std::array<std::string_view, 3> kCounting{"coco", "yolo", "mot"};
    if (std::none_of(kCounting.begin(), kCounting.end(), counts)) continue;
    if (first == nullptr) first = &video;
    if (categories_of(video.project) != categories_of(first->project))
      return fail(
          fmt::format("video \"{}\"", video.name),
          fmt::format("counts other categories ({}) than \"{}\" ({}); give all of them the same export.categories",
                      category_list(video.project), first->name, category_list(first->project)));
  }
  return {};
}

// A name in the form that a format uses for folders and columns.
std::string name_in(std::string_view format, const std::string& name) {
  return format == "kitti" ? word_name(name) : line_name(name);
}

Result<void> check_sequence_names(const Plan& plan) {
  for (const std::string_view format : {"mot", "kitti", "vot"}) {
    std::map<std::string, const PlannedVideo*> taken;
    for (const PlannedVideo& video : plan.videos) {
      if (!has_labels(video, format)) continue;
      const auto [other, is_new] = taken.emplace(name_in(format, video.name), &video);
      if (!is_new)
        return fail(fmt::format("video \"{}\"", video.name),
                    fmt::format("is called {} in {} labels, and so is \"{}\"; call it otherwise", other->first, format,
                                other->second->name));
    }
  }
  return {};
}

struct Merger {
  std::string_view format;
  std::string_view suffix;  // of one split's file; empty: a folder of all splits
  Result<void> (*merge)(const SplitLabels& labels, const fs::path& place);
};

constexpr Merger kMergers[] = {{"coco", ".json", merge_coco}, {"aot", ".json", merge_aot}, {"csv", ".csv", merge_csv},
                               {"mot", "", merge_mot},        {"kitti", "", merge_kitti},  {"vot", "", merge_vot}};

std::vector<SplitLabels> labels_of(std::string_view format, const MergeRequest& request,
                                   const std::vector<FinishedVideo>& videos) {
  std::vector<SplitLabels> sets;
  for (const std::string& split : splits_of(videos)) {
    SplitLabels labels{.dataset = request.name, .split = split};
    for (const FinishedVideo& one : videos) {
      const PlannedVideo& video = *one.video;
      if (split_of(video) != split || !has_labels(video, format)) continue;
      const std::string name = video.project.name + std::string(label_format(format)->suffix);
      labels.videos.push_back({video.name, request.dataset / video.name / name});
    }
    if (!labels.videos.empty()) sets.push_back(std::move(labels));
  }
  return sets;
}

Result<fs::path> made(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return folder;
}

}  // namespace

Result<void> check_labels_agree(const Plan& plan) {
  const Result<void> categories = check_categories(plan);
  return categories ? check_sequence_names(plan) : categories;
}

Result<void> merge_labels(const MergeRequest& request, const std::vector<FinishedVideo>& videos) {
  for (const Merger& merger : kMergers) {
    for (const SplitLabels& labels : labels_of(merger.format, request, videos)) {
      if (const Result<void> on = check_interrupt(request.cancel); !on) return on;
      const Result<fs::path> folder = made(request.folder / merger.format);
      if (!folder) return fail(folder.error());
      const bool is_file = !merger.suffix.empty();
      const Result<void> merged =
          merger.merge(labels, is_file ? *folder / (labels.split + std::string(merger.suffix)) : *folder);
      if (!merged) return merged;
    }
  }
  const std::vector<SplitLabels> yolo = labels_of("yolo", request, videos);
  if (yolo.empty()) return {};
  const Result<fs::path> folder = made(request.folder / "yolo");
  return folder ? merge_yolo(yolo, *folder, "../../") : fail(folder.error());
}

namespace fs = std::filesystem;

namespace {

// Every file under `from` gets a second name under `to`.
Result<void> link_tree(const fs::path& from, const fs::path& to) {
  if (const Result<void> step = make_inner_folder(to); !step) return step;
  const Result<std::vector<fs::path>> paths = folder_contents(from);
  if (!paths) return fail(paths.error());
  for (const fs::path& path : *paths) {
    const fs::path place = to / path.filename();
    const Result<void> step = is_folder(path) ? link_tree(path, place) : link_or_copy(path, place);
    if (!step) return step;
  }
  return {};
}

// Every folder directly in `from`, except the one of this name.
Result<void> link_folders(const fs::path& from, const fs::path& to, const std::string& but) {
  if (const Result<void> step = make_inner_folder(to); !step) return step;
  const Result<std::vector<fs::path>> paths = folder_contents(from);
  if (!paths) return fail(paths.error());
  for (const fs::path& path : *paths) {
    if (!is_folder(path) || path.filename() == but) continue;
    if (const Result<void> step = link_tree(path, to / path.filename()); !step) return step;
  }
  return {};
}

std::string without_first_line(const std::string& text) {
  const std::size_t end = text.find('\n');
  return end == std::string::npos ? std::string() : text.substr(end + 1);
}

// From the line that begins with this text to the end.
std::string from_line(const std::string& text, const std::string& begin) {
  const std::size_t place = text.find("\n" + begin);
  return place == std::string::npos ? std::string() : text.substr(place + 1);
}

// The images of a split, a folder for each video, as seen from where `from` leads to the dataset.
Result<std::string> yolo_list(const SplitLabels& labels, const std::string& from) {
  std::string list;
  for (const VideoLabels& video : labels.videos) {
    // As labels/yolo's writer arranges them: one folder in labels/, and in images/ where there are images.
    const Result<std::vector<fs::path>> folders = folder_contents(video.path / "labels");
    if (!folders) return fail(folders.error());
    for (const fs::path& folder : *folders) {
      if (!is_folder(folder)) continue;  // readers leave caches there
      const fs::path images = fs::path(from) / video.video / video.path.filename() / "images" / folder.filename();
      list += "  - " + yaml_text(images.string()) + "\n";
    }
  }
  return list;
}

// Readers ask for train and val: where there is no such split, another takes its place.
const SplitLabels& substitute_split(const std::vector<SplitLabels>& splits, const char* name) {
  for (const char* const wanted : {name, "test", "train"})
    for (const SplitLabels& labels : splits)
      if (labels.split == wanted) return labels;
  return splits.front();
}

}  // namespace

Result<void> merge_mot(const SplitLabels& labels, const fs::path& folder) {
  const std::string name = line_name(labels.dataset + "-" + labels.split);
  std::string map = "name\n";
  for (const VideoLabels& video : labels.videos) {
    const Result<std::string> sequence =
        read_text(video.path / "seqmaps" / (line_name(video.path.stem().string()) + ".txt"));
    if (!sequence) return fail(sequence.error());
    map += without_first_line(*sequence);
    if (const Result<void> linked = link_folders(video.path, folder / name, "seqmaps"); !linked) return linked;
  }
  if (const Result<void> step = make_inner_folder(folder / "seqmaps"); !step) return step;
  return write_text_file(folder / "seqmaps" / (name + ".txt"), map);
}

Result<void> merge_kitti(const SplitLabels& labels, const fs::path& folder) {
  constexpr const char* kMap = "evaluate_tracking.seqmap.training";
  std::string map;
  for (const VideoLabels& video : labels.videos) {
    const Result<std::string> sequence = read_text(video.path / kMap);
    if (!sequence) return fail(sequence.error());
    map += *sequence;
    if (const Result<void> linked = link_folders(video.path, folder / labels.split, ""); !linked) return linked;
  }
  return write_text_file(folder / labels.split / kMap, map);
}

Result<void> merge_vot(const SplitLabels& labels, const fs::path& folder) {
  std::string list;
  for (const VideoLabels& video : labels.videos) {
    const Result<std::string> sequences = read_text(video.path / "list.txt");
    if (!sequences) return fail(sequences.error());
    list += *sequences;
    if (const Result<void> linked = link_folders(video.path, folder / labels.split, ""); !linked) return linked;
  }
  return write_text_file(folder / labels.split / "list.txt", list);
}

Result<void> merge_yolo(const std::vector<SplitLabels>& splits, const fs::path& folder, const std::string& from) {
  const Result<std::string> first = read_text(splits.front().videos.front().path / "data.yaml");
  if (!first) return fail(first.error());
  const std::string classes = from_line(*first, "nc: ");
  if (classes.empty())
    return fail((splits.front().videos.front().path / "data.yaml").string(), "has no line \"nc: \"; make it anew");
  std::string text;
  const auto add = [&](const std::string& key, const SplitLabels& labels) -> Result<void> {
    const Result<std::string> list = yolo_list(labels, from);
    if (!list) return fail(list.error());
    text += key + ":\n" + *list;
    return {};
  };
  for (const char* const name : {"train", "val"}) {
    const SplitLabels& labels = substitute_split(splits, name);
    if (labels.split != name)
      text += fmt::format("# There is no split of this name: {} stands for it.\n", yaml_text(labels.split));
    if (const Result<void> step = add(name, labels); !step) return step;
  }
  for (const SplitLabels& labels : splits)
    if (labels.split != "train" && labels.split != "val")
      if (const Result<void> step = add(yaml_text(labels.split), labels); !step) return step;
  return write_text_file(folder / "data.yaml", text + classes);
}

}  // namespace sigs
