// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "evaluation/readers/json_reading.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/truth_builder.h"

namespace sigs {

namespace {

struct CocoImage {
  int id = 0;
  std::string name;
  std::optional<int> video;
  std::optional<int> frame;  // of the footage, as the file states it
  std::optional<double> time_s;
  cv::Size size_px;
};

struct CocoVideo {
  int id = 0;
  std::string name;
  double rate_hz = 0;
  std::vector<CocoImage> images;  // in order of their frames
};

// Where an image's frame is.
struct CocoPlace {
  std::size_t video = 0;
  int frame = 0;
};

// A list of the document; null: there is none.
const Json* list_of(JsonFields& fields, const Json& document, const char* key) {
  const Json* const list = JsonFields::field(document, key);
  if (list == nullptr || list->is_array()) return list;
  fields.enter("");
  fields.wrong(key, "is not a list");
  return nullptr;
}

CocoImage image_of(JsonFields& fields, const Json& entry, bool stills) {
  CocoImage image{.id = fields.whole(entry, "id"), .name = fields.text(entry, "file_name")};
  if (!stills) image.video = fields.optional_whole(entry, "video_id");
  if (!stills) image.frame = fields.optional_whole(entry, "footage_frame");
  if (!stills && !image.frame) image.frame = fields.optional_whole(entry, "frame_id");
  if (!stills) image.time_s = fields.optional_number(entry, "time_s");
  image.size_px = {fields.optional_whole(entry, "width").value_or(0),
                   fields.optional_whole(entry, "height").value_or(0)};
  return image;
}

// The videos of the file by rising id, or one of all images where images are of none.
Result<std::vector<CocoVideo>> videos_of(JsonFields& fields, const Json& document, const TruthOptions& options) {
  std::map<int, CocoVideo> by_id;
  if (const Json* const videos = options.stills ? nullptr : list_of(fields, document, "videos"))
    for (std::size_t i = 0; i < videos->size(); ++i) {
      fields.enter(fmt::format("videos[{}]", i));
      CocoVideo video{.id = fields.whole((*videos)[i], "id")};
      const char* const name = JsonFields::field((*videos)[i], "name") != nullptr ? "name" : "file_name";
      video.name = fields.text((*videos)[i], name);
      video.rate_hz = fields.optional_number((*videos)[i], "fps").value_or(0);
      if (video.rate_hz < 0) fields.wrong("fps", "is below 0");
      if (!by_id.emplace(video.id, video).second) fields.wrong("id", fmt::format("{} is there twice", video.id));
    }
  const Json* const images = list_of(fields, document, "images");
  const bool has_videos = !by_id.empty();
  std::set<int> ids;
  std::string whole_name = fields.path().stem().string();
  if (whole_name.ends_with(".coco")) whole_name.resize(whole_name.size() - 5);
  for (std::size_t i = 0; images != nullptr && i < images->size() && !fields.is_wrong(); ++i) {
    fields.enter(fmt::format("images[{}]", i));
    const CocoImage image = image_of(fields, (*images)[i], options.stills);
    if (!ids.insert(image.id).second) fields.wrong("id", fmt::format("{} is there twice", image.id));
    if (image.video && !by_id.contains(*image.video))
      fields.wrong("video_id", fmt::format("{} is no video of the file", *image.video));
    if (!image.video && has_videos) fields.wrong("video_id", "is missing, though the file has videos");
    CocoVideo& video = by_id[image.video.value_or(0)];
    if (!image.video) video.name = whole_name;
    video.images.push_back(image);
  }
  if (fields.is_wrong()) return fields.failure();
  std::vector<CocoVideo> videos;
  for (auto& [id, video] : by_id)
    if (!video.images.empty()) videos.push_back(std::move(video));
  if (videos.empty()) return fields.failure("has no image");
  return videos;
}

// Puts the images in order and numbers those without a number by their ids.
Result<void> number_images(const JsonFields& fields, CocoVideo& video) {
  const auto numbered = std::ranges::count_if(video.images, [](const CocoImage& i) { return i.frame.has_value(); });
  if (numbered != 0 && numbered != std::ssize(video.images))
    return fields.failure(fmt::format("video {}: {} of {} images have a frame_id; all need one, or none", video.name,
                                      numbered, video.images.size()));
  std::ranges::sort(video.images, {}, [](const CocoImage& image) { return std::pair(image.frame, image.id); });
  for (std::size_t i = 0; i < video.images.size(); ++i) {
    CocoImage& image = video.images[i];
    if (!image.frame) image.frame = static_cast<int>(i);
    if (*image.frame < 0 || *image.frame > kMaxClipFrames)
      return fields.failure(
          fmt::format("image {}: frame {} is not from 0 to {}", image.name, *image.frame, kMaxClipFrames));
    if (i == 0) continue;
    const CocoImage& before = video.images[i - 1];
    if (*image.frame == *before.frame)
      return fields.failure(fmt::format("images {} and {} are both frame {}", before.name, image.name, *image.frame));
    if (*image.frame != *before.frame + 1)
      return fields.failure(
          fmt::format("image {}: frame {} follows frame {}: those between are missing; images that "
                      "are no video are read with --stills",
                      image.name, *image.frame, *before.frame));
    if (image.time_s && before.time_s && !(*image.time_s > *before.time_s))
      return fields.failure(fmt::format("image {}: time_s does not rise", image.name));
  }
  return {};
}

TruthBuilder builder_of(const CocoVideo& video, const TruthOptions& options) {
  std::vector<double> times_s;
  for (const CocoImage& image : video.images)
    if (image.time_s) times_s.push_back(*image.time_s);
  if (times_s.size() != video.images.size()) times_s.clear();
  return {{.video = video.name,
           .size_px = video.images.front().size_px,
           .first_frame = *video.images.front().frame,
           .last_frame = *video.images.back().frame},
          video.rate_hz,
          std::move(times_s),
          options};
}

HorizonSide horizon_side_in(JsonFields& fields, const Json& entry) {
  if (JsonFields::field(entry, "horizon") == nullptr) return HorizonSide::unknown;
  const std::optional<HorizonSide> side = horizon_side_named(fields.text(entry, "horizon"));
  if (!side) fields.wrong("horizon", "is not above, on, below or unknown");
  return side.value_or(HorizonSide::unknown);
}

// Corner of the first pixel to its centre.
Box box_of_numbers(const std::array<double, 4>& box) {
  return {box[0] - kEdgeFrom0, box[1] - kEdgeFrom0, box[2], box[3]};
}

// true, false, 1 or 0; not there: false.
bool flag_of(JsonFields& fields, const Json& entry, const char* key) {
  const Json* const value = JsonFields::field(entry, key);
  if (value == nullptr) return false;
  if (value->is_boolean()) return value->get<bool>();
  const int number = fields.whole(entry, key);
  if (number != 0 && number != 1) fields.wrong(key, "is neither 0 nor 1");
  return number == 1;
}

// An annotation; what SIGS adds to the layout is read where it is there.
TrueBox box_of_annotation(JsonFields& fields, const Json& entry, const std::map<int, std::string>& categories) {
  TrueBox box{.box = box_of_numbers(fields.four_numbers(entry, "bbox"))};
  box.is_ignored = flag_of(fields, entry, "iscrowd");
  box.is_ignored |= flag_of(fields, entry, "ignore");
  const int category = fields.whole(entry, "category_id");
  const auto named = categories.find(category);
  if (named == categories.end() && !categories.empty() && !fields.is_wrong())
    fields.wrong("category_id", fmt::format("{} is no category of the file", category));
  box.category = named == categories.end() ? std::to_string(category) : named->second;
  for (const char* const key : {"track_id", "instance_id"})
    if (!box.id && !box.is_ignored) box.id = fields.optional_whole(entry, key);
  if (box.id && *box.id < 0) box.id.reset();
  box.visible_fraction = fields.optional_number(entry, "visible_fraction").value_or(box.visible_fraction);
  box.distance_m = fields.optional_number(entry, "distance_m").value_or(box.distance_m);
  box.rms_contrast = fields.optional_number(entry, "rms_contrast");
  if (JsonFields::field(entry, "amodal_bbox") != nullptr)
    box.amodal_box = box_of_numbers(fields.four_numbers(entry, "amodal_bbox"));
  box.horizon = horizon_side_in(fields, entry);
  return box;
}

std::map<int, std::string> categories_of(JsonFields& fields, const Json& document) {
  std::map<int, std::string> names;
  const Json* const list = list_of(fields, document, "categories");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    fields.enter(fmt::format("categories[{}]", i));
    names[fields.whole((*list)[i], "id")] = fields.text((*list)[i], "name");
  }
  return names;
}

Result<void> add_annotations(JsonFields& fields, const Json& document, const std::map<int, CocoPlace>& places,
                             std::vector<TruthBuilder>& builders) {
  const std::map<int, std::string> categories = categories_of(fields, document);
  const Json* const annotations = list_of(fields, document, "annotations");
  if (annotations == nullptr && !fields.is_wrong()) return fields.failure("has no list \"annotations\"");
  for (std::size_t i = 0; annotations != nullptr && i < annotations->size(); ++i) {
    if (fields.is_wrong()) break;
    const std::string place = fmt::format("annotations[{}]", i);
    fields.enter(place);
    TrueBox box = box_of_annotation(fields, (*annotations)[i], categories);
    const int image = fields.whole((*annotations)[i], "image_id");
    const auto found = places.find(image);
    if (!fields.is_wrong() && found == places.end())
      fields.wrong("image_id", fmt::format("{} is no image of the file", image));
    // A distractor of ours, such as a bird: a report at it is a false alarm, as in the annotation file.
    const bool is_distractor = flag_of(fields, (*annotations)[i], "distractor");
    if (fields.is_wrong()) break;
    if (is_distractor) continue;
    box.frame = found->second.frame;
    if (const Result<void> added = builders[found->second.video].add(box); !added)
      return fields.failure(place + ": " + added.error().what);
  }
  if (fields.is_wrong()) return fields.failure();
  return {};
}

}  // namespace

