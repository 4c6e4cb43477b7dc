// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "export/export_files.h"
#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"
#include "truth/measure.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kLabelledFrames = 6;
const cv::Size kLabelledSize(160, 120);

// One aircraft before the camera, one that the image's border cuts, and an own body below.
void prepare_two_aircraft(Scenario& scenario) {
  write_footage(scenario.path("footage.mkv"), kLabelledSize, kLabelledFrames, PixelLayout::yuv420);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.add("aircraft.obj", {60, 0, -150});
  scenario.add("aircraft.obj", {60, 16, -150});
  cv::Mat body = cv::Mat::zeros(kLabelledSize, CV_8UC1);
  body.rowRange(100, 120).setTo(255);
  cv::imwrite(scenario.path("body.png").string(), body);
  scenario.project.footage.own_body_mask = "body.png";
  scenario.project.output.codec = VideoCodec::png;
  scenario.project.output.masks = MasksChoice::none;
  scenario.project.output.labels = {"xml", "coco", "yolo", "voc", "cvat"};
}

ExportRequest request_of(const Scenario& scenario, bool overwrite = false, int first = 2, int last = 4) {
  return {.project = scenario.project,
          .folder = scenario.path("out"),
          .frames = FrameRange{first, last},
          .jobs = 2,
          .overwrite = overwrite};
}

// Boxes of a frame by the XML file of our own, x y width height.
std::vector<std::vector<int>> boxes_in_xml(const Scenario& scenario, int frame) {
  pugi::xml_document document;
  REQUIRE(document.load_file(scenario.path("out/lot.xml").c_str()));
  std::vector<std::vector<int>> boxes;
  const pugi::xml_node found =
      document.child("sigs").find_child_by_attribute("frame", "index", std::to_string(frame).c_str());
  for (const pugi::xml_node& intruder : found.children("intruder"))
    if (const pugi::xml_node box = intruder.child("box"))
      boxes.push_back({box.attribute("x").as_int(), box.attribute("y").as_int(), box.attribute("width").as_int(),
                       box.attribute("height").as_int()});
  return boxes;
}

std::vector<std::vector<int>> boxes_in_voc(const Scenario& scenario, const std::string& stem) {
  pugi::xml_document document;
  REQUIRE(document.load_file(scenario.path("out/lot.voc/Annotations/" + stem + ".xml").c_str()));
  std::vector<std::vector<int>> boxes;
  for (const pugi::xml_node& object : document.child("annotation").children("object")) {
    const pugi::xml_node box = object.child("bndbox");
    const auto number = [&box](const char* name) { return box.child(name).text().as_int(); };
    boxes.push_back({number("xmin") - 1, number("ymin") - 1, number("xmax") - number("xmin") + 1,
                     number("ymax") - number("ymin") + 1});
  }
  return boxes;
}

