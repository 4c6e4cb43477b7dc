// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <pugixml.hpp>

#include "base/staged_outputs.h"
#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test::labels {
namespace {

namespace fs = std::filesystem;

pugi::xml_document annotation_in(const fs::path& folder, const std::string& image) {
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "Annotations" / (image + ".xml")).c_str()));
  return document;
}

pugi::xml_document annotation_of(const LabelSequence& sequence, const std::vector<IntruderTruth>& intruders) {
  const TemporaryFolder folder;
  write_labels("voc", folder / "a", sequence, frames_of({intruders}));
  return annotation_in(folder / "a", "frame_000100");
}

std::string text_at(const pugi::xml_node& node, const char* path) {
  const pugi::xml_node found = node.first_element_by_path(path);
  REQUIRE_MESSAGE(found, path << " is missing");
  return found.text().get();
}

// VOC counts from 1 and both ends belong to the box: VOCcode takes xmax - xmin + 1 as its width.
cv::Rect voc_box(const pugi::xml_node& object) {
  const auto number = [&object](const char* path) { return std::stoi(text_at(object, path)); };
  const int x = number("bndbox/xmin");
  const int y = number("bndbox/ymin");
  return {x - 1, y - 1, number("bndbox/xmax") - x + 1, number("bndbox/ymax") - y + 1};
}

std::string flags_of(double visible_fraction, double inside_fraction) {
  IntruderTruth truth = visible_intruder(0, {1, 1, 4, 4});
  truth.visible_fraction = visible_fraction;
  truth.inside_fraction = inside_fraction;
  const pugi::xml_document document = annotation_of(label_sequence(), {truth});
  const pugi::xml_node object = document.child("annotation").child("object");
  return text_at(object, "truncated") + text_at(object, "occluded") + text_at(object, "difficult");
}

std::string list_in(const fs::path& folder, const std::string& name) {
  return *read_text(folder / "ImageSets" / "Main" / name);
}

}  // namespace

TEST_CASE("voc: an annotation names its image and holds its objects") {
  const pugi::xml_document document =
      annotation_of(label_sequence(), {visible_intruder(0, {3, 4, 5, 6}), visible_intruder(1, {30, 20, 2, 1})});
  const pugi::xml_node annotation = document.child("annotation");
  CHECK(text_at(annotation, "folder") == "crossing.voc");
  CHECK(text_at(annotation, "filename") == "frame_000100.png");
  CHECK(text_at(annotation, "source/image") == "flight.mp4");
  CHECK(text_at(annotation, "size/width") == "64");
  CHECK(text_at(annotation, "size/height") == "48");
  CHECK(text_at(annotation, "size/depth") == "3");
  CHECK(text_at(annotation, "segmented") == "0");
  const pugi::xml_node first = annotation.child("object");
  CHECK(text_at(first, "name") == "airplane");
  CHECK(text_at(first, "pose") == "Unspecified");
  CHECK(text_at(first, "trackid") == "0");
  CHECK(text_at(first, "bndbox/xmin") == "4");
  CHECK(text_at(first, "bndbox/ymin") == "5");
  CHECK(text_at(first, "bndbox/xmax") == "8");
  CHECK(text_at(first, "bndbox/ymax") == "10");
  const pugi::xml_node second = first.next_sibling("object");
  CHECK(text_at(second, "name") == "glider");
  CHECK(voc_box(second) == cv::Rect(30, 20, 2, 1));
  CHECK_FALSE(second.next_sibling());
}

TEST_CASE("voc: one pixel in a corner of the image is read back, and the last pixel is the image's size") {
  for (const cv::Point corner : {cv::Point(0, 0), {63, 0}, {0, 47}, {63, 47}}) {
    const pugi::xml_document document =
        annotation_of(label_sequence(), {visible_intruder(0, {corner, cv::Size(1, 1)})});
    CHECK(voc_box(document.child("annotation").child("object")) == cv::Rect(corner, cv::Size(1, 1)));
  }
  const pugi::xml_document whole = annotation_of(label_sequence(), {visible_intruder(0, {0, 0, 64, 48})});
  CHECK(text_at(whole, "annotation/object/bndbox/xmax") == "64");
  CHECK(text_at(whole, "annotation/object/bndbox/ymax") == "48");
}

TEST_CASE("voc: flags follow the guidelines' shares") {
  CHECK(flags_of(1, 1) == "000");
  CHECK(flags_of(0.86, 0.86) == "000");  // cut off by 14 %
  CHECK(flags_of(0.84, 0.84) == "100");
  CHECK(flags_of(0.96, 1) == "000");  // hidden by 4 %
  CHECK(flags_of(0.94, 1) == "010");
  CHECK(flags_of(0.21, 0.5) == "110");
  CHECK(flags_of(0.19, 0.5) == "111");
  CHECK(flags_of(0.19, 0.19) == "101");
}

TEST_CASE("voc: an image without a box has an annotation without objects, thresholds included") {
  LabelSequence sequence = label_sequence();
  sequence.thresholds.min_visible_fraction = 0.5;
  IntruderTruth hidden = visible_intruder(0, {1, 1, 9, 9});
  hidden.visible_fraction = 0.4;
  const pugi::xml_document document = annotation_of(sequence, {hidden, invisible_intruder(1)});
  CHECK(document.child("annotation").child("filename"));
  CHECK_FALSE(document.child("annotation").child("object"));
}

