// SPDX-License-Identifier: MIT
#include "evaluation/opencv_tracker.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/image.h"

namespace sigs::test {

namespace {

cv::Mat texture(cv::Size size, int low, int high, double sigma_px, std::uint64_t seed) {
  cv::Mat image(size, CV_8UC3);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, low, high);
  cv::GaussianBlur(image, image, {}, sigma_px);
  return image;
}

cv::Rect square_pixels(int frame) {
  return {60 + 2 * frame, 50 + frame, 40, 30};
}

Box square_box(int frame) {
  const cv::Rect pixels = square_pixels(frame);
  return {pixels.x - 0.5, pixels.y - 0.5, double(pixels.width), double(pixels.height)};
}

// The ground alone. CV_8UC3.
cv::Mat background_image() {
  return texture({200, 150}, 90, 140, 2, 7);
}

// A textured patch that crosses the ground, in each frame one pixel down and two to the right. CV_8UC3.
cv::Mat square_image(int frame) {
  cv::Mat image = background_image();
  texture(square_pixels(0).size(), 0, 255, 1.5, 3).copyTo(image(square_pixels(frame)));
  return image;
}

constexpr int kFrames = 6;

std::vector<std::string> all_names() {
  return {tracker_names().begin(), tracker_names().end()};
}

// The results of the trackers on the moving square, run in turn.
std::vector<Results> tracked(const std::vector<std::string>& names) {
  TrackerGroup group = TrackerGroup::make(names).value();
  group.start(0, square_image(0), square_box(0));
  for (int frame = 1; frame < kFrames; ++frame) group.follow(frame, square_image(frame));
  CHECK(group.remarks().empty());
  return group.results();
}

void check_equal(const Results& one, const Results& other) {
  CHECK(one.name == other.name);
  REQUIRE(one.frames.size() == other.frames.size());
  for (const auto& [number, boxes] : one.frames) {
    const int frame = number;
    REQUIRE(other.frames.contains(frame));
    CHECK_MESSAGE(boxes.front().box == other.frames.at(frame).front().box, one.name << " frame " << frame);
  }
}

double center_distance_px(const Box& a, const Box& b) {
  return std::hypot(a.x + a.width / 2 - b.x - b.width / 2, a.y + a.height / 2 - b.y - b.height / 2);
}

OpenCvTracker tracker(const char* name) {
  return std::move(OpenCvTracker::make(name)).value();
}

}  // namespace

TEST_CASE("every tracker follows a textured patch over textured ground") {
  for (const Results& results : tracked(all_names())) {
    CHECK_MESSAGE(results.frames.size() == kFrames, results.name);
    // MIL goes where its classifier says, up to 25 px away (its search window) from one frame to the next; TLD changes
    // its box's size. The others stay within a tenth of the patch.
    const double most_px = results.name == "mil" ? 25 : results.name == "tld" ? 10 : 4;
    for (const auto& found : results.frames)
      CHECK_MESSAGE(center_distance_px(found.second.front().box, square_box(found.first)) < most_px,
                    results.name << " frame " << found.first);
    REQUIRE(results.frames_per_s.has_value());
    CHECK(*results.frames_per_s > 0);
  }
}

TEST_CASE("a patch that moves by whole pixels is found where it is by trackers that are exact") {
  for (const Results& results : tracked({"mosse", "medianflow"}))
    for (const auto& found : results.frames)
      CHECK_MESSAGE(center_distance_px(found.second.front().box, square_box(found.first)) < 0.5,
                    results.name << " frame " << found.first);
}

TEST_CASE("a tracker has the same results when repeated, alone, among others and on one thread") {
  const std::vector<Results> together = tracked(all_names());
  std::vector<std::string> backwards = all_names();
  std::reverse(backwards.begin(), backwards.end());
  std::vector<Results> turned = tracked(backwards);
  std::reverse(turned.begin(), turned.end());
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  for (std::size_t i = 0; i < together.size(); ++i) {
    check_equal(together[i], turned[i]);
    cv::theRNG().state = 12345 + i;  // earlier random numbers have no effect
    check_equal(together[i], tracked({together[i].name}).front());
  }
  cv::setNumThreads(threads);
}

