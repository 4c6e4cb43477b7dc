// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <utility>

#include "labels/label_files.h"
#include "labels/label_text.h"
#include "truth/measure.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr double kTruncated = 0.15;  // outside the image; the guidelines say 15 to 20 %
constexpr double kDifficult = 0.2;   // visible; the guidelines leave out what is visible by less than 10 to 20 %

bool is_difficult(const IntruderTruth& truth) {
  return truth.visible_fraction < kDifficult;
}

void add_object(pugi::xml_node annotation, const IntruderTruth& truth, const cv::Rect& labelled,
                const std::string& category) {
  pugi::xml_node object = annotation.append_child("object");
  add_element(object, "name", category);
  add_element(object, "pose", "Unspecified");
  add_element(object, "truncated", truth.inside_fraction < 1 - kTruncated ? 1 : 0);
  add_element(object, "occluded", is_occluded(truth) ? 1 : 0);
  add_element(object, "difficult", is_difficult(truth) ? 1 : 0);
  add_element(object, "trackid", truth.id);
  pugi::xml_node box = object.append_child("bndbox");
  add_element(box, "xmin", labelled.x + 1);
  add_element(box, "ymin", labelled.y + 1);
  add_element(box, "xmax", labelled.x + labelled.width);
  add_element(box, "ymax", labelled.y + labelled.height);
}

std::string annotation_of(const FrameTruth& truth, const LabelSequence& sequence) {
  pugi::xml_document document;
  pugi::xml_node annotation = document.append_child("annotation");
  add_element(annotation, "folder", sequence.name + ".voc");
  add_element(annotation, "filename", image_name(truth.index, sequence.image_extension));
  pugi::xml_node source = annotation.append_child("source");
  add_element(source, "database", "SIGS");
  add_element(source, "annotation", sequence.name);
  add_element(source, "image", sequence.footage.video);
  pugi::xml_node size = annotation.append_child("size");
  add_element(size, "width", sequence.footage.size_px.width);
  add_element(size, "height", sequence.footage.size_px.height);
  add_element(size, "depth", sequence.channels);
  add_element(annotation, "segmented", 0);
  for (const IntruderTruth& intruder : truth.intruders)
    if (is_labelled(intruder, sequence.thresholds))
      add_object(annotation, intruder, labelled_box(intruder, sequence),
                 sequence.categories[static_cast<std::size_t>(category_index(sequence, intruder.id))]);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default | pugi::format_no_declaration, pugi::encoding_utf8);
  return text.str();
}

// Whether an image shows a category, as VOC's lists say it.
enum class Presence { no = -1, difficult = 0, yes = 1 };

// The first bytes of a text in UTF-8, at most so many, whole characters alone.
std::string whole_characters(const std::string& text, std::size_t max_bytes) {
  std::size_t end = std::min(max_bytes, text.size());
  const auto is_within_character = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  while (end > 0 && is_within_character(end)) --end;
  return text.substr(0, end);
}

// Each category as part of a file's name; a free number is appended where two become the same.
std::vector<std::string> file_names_of(const std::vector<std::string>& categories) {
  constexpr std::size_t kMaxBytes = 200;  // file systems allow 255, and more text follows
  std::vector<std::string> names;
  for (const std::string& category : categories) {
    std::string plain = whole_characters(category, kMaxBytes);
    std::replace(plain.begin(), plain.end(), '/', '_');
    std::string name = plain;
    for (std::size_t number = names.size(); std::ranges::count(names, name) > 0; ++number)
      name = fmt::format("{}_{}", plain, number);
    names.push_back(name);
  }
  return names;
}

class VocLabels : public LabelWriter {
 public:
  VocLabels(fs::path root, const LabelSequence& sequence)
      : root_(std::move(root)), sequence_(sequence), presence_(sequence.categories.size()) {}

  Result<void> begin() {
    if (const Result<void> created = make_inner_folder(root_ / "Annotations"); !created) return created;
    return make_inner_folder(root_ / "ImageSets" / "Main");
  }

  Result<void> write(const FrameTruth& truth) override {
    images_.emplace_back(image_name(truth.index, sequence_.image_extension));
    for (std::vector<Presence>& shown : presence_) shown.push_back(Presence::no);
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds)) note_presence(intruder);
    const fs::path file = fs::path(images_.back()).replace_extension(".xml");
    return write_text_file(root_ / "Annotations" / file, annotation_of(truth, sequence_));
  }

  Result<void> finish(const fs::path& images) override {
    const Result<void> written = write_lists();
    return written ? link_images(images, images_, root_ / "JPEGImages") : written;
  }

 private:
  void note_presence(const IntruderTruth& intruder) {
    Presence& presence = presence_[static_cast<std::size_t>(category_index(sequence_, intruder.id))].back();
    presence = std::max(presence, is_difficult(intruder) ? Presence::difficult : Presence::yes);
  }

  Result<void> write_lists() {
    std::string all;
    for (const fs::path& image : images_) all += image.stem().string() + "\n";
    if (const Result<void> written = write_sets("", all); !written) return written;
    const std::vector<std::string> names = file_names_of(sequence_.categories);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (const Result<void> written = write_sets(names[i] + "_", list_of(presence_[i])); !written) return written;
    return {};
  }

  [[nodiscard]] std::string list_of(const std::vector<Presence>& shown) const {
    std::string list;
    for (std::size_t i = 0; i < shown.size(); ++i)
      list += fmt::format("{} {:2}\n", images_[i].stem().string(), static_cast<int>(shown[i]));
    return list;
  }

  Result<void> write_sets(const std::string& prefix, const std::string& list) {
    const fs::path folder = root_ / "ImageSets" / "Main";
    for (const auto& [set, text] :
         {std::pair("train", list), std::pair("val", std::string()), std::pair("trainval", list)})
      if (const Result<void> written = write_text_file(folder / (prefix + set + ".txt"), text); !written)
        return written;
    return {};
  }

  fs::path root_;
  LabelSequence sequence_;
  std::vector<fs::path> images_;
  std::vector<std::vector<Presence>> presence_;  // by category, then image
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_voc(const fs::path& path, const LabelSequence& sequence) {
  auto writer = std::make_unique<VocLabels>(path, sequence);
  if (const Result<void> begun = writer->begin(); !begun) return fail(begun.error());
  return writer;
}

}  // namespace sigs
