// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <opencv2/imgproc.hpp>

#include "occlusion/detect.h"

namespace {

using namespace sigs;

const cv::Size kPanSize{320, 240};
constexpr int kPan_px = 200;

// The same texture everywhere: random codes, blurred, of the deviation given.
cv::Mat texture(double deviation, double blur_px) {
  cv::Mat image(kPanSize.height, kPanSize.width + kPan_px, CV_32FC1);
  cv::RNG rng(7);
  rng.fill(image, cv::RNG::NORMAL, 0, 1);
  cv::GaussianBlur(image, image, {}, blur_px);
  cv::Scalar mean, spread;
  cv::meanStdDev(image, mean, spread);
  return (image - mean[0]) * (deviation / spread[0]) + 120;
}

struct Pan {
  double deviation = 25;
  double blur_px = 1.5;
  int frames = 200;
  cv::Rect body;  // plain, with a few lines; empty: none
};

// Everything but the body slides by kPan_px in all; every sample has grain.
Verdict verdict_on_pan(const Pan& pan) {
  const cv::Mat world = texture(pan.deviation, pan.blur_px);
  const auto method = stable_method({}, kPanSize);
  cv::RNG rng(3);
  for (int n = 0; n < pan.frames; ++n) {
    const double shift_px = double(kPan_px) * n / pan.frames;
    cv::Mat image;
    cv::warpAffine(world, image, cv::Matx23d(1, 0, -shift_px, 0, 1, 0), kPanSize, cv::INTER_LINEAR);
    if (!pan.body.empty()) {
      cv::rectangle(image, pan.body, 190, cv::FILLED);
      for (int x = pan.body.x + 9; x < pan.body.br().x; x += 23)
        cv::line(image, {x, pan.body.y}, {x, kPanSize.height}, 150);
    }
    cv::Mat grain(kPanSize, CV_32FC1);
    rng.fill(grain, cv::RNG::NORMAL, 0, 2);
    cv::Mat luma;
    cv::Mat(image + grain).convertTo(luma, CV_8U);
    method->add(luma);
  }
  return method->verdict(KeepStages::no);
}

cv::Mat mask_of(const cv::Rect& body) {
  cv::Mat mask = cv::Mat::zeros(kPanSize, CV_8UC1);
  mask(body).setTo(255);
  return mask;
}

}  // namespace

TEST_CASE("where everything moves alike, nothing is found, and the confidence is that of the world") {
  for (const Pan& pan : {Pan{}, Pan{.deviation = 12}, Pan{.blur_px = 3}, Pan{.frames = 60}, Pan{.deviation = 50}}) {
    CAPTURE(pan.deviation);
    CAPTURE(pan.blur_px);
    CAPTURE(pan.frames);
    const Verdict verdict = verdict_on_pan(pan);
    CHECK_MESSAGE(!verdict.undecided, verdict.undecided.value_or(""));
    CHECK(cv::countNonZero(verdict.own_body) == 0);
    CHECK(cv::mean(verdict.confidence)[0] < 0.25);  // the confidence of a world that does not move
  }
}

TEST_CASE("a body before a world that moves alike is found, however small") {
  for (const cv::Rect& body : {cv::Rect(0, 190, 320, 50), cv::Rect(140, 180, 50, 60), cv::Rect(0, 100, 60, 30)}) {
    CAPTURE(body);
    const Verdict verdict = verdict_on_pan({.body = body});
    CHECK_MESSAGE(!verdict.undecided, verdict.undecided.value_or(""));
    CHECK(intersection_over_union(verdict.own_body, mask_of(body)) >= 0.9);
    CHECK(cv::mean(verdict.confidence, mask_of(body))[0] > 0.8);
  }
}

TEST_CASE("sensor noise alone, however strong, does not count as motion") {
  for (const double deviation : {2.0, 6.0, 10.0}) {
    CAPTURE(deviation);
    const auto method = stable_method({}, kPanSize);
    const cv::Mat world = texture(20, 1.5)(cv::Rect({}, kPanSize));
    cv::RNG rng(5);
    for (int n = 0; n < 100; ++n) {
      cv::Mat grain(kPanSize, CV_32FC1);
      rng.fill(grain, cv::RNG::NORMAL, 0, deviation);
      cv::Mat luma;
      cv::Mat(world + grain).convertTo(luma, CV_8U);
      method->add(luma);
    }
    CHECK(method->verdict(KeepStages::no).undecided);
  }
}
