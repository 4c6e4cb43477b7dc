// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <map>
#include <pugixml.hpp>
#include <random>

#include "base/staged_outputs.h"
#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/test_data.h"

namespace sigs::test::labels {
namespace {

std::string cvat_text(const LabelSequence& sequence, const std::vector<FrameTruth>& frames) {
  const TemporaryFolder folder;
  write_labels("cvat", folder / "crossing.cvat.xml", sequence, frames);
  return *read_text(folder / "crossing.cvat.xml");
}

pugi::xml_document cvat_of(const LabelSequence& sequence, const std::vector<FrameTruth>& frames) {
  pugi::xml_document document;
  REQUIRE(document.load_string(cvat_text(sequence, frames).c_str()));
  return document;
}

cv::Rect cvat_box(const pugi::xml_node& shape) {
  const auto number = [&shape](const char* name) {
    REQUIRE_MESSAGE(shape.attribute(name), name << " is missing");
    return shape.attribute(name).as_int();
  };
  return {cv::Point(number("xtl"), number("ytl")), cv::Point(number("xbr"), number("ybr"))};
}

// A track as CVAT shows it: from each keyframe on until the next, except where the keyframe is outside. Boxes that
// would be drawn between two keyframes are not expected, so they have a size that no truth has.
std::map<int, cv::Rect> shown(const pugi::xml_node& track, int frames) {
  std::map<int, cv::Rect> boxes;
  pugi::xml_node last;
  for (const pugi::xml_node& shape : track.children("box")) {
    const int frame = shape.attribute("frame").as_int(-1);
    REQUIRE(frame < frames);
    if (last) REQUIRE(frame > last.attribute("frame").as_int());
    for (int between = last ? last.attribute("frame").as_int() + 1 : frame; between < frame; ++between)
      if (last.attribute("outside").as_int() == 0) boxes[between] = {};
    CHECK(shape.attribute("keyframe").as_int() == 1);
    if (shape.attribute("outside").as_int(-1) == 0) boxes[frame] = cvat_box(shape);
    last = shape;
  }
  for (int after = last.attribute("frame").as_int() + 1; after < frames; ++after)
    if (last.attribute("outside").as_int() == 0) boxes[after] = {};
  return boxes;
}

}  // namespace

TEST_CASE("cvat: the header states version, task, labels and size") {
  LabelSequence sequence = label_sequence(149);
  sequence.video = "crossing.mkv";
  const pugi::xml_document document = cvat_of(sequence, {});
  const pugi::xml_node root = document.child("annotations");
  CHECK(std::string(root.child("version").text().get()) == "1.1");
  const pugi::xml_node task = root.child("meta").child("task");
  const auto text = [&task](const char* path) { return std::string(task.first_element_by_path(path).text().get()); };
  CHECK(text("name") == "crossing");
  CHECK(text("size") == "50");
  CHECK(text("mode") == "interpolation");
  CHECK(text("start_frame") == "0");
  CHECK(text("stop_frame") == "49");
  CHECK(text("segments/segment/start") == "0");
  CHECK(text("segments/segment/stop") == "49");
  CHECK(text("original_size/width") == "64");
  CHECK(text("original_size/height") == "48");
  CHECK(text("labels/label/name") == "airplane");
  CHECK(std::string(task.child("labels").last_child().child("name").text().get()) == "glider");
  CHECK(std::string(root.child("meta").child("source").text().get()) == "crossing.mkv");
  CHECK_FALSE(root.child("track"));
}

TEST_CASE("cvat: a box extends from edge to edge, in frames of the exported video") {
  const pugi::xml_document document = cvat_of(
      label_sequence(102),
      frames_of({{invisible_intruder(1)}, {visible_intruder(1, {3, 4, 5, 6})}, {visible_intruder(1, {4, 4, 5, 6})}}));
  const pugi::xml_node track = document.child("annotations").child("track");
  CHECK(track.attribute("id").as_int(-1) == 1);
  CHECK(std::string(track.attribute("label").value()) == "glider");
  CHECK_FALSE(track.next_sibling("track"));
  const pugi::xml_node box = track.child("box");
  CHECK(box.attribute("frame").as_int(-1) == 1);
  CHECK(std::string(box.attribute("xtl").value()) == "3.00");
  CHECK(std::string(box.attribute("ytl").value()) == "4.00");
  CHECK(std::string(box.attribute("xbr").value()) == "8.00");
  CHECK(std::string(box.attribute("ybr").value()) == "10.00");
  CHECK(std::string(box.attribute("z_order").value()) == "0");
  std::vector<std::string> order;
  for (const pugi::xml_attribute& attribute : box.attributes()) order.emplace_back(attribute.name());
  CHECK(order ==
        std::vector<std::string>{"frame", "keyframe", "outside", "occluded", "xtl", "ytl", "xbr", "ybr", "z_order"});
}

TEST_CASE("cvat: one pixel in a corner of the image is read back") {
  for (const cv::Point corner : {cv::Point(0, 0), {63, 0}, {0, 47}, {63, 47}}) {
    const pugi::xml_document document =
        cvat_of(label_sequence(), frames_of({{visible_intruder(0, {corner, cv::Size(1, 1)})}}));
    CHECK(cvat_box(document.child("annotations").child("track").child("box")) == cv::Rect(corner, cv::Size(1, 1)));
  }
}

TEST_CASE("cvat: whenever intruders appear and disappear, CVAT shows a box exactly in the frames that have one") {
  std::mt19937 random(66);
  for (int round = 0; round < 50; ++round) {
    constexpr int kFrames = 12;
    std::vector<std::vector<IntruderTruth>> clip;
    std::map<int, std::map<int, cv::Rect>> expected;
    for (int frame = 0; frame < kFrames; ++frame) {
      clip.emplace_back();
      for (const int id : {0, 1}) {
        const cv::Rect box(int(random() % 50), int(random() % 40), 1 + int(random() % 9), 1 + int(random() % 7));
        const bool is_seen = random() % 3 != 0;
        clip.back().push_back(is_seen ? visible_intruder(id, box) : invisible_intruder(id));
        if (is_seen) expected[id][frame] = box;
      }
    }
    const pugi::xml_document document = cvat_of(label_sequence(99 + kFrames), frames_of(clip));
    std::map<int, std::map<int, cv::Rect>> found;
    for (const pugi::xml_node& track : document.child("annotations").children("track"))
      found[track.attribute("id").as_int(-1)] = shown(track, kFrames);
    CHECK(found == expected);
  }
}

TEST_CASE("cvat: an intruder that is never visible, or never meets the thresholds, has no track") {
  LabelSequence sequence = label_sequence(101);
  sequence.thresholds.min_pixels = 100;
  const pugi::xml_document document =
      cvat_of(sequence, frames_of({{invisible_intruder(0), visible_intruder(1, {1, 1, 9, 9})},
                                   {invisible_intruder(0), visible_intruder(1, {1, 1, 9, 12})}}));
  const pugi::xml_node track = document.child("annotations").child("track");
  CHECK(track.attribute("id").as_int() == 1);
  CHECK(track.child("box").attribute("frame").as_int() == 1);
  CHECK_FALSE(track.child("box").next_sibling());
  CHECK_FALSE(track.next_sibling("track"));
}

TEST_CASE("cvat: a partly hidden intruder is occluded, one truncated by the border is not") {
  IntruderTruth hidden = visible_intruder(0, {1, 1, 4, 4});
  hidden.visible_fraction = 0.5;
  IntruderTruth cut = visible_intruder(1, {0, 1, 4, 4});
  cut.visible_fraction = cut.inside_fraction = 0.5;
  const pugi::xml_document document = cvat_of(label_sequence(), frames_of({{hidden, cut}}));
  const pugi::xml_node first = document.child("annotations").child("track");
  CHECK(first.child("box").attribute("occluded").as_int(-1) == 1);
  CHECK(first.next_sibling("track").child("box").attribute("occluded").as_int(-1) == 0);
}

TEST_CASE("cvat: unusual names are read back") {
  std::vector<std::string> names = special_names();
  names.emplace_back("tab\tand\nline");
  for (const std::string& name : names) {
    LabelSequence sequence = label_sequence();
    sequence.name = sequence.images = name;
    sequence.categories[0] = sequence.intruders[0].category = name;
    const pugi::xml_document document = cvat_of(sequence, frames_of({{visible_intruder(0, {1, 1, 1, 1})}}));
    const pugi::xml_node root = document.child("annotations");
    CHECK(std::string(root.child("track").attribute("label").value()) == name);
    CHECK(std::string(root.first_element_by_path("meta/task/labels/label/name").text().get()) == name);
    CHECK(std::string(root.first_element_by_path("meta/task/name").text().get()) == name);
    CHECK(std::string(root.first_element_by_path("meta/source").text().get()) == name);
  }
}

TEST_CASE("cvat: labels do not depend on the locale") {
  LabelSequence sequence = label_sequence(100 + 12344);
  sequence.footage.size_px = {4096, 2160};
  const std::vector<FrameTruth> frames = frames_of({{visible_intruder(0, {2000, 1500, 1, 1})}});
  const std::string expected = cvat_text(sequence, frames);
  const CommaLocale comma;
  CHECK(cvat_text(sequence, frames) == expected);
  CHECK(expected.find("<size>12345</size>") != std::string::npos);
  CHECK(expected.find("xtl=\"2000.00\"") != std::string::npos);
}

TEST_CASE("cvat: a full disk is an error") {
  if (!std::filesystem::exists("/dev/full")) return;
  const Result<std::unique_ptr<LabelWriter>> writer = open_cvat("/dev/full", label_sequence());
  REQUIRE(writer.has_value());
  const Result<void> finished = (*writer)->finish({});
  REQUIRE_FALSE(finished.has_value());
  CHECK(finished.error().kind == ErrorKind::write_failed);
}

}  // namespace sigs::test::labels
