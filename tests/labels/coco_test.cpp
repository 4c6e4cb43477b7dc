// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "labels/label_files.h"
#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/test_data.h"

namespace sigs::test::labels {
namespace {

using Json = nlohmann::json;

std::string coco_text(const LabelSequence& sequence, const std::vector<FrameTruth>& frames) {
  const TemporaryFolder folder;
  write_labels("coco", folder / "crossing.coco.json", sequence, frames);
  return *read_text(folder / "crossing.coco.json");
}

Json coco_of(const LabelSequence& sequence, const std::vector<FrameTruth>& frames) {
  return Json::parse(coco_text(sequence, frames));
}

std::vector<Json> of_image(const Json& coco, int image_id, int iscrowd) {
  std::vector<Json> list;
  for (const Json& annotation : coco["annotations"])
    if (annotation["image_id"] == image_id && annotation["iscrowd"] == iscrowd) list.push_back(annotation);
  return list;
}

// What pycocotools' index and evaluation rely on: https://cocodataset.org/#format-data.
void check_is_coco(const Json& coco) {
  std::set<int> images;
  std::set<int> categories;
  std::set<int> annotations;
  for (const Json& image : coco.at("images")) CHECK(images.insert(image.at("id").get<int>()).second);
  for (const Json& category : coco.at("categories")) CHECK(categories.insert(category.at("id").get<int>()).second);
  for (const Json& annotation : coco.at("annotations")) {
    CHECK(annotation.at("id").get<int>() > 0);
    CHECK(annotations.insert(annotation.at("id").get<int>()).second);
    CHECK(images.contains(annotation.at("image_id").get<int>()));
    CHECK(categories.contains(annotation.at("category_id").get<int>()));
    CHECK(annotation.at("bbox").size() == 4);
    CHECK(annotation.at("area").is_number());
    CHECK((annotation.at("iscrowd") == 0 || annotation.at("iscrowd") == 1));
  }
  CHECK(coco.at("info").is_object());
  CHECK(coco.at("licenses").is_array());
}

}  // namespace

TEST_CASE("coco: images, video and categories are numbered from 1, frames of the video from 0") {
  const Json coco = coco_of(label_sequence(102), frames_of({{}, {visible_intruder(0, {3, 4, 5, 6})}, {}}));
  check_is_coco(coco);
  REQUIRE(coco["images"].size() == 3);
  const Json& image = coco["images"][1];
  CHECK(image["id"] == 2);
  CHECK(image["file_name"] == "crossing/frame_000101.png");
  CHECK(image["width"] == 64);
  CHECK(image["height"] == 48);
  CHECK(image["video_id"] == 1);
  CHECK(image["frame_id"] == 1);
  CHECK(image["footage_frame"] == 101);
  CHECK(image["time_s"].get<double>() == doctest::Approx(101 * 1001.0 / 30000).epsilon(1e-7));
  const Json& video = coco["videos"][0];
  CHECK(video["id"] == 1);
  CHECK(video["name"] == "crossing");
  CHECK(video["width"] == 64);
  CHECK(video["height"] == 48);
  CHECK(video["length"] == 3);
  CHECK(video["fps"].get<double>() == doctest::Approx(30000.0 / 1001).epsilon(1e-7));
  CHECK(video["footage"]["file_name"] == "flight.mp4");
  CHECK(video["footage"]["first_frame"] == 100);
  CHECK_FALSE(video.contains("file_name"));
  CHECK(coco["categories"][1]["id"] == 2);
  CHECK(coco["categories"][1]["name"] == "glider");
  CHECK(coco["tracks"][1]["id"] == 1);
  CHECK(coco["tracks"][1]["category_id"] == 2);
  CHECK(coco["tracks"][1]["name"] == "sailplane");
}

TEST_CASE("coco: the exported video is named where there is one") {
  LabelSequence sequence = label_sequence();
  sequence.video = "crossing.mkv";
  CHECK(coco_of(sequence, {})["videos"][0]["file_name"] == "crossing.mkv");
}

TEST_CASE("coco: of several cameras the video has name, lens and mount, and each image the name") {
  LabelSequence sequence = label_sequence();
  const std::string alone = coco_text(sequence, frames_of({{visible_intruder(1, {10, 20, 3, 2})}}));
  CHECK(alone.find("\"camera\"") == std::string::npos);
  const double half = std::sqrt(0.5);
  sequence.mounted = MountedCamera{.name = "left", .body_from_camera = {{half, 0, 0, -half}, {0.5, -1, 0.25}}};
  const Json coco = coco_of(sequence, frames_of({{visible_intruder(1, {10, 20, 3, 2})}}));
  check_is_coco(coco);
  for (const Json& image : coco["images"]) CHECK(image["camera"] == "left");
  const Json& camera = coco["videos"][0]["camera"];
  CHECK(camera["name"] == "left");
  CHECK(camera["mount"]["position_m"] == Json({0.5, -1.0, 0.25}));
  CHECK(camera["mount"]["body_from_camera_wxyz"] == Json({half, 0.0, 0.0, -half}));
  CHECK(camera.contains("lens") == sequence.camera.has_value());
}

TEST_CASE("coco: an annotation has the box, mask and place of the intruder") {
  IntruderTruth truth = visible_intruder(1, {10, 20, 3, 2});
  truth.visible.at<unsigned char>(0, 0) = 0;
  truth.visible_pixels = 5;
  truth.visible_fraction = 0.25;
  truth.inside_fraction = 0.5;
  truth.position_m = {3e3, -4e3, 12e3};
  truth.world_from_body = rotation_of({rad_of_deg(10), rad_of_deg(-20), rad_of_deg(170)});
  truth.amodal_box = Box{9.25, 19.5, 6, 2.5};
  truth.horizon = HorizonSide::above;
  truth.detectability = Detectability{-0.5, 0.75, 12};
  truth.image_formation = {.blur_px = 0.45, .motion_blur_px = 2, .visibility_m = 1e4};
  const Json coco = coco_of(label_sequence(), frames_of({{truth}}));
  const Json annotation = coco["annotations"][0];
  CHECK(annotation["category_id"] == 2);
  CHECK(annotation["track_id"] == 1);
  CHECK(annotation["video_id"] == 1);
  CHECK(annotation["bbox"] == Json({10, 20, 3, 2}));
  CHECK(annotation["area"] == 5);
  CHECK(annotation["iscrowd"] == 0);
  CHECK(annotation["visible_fraction"] == 0.25);
  CHECK(annotation["inside_fraction"] == 0.5);
  CHECK(annotation["distance_m"] == 13000.0);
  CHECK(annotation["position_m"] == Json({3000.0, -4000.0, 12000.0}));
  CHECK(annotation["attitude_deg"] == Json({{"roll", 10.0}, {"pitch", -20.0}, {"yaw", 170.0}}));
  CHECK(annotation["horizon"] == "above");
  CHECK(annotation["weber_contrast"] == -0.5);
  CHECK(annotation["rms_contrast"] == 0.75);
  CHECK(annotation["signal_to_noise"] == 12.0);
  CHECK(annotation["blur_px"] == 0.45);
  CHECK(annotation["motion_blur_px"] == 2.0);
  CHECK(annotation["visibility_m"] == 1e4);
  CHECK(annotation["amodal_bbox"] == Json({9.75, 20.0, 6.0, 2.5}));  // from the first pixel's corner, not its middle
  CHECK(annotation["segmentation"]["size"] == Json({48, 64}));
  CHECK(annotation["segmentation"]["counts"] == coco_counts(column_runs(truth.visible, {10, 20, 3, 2}, {64, 48})));
}

TEST_CASE("coco: one pixel in a corner of the image has a box of one pixel there") {
  for (const cv::Point corner : {cv::Point(0, 0), {63, 0}, {0, 47}, {63, 47}}) {
    const Json coco = coco_of(label_sequence(), frames_of({{visible_intruder(0, {corner, cv::Size(1, 1)})}}));
    CHECK(coco["annotations"][0]["bbox"] == Json({corner.x, corner.y, 1, 1}));
    CHECK(coco["annotations"][0]["area"] == 1);
  }
}

TEST_CASE("coco: each image has its intruders, and thresholds leave some out") {
  LabelSequence sequence = label_sequence(102);
  sequence.thresholds = {.min_pixels = 5, .min_visible_fraction = 0.5};
  IntruderTruth hidden = visible_intruder(1, {10, 10, 9, 9});
  hidden.visible_fraction = 0.49;
  const Json coco = coco_of(sequence, frames_of({{visible_intruder(0, {0, 0, 5, 1}), visible_intruder(1, {9, 9, 4, 4})},
                                                 {visible_intruder(0, {0, 0, 4, 1}), hidden},
                                                 {invisible_intruder(0), invisible_intruder(1)}}));
  check_is_coco(coco);
  CHECK(of_image(coco, 1, 0).size() == 2);
  CHECK(of_image(coco, 2, 0).empty());
  CHECK(of_image(coco, 3, 0).empty());
  CHECK(coco["info"]["min_pixels"] == 5);
  CHECK(coco["info"]["min_visible_fraction"] == 0.5);
}

TEST_CASE("coco: no visible intruder gives an empty list") {
  const Json coco = coco_of(label_sequence(101), frames_of({{invisible_intruder(0), invisible_intruder(1)},
                                                            {invisible_intruder(0), invisible_intruder(1)}}));
  check_is_coco(coco);
  CHECK(coco["annotations"].empty());
  CHECK(coco["images"].size() == 2);
}

TEST_CASE("coco: no intruders and no frames are still valid") {
  LabelSequence sequence = label_sequence();
  sequence.intruders.clear();
  sequence.categories.clear();
  const Json coco = coco_of(sequence, {});
  check_is_coco(coco);
  CHECK(coco["categories"].empty());
  CHECK(coco["images"].empty());
}

// pycocotools compares a detection with the crowd regions of its own image and category only.
TEST_CASE("coco: each part of the own body is a crowd region of each image and category") {
  LabelSequence sequence = label_sequence(101);
  sequence.own_body = cv::Mat::zeros(48, 64, CV_32FC1);
  sequence.own_body(cv::Rect(0, 40, 10, 8)).setTo(1);
  sequence.own_body(cv::Rect(50, 30, 14, 18)).setTo(1);
  const Json coco = coco_of(sequence, frames_of({{visible_intruder(0, {20, 10, 3, 3})}, {invisible_intruder(0)}}));
  check_is_coco(coco);
  for (const int image_id : {1, 2}) {
    std::map<int, std::vector<Json>> boxes;
    for (const Json& region : of_image(coco, image_id, 1)) {
      boxes[region["category_id"].get<int>()].push_back(region["bbox"]);
      CHECK(region["own_body"] == true);
      CHECK_FALSE(region.contains("track_id"));
    }
    const std::vector<Json> expected{{50, 30, 14, 18}, {0, 40, 10, 8}};
    CHECK(boxes == std::map<int, std::vector<Json>>{{1, expected}, {2, expected}});
  }
  const Json region = of_image(coco, 2, 1)[1];
  CHECK(region["area"] == 80);
  // 40 px above in the first column, 8 of the body, then 40 and 8 by turns; the last run is all the rest.
  const std::vector<std::uint32_t> runs{40, 8, 40, 8, 40, 8, 40, 8, 40, 8, 40, 8, 40, 8, 40, 8, 40, 8, 40, 8, 54 * 48};
  CHECK(region["segmentation"]["counts"] == coco_counts(runs));
}

TEST_CASE("labelled boxes are the visible ones, or wider by a scale and a margin, within the image") {
  LabelSequence sequence = label_sequence();  // 64 x 48
  IntruderTruth truth = visible_intruder(0, {20, 10, 10, 6});
  CHECK(labelled_box(truth, sequence) == cv::Rect(20, 10, 10, 6));
  sequence.box_margin_px = 8;
  CHECK(labelled_box(truth, sequence) == cv::Rect(12, 2, 26, 22));
  sequence.box_scale = 2;
  CHECK(labelled_box(truth, sequence) == cv::Rect(7, 0, 36, 27));  // cut off above
  sequence.box_margin_px = 1000;
  CHECK(labelled_box(truth, sequence) == cv::Rect(0, 0, 64, 48));
}

TEST_CASE("coco: a margin widens the box and leaves area and mask") {
  LabelSequence sequence = label_sequence();
  sequence.box_margin_px = 3;
  const Json coco = coco_of(sequence, frames_of({{visible_intruder(0, {20, 10, 3, 3})}}));
  check_is_coco(coco);
  CHECK(coco["annotations"][0]["bbox"] == Json{17, 7, 9, 9});
  CHECK(coco["annotations"][0]["area"] == 9);
}

TEST_CASE("coco: a real aircraft in the footage is a crowd region of its image and each category") {
  std::vector<FrameTruth> frames = frames_of({{visible_intruder(0, {20, 10, 3, 3})}, {invisible_intruder(0)}});
  frames[1].real_aircraft = {{5, 6, 4, 3}};
  const Json coco = coco_of(label_sequence(101), frames);
  check_is_coco(coco);
  CHECK(of_image(coco, 1, 1).empty());
  const std::vector<Json> regions = of_image(coco, 2, 1);
  REQUIRE(regions.size() == 2);
  for (const Json& region : regions) {
    CHECK(region["bbox"] == Json{5, 6, 4, 3});
    CHECK(region["area"] == 12);
    CHECK(region["real_aircraft"] == true);
  }
  CHECK(regions[0]["category_id"] != regions[1]["category_id"]);
}

TEST_CASE("coco: unusual names are read back") {
  for (const std::string& name : special_names()) {
    LabelSequence sequence = label_sequence();
    sequence.name = sequence.images = name;
    sequence.categories[0] = sequence.intruders[0].category = sequence.intruders[0].name = name;
    const Json coco = coco_of(sequence, frames_of({{visible_intruder(0, {1, 1, 1, 1})}}));
    CHECK(coco["videos"][0]["name"] == name);
    CHECK(coco["images"][0]["file_name"] == name + "/frame_000100.png");
    CHECK(coco["categories"][0]["name"] == name);
    CHECK(coco["tracks"][0]["name"] == name);
  }
}

TEST_CASE("coco: a name that is not UTF-8 leaves the file valid") {
  LabelSequence sequence = label_sequence();
  sequence.intruders[0].name = "a\xFF";
  CHECK(coco_of(sequence, {})["tracks"][0]["name"] == "a\xEF\xBF\xBD");
}

TEST_CASE("coco: large distances have digits to the micrometre, and the locale has no influence") {
  IntruderTruth truth = visible_intruder(0, {1, 2, 3, 4});
  truth.position_m = {1e7 + 0.123456, -1234.5, -0.0000001};
  const std::vector<FrameTruth> frames = frames_of({{truth}});
  const std::string expected = coco_text(label_sequence(), frames);
  CHECK(Json::parse(expected)["annotations"][0]["position_m"] == Json({10000000.123456, -1234.5, 0.0}));
  const CommaLocale comma;
  CHECK(coco_text(label_sequence(), frames) == expected);
}

TEST_CASE("coco: a full disk is an error") {
  if (!std::filesystem::exists("/dev/full")) return;
  const Result<std::unique_ptr<LabelWriter>> writer = open_coco("/dev/full", label_sequence());
  REQUIRE(writer.has_value());
  const Result<void> finished = (*writer)->finish({});
  REQUIRE_FALSE(finished.has_value());
  CHECK(finished.error().kind == ErrorKind::write_failed);
}

}  // namespace sigs::test::labels
