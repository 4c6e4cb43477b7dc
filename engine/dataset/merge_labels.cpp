// SPDX-License-Identifier: MIT
#include "dataset/merge_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "base/text.h"
#include "base/threads.h"
#include "labels/label_files.h"
#include "labels/label_text.h"
#include "labels/labels.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

bool has_labels(const PlannedVideo& video, std::string_view format) {
  return std::ranges::count(video.project.output.labels, format) > 0;
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

}  // namespace

Result<void> check_labels_agree(const Plan& plan) {
  const Result<void> categories = check_categories(plan);
  return categories ? check_sequence_names(plan) : categories;
}

Result<void> merge_labels(const MergeRequest& request, const std::vector<FinishedVideo>& videos) {
  for (const Merger& merger : kMergers) {
    for (const SplitLabels& labels : labels_of(merger.format, request, videos)) {
      if (const Result<void> on = check_interrupt(request.cancel); !on) return on;
      const fs::path folder = request.folder / merger.format;
      if (const Result<void> made = make_inner_folder(folder); !made) return made;
      const bool is_file = !merger.suffix.empty();
      const Result<void> merged =
          merger.merge(labels, is_file ? folder / (labels.split + std::string(merger.suffix)) : folder);
      if (!merged) return merged;
    }
  }
  const std::vector<SplitLabels> yolo = labels_of("yolo", request, videos);
  if (yolo.empty()) return {};
  const fs::path folder = request.folder / "yolo";
  const Result<void> made = make_inner_folder(folder);
  return made ? merge_yolo(yolo, folder, "../../") : made;
}

}  // namespace sigs
