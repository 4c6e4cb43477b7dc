// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "flights/flights.h"
#include "occlusion/detect.h"

namespace {

using namespace sigs;

constexpr int kReflectionFrames = 150;

Verdict verdict_on_flight(const flights::Flight& flight) {
  const auto method = stable_method({}, flight.size_px);
  for (int n = 0; n < kReflectionFrames; ++n) {
    cv::Mat luma;
    cv::cvtColor(flight.bgr(n), luma, cv::COLOR_BGR2GRAY);
    method->add(luma);
  }
  return method->verdict(KeepStages::no);
}

flights::Flight named(const std::vector<flights::Flight>& all, const std::string& name) {
  return *std::ranges::find(all, name, &flights::Flight::name);
}

}  // namespace

TEST_CASE("a reflection that is taken for body does not get the confidence of a body, a body beside one does") {
  const std::vector<flights::Flight> reflecting = flights::reflecting({.frames = kReflectionFrames});
  const Verdict mirrored = verdict_on_flight(named(reflecting, "sharp reflection"));
  const double masked = cv::countNonZero(mirrored.own_body);
  REQUIRE(masked > 0);  // otherwise this test would be void
  CHECK(cv::mean(mirrored.confidence, mirrored.own_body)[0] < 0.8);
  CHECK(cv::countNonZero(mirrored.confidence > 0.9) < 0.15 * masked);
  const flights::Flight nose = named(reflecting, "nose, reflection");
  const Verdict body = verdict_on_flight(nose);
  CHECK(cv::mean(body.confidence, nose.own_body)[0] > 0.9);
}
