// SPDX-License-Identifier: MIT
#include "editor/preview/thumbnails.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <opencv2/core.hpp>

#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::TinyProject;

TEST_CASE("a project's image shows its intruder") {
  const TinyProject tiny;
  ComposeContext context;
  const Result<cv::Mat> image = project_thumbnail(tiny.project(), {40, 30}, context);
  REQUIRE(image);
  CHECK(image->size() == cv::Size(40, 30));
  // The footage is grey; the cube is red.
  double maximum = 0;
  cv::Mat red;
  cv::Mat blue;
  cv::extractChannel(*image, red, 2);
  cv::extractChannel(*image, blue, 0);
  cv::minMaxLoc(red - blue, nullptr, &maximum);
  CHECK(maximum > 40);
}

TEST_CASE("without a model the footage is shown, without footage there is no image") {
  TinyProject tiny;
  ComposeContext context;
  tiny.change("cube.obj", "nowhere.obj");
  const Result<cv::Mat> footage = project_thumbnail(tiny.project(), {40, 30}, context);
  REQUIRE(footage);
  CHECK(cv::norm(footage->row(0), footage->row(29), cv::NORM_INF) == 0);
  tiny.change("clip.mkv", "nowhere.mkv");
  CHECK_FALSE(project_thumbnail(tiny.project(), {40, 30}, context));
  CHECK_FALSE(project_thumbnail(tiny.file("nowhere.json"), {40, 30}, context));
}

TEST_CASE("images come later, once, and are kept") {
  const TinyProject tiny;
  std::atomic<int> wakes = 0;
  Thumbnails images(
      {40, 30}, [&] { ++wakes; }, project_thumbnail);
  CHECK_FALSE(images.of(tiny.project()));
  CHECK_FALSE(images.of(tiny.file("nowhere.json")));
  for (int i = 0; i < 3000 && wakes == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto image = images.of(tiny.project());
  REQUIRE(image);
  CHECK(images.of(tiny.project()) == image);
  CHECK_FALSE(images.of(tiny.file("nowhere.json")));
  CHECK(wakes == 1);
}

TEST_CASE("while images rest, what waits is dropped and nothing is asked for; then it is made when asked for again") {
  std::atomic<int> made = 0;
  std::atomic<bool> may_go_on = false;
  const auto make = [&](const std::filesystem::path&, cv::Size size_px, ComposeContext&) -> Result<cv::Mat> {
    ++made;
    while (!may_go_on) std::this_thread::yield();
    return cv::Mat(size_px, CV_8UC3, cv::Scalar::all(0));
  };
  std::atomic<int> wakes = 0;
  Thumbnails images(
      {4, 3}, [&] { ++wakes; }, make);
  const auto wait_for = [](const std::function<bool()>& is_so) {
    for (int i = 0; i < 3000 && !is_so(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return is_so();
  };
  CHECK_FALSE(images.of("first"));
  REQUIRE(wait_for([&] { return made == 1; }));
  CHECK_FALSE(images.of("second"));
  images.rest(true);
  CHECK_FALSE(images.of("third"));
  may_go_on = true;
  REQUIRE(wait_for([&] { return wakes == 1; }));
  CHECK(images.of("first"));  // the one at work is finished and kept
  CHECK_FALSE(images.of("second"));
  images.rest(false);
  CHECK(made == 1);
  CHECK_FALSE(images.of("second"));
  REQUIRE(wait_for([&] { return wakes == 2; }));
  CHECK(images.of("second"));
  CHECK(made == 2);
}
