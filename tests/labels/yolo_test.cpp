// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <sstream>

#include "base/staged_outputs.h"
#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test::labels {
namespace {

namespace fs = std::filesystem;

struct Line {
  int number = -1;
  double x = -1;
  double y = -1;
  double width = -1;
  double height = -1;
};

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  for (Line line; in >> line.number >> line.x >> line.y >> line.width >> line.height;) lines.push_back(line);
  CHECK(in.eof());
  return lines;
}

std::vector<Line> labels_of(const LabelSequence& sequence, const std::vector<IntruderTruth>& intruders) {
  const TemporaryFolder folder;
  write_labels("yolo", folder / "a", sequence, frames_of({intruders}));
  return lines_of(*read_text(folder / "a" / "labels" / sequence.name / "frame_000100.txt"));
}

// As Ultralytics finds labels: the path's last images/ becomes labels/, what follows the last point txt.
std::string label_path_of(std::string image) {
  image.replace(image.rfind("/images/"), 8, "/labels/");
  return image.substr(0, image.rfind('.')) + ".txt";
}

}  // namespace

TEST_CASE("yolo: a line is the class and the box's middle and size as shares of the image") {
  const std::vector<Line> lines =
      labels_of(label_sequence(), {visible_intruder(0, {16, 12, 32, 6}), visible_intruder(1, {0, 0, 64, 48})});
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].number == 0);
  CHECK(lines[0].x == 0.5);
  CHECK(lines[0].y == 15.0 / 48);
  CHECK(lines[0].width == 0.5);
  CHECK(lines[0].height == 6.0 / 48);
  CHECK(lines[1].number == 1);
  CHECK(lines[1].x == 0.5);
  CHECK(lines[1].y == 0.5);
  CHECK(lines[1].width == 1);
  CHECK(lines[1].height == 1);
}

TEST_CASE("yolo: every box of a small image is read back and never leaves the image") {
  LabelSequence sequence = label_sequence();
  sequence.footage.size_px = {7, 3};  // no share of these ends in decimals
  constexpr double kLastDecimal = 1e-8;
  for (int x = 0; x < 7; ++x)
    for (int width = 1; x + width <= 7; ++width)
      for (int y = 0; y < 3; ++y) {
        const Line line = labels_of(sequence, {visible_intruder(0, {x, y, width, 3 - y})}).at(0);
        CHECK(std::abs((line.x - line.width / 2) * 7 - x) < 7 * 2 * kLastDecimal);
        CHECK(std::abs((line.x + line.width / 2) * 7 - (x + width)) < 7 * 2 * kLastDecimal);
        CHECK(std::abs((line.y - line.height / 2) * 3 - y) < 3 * 2 * kLastDecimal);
        constexpr double kLastBit = 1e-15;  // of the sum here, not of the numbers written
        CHECK(line.x - line.width / 2 >= -kLastBit);
        CHECK(line.x + line.width / 2 <= 1 + kLastBit);
        CHECK(line.y + line.height / 2 <= 1 + kLastBit);
      }
}

TEST_CASE("yolo: one pixel in a corner of a large image keeps its place and size") {
  LabelSequence sequence = label_sequence();
  sequence.footage.size_px = {8192, 4320};
  for (const cv::Point corner : {cv::Point(0, 0), {8191, 0}, {0, 4319}, {8191, 4319}}) {
    const Line line = labels_of(sequence, {visible_intruder(0, {corner, cv::Size(1, 1)})}).at(0);
    CHECK(std::abs(line.x * 8192 - (corner.x + 0.5)) < 1e-4);
    CHECK(std::abs(line.y * 4320 - (corner.y + 0.5)) < 1e-4);
    CHECK(std::abs(line.width * 8192 - 1) < 1e-4);
    CHECK(std::abs(line.height * 4320 - 1) < 1e-4);
  }
}