Result<std::vector<TruthClip>> read_coco_clips(const std::filesystem::path& path, const TruthOptions& options) {
  JsonFields fields(path);
  const Result<Json> document = fields.document();
  if (!document) return fail(document.error());
  Result<std::vector<CocoVideo>> videos = videos_of(fields, *document, options);
  if (!videos) return fail(videos.error());
  std::map<int, CocoPlace> places;
  std::vector<TruthBuilder> builders;
  std::vector<FramesOfImages> images_of;
  for (CocoVideo& video : *videos) {
    if (const Result<void> good = number_images(fields, video); !good) return fail(good.error());
    FramesOfImages images;
    for (const CocoImage& image : video.images) {
      places[image.id] = {builders.size(), *image.frame};
      images.by_id[image.id] = *image.frame;
      images.by_name[image.name] = *image.frame;
    }
    add_short_names(images);
    images_of.push_back(std::move(images));
    builders.push_back(builder_of(video, options));
  }
  if (const Result<void> added = add_annotations(fields, *document, places, builders); !added)
    return fail(added.error());
  std::vector<TruthClip> clips;
  for (std::size_t i = 0; i < builders.size(); ++i) {
    Result<TruthClip> clip = builders[i].clip((*videos)[i].name, std::move(images_of[i]));
    if (!clip) return fields.failure(clip.error().what);
    clips.push_back(std::move(*clip));
  }
  return clips;
}

}  // namespace sigs
