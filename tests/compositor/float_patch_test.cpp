// SPDX-License-Identifier: MIT
#include "compositor/float_patch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "compositor/blend.h"
#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

const cv::Size kImageSize_px(61, 43);

std::vector<cv::Rect> places() {
  return {{20, 12, 20, 16}, {0, 0, 9, 7}, {50, 35, 11, 8}, {0, 0, 61, 43}, {30, 20, 1, 1}, {60, 42, 1, 1}};
}

Layer white_layer(const cv::Rect& rect, float opacity) {
  return even_layer(rect, {opacity, opacity, opacity, opacity});
}

// All stages, strong.
void all_stages(FloatPatch& patch) {
  sharpen(patch, 2, 1.1);
  blur_chroma(patch, 1.2);
  add_grain(patch, {.sd_dark = 6, .sd_bright = 6, .sd_chroma = 5, .correlation_length_px = 0.7}, 3);
}

int margin_of(PixelLayout layout) {
  return std::max(sharpening_margin_px(2, 1.1), chroma_blur_margin_px(layout, 1.2));
}

// Whether all samples are equal where the mask is 0; a chroma sample is checked where all pixels around it are 0.
void check_kept(const Frame& before, const Frame& after, const cv::Mat& touched, const Sort& sort) {
  for (int plane = 0; plane < before.plane_count(); ++plane) {
    const auto index = static_cast<std::size_t>(plane);
    const cv::Size step = plane == 0 ? cv::Size(1, 1) : sort.step;
    for (int y = 0; y < before.planes[index].rows; ++y)
      for (int x = 0; x < before.planes[index].cols; ++x) {
        bool is_touched = false;
        for (int j = y * step.height; j < std::min((y + 1) * step.height, touched.rows); ++j)
          for (int i = x * step.width; i < std::min((x + 1) * step.width, touched.cols); ++i)
            is_touched = is_touched || touched.at<uchar>(j, i) != 0;
        if (!is_touched) REQUIRE(after.planes[index].at<uchar>(y, x) == before.planes[index].at<uchar>(y, x));
      }
  }
}

// A step of luma codes between columns 29 and 30 of a wide gray image, as an opaque layer makes it.
constexpr int kEdge = 30;
FloatPatch step_patch(uchar below, double above_display) {
  Sort sort = all_sorts().front();
  sort.is_limited = false;
  const auto light = static_cast<float>(linear_value(above_display));
  return blended_patch(even(sort, {80, 40}, below), even_layer({kEdge, 0, 50, 40}, {light, light, light, 1}),
                       BlendChoice::linear, 40, {});
}

}  // namespace

TEST_CASE("a patch without stages rounds to what blending makes, bit for bit") {
  for (const Sort& sort : all_sorts())
    for (const BlendChoice space : {BlendChoice::linear, BlendChoice::display})
      for (const cv::Rect& place : places()) {
        CAPTURE(sort.name);
        CAPTURE(place);
        Frame blended = grainy(sort, kImageSize_px);
        Frame patched = cloned(blended);
        const Layer layer = cloudy_layer(place, 21);
        blend_over(blended, layer, space);
        write_patch(blended_patch(patched, layer, space, 5, {}), patched);
        for (int plane = 0; plane < blended.plane_count(); ++plane)
          REQUIRE(same_bytes(blended.planes[static_cast<std::size_t>(plane)],
                             patched.planes[static_cast<std::size_t>(plane)]));
      }
}

TEST_CASE("stages at zero change nothing") {
  for (const Sort& sort : all_sorts()) {
    const Frame frame = grainy(sort, kImageSize_px);
    FloatPatch patch = blended_patch(frame, cloudy_layer({10, 9, 30, 20}, 4), BlendChoice::linear, 6, {});
    const FloatPatch before = patch;
    std::array<cv::Mat, 3> codes;
    for (std::size_t i = 0; i < 3; ++i) codes[i] = patch.planes[i].after.clone();
    sharpen(patch, 0, 1);
    blur_chroma(patch, 0);
    add_grain(patch, {}, 1);
    for (int plane = 0; plane < patch.plane_count(); ++plane)
      CHECK(same_bytes(patch.planes[static_cast<std::size_t>(plane)].after, codes[static_cast<std::size_t>(plane)]));
  }
}

TEST_CASE("all stages rewrite what they say and nothing else, in every layout and at the image's edges") {
  for (const Sort& sort : all_sorts())
    for (const cv::Rect& place : places()) {
      CAPTURE(sort.name);
      CAPTURE(place);
      const Frame before = grainy(sort, kImageSize_px);
      Frame after = cloned(before);
      FloatPatch patch =
          blended_patch(after, white_layer(place, 0.8F), BlendChoice::linear, margin_of(sort.layout), {});
      all_stages(patch);
      const cv::Mat changed = write_patch(patch, after);
      cv::Mat touched = cv::Mat::zeros(kImageSize_px, CV_8UC1);
      changed.copyTo(touched(patch.planes[0].rect));
      check_kept(before, after, touched, sort);
      CHECK(cv::countNonZero(touched(place)) == place.area());
    }
}

