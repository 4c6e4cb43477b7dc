// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <string>

#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

namespace fs = std::filesystem;

// A line of gt.txt as the challenge's instructions name its columns.
struct MotRow {
  int frame, id;
  cv::Rect2d box;
  double counts;
  int category;
  double visibility;
};

std::vector<MotRow> mot_rows(const fs::path& labels, const std::string& name = "clip") {
  std::vector<MotRow> rows;
  for (const std::string& line : lines_of(labels / name / "gt" / "gt.txt")) {
    const std::vector<std::string> fields = parts_of(line, ',');
    REQUIRE(fields.size() == 9);
    std::vector<double> n;
    for (const std::string& field : fields) n.push_back(std::stod(field));
    rows.push_back({int(n[0]), int(n[1]), {n[2], n[3], n[4], n[5]}, n[6], int(n[7]), n[8]});
  }
  return rows;
}

std::map<std::string, std::string> ini_of(const fs::path& path, const std::string& section) {
  std::map<std::string, std::string> keys;
  bool within = false;
  for (const std::string& line : lines_of(path)) {
    if (line.starts_with("[")) within = line == "[" + section + "]";
    const std::size_t equals = line.find('=');
    if (within && equals != std::string::npos) keys[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return keys;
}

// What TrackEval refuses (mot_challenge_2d_box.py): frames beyond seqLength, an id twice in a frame.
void check_accepted(const fs::path& labels) {
  const int length = std::stoi(ini_of(labels / "clip" / "seqinfo.ini", "Sequence").at("seqLength"));
  std::set<std::pair<int, int>> ids;
  for (const MotRow& row : mot_rows(labels)) {
    CHECK(row.frame >= 1);
    CHECK(row.frame <= length);
    CHECK(row.id >= 1);
    CHECK(row.box.width > 0);
    CHECK(row.box.height > 0);
    CHECK(ids.insert({row.frame, row.id}).second);
  }
}

}  // namespace

TEST_CASE("mot counts frames, ids, pixels and classes from 1") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(100, 102, {"airplane", "drone"});
  IntruderTruth half = visible_intruder(1, {638, 478, 2, 2});
  half.visible_fraction = 0.25;
  write_labels(
      "mot", folder / "m", clip,
      {frame_of(100, {visible_intruder(0, {0, 0, 1, 1}), invisible_intruder(1)}),
       frame_of(101, {invisible_intruder(0), invisible_intruder(1)}), frame_of(102, {invisible_intruder(0), half})});
  const std::vector<MotRow> rows = mot_rows(folder / "m");
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].frame == 1);
  CHECK(rows[0].id == 1);
  CHECK(rows[0].box == cv::Rect2d(1, 1, 1, 1));
  CHECK(rows[0].category == 1);
  CHECK(rows[0].visibility == 1);
  CHECK(rows[1].frame == 3);
  CHECK(rows[1].id == 2);
  CHECK(rows[1].box == cv::Rect2d(639, 479, 2, 2));  // its last pixel is 640, 480: the image's last
  CHECK(rows[1].category == 2);
  CHECK(rows[1].visibility == 0.25);
  for (const MotRow& row : rows) CHECK(row.counts == 1);
  check_accepted(folder / "m");
}

TEST_CASE("mot's seqinfo describes the sequence, in the order that readers by line number expect") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(7, 19, {"airplane"});
  clip.footage.frame_rate_num = 30000;
  clip.footage.frame_rate_den = 1001;
  write_labels("mot", folder / "m", clip, {});
  const std::vector<std::string> lines = lines_of(folder / "m" / "clip" / "seqinfo.ini");
  const std::vector<std::string> expected{"[Sequence]",   "name=clip",   "imDir=img1",   "frameRate=30",
                                          "seqLength=13", "imWidth=640", "imHeight=480", "imExt=.png"};
  REQUIRE(lines.size() > expected.size());
  CHECK(std::vector<std::string>(lines.begin(), lines.begin() + 8) == expected);
  CHECK(ini_of(folder / "m" / "clip" / "seqinfo.ini", "Sequence").at("exactFrameRate") == "30000/1001");
  CHECK(ini_of(folder / "m" / "clip" / "seqinfo.ini", "Classes").at("1") == "airplane");
  CHECK(lines_of(folder / "m" / "seqmaps" / "clip.txt") == std::vector<std::string>{"name", "clip"});
}

TEST_CASE("mot's seqinfo names the camera where it is one of several") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(7, 19, {"airplane"});
  write_labels("mot", folder / "alone", clip, {});
  clip.mounted = MountedCamera{.name = "left", .body_from_camera = {}};
  write_labels("mot", folder / "rig", clip, {});
  CHECK_FALSE(ini_of(folder / "alone" / "clip" / "seqinfo.ini", "Sequence").contains("camera"));
  CHECK(ini_of(folder / "rig" / "clip" / "seqinfo.ini", "Sequence").at("camera") == "left");
  CHECK(ini_of(folder / "rig" / "clip" / "seqinfo.ini", "Classes") ==
        ini_of(folder / "alone" / "clip" / "seqinfo.ini", "Classes"));
}

