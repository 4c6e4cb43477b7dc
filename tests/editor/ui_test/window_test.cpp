// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "editor/ui_test/ui_test.h"

// What is on the screen, not what the editor says of it: parts of the window that changed are drawn and shown alone.

namespace sigs::test {

namespace {

// Into the build folder's screenshots/ too.
cv::Mat screen_of(UiTest& ui_test, const std::string& name) {
  const std::filesystem::path file = build_dir() / "screenshots" / ("window-" + name + ".png");
  ui_test.editor().screenshot(file);
  return cv::imread(file.string());
}

// The screen once it is as wanted, or after ten seconds: a busy machine may take a while to draw all of it.
cv::Mat screen_when(UiTest& ui_test, const std::string& name, const std::function<bool(const cv::Mat&)>& is_so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  cv::Mat screen = screen_of(ui_test, name);
  while (!is_so(screen) && std::chrono::steady_clock::now() < end) screen = screen_of(ui_test, name);
  return screen;
}

cv::Rect pixels_of(const ScreenPlace& place) {
  return {static_cast<int>(std::lround(place.x)), static_cast<int>(std::lround(place.y)),
          static_cast<int>(std::lround(place.width)), static_cast<int>(std::lround(place.height))};
}

// By how many codes half of an image's samples differ at most: overlays cover less than half.
double median_difference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  std::vector<uchar> codes(difference.datastart, difference.dataend);
  std::nth_element(codes.begin(), codes.begin() + static_cast<std::ptrdiff_t>(codes.size() / 2), codes.end());
  return codes[codes.size() / 2];
}

UiTest& opened(UiTest& ui_test) {
  ui_test.editor().start({put(sample_project("crossing"), ui_test.folder() / "mine.json").string()});
  ui_test.editor().wait_for_image();
  return ui_test;
}

// Until nothing is made ahead either, which begins a while after an edit.
void wait_for_rest(EditorDriver& editor) {
  nlohmann::json memory;
  auto since = std::chrono::steady_clock::now();
  editor.wait_for("rest", [&](const nlohmann::json& now) {
    if (now.value("busy", true) || now.at("memory") != memory) since = std::chrono::steady_clock::now();
    memory = now.at("memory");
    return std::chrono::steady_clock::now() - since > std::chrono::seconds(1);
  });
  editor.settle();
}

cv::Mat footage_frame() {
  const std::filesystem::path clip = source_dir() / "assets/footage/sample.mp4";
  const std::filesystem::path file = build_dir() / "screenshots/first-frame.png";
  std::filesystem::create_directories(file.parent_path());
  const std::string command = fmt::format("ffmpeg -v error -y -i '{}' -frames:v 1 '{}'", clip.string(), file.string());
  REQUIRE(std::system(command.c_str()) == 0);
  return cv::imread(file.string());
}

}  // namespace

namespace {

void check_footage_is_in_place(UiTest& ui_test, const cv::Mat& frame, const cv::Size& size_px) {
  EditorDriver& editor = ui_test.editor();
  editor.wait_for_image();
  editor.move(1, 1);
  editor.settle();
  const auto place = [&] { return pixels_of(editor.place("viewport/image")) & cv::Rect({0, 0}, size_px); };
  const auto difference = [&](const cv::Mat& screen) {
    cv::Mat expected;
    cv::resize(frame, expected, place().size(), 0, 0, cv::INTER_AREA);
    return median_difference(screen(place()), expected);
  };
  const std::string name = fmt::format("{}x{}", size_px.width, size_px.height);
  const cv::Mat screen = screen_when(ui_test, name, [&](const cv::Mat& now) { return difference(now) <= 4; });
  CAPTURE(size_px.width);
  CAPTURE(size_px.height);
  CHECK(difference(screen) <= 4);
  const cv::Mat dark(place().size(), CV_8UC3, cv::Scalar::all(20));
  CHECK(median_difference(screen(place()), dark) > 40);
  CHECK(place().width > size_px.width / 4);
}

}  // namespace

TEST_CASE("the footage is where the window says, whatever size the window gets") {
  UiTest ui_test("window");
  EditorDriver& editor = opened(ui_test).editor();
  const cv::Mat frame = footage_frame();
  for (const cv::Size& size_px :
       {cv::Size(1600, 960), cv::Size(1150, 760), cv::Size(1500, 620), cv::Size(820, 900), cv::Size(1600, 960)}) {
    editor.resize(size_px.width, size_px.height);
    check_footage_is_in_place(ui_test, frame, size_px);
  }
}

// The X server refuses to show what lies outside of a buffer that is smaller by now; that ended the program.
TEST_CASE("a window that gets many sizes in quick succession stays, and is right in the end") {
  UiTest ui_test("window");
  EditorDriver& editor = opened(ui_test).editor();
  std::mt19937 random(7);
  for (int round = 0; round < 12; ++round) {
    std::vector<std::pair<int, int>> sizes_px;
    for (int i = 0; i < 20; ++i)
      sizes_px.emplace_back(820 + static_cast<int>(random() % 760), 500 + static_cast<int>(random() % 450));
    editor.resize_through(sizes_px);
  }
  editor.resize(1400, 800);
  check_footage_is_in_place(ui_test, footage_frame(), {1400, 800});
}

TEST_CASE("what was drawn part by part is what all of the window is when it is drawn anew") {
  UiTest ui_test("window");
  EditorDriver& editor = opened(ui_test).editor();
  const auto check = [&](const std::string& when) {
    editor.wait_for_image();
    wait_for_rest(editor);
    const cv::Mat by_parts = screen_of(ui_test, when + "-parts");
    editor.hide_and_show();
    // The line below the view tells the memory of textures too, which go when they were not drawn for a while.
    const cv::Rect view = pixels_of(editor.place("viewport"));
    const cv::Rect readout(view.x, view.br().y, view.width, 28);
    const auto difference = [&](const cv::Mat& now) {
      cv::Mat codes;
      cv::absdiff(by_parts, now, codes);
      codes(readout & cv::Rect({0, 0}, codes.size())).setTo(0);
      return cv::norm(codes, cv::NORM_INF);
    };
    const cv::Mat anew = screen_when(ui_test, when + "-anew", [&](const cv::Mat& now) { return difference(now) == 0; });
    CAPTURE(when);
    CHECK(difference(anew) == 0);
    CHECK(cv::countNonZero(anew.reshape(1) > 60) > anew.rows * anew.cols / 10);  // not a dark screen
  };
  check("start");
  editor.drag("viewport/waypoint/0/1", 60, 40);
  editor.move(1, 1);
  check("drag");
  editor.key("End");
  check("other-frame");
  editor.resize(1300, 800);
  editor.move(1, 1);
  check("smaller");
  const ScreenPlace view = editor.place("viewport");
  editor.move(view.center_x(), view.center_y());
  editor.key("1");
  editor.move(1, 1);
  check("exact");
}

}  // namespace sigs::test