TEST_CASE("samples of the own body keep their bits under all stages") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    const Frame before = grainy(sort, kImageSize_px);
    Frame after = cloned(before);
    cv::Mat body = cv::Mat::zeros(kImageSize_px, CV_32FC1);
    body.colRange(30, kImageSize_px.width).setTo(1);
    // What is left of a layer from column 15 to 45.
    const Layer layer = white_layer({15, 10, 15, 20}, 1);
    FloatPatch patch = blended_patch(after, layer, BlendChoice::linear, margin_of(sort.layout), body);
    all_stages(patch);
    write_patch(patch, after);
    for (int plane = 0; plane < before.plane_count(); ++plane) {
      // A chroma sample on column 30 has a quarter of column 29 in it.
      const int first = plane == 0 ? 30 : (30 + sort.step.width - 1) / sort.step.width + (sort.step.width > 1 ? 1 : 0);
      const auto index = static_cast<std::size_t>(plane);
      CHECK(same_bytes(before.planes[index].colRange(first, before.planes[index].cols).clone(),
                       after.planes[index].colRange(first, after.planes[index].cols).clone()));
    }
  }
}

TEST_CASE("sharpening an edge overshoots as the Gaussian's error function says") {
  // Upper half of the step s = 100 at x = 0: s amount (1 - Phi(x / sigma)); samples lie half a pixel beside. The
  // Gaussian on whole pixels has its steps there too.
  for (const double sigma_px : {1.0, 1.5, 2.5}) {
    CAPTURE(sigma_px);
    FloatPatch patch = step_patch(80, 180 / 255.0);
    const double amount = 0.8;
    sharpen(patch, amount, sigma_px);
    const float* const row = patch.planes[0].after.ptr<float>(20);
    for (int x = kEdge - 12; x < kEdge + 12; ++x) {
      const double from_edge = x - kEdge + 0.5;
      const double spread = 0.5 * (1 + std::erf(from_edge / sigma_px / std::numbers::sqrt2));
      const double step = from_edge > 0 ? 1 : 0;
      // Cut at three sigmas and sampled: within 1.5 % of the step.
      CHECK(std::abs(row[x] - (80 + 100 * (step + amount * (step - spread)))) < 1.5);
    }
  }
}

TEST_CASE("sharpening keeps the mean of what the layer changes") {
  const Sort sort = all_sorts().front();
  const Frame frame = even(sort, {120, 90}, 90);
  FloatPatch patch = blended_patch(frame, cloudy_layer({30, 25, 50, 40}, 8), BlendChoice::linear, 12, {});
  const double before = cv::sum(patch.planes[0].after)[0];
  sharpen(patch, 1.5, 2);
  // Of an even background the layer's whole detail sums to 0; what opacity leaves of an even image's detail is 0.
  CHECK(cv::sum(patch.planes[0].after)[0] == doctest::Approx(before).epsilon(1e-6));
}

TEST_CASE("an opaque layer shows nothing of the footage's detail behind it, sharpened and spread") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    const cv::Rect all({0, 0}, kImageSize_px);
    FloatPatch busy =
        blended_patch(grainy(sort, kImageSize_px), even_layer(all, {0.3F, 0.1F, 0.05F, 1}), BlendChoice::linear, 9, {});
    sharpen(busy, 3, 1);
    blur_chroma(busy, 1);
    for (int plane = 0; plane < busy.plane_count(); ++plane) {
      double low = 0;
      double high = 0;
      cv::minMaxIdx(busy.planes[static_cast<std::size_t>(plane)].after, &low, &high);
      CHECK(high - low < 2e-3);  // floats of codes up to 255
    }
  }
}

TEST_CASE("a point of colour becomes the Gaussian, with its sum kept and luma untouched") {
  const double sigma = 1.2;
  for (const Sort& sort : all_sorts()) {
    if (sort.step.area() != 1 || sort.layout == PixelLayout::gray) continue;
    CAPTURE(sort.name);
    const Frame frame = even(sort, {41, 41}, 120);
    FloatPatch patch = blended_patch(frame, even_layer({20, 20, 1, 1}, {0.4F, 0.1F, 0.1F, 1}), BlendChoice::linear,
                                     chroma_blur_margin_px(sort.layout, sigma), {});
    const std::array<cv::Mat, 3> before{patch.planes[0].after.clone(), patch.planes[1].after.clone(),
                                        patch.planes[2].after.clone()};
    blur_chroma(patch, sigma);
    if (sort.layout == PixelLayout::rgb) {
      const auto luma_of = [](const cv::Mat& r, const cv::Mat& g, const cv::Mat& b) {
        return cv::Mat(0.2126 * r + 0.7152 * g + 0.0722 * b);
      };
      CHECK(cv::norm(luma_of(before[0], before[1], before[2]),
                     luma_of(patch.planes[0].after, patch.planes[1].after, patch.planes[2].after),
                     cv::NORM_INF) < 1e-3);
      continue;
    }
    CHECK(same_bytes(patch.planes[0].after, before[0]));
    const PatchPlane& cr = patch.planes[2];
    CHECK(cv::sum(cr.after)[0] == doctest::Approx(cv::sum(before[2])[0]).epsilon(1e-6));
    const cv::Point middle = cv::Point(20, 20) - cr.rect.tl();
    const double point = before[2].at<float>(middle) - 128;
    REQUIRE(point > 20);
    const double scale = point / (2 * std::numbers::pi * sigma * sigma);
    for (const cv::Point by : {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 2), cv::Point(-2, 1)}) {
      const double wanted = scale * std::exp(-(by.x * by.x + by.y * by.y) / (2 * sigma * sigma));
      CHECK(std::abs(cr.after.at<float>(middle + by) - 128 - wanted) < 0.02 * scale);
    }
  }
}

}  // namespace sigs::test
