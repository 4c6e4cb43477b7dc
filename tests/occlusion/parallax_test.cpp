// SPDX-License-Identifier: MIT
#include "occlusion/parallax.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "occlusion/synthetic_clip.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

const cv::Size kImage_px(320, 240);
constexpr double kFocal_px = 300;
constexpr int kFrames = 21;
constexpr double kTurnPerFrame_rad = 0.002;  // to the right: far points move 0.6 px a frame to the left
constexpr double kStep_m = 0.5;              // to the right, a frame

Camera pinhole() {
  return {*Lens::make({.fx = kFocal_px, .fy = kFocal_px, .cx = 159.5, .cy = 119.5}), kImage_px};
}

Pose<frame::World, frame::Camera> pose_at(int frame) {
  return {rotation_of({0, 0, kTurnPerFrame_rad * frame}), {0, kStep_m * frame, -100}};
}

// Rough texture without end: the value at a point of the plane, as smooth noise.
cv::Mat texture(int seed, double brightness) {
  cv::Mat noise(600, 1200, CV_8UC1);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {}, 1.5);
  cv::normalize(noise, noise, brightness - 50, brightness + 50, cv::NORM_MINMAX);
  return noise;
}

// What is near: a block with a round top at the lower right of frame 10, 50 m away.
cv::Mat near_at_10() {
  cv::Mat mask = cv::Mat::zeros(kImage_px, CV_8UC1);
  cv::circle(mask, {220, 150}, 50, 255, cv::FILLED);
  cv::rectangle(mask, {170, 150, 100, 90}, 255, cv::FILLED);
  return mask;
}

// The view of frame n: far texture that turns alone, and the block that moves by 300 * 0.5 / 50 = 3 px a frame more.
cv::Mat view(int frame, double step_px = 3) {
  const cv::Mat far_plane = texture(1, 170);
  const cv::Mat near_plane = texture(2, 80);
  cv::Mat map(kImage_px, CV_32FC2);
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x) {
      // The ray of this pixel in the axes of frame 10.
      const double angle = std::atan((x - 159.5) / kFocal_px) + kTurnPerFrame_rad * (frame - 10);
      const double vertical = (y - 119.5) / std::hypot(kFocal_px, x - 159.5);
      map.at<cv::Vec2f>(y, x) = {static_cast<float>(159.5 + kFocal_px * std::tan(angle)),
                                 static_cast<float>(119.5 + kFocal_px * vertical / std::cos(angle))};
    }
  cv::Mat far_view;
  cv::Mat near_view;
  cv::Mat shape_view;
  const auto shifted = [&](double x, double y) { return cv::Mat(map + cv::Scalar(x, y)); };
  cv::remap(far_plane, far_view, shifted(300, 100), cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  cv::remap(near_plane, near_view, shifted(300 + step_px * (frame - 10), 100), cv::noArray(), cv::INTER_LINEAR,
            cv::BORDER_REFLECT);
  cv::remap(near_at_10(), shape_view, shifted(step_px * (frame - 10), 0), cv::noArray(), cv::INTER_LINEAR,
            cv::BORDER_CONSTANT, 0);
  near_view.copyTo(far_view, shape_view > 127);
  return far_view;
}

double overlap_of(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

Result<NearScenery> found_in(const std::function<cv::Mat(int)>& luma, const ParallaxSettings& settings,
                             int frames = kFrames) {
  const TemporaryFolder folder;
  write_luma_clip(folder / "clip.mkv", frames, luma);
  Result<FrameSource> footage = FrameSource::open(folder / "clip.mkv");
  REQUIRE(footage);
  return near_scenery(*footage, pinhole(), pose_at, settings);
}

}  // namespace

TEST_CASE("what moves against infinity while the camera turns and travels is near") {
  const Result<NearScenery> found = found_in([](int frame) { return view(frame); }, {.frame = 10, .span = 9});
  REQUIRE_MESSAGE(found, found.error().text());
  CHECK(overlap_of(found->mask, near_at_10()) > 0.95);
  CHECK(found->parallax_px.at<float>(150, 220) == doctest::Approx(27).epsilon(0.05));
  CHECK(found->known_share > 0.5);
  CHECK(found->warnings.empty());
}

TEST_CASE("with the camera's path known, distance decides") {
  // The block's motion is that of something 50 m away.
  const auto luma = [](int frame) { return view(frame); };
  const Result<NearScenery> within_70 = found_in(luma, {.frame = 10, .span = 9, .max_m = 70});
  REQUIRE(within_70);
  CHECK(overlap_of(within_70->mask, near_at_10()) > 0.95);
  const Result<NearScenery> within_30 = found_in(luma, {.frame = 10, .span = 9, .max_m = 30});
  REQUIRE(within_30);
  CHECK(cv::countNonZero(within_30->mask) == 0);
}

TEST_CASE("without parallax nothing is near, and that is said") {
  const Result<NearScenery> found = found_in([](int frame) { return view(frame, 0); }, {.frame = 10, .span = 9});
  REQUIRE(found);
  CHECK(cv::countNonZero(found->mask) == 0);
  REQUIRE(found->warnings.size() == 1);
  CHECK(found->warnings[0].what.find("hardly travels") != std::string::npos);
}

TEST_CASE("blank footage, and footage of one frame, are errors") {
  const auto blank = [](int) { return cv::Mat(kImage_px, CV_8UC1, cv::Scalar(120)); };
  const Result<NearScenery> without_texture = found_in(blank, {.frame = 3, .span = 2}, 6);
  REQUIRE_FALSE(without_texture);
  CHECK(without_texture.error().what.find("too little") != std::string::npos);
  const Result<NearScenery> alone = found_in([](int frame) { return view(frame); }, {.frame = 0, .span = 9}, 1);
  REQUIRE_FALSE(alone);
  CHECK(alone.error().what.find("no other frame") != std::string::npos);
}

}  // namespace sigs::test
