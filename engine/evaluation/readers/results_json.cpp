// SPDX-License-Identifier: MIT
// Layouts of results in JSON: aot and coco.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <climits>
#include <cstdint>
#include <map>
#include <span>

#include "evaluation/readers/json_reading.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

namespace {

// The folder in which an image lies: "one" of "flights/one/frame_000123.png"; empty where its name has none.
std::string folder_of_image(const std::string& image) {
  std::string folder = image.substr(0, image.find_last_of("/\\") + 1);  // npos + 1 is 0
  if (!folder.empty()) folder.pop_back();
  return folder.substr(folder.find_last_of("/\\") + 1);
}

// Reads entries into boxes.
class BoxReader : public EntryReader {
 public:
  // first_number: what the file calls the clip's first frame, for messages
  BoxReader(const ResultsFile& file, int first_number) : EntryReader(file), builder_(file, first_number) {}

  [[nodiscard]] Result<Results> read() {
    if (const Result<void> good = read_entries(); !good) return fail(good.error());
    Results results = builder_.results();
    results.clip = clip_;
    results.boxes_elsewhere = boxes_elsewhere_;
    return results;
  }

 protected:
  // An entry's or a detection's number; `standard` where it has none. Error: it is something else.
  [[nodiscard]] Result<double> number(const JsonValue& object, const char* key, double standard) const {
    const JsonValue* const value = object.field(key);
    if (value == nullptr) return standard;
    if (!value->is(JsonValue::kNumber)) return wrong(*value, fmt::format("{} is {}, not a number", key, value->kind));
    return value->number;
  }

  // `track` is a number of the file, which must be whole, negative for none.
  [[nodiscard]] Result<void> add_box(int frame, const Box& box, double score, double track, int line) {
    const std::optional<int> whole_track = integer_of(track);
    if (!whole_track) return file().wrong(line, "track_id is no whole number");
    const int number = *whole_track < 0 ? kNoTrack : *whole_track;
    return builder_.add(frame, {.box = box, .score = score, .track = number, .line = line});
  }

  // The footage's number of an image's frame: by ResultsOptions::images, else the number at the end of its name.
  [[nodiscard]] std::optional<int> frame_named(std::string_view image) const {
    const FramesOfImages* const images = file().options.images;
    if (images == nullptr || images->by_name.empty()) return frame_of_image(image);
    if (const auto found = images->by_name.find(image); found != images->by_name.end()) return found->second;
    const auto by_stem = images->by_name.find(stem_of_image(image));
    return by_stem == images->by_name.end() ? std::nullopt : std::optional(by_stem->second);
  }

  void leave_out(std::size_t boxes) { boxes_elsewhere_ += static_cast<int>(boxes); }  // of an image not in the truth
  void set_clip_of_image(const std::string& image) {  // the first image that names one counts
    if (clip_.empty()) clip_ = folder_of_image(image);
  }

 private:
  ResultsBuilder builder_;
  std::string clip_;
  int boxes_elsewhere_ = 0;
};

// Results of the Airborne Object Tracking challenge:
// [{"img_name": ..., "detections": [{"x": ..., "y": ..., "w": ..., "h": ..., "s": ...}, ...]}, ...].
class AotReader : public BoxReader {
 public:
  explicit AotReader(const ResultsFile& results) : BoxReader(results, results.clip.first_frame) {}

 private:
  Result<void> take(const JsonValue& entry) override {
    if (!entry.is(JsonValue::kObject)) return wrong(entry, fmt::format(kJsonLayouts, entry.kind));
    const JsonValue* const name = entry.field("img_name");
    if (name != nullptr && !name->is(JsonValue::kText)) return wrong(*name, std::string("img_name is ") + name->kind);
    const JsonValue* const list = entry.field("detections");
    if (list != nullptr && !list->is(JsonValue::kList))
      return wrong(*list, fmt::format("detections is {}, not a list", list->kind));
    const std::span detections = list == nullptr ? std::span<const JsonValue>() : std::span(list->items);
    if (name == nullptr) return wrong(entry, "has no img_name");
    const std::optional<int> frame = frame_named(name->text);
    if (!frame && file().options.images != nullptr) {
      leave_out(detections.size());
      return {};
    }
    if (!frame)
      return wrong(entry, fmt::format("img_name {} does not end with a frame number, as frame_000123.png does",
                                      in_quotes(name->text)));
    const auto [there, is_first] = line_of_frame_.emplace(*frame, entry.line);
    if (!is_first) return wrong(entry, fmt::format("frame {} a second time, first in line {}", *frame, there->second));
    set_clip_of_image(name->text);
    for (std::size_t i = 0; i < detections.size(); ++i) {
      set_detection(i);
      if (const Result<void> added = add_detection(*frame, detections[i]); !added) return added;
    }
    return {};
  }

