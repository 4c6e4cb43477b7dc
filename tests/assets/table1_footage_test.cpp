// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "scene/scene_files.h"
#include "support/test_data.h"
#include "video/frame_source.h"

namespace sigs::test {
namespace {

constexpr int kFrames = 190;
constexpr const char* kClips[] = {"table1_clouds", "table1_clear", "table1_vibration"};

std::filesystem::path in_footage(const std::string& name) {
  return source_dir() / "assets/footage" / name;
}

FrameSource opened(const std::string& clip) {
  Result<FrameSource> source = FrameSource::open(in_footage(clip + ".mp4"));
  if (!source) FAIL(source.error().text());
  return *std::move(source);
}

std::vector<AttitudeAtFrame> attitudes() {
  const auto known = read_attitude_file(in_footage("table1_vibration_attitude.csv"));
  if (!known) FAIL(known.error().text());
  return *known;
}

Camera camera() {
  return read_calibration(source_dir() / "assets/calibrations/sample.xml").value();
}

// Where the clip shows the far distance straight ahead.
glm::dvec2 ahead_px(const Camera& camera, const Attitude& attitude) {
  return camera.lens.pixel(glm::conjugate(rotation_of(attitude)) * glm::dvec3(1, 0, 0)).value();
}

// A piece of the image around the horizon straight ahead: all of it is a kilometre away or more.
cv::Mat far_piece(const Frame& frame) {
  cv::Mat piece;
  frame.planes[0](cv::Rect(430, 376, 420, 176)).convertTo(piece, CV_32F);
  return piece;
}

// Luma and chroma distinguish a cloud from the blue sky: it has no colour. Share of the upper 440 rows.
double colourless_share(const Frame& frame) {
  const cv::Mat blue = frame.planes[1].rowRange(0, 220), red = frame.planes[2].rowRange(0, 220);
  const cv::Mat colourless = (blue < 138) & (red > 119);
  return cv::countNonZero(colourless) / static_cast<double>(colourless.total());
}

struct Overshoot {
  double mean = 0;
  double rms = 0;
};

Overshoot swing_of(const std::vector<AttitudeAtFrame>& all, double Attitude::*angle) {
  Overshoot overshoot;
  for (const AttitudeAtFrame& one : all) overshoot.mean += one.attitude.*angle / static_cast<double>(all.size());
  for (const AttitudeAtFrame& one : all)
    overshoot.rms += std::pow(one.attitude.*angle, 2) / static_cast<double>(all.size());
  overshoot.rms = std::sqrt(overshoot.rms);
  return overshoot;
}

}  // namespace

TEST_CASE("the clips of Table 1 are the sample's size and rate and small") {
  for (const char* const clip : kClips) {
    CAPTURE(clip);
    const FrameSource source = opened(clip);
    CHECK(source.info().size_px == cv::Size(1280, 960));
    CHECK(source.info().frame_count() == kFrames);
    CHECK(std::abs(source.info().times_s.back() - (kFrames - 1) / 25.0) < 1e-3);
    CHECK(std::filesystem::file_size(in_footage(std::string(clip) + ".mp4")) <= 3 * 1024 * 1024);
  }
}

TEST_CASE("clouds cover most of the one sky and hardly any of the other") {
  CHECK(colourless_share(opened("table1_clouds").read(100).value()) > 0.6);
  CHECK(colourless_share(opened("table1_clear").read(100).value()) < 0.1);
}

TEST_CASE("the vibration is known for every frame, has no mean, and is strongest sideways") {
  const std::vector<AttitudeAtFrame> all = attitudes();
  REQUIRE(all.size() == kFrames);
  for (int n = 0; n < kFrames; ++n) CHECK(all[static_cast<std::size_t>(n)].frame == n);
  const Overshoot pitch = swing_of(all, &Attitude::pitch_rad), yaw = swing_of(all, &Attitude::yaw_rad);
  // The file's last digit is a millionth of a degree.
  for (const Overshoot& overshoot : {pitch, yaw, swing_of(all, &Attitude::roll_rad)})
    CHECK(std::abs(overshoot.mean) < 2e-8);
  constexpr double kRadPerPixel = 1 / 561.8;
  CHECK(yaw.rms / kRadPerPixel > 1.5);
  CHECK(yaw.rms / kRadPerPixel < 6);
  CHECK(yaw.rms > 1.5 * pitch.rms);
}

TEST_CASE("the vibrating image moves as its attitude file states") {
  const Camera lens = camera();
  const std::vector<AttitudeAtFrame> all = attitudes();
  FrameSource source = opened("table1_vibration");
  cv::Mat window, before;
  double farthest_px = 0;
  for (int n = 60; n < 80; ++n) {
    const cv::Mat piece = far_piece(source.read(n).value());
    if (window.empty()) cv::createHanningWindow(window, piece.size(), CV_32F);
    if (!before.empty()) {
      CAPTURE(n);
      const cv::Point2d measured = cv::phaseCorrelate(before, piece, window);
      const auto now = static_cast<std::size_t>(n);
      const glm::dvec2 expected = ahead_px(lens, all.at(now).attitude) - ahead_px(lens, all.at(now - 1).attitude);
      CHECK(std::abs(measured.x - expected.x) < 0.5);  // the window, the encoder and the flight ahead: some 0.4 px
      CHECK(std::abs(measured.y - expected.y) < 0.5);
      farthest_px = std::max(farthest_px, glm::length(expected));
    }
    before = piece;
  }
  CHECK(farthest_px > 4);
}

TEST_CASE("the clips without vibration shake by a pixel or two at most") {
  for (const char* const clip : {"table1_clouds", "table1_clear"}) {
    CAPTURE(clip);
    FrameSource source = opened(clip);
    cv::Mat window, before;
    for (int n = 90; n < 100; ++n) {
      const cv::Mat piece = far_piece(source.read(n).value());
      if (window.empty()) cv::createHanningWindow(window, piece.size(), CV_32F);
      if (!before.empty()) {
        const cv::Point2d moved_px = cv::phaseCorrelate(before, piece, window);
        CHECK(std::hypot(moved_px.x, moved_px.y) < 2);
      }
      before = piece;
    }
  }
}

}  // namespace sigs::test
