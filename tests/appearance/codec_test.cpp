// SPDX-License-Identifier: MIT
#include "appearance/codec.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

using namespace sigs;

namespace {

// Soft noise with hard bars, and the same after JPEG of a quality.
cv::Mat scene_luma(int number) {
  cv::RNG random(static_cast<std::uint64_t>(number) + 1);
  cv::Mat values(240, 320, CV_32FC1);
  random.fill(values, cv::RNG::NORMAL, 140, 20);
  cv::GaussianBlur(values, values, {}, 6);
  for (int x = 20; x < 320; x += 100) cv::line(values, {x, 0}, {x + 9, 239}, cv::Scalar(30), 3, cv::LINE_AA);
  cv::Mat luma;
  values.convertTo(luma, CV_8UC1);
  return luma;
}

Frame frame_with(const cv::Mat& luma, double qp) {
  Frame frame{.layout = PixelLayout::gray, .planes = {luma}};
  if (qp >= 0) frame.quantisers = std::make_shared<const FrameQuantisers>(FrameQuantisers{.codec = "h264", .mean = qp});
  return frame;
}

cv::Mat jpeg(const cv::Mat& luma, int quality) {
  std::vector<uchar> bytes;
  cv::imencode(".jpg", luma, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

CodecEstimate estimate_at(int quality) {
  CodecEstimator estimator;
  for (int n = 0; n < 4; ++n) estimator.add(frame_with(quality > 0 ? jpeg(scene_luma(n), quality) : scene_luma(n), -1));
  return estimator.finish();
}

}  // namespace

TEST_CASE("the quantiser is the mean of what the frames state, with its deviation over the frames") {
  CodecEstimator estimator;
  for (const double qp : {22.0, 26.0, 24.0}) estimator.add(frame_with(scene_luma(0), qp));
  const CodecEstimate found = estimator.finish();
  CHECK(found.codec == "h264");
  CHECK(found.quantiser.is_known);
  CHECK(found.quantiser.value == doctest::Approx(24));
  CHECK(found.quantiser.sd == doctest::Approx(2));
}

TEST_CASE("where the stream states nothing the quantiser is not known, a default stands in and it says why") {
  const CodecEstimate found = estimate_at(0);
  CHECK(!found.quantiser.is_known);
  CHECK(found.quantiser.value == kDefaultQp);
  CHECK(found.quantiser.why.find("stream") != std::string::npos);
  CHECK(!CodecEstimator().finish().quantiser.is_known);
}

TEST_CASE("ringing grows with compression, and neither it nor a block grid is found without") {
  const CodecEstimate raw = estimate_at(0);
  REQUIRE(raw.block_grid.is_known);
  CHECK(std::abs(raw.block_grid.value) < 0.05);
  REQUIRE(raw.ringing.is_known);
  CHECK(std::abs(raw.ringing.value) < 0.1);
  double last = 0.1;
  for (const int quality : {75, 40}) {
    CAPTURE(quality);
    const CodecEstimate found = estimate_at(quality);
    CHECK(found.block_grid.value > 0.3);
    CHECK(found.ringing.value > last);
    last = found.ringing.value;
  }
}

TEST_CASE("an even image and a tiny one tell neither a grid nor ringing") {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(1, 1), cv::Size(9, 9)}) {
    CodecEstimator estimator;
    estimator.add(frame_with(cv::Mat(size, CV_8UC1, cv::Scalar(90)), -1));
    const CodecEstimate found = estimator.finish();
    CHECK(!found.block_grid.is_known);
    CHECK(!found.ringing.is_known);
    CHECK(!found.ringing.why.empty());
  }
}
