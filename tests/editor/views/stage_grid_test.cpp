// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>

#include "editor/views/stages/stage_grid.h"

using namespace sigs::editor;

namespace {

double zoom_in(int columns, int rows, const glm::dvec2& image_px, const glm::dvec2& room_px, double label_px) {
  return std::min(room_px.x / columns / image_px.x, (room_px.y / rows - label_px) / image_px.y);
}

}  // namespace

TEST_CASE("no other grid of all images shows them larger") {
  for (const int count : {1, 2, 3, 5, 7, 10})
    for (const glm::dvec2 room_px : {glm::dvec2(780, 650), glm::dvec2(1500, 300), glm::dvec2(300, 1200)})
      for (const glm::dvec2 image_px : {glm::dvec2(1280, 960), glm::dvec2(3840, 2160), glm::dvec2(600, 900)}) {
        const GridShape shape = grid_shape(count, image_px, room_px, 22);
        REQUIRE(shape.columns * shape.rows >= count);
        const double zoom = zoom_in(shape.columns, shape.rows, image_px, room_px, 22);
        for (int columns = 1; columns <= count; ++columns)
          for (int rows = 1; rows <= count; ++rows)
            if (columns * rows >= count) CHECK(zoom >= zoom_in(columns, rows, image_px, room_px, 22) - 1e-12);
      }
}

TEST_CASE("a grid of no images, or on an empty area, is still a grid") {
  CHECK(grid_shape(0, {1280, 960}, {800, 600}, 22).columns == 1);
  const GridShape cramped = grid_shape(7, {1280, 960}, {1, 1}, 22);
  CHECK(cramped.columns * cramped.rows >= 7);
  const GridShape unknown = grid_shape(7, {0, 0}, {800, 600}, 22);
  CHECK(unknown.columns * unknown.rows >= 7);
}

using namespace sigs;
using namespace sigs::editor;

namespace {

Stage stage(const char* name, int grey = 7) {
  return {name, cv::Mat(3, 4, CV_8UC3, cv::Scalar::all(grey))};
}

std::vector<std::string> labels_of(const std::vector<StageTile>& tiles) {
  std::vector<std::string> labels;
  for (const StageTile& tile : tiles) labels.push_back(tile.label);
  return labels;
}

}  // namespace

TEST_CASE("a number before an underscore is the intruder's, anything else belongs to the name") {
  CHECK(stage_name("12_warped").intruder == 12);
  CHECK(stage_name("12_warped").stage == "warped");
  CHECK(stage_name("0_a").intruder == 0);
  for (const char* name :
       {"warped", "_warped", "1warped", "1", "-1_warped", "", "99999999999999999999_warped", "1 _warped"}) {
    CAPTURE(name);
    CHECK_FALSE(stage_name(name).intruder.has_value());
    CHECK(stage_name(name).stage == name);
  }
}

TEST_CASE("each intruder with stages is named once, rising") {
  CHECK(intruders_of({stage("3_layer"), stage("1_layer"), stage("3_warped"), stage("output")}) ==
        std::vector<int>{1, 3});
  CHECK(intruders_of({stage("output")}).empty());
  CHECK(intruders_of({}).empty());
}

TEST_CASE("an intruder's tiles are its own stages and the frame's, in the order of computation") {
  std::vector<Stage> stages{stage("input1"), stage("0_layer"), stage("1_layer"), stage("1_warped"), stage("output")};
  CHECK(labels_of(stage_tiles(stages, 1)) == std::vector<std::string>{"Input 1", "Layer", "Warped", "Output"});
  CHECK(labels_of(stage_tiles(stages, std::nullopt)) == std::vector<std::string>{"Input 1", "Output"});
  stages[3].image = cv::Mat();
  CHECK(labels_of(stage_tiles(stages, 1)) == std::vector<std::string>{"Input 1", "Layer", "Output"});
  CHECK(labels_of(stage_tiles({stage("not known yet")}, 0)) == std::vector<std::string>{"not known yet"});
}

TEST_CASE("every stage of the paper's figure 4 has its label") {
  for (const char* name : {"input1", "input2", "a", "b", "c", "d", "f"}) {
    const std::vector<StageTile> tiles = stage_tiles({stage(name)}, std::nullopt);
    REQUIRE(tiles.size() == 1);
    CHECK(tiles[0].label != name);
    CHECK_FALSE(tiles[0].tooltip.empty());
  }
}

TEST_CASE("a difference is its size times the gain in each channel, cut at white") {
  const cv::Mat a(2, 2, CV_8UC3, cv::Scalar(10, 200, 50));
  const cv::Mat b(2, 2, CV_8UC3, cv::Scalar(13, 100, 50));
  CHECK(difference(a, b, 8).at<cv::Vec3b>(1, 1) == cv::Vec3b(24, 255, 0));
  CHECK(difference(b, a, 8).at<cv::Vec3b>(1, 1) == cv::Vec3b(24, 255, 0));
  CHECK(cv::countNonZero(difference(a, a, 64).reshape(1)) == 0);
  CHECK(difference(a, cv::Mat(2, 3, CV_8UC3), 1).empty());
  CHECK(difference(a, cv::Mat(2, 2, CV_8UC1), 1).empty());
  CHECK(difference({}, {}, 1).empty());
}

TEST_CASE("a difference asked for again is the same memory, another gain is another image") {
  const cv::Mat a = stage("a", 10).image;
  const cv::Mat b = stage("b", 12).image;
  Differences differences;
  const cv::Mat first = differences.of(a, b, 4);
  CHECK(differences.of(a, b, 4).data == first.data);
  CHECK(differences.of(a, b, 5).at<cv::Vec3b>(0, 0) == cv::Vec3b(10, 10, 10));
  for (int gain = 10; gain < 20; ++gain) (void)differences.of(a, b, gain);
  CHECK(differences.of(a, b, 4).at<cv::Vec3b>(0, 0) == first.at<cv::Vec3b>(0, 0));  // made again
}
