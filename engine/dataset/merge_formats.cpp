// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "dataset/merge_labels.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace fs = std::filesystem;

// --- The formats that have one file for each split: COCO, AOT and CSV. All of them are put together from the label
// files of the videos, since nothing else that is kept of a video has what they need: NAME.xml is written only where
// the recipe asks for it, and has neither the masks that COCO encodes nor the labels' thresholds.

namespace {

// Offsets added to the ids of a video's COCO labels, so that they differ from those of the videos before it.
struct IdOffsets {
  std::int64_t video = 0;
  std::int64_t track = 0;
  std::int64_t annotation = 0;
  std::int64_t image = 0;
};

void add_offset(Json& json, const char* key, std::int64_t offset) {
  if (const auto id = json.find(key); id != json.end()) *id = id->get<std::int64_t>() + offset;
}

void prepend_folder(Json& json, const char* key, const std::string& folder) {
  if (const auto name = json.find(key); name != json.end()) *name = folder + name->get<std::string>();
}

// A list of the merged file, an item a line.
class List {
 public:
  explicit List(TextFile& out) : out_(out) {}
  Result<void> put(const Json& item) {
    const std::string before = is_first_ ? "\n" : ",\n";
    is_first_ = false;
    return out_.put(before + json_line(item));
  }

 private:
  TextFile& out_;
  bool is_first_ = true;
};

// The labels of one video. Error: the file cannot be read or is no JSON.
Result<Json> read_labels(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  return text ? parsed_json(*text, file.string(), ErrorKind::bad_data) : fail(text.error());
}

// The merged file lists all videos and tracks, then all annotations, then all images. Each video's file is read once
// for each of the three, so that no more than one of them is in memory.
class CocoMerge {
 public:
  CocoMerge(const SplitLabels& labels, TextFile& out) : labels_(labels), out_(out) {}

  Result<void> run() {
    Result<void> step = put_heads();
    if (step) step = put_annotations();
    return step ? put_images() : step;
  }

 private:
  // Information, videos, categories and tracks; computes the offsets of each video's ids.
  Result<void> put_heads() {
    Json videos = Json::array();
    Json tracks = Json::array();
    Json info;
    Json categories;
    IdOffsets next;
    for (const VideoLabels& labels : labels_.videos) {
      Result<Json> coco = read_labels(labels.path);
      if (!coco) return fail(coco.error());
      offsets_.push_back(next);
      Json video = coco->at("videos").at(0);
      add_offset(video, "id", next.video);
      prepend_folder(video, "file_name", labels.video + "/");
      videos.push_back(std::move(video));
      for (Json& track : coco->at("tracks")) {
        add_offset(track, "id", next.track);
        add_offset(track, "video_id", next.video);
        tracks.push_back(track);
      }
      info = coco->at("info");
      categories = coco->at("categories");
      next = {.video = next.video + 1,
              .track = next.track + static_cast<std::int64_t>(coco->at("tracks").size()),
              .annotation = next.annotation + static_cast<std::int64_t>(coco->at("annotations").size()),
              .image = next.image + static_cast<std::int64_t>(coco->at("images").size())};
    }
    info["description"] = labels_.dataset + " " + labels_.split;
    Result<void> step = out_.put("{\n\"info\": " + json_line(info) + ",\n\"licenses\": [],\n\"videos\": [");
    List list(out_);
    for (const Json& video : videos)
      if (step) step = list.put(video);
    if (!step) return step;
    return out_.put(fmt::format("\n],\n\"categories\": {},\n\"tracks\": {},\n\"annotations\": [", json_line(categories),
                                json_line(tracks)));
  }

  // One list of all videos, each item changed by `renumber` first.
  Result<void> put_list(const char* key,
                        const std::function<void(Json&, const IdOffsets&, const VideoLabels&)>& renumber) {
    List list(out_);
    for (std::size_t i = 0; i < labels_.videos.size(); ++i) {
      Result<Json> coco = read_labels(labels_.videos[i].path);
      if (!coco) return fail(coco.error());
      for (Json& item : coco->at(key)) {
        renumber(item, offsets_[i], labels_.videos[i]);
        if (const Result<void> step = list.put(item); !step) return step;
      }
    }
    return {};
  }

