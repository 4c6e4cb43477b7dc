// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/text_parsing.h"
#include "evaluation/readers/truth_builder.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

bool is_image_file(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp" ||
         extension == ".tif" || extension == ".tiff" || extension == ".webp";
}

// An image of a sequence and its labels; either may be missing.
struct YoloImage {
  fs::path image;
  fs::path labels;
};

// By name without extension. An image without labels shows nothing.
Result<std::map<std::string, YoloImage>> images_of(const fs::path& labels, const fs::path& images) {
  std::map<std::string, YoloImage> all;
  if (is_folder(images)) {
    const Result<std::vector<fs::path>> there = folder_contents(images);
    if (!there) return fail(there.error());
    for (const fs::path& path : *there)
      if (is_image_file(path) && !all.emplace(path.stem().string(), YoloImage{.image = path}).second)
        return fail(path.string(), "another image has this name");
  }
  const bool has_images = !all.empty();
  const Result<std::vector<fs::path>> there = folder_contents(labels);
  if (!there) return fail(there.error());
  for (const fs::path& path : *there) {
    if (lower_extension(path) != ".txt" || path.filename() == "classes.txt") continue;
    if (has_images && !all.contains(path.stem().string()))
      return fail(path.string(), "has no image in " + images.string());
    all[path.stem().string()].labels = path;
  }
  return all;
}

// class, then centre and size, or the corners of a polygon, as shares of the image.
Result<TrueBox> box_of_line(std::string_view text, cv::Size size_px) {
  const std::vector<std::string_view> fields = number_fields(text);
  const bool is_box = fields.size() == 5;
  if (!is_box && (fields.size() < 7 || fields.size() % 2 == 0))
    return fail("", fmt::format("has {} numbers; labels have 5 (class, centre, size), or a class and the corners of a "
                                "polygon; files with scores are results, not truth",
                                fields.size()));
  std::vector<double> numbers;
  for (const std::string_view field : fields) {
    const std::optional<double> number = finite_number(field);
    if (!number) return fail("", fmt::format("{} is no number", in_quotes(field)));
    if (!numbers.empty() && (*number < -0.01 || *number > 1.01))
      return fail("", fmt::format("{} is no share of the image, 0 to 1; are these pixels?", in_quotes(field)));
    numbers.push_back(*number);
  }
  const std::optional<int> category = integer_of(numbers[0]);
  if (!category || *category < 0)
    return fail("", fmt::format("class {} is no whole number from 0", in_quotes(fields[0])));
  TrueBox box{.category = std::to_string(*category)};
  if (is_box) {
    box.box = {(numbers[1] - numbers[3] / 2) * size_px.width - kEdgeFrom0,
               (numbers[2] - numbers[4] / 2) * size_px.height - kEdgeFrom0, numbers[3] * size_px.width,
               numbers[4] * size_px.height};
    return box;
  }
  const Box shares = box_around(std::span(numbers).subspan(1));
  box.box = {shares.x * size_px.width - kEdgeFrom0, shares.y * size_px.height - kEdgeFrom0,
             shares.width * size_px.width, shares.height * size_px.height};
  return box;
}

Result<void> add_labels(TruthBuilder& builder, const YoloImage& image, int frame, const TruthOptions& options) {
  if (image.labels.empty()) return {};
  const Result<std::string> text = read_text(image.labels);
  if (!text) return fail(text.error());
  TextLines lines(*text);
  cv::Size size_px = options.size_px;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) continue;
    if (size_px.empty() && image.image.empty())
      return fail(image.labels.string(),
                  "its image is not there, so shares of it cannot become pixels; state the images' size with --size");
    if (size_px.empty()) {
      const std::optional<cv::Size> read = image_size_px(image.image);
      if (!read || read->empty()) return fail(image.image.string(), "its size cannot be read; state it with --size");
      size_px = *read;
    }
    Result<TrueBox> box = box_of_line(line->text, size_px);
    if (box) box->frame = frame;
    const Result<void> added = box ? builder.add(*box) : fail(box.error());
    if (!added) return fail(place_of(image.labels, line->number), added.error().what);
  }
  return {};
}

Result<TruthClip> clip_of_labels(const fs::path& labels, const fs::path& images, const std::string& name,
                                 const TruthOptions& options) {
  const Result<std::map<std::string, YoloImage>> all = images_of(labels, images);
  if (!all) return fail(all.error());
  std::vector<std::string> names;
  for (const auto& [stem, image] : *all) names.push_back(stem);
  if (names.empty()) return fail(labels.string(), "has neither labels (.txt) nor images");
  const Result<std::vector<int>> frames = frames_of_images(names, options.stills);
  if (!frames) return fail((labels / frames.error().where).string(), frames.error().what);
  const auto [first, last] = std::ranges::minmax(*frames);
  TruthBuilder builder({.video = name, .size_px = options.size_px, .first_frame = first, .last_frame = last}, 0, {},
                       options);
  FramesOfImages images_by_name;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const Result<void> added = add_labels(builder, all->at(names[i]), (*frames)[i], options); !added)
      return fail(added.error());
    images_by_name.by_name[names[i]] = (*frames)[i];
  }
  Result<TruthClip> clip = builder.clip(name, std::move(images_by_name));
  return clip ? std::move(clip) : fail(labels.string(), clip.error().what);
}

bool has_text_files(const fs::path& folder) {
  const Result<std::vector<fs::path>> there = folder_contents(folder);
  return there && std::ranges::any_of(*there, [](const fs::path& path) { return lower_extension(path) == ".txt"; });
}

}  // namespace

Result<std::vector<TruthClip>> read_yolo_clips(const fs::path& path, const TruthOptions& options) {
  const fs::path labels = path / "labels";
  const Result<std::vector<fs::path>> there = folder_contents(labels);
  if (!there) return fail(there.error());
  std::vector<std::pair<fs::path, std::string>> sequences;  // below labels/
  for (const fs::path& folder : *there)
    if (is_folder(folder)) sequences.emplace_back(folder.filename(), folder.filename().string());
  if (has_text_files(labels) || sequences.empty()) sequences = {{"", canonical_path(path).filename().string()}};
  std::vector<TruthClip> clips;
  for (const auto& [folder, name] : sequences) {
    Result<TruthClip> clip = clip_of_labels(labels / folder, path / "images" / folder, name, options);
    if (!clip) return fail(clip.error());
    clips.push_back(std::move(*clip));
  }
  return clips;
}

}  // namespace sigs
