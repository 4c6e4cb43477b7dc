// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

namespace fs = std::filesystem;

// Lines "key=value" as the toolkit reads them: a backslash makes the next letter literal.
std::map<std::string, std::string> properties_of(const fs::path& path) {
  std::map<std::string, std::string> properties;
  for (const std::string& line : lines_of(path)) {
    std::vector<std::string> fields{""};
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '=')
        fields.emplace_back();
      else
        fields.back() += line[i] == '\\' ? line.at(++i) : line[i];
    }
    REQUIRE_MESSAGE(fields.size() == 2, line);
    properties[fields[0]] = fields[1];
  }
  return properties;
}

// As the toolkit parses a region: four numbers, none of them NaN, are a rectangle.
std::vector<std::optional<cv::Rect2d>> regions_of(const fs::path& path) {
  std::vector<std::optional<cv::Rect2d>> regions;
  for (const std::string& line : lines_of(path)) {
    std::vector<double> n;
    for (const std::string& field : parts_of(line, ',')) n.push_back(std::stod(field));
    REQUIRE(n.size() == 4);
    if (std::isnan(n[0] + n[1] + n[2] + n[3]))
      regions.emplace_back();
    else
      regions.emplace_back(cv::Rect2d(n[0], n[1], n[2], n[3]));
  }
  return regions;
}

}  // namespace

TEST_CASE("a vot sequence has a line for each frame, pixels counted from 0 and absent targets marked") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(50, 53, {"airplane"});
  IntruderTruth far = invisible_intruder(0);
  far.position_m = {-1e7, 0, 0};
  IntruderTruth half = visible_intruder(0, {639, 479, 1, 1});
  half.visible_fraction = 0.4;
  half.inside_fraction = 0.8;
  half.position_m = {3, 4, 12};
  write_labels(
      "vot", folder / "v", clip,
      {frame_of(50, {visible_intruder(0, {0, 0, 3, 2})}), frame_of(51, {far}), frame_of(52, {half}), frame_of(53, {})});
  const fs::path sequence = folder / "v" / "clip";
  const auto regions = regions_of(sequence / "groundtruth.txt");
  REQUIRE(regions.size() == 4);
  CHECK(regions[0] == cv::Rect2d(0, 0, 3, 2));
  CHECK_FALSE(regions[1].has_value());
  CHECK(regions[2] == cv::Rect2d(639, 479, 1, 1));
  CHECK_FALSE(regions[3].has_value());
  using Lines = std::vector<std::string>;
  CHECK(lines_of(sequence / "absence.tag") == Lines{"0", "1", "0", "1"});
  CHECK(lines_of(sequence / "occlusion.tag") == Lines{"0", "0", "1", "0"});
  CHECK(lines_of(sequence / "distance_m.value") == Lines{"100", "10000000", "13", "0"});
  CHECK(lines_of(sequence / "visible_fraction.value") == Lines{"1", "0", "0.4", "0"});
  CHECK(lines_of(folder / "v" / "list.txt") == Lines{"clip"});
}

TEST_CASE("a vot target that the image's border cuts is not called occluded") {
  const TemporaryFolder folder;
  IntruderTruth cut = visible_intruder(0, {0, 0, 3, 2});
  cut.visible_fraction = cut.inside_fraction = 0.3;
  write_labels("vot", folder / "v", synthetic_sequence(0, 0, {"airplane"}), {frame_of(0, {cut})});
  CHECK(lines_of(folder / "v" / "clip" / "occlusion.tag") == std::vector<std::string>{"0"});
}

TEST_CASE("a vot sequence's properties are read as the toolkit reads them") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(3, 12, {"airplane"});
  clip.name = "a=b \\ \xC3\xBC";
  clip.footage.frame_rate_num = 30000;
  clip.footage.frame_rate_den = 1001;
  write_labels("vot", folder / "v", clip, {});
  const std::map<std::string, std::string> expected{
      {"name", clip.name},         {"fps", "30"},    {"width", "640"},
      {"height", "480"},           {"length", "10"}, {"channels.color", "color/%08d.png"},
      {"frame_rate", "30000/1001"}};
  CHECK(properties_of(folder / "v" / clip.name / "sequence") == expected);
}

TEST_CASE("each of several intruders has its vot sequence, and the list names those that appear") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(0, 1, {"airplane", "airplane", "drone"});
  write_synthetic_images(folder / "images", clip);
  write_labels("vot", folder / "v", clip,
               {frame_of(0, {visible_intruder(0, {1, 1, 4, 4}), invisible_intruder(1), invisible_intruder(2)}),
                frame_of(1, {invisible_intruder(0), invisible_intruder(1), visible_intruder(2, {7, 7, 4, 4})})},
               folder / "images");
  CHECK(lines_of(folder / "v" / "list.txt") == std::vector<std::string>{"clip-0", "clip-2"});
  for (const std::string name : {"clip-0", "clip-1", "clip-2"}) {
    const fs::path sequence = folder / "v" / name;
    CHECK(regions_of(sequence / "groundtruth.txt").size() == 2);
    CHECK(files_below(sequence / "color") == std::vector<std::string>{"00000001.png", "00000002.png"});
    CHECK(text_of(sequence / "color" / "00000002.png") == "1");
    CHECK(fs::hard_link_count(sequence / "color" / "00000002.png") == 4);
  }
  CHECK(regions_of(folder / "v" / "clip-2" / "groundtruth.txt")[1] == cv::Rect2d(7, 7, 4, 4));
}

TEST_CASE("where nothing is ever visible vot's list is empty") {
  const TemporaryFolder folder;
  write_labels("vot", folder / "v", synthetic_sequence(0, 0, {"airplane"}), {frame_of(0, {invisible_intruder(0)})});
  CHECK(text_of(folder / "v" / "list.txt").empty());
  const TemporaryFolder none;
  write_labels("vot", none / "v", synthetic_sequence(0, 0, {}), {frame_of(0, {})});
  CHECK(files_below(none / "v") == std::vector<std::string>{"list.txt"});
}

TEST_CASE("vot marks targets below the thresholds as absent") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
  clip.thresholds.min_pixels = 5;
  write_labels("vot", folder / "v", clip,
               {frame_of(0, {visible_intruder(0, {1, 1, 2, 2})}), frame_of(1, {visible_intruder(0, {1, 1, 5, 1})})});
  const auto regions = regions_of(folder / "v" / "clip" / "groundtruth.txt");
  CHECK_FALSE(regions.at(0).has_value());
  CHECK(regions.at(1).has_value());
}

TEST_CASE("vot names have no line breaks and no blanks around them") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  clip.name = " two\nlines\xFF ";
  write_labels("vot", folder / "v", clip, {frame_of(0, {visible_intruder(0, {1, 1, 2, 2})})});
  const std::vector<std::string> list = lines_of(folder / "v" / "list.txt");
  CHECK(list == std::vector<std::string>{"two lines\xEF\xBF\xBD"});
  CHECK(fs::exists(folder / "v" / list[0] / "groundtruth.txt"));
}

TEST_CASE("vot labels do not depend on the locale") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  IntruderTruth truth = visible_intruder(0, {1, 1, 2, 2});
  truth.position_m = {1234.5, 0, 0};
  const CommaLocale comma;
  write_labels("vot", folder / "v", clip, {frame_of(0, {truth})});
  CHECK(text_of(folder / "v" / "clip" / "distance_m.value") == "1234.5\n");
}

}  // namespace sigs::test