  Result<void> put_annotations() {
    return put_list("annotations", [](Json& annotation, const IdOffsets& offsets, const VideoLabels&) {
      add_offset(annotation, "id", offsets.annotation);
      add_offset(annotation, "image_id", offsets.image);
      add_offset(annotation, "video_id", offsets.video);
      add_offset(annotation, "track_id", offsets.track);
    });
  }

  Result<void> put_images() {
    Result<void> step = out_.put("\n],\n\"images\": [");
    if (step)
      step = put_list("images", [](Json& image, const IdOffsets& offsets, const VideoLabels& labels) {
        add_offset(image, "id", offsets.image);
        add_offset(image, "video_id", offsets.video);
        prepend_folder(image, "file_name", labels.video + "/");
      });
    return step ? out_.put("\n]\n}\n") : step;
  }

  const SplitLabels& labels_;
  TextFile& out_;
  std::vector<IdOffsets> offsets_;  // of each video
};

// The flights of all videos, as one file of the data set has those of several.
Result<void> put_flights(const SplitLabels& labels, TextFile& out) {
  bool is_first = true;
  for (const VideoLabels& video : labels.videos) {
    const Result<Json> aot = read_labels(video.path);
    if (!aot) return fail(aot.error());
    for (const auto& [name, flight] : aot->at("samples").items()) {
      const std::string before =
          is_first ? "{\"metadata\": " + json_line(aot->at("metadata")) + ",\n\"samples\": {" : ",\n";
      is_first = false;
      Result<void> step = out.put(before + json_string(name) + ": {\"metadata\": " + json_line(flight.at("metadata")) +
                                  ",\n\"entities\": [");
      List entities(out);
      for (const Json& entity : flight.at("entities"))
        if (step) step = entities.put(entity);
      if (step) step = out.put("\n]}");
      if (!step) return step;
    }
  }
  return out.put("}}\n");
}

// Creates the file, which `put` fills from labels in JSON.
Result<void> merged_json(const fs::path& file, const std::function<Result<void>(TextFile&)>& put) {
  Result<TextFile> out = TextFile::create(file);
  if (!out) return fail(out.error());
  try {
    const Result<void> filled = put(*out);
    return filled ? out->close() : filled;
  } catch (const Json::exception&) {
    return fail(file.string(), "cannot be put together: labels of a video are not as sigs writes them");
  }
}

}  // namespace

Result<void> merge_coco(const SplitLabels& labels, const fs::path& file) {
  return merged_json(file, [&](TextFile& out) { return CocoMerge(labels, out).run(); });
}

Result<void> merge_csv(const SplitLabels& labels, const fs::path& file) {
  Result<TextFile> out = TextFile::create(file);
  if (!out) return fail(out.error());
  std::string header;
  for (const VideoLabels& video : labels.videos) {
    const Result<std::string> text = read_text(video.path);
    if (!text) return fail(text.error());
    const std::string first = text->substr(0, text->find('\n') + 1);
    if (first.empty() || (!header.empty() && first != header))
      return fail(video.path.string() + ": line 1", "is not as sigs writes it; make the video anew");
    if (const Result<void> put = out->put(header.empty() ? *text : text->substr(first.size())); !put) return put;
    header = first;
  }
  return out->close();
}

Result<void> merge_aot(const SplitLabels& labels, const fs::path& file) {
  return merged_json(file, [&](TextFile& out) { return put_flights(labels, out); });
}

// --- The formats that have folders: MOT, KITTI, VOT and YOLO.

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

// The folders of all videos side by side, and their lists of sequences one after the other.
Result<void> merge_folders_and_list(const SplitLabels& labels, const fs::path& folder, const char* list_name) {
  std::string list;
  for (const VideoLabels& video : labels.videos) {
    const Result<std::string> sequences = read_text(video.path / list_name);
    if (!sequences) return fail(sequences.error());
    list += *sequences;
    if (const Result<void> linked = link_folders(video.path, folder / labels.split, ""); !linked) return linked;
  }
  return write_text_file(folder / labels.split / list_name, list);
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
  return merge_folders_and_list(labels, folder, "evaluate_tracking.seqmap.training");
}

Result<void> merge_vot(const SplitLabels& labels, const fs::path& folder) {
  return merge_folders_and_list(labels, folder, "list.txt");
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