std::size_t lines_in(const fs::path& path) {
  const std::string text = text_of(path);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("labels of an export have the same truth in every format, and images beside them") {
  Scenario scenario(kLabelledSize, kLabelledFrames);
  prepare_two_aircraft(scenario);
  const Result<ExportReport> report = export_project(request_of(scenario), {});
  REQUIRE_MESSAGE(report.has_value(), (report ? "" : report.error().text()));
  const Json coco = json_of(scenario.path("out/lot.coco.json"));
  REQUIRE(coco["images"].size() == 3);
  for (const Json& image : coco["images"]) {
    const std::vector<std::vector<int>> boxes = boxes_in_xml(scenario, image["footage_frame"].get<int>());
    REQUIRE(boxes.size() == 2);
    std::vector<std::vector<int>> in_coco;
    std::size_t bodies = 0;
    for (const Json& annotation : coco["annotations"]) {
      if (annotation["image_id"] != image["id"]) continue;
      if (annotation["iscrowd"] == 0)
        in_coco.push_back(annotation["bbox"]);
      else
        bodies += annotation["bbox"] == Json({0, 100, 160, 20}) ? 1 : 0;
    }
    CHECK(in_coco == boxes);
    CHECK(bodies == 1);
    const fs::path file_name = image["file_name"].get<std::string>();
    const std::string stem = file_name.stem().string();
    CHECK(boxes_in_voc(scenario, stem) == boxes);
    CHECK(lines_in(scenario.path("out/lot.yolo/labels/lot/" + stem + ".txt")) == 2);
    REQUIRE(fs::exists(scenario.path("out") / file_name));
    CHECK(cv::imread((scenario.path("out") / file_name).string()).size() == kLabelledSize);
    for (const char* const folder : {"out/lot.yolo/images/lot", "out/lot.voc/JPEGImages"})
      CHECK(fs::equivalent(scenario.path(folder) / file_name.filename(), scenario.path("out") / file_name));
  }
  CHECK(report->written.size() == 6);
  for (const fs::path& path : report->written) CHECK(fs::exists(path));
}

TEST_CASE("a video's labels have no images and name the video") {
  Scenario scenario(kLabelledSize, kLabelledFrames);
  prepare_two_aircraft(scenario);
  scenario.project.output.codec = VideoCodec::ffv1;
  REQUIRE(export_project(request_of(scenario), {}).has_value());
  CHECK(json_of(scenario.path("out/lot.coco.json"))["videos"][0]["file_name"] == "lot.mkv");
  CHECK_FALSE(fs::exists(scenario.path("out/lot.yolo/images")));
  CHECK_FALSE(fs::exists(scenario.path("out/lot.voc/JPEGImages")));
  CHECK(fs::exists(scenario.path("out/lot.yolo/labels/lot/frame_000002.txt")));
}

TEST_CASE("a folder of labels is replaced as a whole by a later export") {
  Scenario scenario(kLabelledSize, kLabelledFrames);
  prepare_two_aircraft(scenario);
  REQUIRE(export_project(request_of(scenario), {}).has_value());
  CHECK_FALSE(export_project(request_of(scenario), {}).has_value());
  write_file_and_folders(scenario.path("out/lot.yolo/labels/lot.cache"), "what a reader leaves there");
  const Result<ExportReport> again = export_project(request_of(scenario, true, 4, 5), {});
  REQUIRE_MESSAGE(again.has_value(), (again ? "" : again.error().text()));
  CHECK_FALSE(fs::exists(scenario.path("out/lot.yolo/labels/lot/frame_000002.txt")));
  CHECK(fs::exists(scenario.path("out/lot.yolo/labels/lot/frame_000005.txt")));
  CHECK_FALSE(fs::exists(scenario.path("out/lot.voc/Annotations/frame_000002.xml")));
}

TEST_CASE("a folder of labels with a foreign file is never replaced") {
  for (const char* const name : {"lot.yolo/notes.txt", "lot.yolo/runs/best.pt", "lot.yolo/labels/lot/frame_x.txt",
                                 "lot.voc/ImageSets/Main/mine.txt", "lot.voc/JPEGImages/IMG_000001.jpg"}) {
    CAPTURE(name);
    Scenario scenario(kLabelledSize, kLabelledFrames);
    prepare_two_aircraft(scenario);
    write_file_and_folders(scenario.path("out") / name, "mine");
    const Result<ExportReport> report = export_project(request_of(scenario, true), {});
    REQUIRE(!report.has_value());
    CHECK(report.error().kind == ErrorKind::cannot_create);
    CHECK(report.error().where ==
          scenario.path("out").string() + "/" + std::string(name).substr(0, std::string(name).find('/')));
    CHECK(report.error().what.find(std::string(name).substr(std::string(name).find('/') + 1)) != std::string::npos);
    CHECK(text_of(scenario.path("out") / name) == "mine");
    CHECK_FALSE(fs::exists(scenario.path("out/lot.xml")));
  }
}

TEST_CASE("every file of every folder of labels is recognized by a later export") {
  for (const LabelFormat& format : label_formats()) {
    if (!format.is_folder) continue;
    CAPTURE(format.name);
    for (const VideoCodec codec : {VideoCodec::png, VideoCodec::ffv1}) {
      Scenario scenario(kLabelledSize, kLabelledFrames);
      prepare_two_aircraft(scenario);
      scenario.project.output.codec = codec;
      scenario.project.output.labels = {std::string(format.name)};
      REQUIRE(export_project(request_of(scenario), {}).has_value());
      const Result<ExportReport> again = export_project(request_of(scenario, true), {});
      CHECK_MESSAGE(again.has_value(), (again ? "" : again.error().text()));
      write_file_and_folders(scenario.path("out") / ("lot" + std::string(format.suffix)) / "mine", "mine");
      CHECK_FALSE(export_project(request_of(scenario, true), {}).has_value());
    }
  }
}

TEST_CASE("patterns match paths") {
  CHECK(fits("data.yaml", "data.yaml"));
  CHECK_FALSE(fits("data.yaml2", "data.yaml"));
  CHECK_FALSE(fits("data", "data.yaml"));
  CHECK(fits("labels/a b/frame_000123.txt", "labels/*/frame_#.txt"));
  CHECK(fits("labels/a/frame_1.txt", "labels/*/frame_#.txt"));
  CHECK_FALSE(fits("labels/a/frame_.txt", "labels/*/frame_#.txt"));
  CHECK_FALSE(fits("labels/a/frame_12x.txt", "labels/*/frame_#.txt"));
  CHECK_FALSE(fits("labels/a/b/frame_12.txt", "labels/*/frame_#.txt"));
  CHECK(fits("a_train.txt", "*train.txt"));
  CHECK(fits("train.txt", "*train.txt"));
  CHECK_FALSE(fits("", "a"));
  CHECK_FALSE(fits("a", ""));
}

// A plate 20.67 m square across the axis at 200 m: 31 px square.
TEST_CASE("the share inside the image counts truncation and not occlusion") {
  constexpr double kHalf_m = 15.5 * 200 / 300;
  constexpr double kEdge = 2 * 0.0625 / 31;  // drawing with 16 samples a pixel, on two edges
  Scenario scenario;
  write_obj(scenario.path("plate.obj"), {{{-1e-4, -kHalf_m, -kHalf_m}, {1e-4, kHalf_m, kHalf_m}}}, 1);
  const auto truth_of = [&scenario](double right_m) {
    scenario.project.intruders.clear();
    scenario.add("plate.obj", {200, right_m, -150});
    return composed(scenario.opened(), 1, grainy_frame(scenario.size_px(), 1)).truth.intruders.front();
  };
  CHECK(truth_of(0).inside_fraction == doctest::Approx(1));
  CHECK(truth_of(200).inside_fraction == 0);
  const IntruderTruth cut = truth_of(160.0 * 200 / 300);  // its middle on the image's right edge
  CHECK(std::abs(cut.inside_fraction - 0.5) < kEdge);
  CHECK(cut.visible_fraction == doctest::Approx(cut.inside_fraction));
  CHECK_FALSE(is_occluded(cut));

  cv::Mat body = cv::Mat::zeros(scenario.size_px(), CV_8UC1);
  body.colRange(160, 320).setTo(255);
  cv::imwrite(scenario.path("body.png").string(), body);
  scenario.project.footage.own_body_mask = "body.png";
  const IntruderTruth hidden = truth_of(0);
  CHECK(hidden.inside_fraction == doctest::Approx(1));
  CHECK(std::abs(occluded_fraction(hidden) - 0.5) < kEdge);
  CHECK(is_occluded(hidden));
  CHECK(occluded_fraction(truth_of(160.0 * 200 / 300)) == doctest::Approx(1));
}

}  // namespace sigs::test