  Result<void> add_detection(int frame, const JsonValue& detection) {
    if (!detection.is(JsonValue::kObject)) return wrong(detection, fmt::format(kJsonLayouts, detection.kind));
    std::array<double, 4> box{};
    constexpr std::array kSides{"x", "y", "w", "h"};
    for (std::size_t i = 0; i < box.size(); ++i) {
      if (detection.field(kSides[i]) == nullptr) return wrong(detection, std::string("has no ") + kSides[i]);
      const Result<double> side = number(detection, kSides[i], 0);
      if (!side) return fail(side.error());
      box[i] = *side;
    }
    const Result<double> score = number(detection, "s", 1);
    const Result<double> object = number(detection, "object_id", kNoTrack);
    const Result<double> track = object ? number(detection, "track_id", *object) : object;
    if (!score || !track) return fail(score ? track.error() : score.error());
    // x and y are the centre of the box; the origin is the upper left corner of the first pixel.
    const auto& [x, y, width, height] = box;
    return add_box(frame, {x - width / 2 - kEdgeFrom0, y - height / 2 - kEdgeFrom0, width, height}, *score, *track,
                   detection.line);
  }

  std::map<int, int> line_of_frame_;
};

// Results as COCO's evaluation takes them:
// [{"image_id": 1, "category_id": 1, "bbox": [x, y, w, h], "score": 0.9}, ...].
// image_id: a number of COCO's images, or the name of the image (as Ultralytics writes it).
class CocoReader : public BoxReader {
 public:
  explicit CocoReader(const ResultsFile& results) : BoxReader(results, results.options.first_image_id) {}

 private:
  Result<void> take(const JsonValue& entry) override {
    if (!entry.is(JsonValue::kObject))
      return wrong(entry, std::string("is ") + entry.kind +
                              "; coco results are [{\"image_id\": ..., \"bbox\": [x, y, w, h], \"score\": ...}, ...]");
    const Result<std::array<double, 4>> box = box_in(entry);
    const Result<double> score = number(entry, "score", 1);
    const Result<double> track = number(entry, "track_id", kNoTrack);
    const JsonValue* const image = entry.field("image_id");
    if (image == nullptr) return wrong(entry, "has no image_id");
    if (!image->is(JsonValue::kText) && !image->is(JsonValue::kNumber))
      return wrong(*image, fmt::format("image_id is {}, not a number", image->kind));
    if (!box) return fail(box.error());
    if (!score || !track) return fail(score ? track.error() : score.error());
    const Result<std::optional<int>> frame = frame_in(entry, *image);
    if (!frame) return fail(frame.error());
    if (!*frame) {
      leave_out(1);
      return {};
    }
    const FootageTruth& clip = file().clip;
    if (file().options.last_image_id && (**frame < clip.first_frame || **frame > clip.last_frame)) return {};
    // COCO's origin is the upper left corner of the first pixel.
    const auto& [x, y, width, height] = *box;
    return add_box(**frame, {x - kEdgeFrom0, y - kEdgeFrom0, width, height}, *score, *track, entry.line);
  }

