// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "annotation/label_words.h"
#include "annotation/picture_links.h"
#include "annotation/text_file.h"
#include "base/partial_file.h"
#include "dataset/merge_formats.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

Result<void> make_folders(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return {};
}

// Every file under `from` gets a second name under `to`.
Result<void> link_tree(const fs::path& from, const fs::path& to) {
  if (const Result<void> step = make_folders(to); !step) return step;
  std::error_code code;
  for (fs::recursive_directory_iterator it(from, code), end; !code && it != end; it.increment(code)) {
    const fs::path place = to / it->path().lexically_relative(from);
    const Result<void> step = it->is_directory() ? make_folders(place) : link_or_copy(it->path(), place);
    if (!step) return step;
  }
  if (code) return fail(from.string(), "cannot be read: " + code.message(), ErrorKind::cannot_read);
  return {};
}

// Every folder right under `from`, but for the one called so.
Result<void> link_folders(const fs::path& from, const fs::path& to, const std::string& but) {
  if (const Result<void> step = make_folders(to); !step) return step;
  std::error_code code;
  for (fs::directory_iterator it(from, code), end; !code && it != end; it.increment(code)) {
    if (!it->is_directory() || it->path().filename() == but) continue;
    if (const Result<void> step = link_tree(it->path(), to / it->path().filename()); !step) return step;
  }
  if (code) return fail(from.string(), "cannot be read: " + code.message(), ErrorKind::cannot_read);
  return {};
}

std::string without_first_line(const std::string& text) {
  const std::size_t end = text.find('\n');
  return end == std::string::npos ? std::string() : text.substr(end + 1);
}

// From the line that begins so to the end.
std::string from_line(const std::string& text, const std::string& begin) {
  const std::size_t place = text.find("\n" + begin);
  return place == std::string::npos ? std::string() : text.substr(place + 1);
}

// YAML takes JSON's quoted texts.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::string yolo_list(const SplitLabels& labels, const std::string& from) {
  std::string list;
  for (const VideoLabels& video : labels.videos) {
    // As labels/yolo's writer lays them: one folder in labels/, and in images/ where there are pictures.
    std::error_code code;
    for (const fs::directory_entry& folder : fs::directory_iterator(video.path / "labels", code)) {
      if (!folder.is_directory()) continue;  // readers leave caches there
      list += "  - " +
              quoted(from + video.video + "/" + video.path.filename().string() + "/images/" +
                     folder.path().filename().string()) +
              "\n";
    }
  }
  return list;
}

// Readers ask for train and val: where there is no such split, another stands for it.
const SplitLabels& stand_in(const std::vector<SplitLabels>& splits, const char* name) {
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
  if (const Result<void> step = make_folders(folder / "seqmaps"); !step) return step;
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
  for (const char* const name : {"train", "val"}) {
    const SplitLabels& labels = stand_in(splits, name);
    if (labels.split != name) text += "# There is no split of this name: " + quoted(labels.split) + " stands for it.\n";
    text += std::string(name) + ":\n" + yolo_list(labels, from);
  }
  for (const SplitLabels& labels : splits)
    if (labels.split != "train" && labels.split != "val")
      text += quoted(labels.split) + ":\n" + yolo_list(labels, from);
  return write_text_file(folder / "data.yaml", text + classes);
}

}  // namespace sigs