TEST_CASE("yolo: an image without a box has an empty file, thresholds included") {
  const TemporaryFolder folder;
  LabelSequence sequence = label_sequence(102);
  sequence.thresholds.min_pixels = 5;
  write_labels(
      "yolo", folder / "a", sequence,
      frames_of({{}, {invisible_intruder(0), visible_intruder(1, {1, 1, 2, 2})}, {visible_intruder(1, {1, 1, 5, 1})}}));
  CHECK(files_below(folder / "a") == std::vector<std::string>{"data.yaml", "labels/crossing/frame_000100.txt",
                                                              "labels/crossing/frame_000101.txt",
                                                              "labels/crossing/frame_000102.txt"});
  CHECK(read_text(folder / "a" / "labels/crossing/frame_000100.txt")->empty());
  CHECK(read_text(folder / "a" / "labels/crossing/frame_000101.txt")->empty());
  CHECK(lines_of(*read_text(folder / "a" / "labels/crossing/frame_000102.txt")).size() == 1);
}

TEST_CASE("yolo: readers find the labels of each image, whatever the video is called") {
  for (const std::string name : {"crossing", "images", "labels"}) {
    const TemporaryFolder folder;
    LabelSequence sequence = label_sequence(101);
    sequence.name = sequence.images = name;
    const std::vector<FrameTruth> frames = frames_of({{visible_intruder(0, {1, 1, 2, 2})}, {}});
    write_synthetic_images(folder / "images", sequence);
    write_labels("yolo", folder / "a", sequence, frames, folder / "images");
    const YAML::Node yaml = YAML::LoadFile((folder / "a" / "data.yaml").string());
    const fs::path images = folder / "a" / yaml["train"].as<std::string>();
    REQUIRE(files_below(images) == std::vector<std::string>{"frame_000100.png", "frame_000101.png"});
    for (const std::string& image : files_below(images)) {
      CHECK(fs::equivalent(images / image, folder / "images" / image));
      CHECK(fs::is_regular_file(label_path_of((images / image).string())));
    }
  }
}

TEST_CASE("yolo: data.yaml has the keys that Ultralytics requires, and unusual names are read back") {
  std::vector<std::string> names = special_names();
  names.emplace_back("control \x7F \xC2\x85 \xC2\x9F");
  names.emplace_back("yes");
  names.emplace_back("12");
  for (const std::string& name : names) {
    const TemporaryFolder folder;
    LabelSequence sequence = label_sequence();
    sequence.name = sequence.images = name;
    sequence.categories[0] = sequence.intruders[0].category = name;
    write_labels("yolo", folder / "a", sequence, frames_of({{}}));
    const YAML::Node yaml = YAML::LoadFile((folder / "a" / "data.yaml").string());
    CHECK(yaml["train"].as<std::string>() == "images/" + name);
    CHECK(yaml["val"].as<std::string>() == "images/" + name);
    CHECK(yaml["nc"].as<int>() == 2);
    REQUIRE(yaml["names"].size() == 2);
    CHECK(yaml["names"][0].as<std::string>() == name);
    CHECK(yaml["names"][1].as<std::string>() == "glider");
    CHECK_FALSE(yaml["path"]);
  }
}

TEST_CASE("yolo: no categories are valid too") {
  const TemporaryFolder folder;
  LabelSequence sequence = label_sequence();
  sequence.intruders.clear();
  sequence.categories.clear();
  write_labels("yolo", folder / "a", sequence, frames_of({{}}));
  CHECK(YAML::LoadFile((folder / "a" / "data.yaml").string())["names"].size() == 0);
}

TEST_CASE("yolo: labels do not depend on the locale") {
  const CommaLocale comma;
  const Line line = labels_of(label_sequence(), {visible_intruder(1, {16, 12, 32, 24})}).at(0);
  CHECK(line.number == 1);
  CHECK(line.width == 0.5);
}

}  // namespace sigs::test::labels
