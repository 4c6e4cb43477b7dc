// SPDX-License-Identifier: MIT
#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/nesting.h"
#include "dataset/line_reader.h"
#include "dataset/merge_formats.h"
#include "labels/label_files.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// What has to be added to the ids of a video's labels.
struct Offsets {
  std::int64_t video = 0;
  std::int64_t track = 0;
  std::int64_t annotation = 0;
  std::int64_t image = 0;
};

void add(Json& json, const char* key, std::int64_t offset) {
  if (const auto id = json.find(key); id != json.end()) *id = id->get<std::int64_t>() + offset;
}

void put_before(Json& json, const char* key, const std::string& folder) {
  if (const auto name = json.find(key); name != json.end()) *name = folder + name->get<std::string>();
}

void renumber_image(Json& image, const Offsets& offsets, const std::string& folder) {
  add(image, "id", offsets.image);
  add(image, "video_id", offsets.video);
  put_before(image, "file_name", folder);
}

void renumber_annotation(Json& annotation, const Offsets& offsets) {
  add(annotation, "id", offsets.annotation);
  add(annotation, "image_id", offsets.image);
  add(annotation, "video_id", offsets.video);
  add(annotation, "track_id", offsets.track);
}

// A list of the merged file, items parted by commas.
class List {
 public:
  explicit List(TextFile& out) : out_(out) {}
  Result<void> put(const Json& item) {
    const std::string before = is_first_ ? "\n" : ",\n";
    is_first_ = false;
    return out_.put(before + text_of(item));
  }

 private:
  TextFile& out_;
  bool is_first_ = true;
};

struct Head {
  Json info;
  Json video;
  Json categories;
  Json tracks;
};

Json parsed(const std::string& text, LineReader& lines) {
  Json json(Json::value_t::discarded);
  if (json_depth(text) <= kMaxNesting) json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) lines.mark_malformed();
  return json;
}

// The head of one video's file, up to its annotations.
Head read_head(LineReader& lines) {
  Head head;
  static_cast<void>(lines.between("{", ""));
  head.info = parsed(lines.between("\"info\": ", ","), lines);
  static_cast<void>(lines.between("\"licenses\": [],", ""));
  static_cast<void>(lines.between("\"videos\": [", ""));
  head.video = parsed(lines.between("", ""), lines);
  static_cast<void>(lines.between("],", ""));
  head.categories = parsed(lines.between("\"categories\": ", ","), lines);
  head.tracks = parsed(lines.between("\"tracks\": ", ","), lines);
  return head;
}

// Calls put(item) for each line of the list that begins here. Returns how many there were.
template <class Put>
Result<std::int64_t> each_item(LineReader& lines, const std::string& begin, const Put& put) {
  static_cast<void>(lines.between(begin, ""));
  std::int64_t count = 0;
  for (;; ++count) {
    std::optional<std::string> line = lines.next();
    if (!line || line->empty()) break;
    if (line->front() == ']') return count;
    if (line->back() == ',') line->pop_back();
    const Json item = parsed(*line, lines);
    if (!item.is_object()) break;
    if (const Result<void> step = put(item); !step) return fail(step.error());
  }
  lines.mark_malformed();
  return fail(lines.state().error());
}

class CocoMerge {
 public:
  CocoMerge(const SplitLabels& labels, TextFile out) : labels_(labels), out_(std::move(out)) {}

  Result<void> run() {
    Result<void> step = put_heads();
    if (step) step = put_annotations();
    if (step) step = put_images();
    return step ? out_.close() : step;
  }

 private:
  Result<void> put_heads() {
    Json videos = Json::array();
    Json tracks = Json::array();
    Json info;
    Json categories;
    for (const VideoLabels& video : labels_.videos) {
      LineReader lines(video.path);
      Head head = read_head(lines);
      if (const Result<void> state = lines.state(); !state) return state;
      const Offsets offsets{.video = static_cast<std::int64_t>(videos.size()),
                            .track = static_cast<std::int64_t>(tracks.size())};
      offsets_.push_back(offsets);
      add(head.video, "id", offsets.video);
      put_before(head.video, "file_name", video.video + "/");
      videos.push_back(head.video);
      for (Json& track : head.tracks) {
        add(track, "id", offsets.track);
        add(track, "video_id", offsets.video);
        tracks.push_back(track);
      }
      info = head.info;
      categories = head.categories;
    }
    info["description"] = labels_.dataset + " " + labels_.split;
    Result<void> step = out_.put("{\n\"info\": " + text_of(info) + ",\n\"licenses\": [],\n\"videos\": [");
    List list(out_);
    for (const Json& video : videos)
      if (step) step = list.put(video);
    if (step)
      step = out_.put("\n],\n\"categories\": " + text_of(categories) + ",\n\"tracks\": " + text_of(tracks) +
                      ",\n\"annotations\": [");
    return step;
  }

  // Numbers of images are known after the annotations that name them, so each file is gone through twice.
  Result<void> put_annotations() {
    List list(out_);
    Offsets so_far;
    for (std::size_t i = 0; i < labels_.videos.size(); ++i) {
      offsets_[i].annotation = so_far.annotation;
      offsets_[i].image = so_far.image;
      LineReader lines(labels_.videos[i].path);
      static_cast<void>(read_head(lines));
      const Result<std::int64_t> annotations = each_item(lines, "\"annotations\": [", [&](Json annotation) {
        renumber_annotation(annotation, offsets_[i]);
        return list.put(annotation);
      });
      if (!annotations) return fail(annotations.error());
      const Result<std::int64_t> images = each_item(lines, "\"images\": [", [](const Json&) { return Result<void>(); });
      if (!images) return fail(images.error());
      so_far.annotation += *annotations;
      so_far.image += *images;
    }
    return {};
  }

  Result<void> put_images() {
    if (const Result<void> begin = out_.put("\n],\n\"images\": ["); !begin) return begin;
    List list(out_);
    for (std::size_t i = 0; i < labels_.videos.size(); ++i) {
      const VideoLabels& video = labels_.videos[i];
      LineReader lines(video.path);
      static_cast<void>(read_head(lines));
      const Result<std::int64_t> annotations =
          each_item(lines, "\"annotations\": [", [](const Json&) { return Result<void>(); });
      if (!annotations) return fail(annotations.error());
      const Result<std::int64_t> images = each_item(lines, "\"images\": [", [&](Json image) {
        renumber_image(image, offsets_[i], video.video + "/");
        return list.put(image);
      });
      if (!images) return fail(images.error());
    }
    return out_.put("\n]\n}\n");
  }

  const SplitLabels& labels_;
  TextFile out_;
  std::vector<Offsets> offsets_;
};

}  // namespace

Result<void> merge_coco(const SplitLabels& labels, const fs::path& file) {
  Result<TextFile> out = TextFile::create(file);
  if (!out) return fail(out.error());
  try {
    return CocoMerge(labels, std::move(*out)).run();
  } catch (const Json::exception&) {
    return fail(file.string(), "cannot be put together: labels of a video are not as sigs writes them");
  }
}

}  // namespace sigs