TEST_CASE("mot's images are those of the export, numbered from 1, and take no space of their own") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(98, 100, {"airplane"});
  write_synthetic_images(folder / "images", clip);
  write_labels("mot", folder / "m", clip, {}, folder / "images");
  CHECK(files_below(folder / "m" / "clip" / "img1") ==
        std::vector<std::string>{"000001.png", "000002.png", "000003.png"});
  CHECK(text_of(folder / "m" / "clip" / "img1" / "000001.png") == "98");
  CHECK(text_of(folder / "m" / "clip" / "img1" / "000003.png") == "100");
  CHECK(fs::hard_link_count(folder / "m" / "clip" / "img1" / "000002.png") == 2);
}

TEST_CASE("mot without images has no folder of them") {
  const TemporaryFolder folder;
  write_labels("mot", folder / "m", synthetic_sequence(0, 1, {"airplane"}), {});
  CHECK(files_below(folder / "m") ==
        std::vector<std::string>{"clip/gt/gt.txt", "clip/seqinfo.ini", "seqmaps/clip.txt"});
  CHECK(text_of(folder / "m" / "clip" / "gt" / "gt.txt").empty());
}

TEST_CASE("mot gives the own body in every frame as a distractor that does not count") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
  clip.own_body = cv::Mat::zeros(480, 640, CV_32FC1);
  clip.own_body(cv::Rect(0, 470, 640, 10)) = 1;
  write_labels("mot", folder / "m", clip,
               {frame_of(0, {visible_intruder(0, {5, 5, 9, 9})}), frame_of(1, {invisible_intruder(0)})});
  const std::vector<MotRow> rows = mot_rows(folder / "m");
  REQUIRE(rows.size() == 3);
  for (const std::size_t i : {1U, 2U}) {
    CHECK(rows[i].frame == int(i));
    CHECK(rows[i].id == 2);
    CHECK(rows[i].box == cv::Rect2d(1, 471, 640, 10));
    CHECK(rows[i].counts == 0);
    CHECK(rows[i].category == 8);
  }
  check_accepted(folder / "m");
}

TEST_CASE("mot gives real aircraft of the footage as distractors that do not count") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  clip.has_real_aircraft = true;
  FrameTruth frame = frame_of(0, {visible_intruder(0, {5, 5, 9, 9})});
  frame.real_aircraft = {{20, 30, 7, 5}};
  write_labels("mot", folder / "m", clip, {frame});
  const std::vector<MotRow> rows = mot_rows(folder / "m");
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].box == cv::Rect2d(21, 31, 7, 5));
  CHECK(rows[1].counts == 0);
  CHECK(rows[1].category == 8);
  check_accepted(folder / "m");
}

TEST_CASE("mot's own body takes no class that a category has") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 0, {"a", "b", "c", "d", "e", "f", "g", "h"});
  clip.own_body = cv::Mat::ones(480, 640, CV_32FC1);
  write_labels("mot", folder / "m", clip, {frame_of(0, {visible_intruder(7, {5, 5, 9, 9})})});
  const std::vector<MotRow> rows = mot_rows(folder / "m");
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].category == 8);
  CHECK(rows[1].category == 9);
}

TEST_CASE("mot leaves out objects below the thresholds and keeps those on them") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 3, {"airplane"});
  clip.thresholds = {.min_pixels = 6, .min_visible_fraction = 0.5};
  IntruderTruth on = visible_intruder(0, {5, 5, 3, 2});
  on.visible_fraction = 0.5;
  IntruderTruth hidden = on;
  hidden.visible_fraction = 0.49;
  write_labels(
      "mot", folder / "m", clip,
      {frame_of(0, {visible_intruder(0, {5, 5, 5, 1})}), frame_of(1, {on}), frame_of(2, {hidden}), frame_of(3, {on})});
  std::vector<int> frames;
  for (const MotRow& row : mot_rows(folder / "m")) frames.push_back(row.frame);
  CHECK(frames == std::vector<int>{2, 4});
}

TEST_CASE("mot accepts unusual names for folders and lists") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 0, {"light <aircraft> & co"});
  clip.name = "a, \"b\" \xC3\xBC 'c' 100%";
  write_labels("mot", folder / "m", clip, {frame_of(0, {visible_intruder(0, {5, 5, 9, 9})})});
  CHECK(mot_rows(folder / "m", clip.name).size() == 1);
  CHECK(text_of(folder / "m" / "seqmaps" / (clip.name + ".txt")) == "name\n\"a, \"\"b\"\" \xC3\xBC 'c' 100%\"\n");
}

TEST_CASE("mot labels do not depend on the locale") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(0, 1233, {"airplane"});
  IntruderTruth truth = visible_intruder(0, {5, 5, 1234, 9});
  truth.visible_fraction = 0.125;
  write_labels("mot", folder / "a", clip, {frame_of(1233, {truth})});
  {
    const CommaLocale comma;
    write_labels("mot", folder / "b", clip, {frame_of(1233, {truth})});
  }
  CHECK(text_of(folder / "a" / "clip" / "gt" / "gt.txt") == "1234,1,6,6,1234,9,1,1,0.125\n");
  for (const std::string& file : files_below(folder / "a"))
    CHECK(text_of(folder / "a" / file) == text_of(folder / "b" / file));
}

}  // namespace sigs::test