TEST_CASE("voc: each category has lists of its own, named by whole characters") {
  const TemporaryFolder folder;
  LabelSequence sequence = label_sequence(100);
  std::string wide = "x";
  for (int n = 0; n < 150; ++n) wide += "\xC3\xA4";     // 301 bytes, a cut at 200 would halve a character
  sequence.categories = {"a_b_2", "a_b", "a/b", wide};  // the third is a_b, too, and a_b_2 is taken
  write_labels("voc", folder / "a", sequence, frames_of({{}}));
  int lists = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "a" / "ImageSets" / "Main")) {
    const std::string name = entry.path().filename().string();
    lists += name.ends_with("_trainval.txt") ? 1 : 0;
    int pending = 0;  // bytes of a character that are still to come
    for (const char c : name) {
      const auto byte = static_cast<unsigned char>(c);
      CHECK((pending > 0) == ((byte & 0xC0U) == 0x80U));
      pending = pending > 0 ? pending - 1 : byte >= 0xC0U ? 1 : 0;
    }
    CHECK(pending == 0);
  }
  CHECK(lists == 4);
}

TEST_CASE("voc: lists have all images, and state which show a category") {
  const TemporaryFolder folder;
  IntruderTruth difficult = visible_intruder(0, {1, 1, 4, 4});
  difficult.visible_fraction = 0.1;
  const std::vector<FrameTruth> frames = frames_of({{visible_intruder(0, {1, 1, 2, 2}), invisible_intruder(1)},
                                                    {difficult, visible_intruder(1, {9, 9, 2, 2})},
                                                    {invisible_intruder(0), invisible_intruder(1)}});
  write_synthetic_images(folder / "images", label_sequence(102));
  write_labels("voc", folder / "a", label_sequence(102), frames, folder / "images");
  const fs::path voc = folder / "a";
  CHECK(list_in(voc, "trainval.txt") == "frame_000100\nframe_000101\nframe_000102\n");
  CHECK(list_in(voc, "train.txt") == list_in(voc, "trainval.txt"));
  CHECK(list_in(voc, "val.txt").empty());
  CHECK(list_in(voc, "airplane_trainval.txt") == "frame_000100  1\nframe_000101  0\nframe_000102 -1\n");
  CHECK(list_in(voc, "glider_train.txt") == "frame_000100 -1\nframe_000101  1\nframe_000102 -1\n");
  CHECK(list_in(voc, "glider_val.txt").empty());
  for (const FrameTruth& frame : frames) {
    const std::string name = image_name(frame.index);
    CHECK(fs::equivalent(voc / "JPEGImages" / name, folder / "images" / name));
    CHECK(text_at(annotation_in(voc, fs::path(name).stem()), "annotation/filename") == name);
  }
}

TEST_CASE("voc: without images there is no folder of them") {
  const TemporaryFolder folder;
  write_labels("voc", folder / "a", label_sequence(), frames_of({{}}));
  CHECK_FALSE(fs::exists(folder / "a" / "JPEGImages"));
  CHECK(fs::exists(folder / "a" / "Annotations" / "frame_000100.xml"));
}

TEST_CASE("voc: unusual names are read back, in files and as parts of file names") {
  for (const std::string& name : special_names()) {
    const TemporaryFolder folder;
    LabelSequence sequence = label_sequence();
    sequence.name = sequence.footage.video = name;
    sequence.categories[0] = sequence.intruders[0].category = name;
    write_labels("voc", folder / "a", sequence, frames_of({{visible_intruder(0, {1, 1, 1, 1})}}));
    const pugi::xml_document document = annotation_in(folder / "a", "frame_000100");
    CHECK(text_at(document, "annotation/object/name") == name);
    CHECK(text_at(document, "annotation/source/image") == name);
    CHECK(list_in(folder / "a", name + "_trainval.txt") == "frame_000100  1\n");
  }
}

TEST_CASE("voc: categories that no file name can contain have lists of their own") {
  const TemporaryFolder folder;
  LabelSequence sequence = label_sequence();
  sequence.categories = {"a/b", "a_b", std::string(300, 'x')};
  sequence.intruders[0].category = "a/b";
  sequence.intruders[1].category = "a_b";
  write_labels("voc", folder / "a", sequence, frames_of({{invisible_intruder(0), visible_intruder(1, {1, 1, 1, 1})}}));
  CHECK(list_in(folder / "a", "a_b_trainval.txt") == "frame_000100 -1\n");
  CHECK(list_in(folder / "a", "a_b_1_trainval.txt") == "frame_000100  1\n");
  CHECK(files_below(folder / "a" / "ImageSets").size() == 3 + 3 * 3);
}

TEST_CASE("voc: a grey image has one channel, and the locale has no effect") {
  LabelSequence sequence = label_sequence();
  sequence.channels = 1;
  sequence.footage.size_px = {4096, 2160};
  const CommaLocale comma;
  const pugi::xml_document document = annotation_of(sequence, {visible_intruder(0, {1999, 1, 1, 1})});
  CHECK(text_at(document, "annotation/size/depth") == "1");
  CHECK(text_at(document, "annotation/size/width") == "4096");
  CHECK(text_at(document, "annotation/object/bndbox/xmin") == "2000");
}

}  // namespace sigs::test::labels