TEST_CASE("a tracker's report in its first frame is the box that it was started with, in whole pixels") {
  OpenCvTracker kcf = tracker("kcf");
  REQUIRE(kcf.start(7, square_image(0), {59.6, 49.4, 40, 30}).has_value());
  const Results& results = kcf.results();
  REQUIRE(results.frames.size() == 1);
  CHECK(results.frames.at(7).front().box == Box{59.5, 49.5, 40, 30});
  CHECK_FALSE(results.frames_per_s.has_value());
}

TEST_CASE("a box across the image's edge is clipped, and a box outside the image starts no tracker") {
  OpenCvTracker cut = tracker("medianflow");
  REQUIRE(cut.start(0, square_image(0), {-10.5, -0.5, 50, 400}).has_value());
  CHECK(cut.results().frames.at(0).front().box == Box{-0.5, -0.5, 40, 150});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Box& wrong : {Box{1e7, 10, 20, 20}, Box{-1e7, 10, 20, 20}, Box{-20.5, 10, 20, 20}, Box{10, 149.5, 20, 20},
                           Box{10, 10, 0, 20}, Box{10, 10, 20, -1}, Box{nan, 10, 20, 20}, Box{10, 10, infinity, 20}}) {
    OpenCvTracker outside = tracker("kcf");
    const Result<void> started = outside.start(3, square_image(0), wrong);
    REQUIRE_FALSE(started.has_value());
    CHECK(started.error().text() == "kcf: frame 3: cannot be started with a box outside the image");
    CHECK(outside.results().frames.empty());
  }
}

TEST_CASE("no tracker hangs on a box of a few pixels: it starts, or returns an error") {
  const cv::Mat image = square_image(0);
  for (const std::string& name : all_names())
    for (const cv::Size size :
         {cv::Size(1, 1), cv::Size(4, 2), cv::Size(3, 30), cv::Size(7, 7), cv::Size(8, 4), cv::Size(4, 8)}) {
      OpenCvTracker small = OpenCvTracker::make(name).value();
      const Result<void> started = small.start(0, image, {69.5, 59.5, double(size.width), double(size.height)});
      if (started) static_cast<void>(small.follow(1, square_image(1)));
      const bool is_refused = (name == "mil" || name == "boosting" || name == "tld") && size.width * size.height < 32;
      if (is_refused) CHECK_MESSAGE(!started.has_value(), name << " " << size);
    }
}

TEST_CASE("an exception of OpenCV becomes one line, and the other trackers continue") {
  TrackerGroup group = TrackerGroup::make({"medianflow", "mosse"}).value();
  group.start(0, square_image(0), square_box(0));
  group.follow(1, square_image(1));
  group.follow(2, cv::Mat(7, 5, CV_8UC3, cv::Scalar::all(0)));  // MOSSE crops a patch from any image it is given
  group.follow(3, square_image(3));
  REQUIRE(group.remarks().size() == 1);
  const std::string remark = group.remarks().front();
  CHECK_MESSAGE(remark.starts_with("medianflow: frame 2: OpenCV cannot follow in it: "), remark);
  CHECK(remark.ends_with("; it reports nothing from there on"));
  CHECK(remark.find('\n') == std::string::npos);
  const std::vector<Results> results = group.results();
  CHECK(results[0].frames.size() == 2);
  CHECK_FALSE(results[0].frames.contains(3));
}

TEST_CASE("a tracker that declares its target lost has no result") {
  OpenCvTracker mosse = tracker("mosse");
  REQUIRE(mosse.start(0, square_image(0), square_box(0)).has_value());
  REQUIRE(mosse.follow(1, square_image(1)).has_value());
  REQUIRE(mosse.results().frames.contains(1));
  REQUIRE(mosse.follow(2, background_image()).has_value());
  CHECK_FALSE(mosse.results().frames.contains(2));
}

TEST_CASE("an unknown tracker is an error that lists the known ones, and so is a name given twice") {
  const Result<OpenCvTracker> unknown = OpenCvTracker::make("goturn");
  REQUIRE_FALSE(unknown.has_value());
  CHECK(unknown.error().text() ==
        "goturn: no such tracker; there are csrt, kcf, mil, mosse, medianflow, tld, boosting");
  CHECK(unknown.error().kind == ErrorKind::usage);
  const Result<TrackerGroup> twice = TrackerGroup::make({"kcf", "mil", "kcf"});
  REQUIRE_FALSE(twice.has_value());
  CHECK(twice.error().text() == "kcf: is named twice");
}

}  // namespace sigs::test