  [[nodiscard]] Result<std::array<double, 4>> box_in(const JsonValue& entry) const {
    const JsonValue* const list = entry.field("bbox");
    if (list == nullptr) return wrong(entry, "has no bbox");
    if (!list->is(JsonValue::kList))
      return wrong(*list, fmt::format("bbox is {}, not a list of 4 numbers", list->kind));
    for (const JsonValue& item : list->items)
      if (!item.is(JsonValue::kNumber)) return wrong(item, fmt::format("bbox holds {}, not a number", item.kind));
    std::array<double, 4> box{};
    if (list->items.size() != box.size())
      return wrong(entry, "bbox is not a list of 4 numbers: left, top, width, height");
    std::ranges::transform(list->items, box.begin(), &JsonValue::number);
    return box;
  }

  // The footage's number of the entry's frame; nullopt for an image that the truth does not have.
  [[nodiscard]] Result<std::optional<int>> frame_in(const JsonValue& entry, const JsonValue& image) {
    const ResultsOptions& options = file().options;
    if (image.is(JsonValue::kText)) {
      // Another clip of the file may have an image of the same name.
      if (options.last_image_id && options.images == nullptr)
        return wrong(entry,
                     "image_id is a name, which does not say of which clip; use the numbers of labels/coco/, or a "
                     "file for each clip");
      const std::optional<int> frame = frame_named(image.text);
      if (!frame && options.images == nullptr)
        return wrong(entry, fmt::format("image_id {} is neither a number nor an image's name that ends with one, as "
                                        "frame_000123",
                                        in_quotes(image.text)));
      if (frame) set_clip_of_image(image.text);
      return frame;
    }
    const std::optional<int> id = integer_of(image.number);
    if (id && options.images != nullptr && !options.images->by_id.empty()) {
      const auto found = options.images->by_id.find(*id);
      return found == options.images->by_id.end() ? std::nullopt : std::optional(found->second);
    }
    if (!id || *id < 1) return wrong(entry, "image_id is not a whole number from 1; 1 is the clip's first frame");
    if (options.last_image_id && *id > *options.last_image_id)
      return wrong(entry, fmt::format("image_id {} is past the last one, {}", *id, *options.last_image_id));
    const std::int64_t frame = std::int64_t{file().clip.first_frame} + *id - options.first_image_id;
    return static_cast<int>(std::clamp<std::int64_t>(frame, INT_MIN, INT_MAX));
  }
};

// Looks at the first entry alone.
class FormatReader : public EntryReader {
 public:
  using EntryReader::EntryReader;
  [[nodiscard]] std::optional<ResultsFormat> format() const { return format_; }
  [[nodiscard]] bool is_unknown() const { return is_unknown_; }

 private:
  Result<void> take(const JsonValue& entry) override {
    const auto has = [&](const char* key) { return entry.field(key) != nullptr; };
    if (has("img_name") || has("detections")) format_ = ResultsFormat::aot;
    if (has("image_id") || has("bbox")) format_ = ResultsFormat::coco;
    is_unknown_ = entry.is(JsonValue::kObject) && !format_;
    return fail("", "");
  }

  std::optional<ResultsFormat> format_;
  bool is_unknown_ = false;
};

}  // namespace

Result<Results> read_aot(const ResultsFile& file) {
  return AotReader(file).read();
}

Result<Results> read_coco(const ResultsFile& file) {
  return CocoReader(file).read();
}

Result<ResultsFormat> json_format(const ResultsFile& file) {
  FormatReader first(file);
  static_cast<void>(first.read_entries());
  if (!first.is_unknown()) return first.format().value_or(ResultsFormat::aot);  // whose reader says what is wrong
  return file.wrong(1,
                    "is of no known layout: its first entry has neither img_name and detections (aot) nor image_id and "
                    "bbox (coco)");
}

std::string_view stem_of_image(std::string_view image) {
  const std::string_view name = image.substr(image.find_last_of("/\\") + 1);  // npos + 1 is 0
  return name.substr(0, name.find_last_of('.'));
}

std::optional<int> frame_of_image(std::string_view image) {
  const std::string_view name = stem_of_image(image);
  const auto is_digit = [](char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; };
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), is_digit).base();
  const std::string_view digits = name.substr(static_cast<std::size_t>(begin - name.begin()));
  return digits.empty() ? std::nullopt : integer_of(digits);
}

}  // namespace sigs
