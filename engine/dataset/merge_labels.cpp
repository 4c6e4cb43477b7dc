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
  Result<void> (*merge)(const SplitLabels& labels, const fs::path& place) = nullptr;
  // In place of the one above: all splits at once.
  Result<void> (*merge_splits)(const std::vector<SplitLabels>& splits, const fs::path& folder,
                               const std::string& from) = nullptr;
};

constexpr Merger kMergers[] = {{.format = "coco", .suffix = ".json", .merge = merge_coco},
                               {.format = "aot", .suffix = ".json", .merge = merge_aot},
                               {.format = "csv", .suffix = ".csv", .merge = merge_csv},
                               {.format = "mot", .suffix = "", .merge = merge_mot},
                               {.format = "kitti", .suffix = "", .merge = merge_kitti},
                               {.format = "vot", .suffix = "", .merge = merge_vot},
                               {.format = "yolo", .suffix = "", .merge_splits = merge_yolo}};

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

Result<void> merge_each(const Merger& merger, const std::vector<SplitLabels>& splits, const fs::path& folder,
                        const std::atomic<bool>* cancel) {
  for (const SplitLabels& labels : splits) {
    if (const Result<void> on = check_interrupt(cancel); !on) return on;
    const bool is_file = !merger.suffix.empty();
    const Result<void> merged =
        merger.merge(labels, is_file ? folder / (labels.split + std::string(merger.suffix)) : folder);
    if (!merged) return merged;
  }
  return {};
}

}  // namespace

Result<void> check_labels_agree(const Plan& plan) {
  const Result<void> categories = check_categories(plan);
  return categories ? check_sequence_names(plan) : categories;
}

Result<void> merge_labels(const MergeRequest& request, const std::vector<FinishedVideo>& videos) {
  for (const Merger& merger : kMergers) {
    const std::vector<SplitLabels> splits = labels_of(merger.format, request, videos);
    if (splits.empty()) continue;
    const fs::path folder = request.folder / merger.format;
    if (const Result<void> made = make_inner_folder(folder); !made) return made;
    const Result<void> merged = merger.merge_splits != nullptr ? merger.merge_splits(splits, folder, "../../")
                                                               : merge_each(merger, splits, folder, request.cancel);
    if (!merged) return merged;
  }
  return {};
}

}  // namespace sigs
