// SPDX-License-Identifier: MIT
#include "truth/measure.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

using namespace sigs;

namespace {

// Luminance is the code by 255: numbers can be told by heart.
LuminanceOfCode straight_luminance() {
  LuminanceOfCode luminance{};
  for (std::size_t code = 0; code < luminance.size(); ++code) luminance[code] = static_cast<float>(code) / 255.0F;
  return luminance;
}

const cv::Size kImage_px(100, 80);

// An intruder that is a rectangle of one code, or of two codes in its left and its right half.
struct Shown {
  cv::Mat footage;
  cv::Mat image;
  IntruderTruth truth;

  Shown(int behind, int left, int right, const cv::Rect& box = {40, 30, 10, 6}) {
    footage = cv::Mat(kImage_px, CV_8UC1, cv::Scalar(behind));
    image = footage.clone();
    image(cv::Rect(box.x, box.y, box.width / 2, box.height)).setTo(left);
    image(cv::Rect(box.x + box.width / 2, box.y, box.width - box.width / 2, box.height)).setTo(right);
    truth.visible_box = box;
    truth.visible = cv::Mat(box.size(), CV_8UC1, cv::Scalar(255));
    truth.visible_pixels = box.area();
  }

  [[nodiscard]] std::optional<Detectability> measured(const cv::Mat& own_body = {}) const {
    const cv::Rect rect = background_rect(*truth.visible_box, kImage_px);
    return detectability(truth, image(*truth.visible_box), footage(rect), rect, own_body, straight_luminance());
  }
};

}  // namespace

TEST_CASE("an even intruder before an even sky has Weber's contrast, dark or bright") {
  const Detectability dark = Shown(200, 50, 50).measured().value();
  CHECK(dark.weber_contrast == doctest::Approx(-0.75).epsilon(1e-6));
  CHECK(dark.rms_contrast == doctest::Approx(0.75).epsilon(1e-6));
  CHECK(dark.signal_to_noise == doctest::Approx(150 * std::sqrt(12.0)).epsilon(1e-6));  // rounding alone
  const Detectability bright = Shown(100, 250, 250).measured().value();
  CHECK(bright.weber_contrast == doctest::Approx(1.5).epsilon(1e-6));
}

TEST_CASE("an intruder half darker and half brighter than its sky has a contrast, though its mean has none") {
  const Detectability half = Shown(100, 50, 150).measured().value();
  CHECK(std::abs(half.weber_contrast) < 1e-6);
  CHECK(half.rms_contrast == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(std::abs(half.signal_to_noise) < 1e-6);
}

TEST_CASE("noise of the background lowers the signal to noise ratio in proportion") {
  Shown shown(100, 140, 140);
  for (int y = 0; y < kImage_px.height; ++y)
    for (int x = 0; x < kImage_px.width; ++x) shown.footage.at<uchar>(y, x) = (x + y) % 2 == 0 ? 95 : 105;
  const Detectability at_5 = shown.measured().value();
  CHECK(at_5.signal_to_noise == doctest::Approx(40.0 / 5).epsilon(0.01));
  CHECK(at_5.weber_contrast == doctest::Approx(0.4).epsilon(0.01));
}

TEST_CASE("only visible pixels count, and what the own body covers is no background") {
  Shown shown(100, 50, 50);
  shown.truth.visible(cv::Rect(0, 0, 5, 6)).setTo(0);
  shown.image(cv::Rect(40, 30, 5, 6)).setTo(255);  // hidden by something bright
  CHECK(shown.measured()->weber_contrast == doctest::Approx(-0.5).epsilon(1e-6));
  cv::Mat own_body(kImage_px, CV_32FC1, cv::Scalar(0));
  own_body.rowRange(0, 40).setTo(1);
  shown.footage.rowRange(0, 40).setTo(10);
  CHECK(shown.measured(own_body)->weber_contrast == doctest::Approx(-0.5).epsilon(1e-6));
}

TEST_CASE("black, white, borders and nothing to be seen have finite answers or none") {
  for (const int behind : {0, 255})
    for (const int seen : {0, 255}) {
      const Detectability found = Shown(behind, seen, seen, {0, 0, 1, 1}).measured().value();
      CHECK(std::isfinite(found.weber_contrast));
      CHECK(std::isfinite(found.rms_contrast));
      CHECK(std::isfinite(found.signal_to_noise));
    }
  Shown hidden(100, 50, 50);
  hidden.truth.visible_box.reset();
  hidden.truth.visible.release();
  const cv::Rect rect(0, 0, 10, 10);
  CHECK_FALSE(detectability(hidden.truth, hidden.image, hidden.footage(rect), rect, {}, straight_luminance()));
  const cv::Mat all_body(kImage_px, CV_32FC1, cv::Scalar(1));
  CHECK_FALSE(Shown(100, 50, 50).measured(all_body));
  CHECK(background_rect({99, 79, 1, 1}, kImage_px) == cv::Rect(95, 75, 5, 5));
  CHECK(background_rect({0, 0, 100, 80}, kImage_px) == cv::Rect(0, 0, 100, 80));
}
