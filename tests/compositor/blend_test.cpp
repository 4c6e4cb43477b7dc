// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "compositor/blend.h"
#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

// Code values of the colour where the whole of each block is covered; nothing if a rounding could go either way.
std::optional<cv::Vec3i> certain_codes(const Sort& sort, const cv::Vec3d& display) {
  const cv::Vec3d codes = codes_of(sort, display);
  cv::Vec3i rounded;
  for (int c = 0; c < 3; ++c) {
    const double clipped = std::min(std::max(codes[c], 0.0), 255.0);
    // Floats hold 24 bits: half a code is decided for all but what lies this close to it.
    if (std::abs(clipped - std::floor(clipped) - 0.5) < 1e-3) return std::nullopt;
    rounded[c] = static_cast<int>(std::lround(clipped));
  }
  return rounded;
}

Layer opaque(const cv::Rect& rect, const cv::Vec3d& linear, double opacity = 1) {
  const cv::Vec3d c = linear * opacity;
  return even_layer(rect, {float(c[0]), float(c[1]), float(c[2]), float(opacity)});
}

}  // namespace

TEST_CASE("samples that a layer does not cover are bit-identical in every layout") {
  for (const Sort& sort : all_sorts())
    for (const BlendChoice space : {BlendChoice::linear, BlendChoice::display}) {
      CAPTURE(sort.name);
      Frame frame = grainy(sort, {37, 23});
      const Frame before = cloned(frame);
      Layer layer = cloudy_layer({5, 4, 21, 15}, 11);
      blend_over(frame, layer, space);
      int changed = 0;
      for (int plane = 0; plane < frame.plane_count(); ++plane) {
        const cv::Mat& old_plane = before.planes[static_cast<std::size_t>(plane)];
        const cv::Mat& new_plane = frame.planes[static_cast<std::size_t>(plane)];
        for (int y = 0; y < old_plane.rows; ++y)
          for (int x = 0; x < old_plane.cols; ++x) {
            const bool same = old_plane.at<uchar>(y, x) == new_plane.at<uchar>(y, x);
            if (is_covered(layer, x, y, plane, sort, {37, 23}))
              changed += same ? 0 : 1;
            else
              REQUIRE(same);
          }
      }
      CHECK(changed > 50);
      CHECK(frame.color == before.color);
      CHECK(frame.time_s == before.time_s);
    }
}

TEST_CASE("an opaque layer gives its own colour whatever lies below") {
  const std::vector<cv::Vec3d> colors{
      {1, 1, 1},        {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.5, 0.05}, {0.003, 0.001, 0.002},
      {0.7, 0.68, 0.71}};
  int compared = 0;
  for (const Sort& sort : all_sorts())
    for (const cv::Vec3d& linear : colors)
      for (const BlendChoice space : {BlendChoice::linear, BlendChoice::display}) {
        CAPTURE(sort.name);
        CAPTURE(linear);
        const auto wanted =
            certain_codes(sort, {display_value(linear[0]), display_value(linear[1]), display_value(linear[2])});
        if (!wanted) continue;
        Frame frame = grainy(sort, {19, 13});
        blend_over(frame, opaque({0, 0, 19, 13}, linear), space);
        for (int plane = 0; plane < frame.plane_count(); ++plane) {
          const cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
          for (int y = 0; y < codes.rows; ++y)
            for (int x = 0; x < codes.cols; ++x) REQUIRE(int(codes.at<uchar>(y, x)) == (*wanted)[plane]);
        }
        ++compared;
      }
  CHECK(compared > 150);
}

TEST_CASE("half opacity mixes light in closed form and code values where asked to") {
  for (const Sort& sort : all_sorts()) {
    if (sort.step.area() > 1 && sort.layout != PixelLayout::yuv420) continue;
    CAPTURE(sort.name);
    for (const int below : {40, 90, 140, 200})
      for (const double above : {0.0, 0.1, 0.5, 1.0}) {
        CAPTURE(below);
        CAPTURE(above);
        const double low = sort.is_limited ? 16 : 0;
        const double span = sort.is_limited ? 219 : 255;
        const double old_display = (below - low) / span;
        const double mixed_light = display_value(0.5 * above + 0.5 * linear_value(old_display));
        const double mixed_codes = 0.5 * display_value(above) + 0.5 * old_display;
        Frame by_light = even(sort, {8, 6}, static_cast<uchar>(below));
        Frame by_codes = cloned(by_light);
        const Layer layer = opaque({0, 0, 8, 6}, cv::Vec3d::all(above), 0.5);
        blend_over(by_light, layer, BlendChoice::linear);
        blend_over(by_codes, layer, BlendChoice::display);
        // Rounding to a code value, and a few 24-bit roundings more.
        CHECK(std::abs(by_light.planes[0].at<uchar>(3, 4) - (low + span * mixed_light)) < 0.501);
        CHECK(std::abs(by_codes.planes[0].at<uchar>(3, 4) - (low + span * mixed_codes)) < 0.501);
        if (sort.layout == PixelLayout::rgb || sort.layout == PixelLayout::gray) continue;
        CHECK(by_light.planes[1].at<uchar>(1, 1) == 128);
        CHECK(by_light.planes[2].at<uchar>(1, 1) == 128);
      }
  }
}

TEST_CASE("an opacity near zero leaves the image unchanged") {
  for (const Sort& sort : all_sorts())
    for (const BlendChoice space : {BlendChoice::linear, BlendChoice::display})
      for (const double opacity : {1e-4, 1e-7, 1e-20, 1e-38, 1e-44}) {
        CAPTURE(sort.name);
        CAPTURE(opacity);
        Frame frame = grainy(sort, {37, 23});
        const Frame before = cloned(frame);
        blend_over(frame, opaque({0, 0, 37, 23}, {1, 0.5, 0.25}, opacity), space);
        int maximum = 0;
        for (int plane = 0; plane < frame.plane_count(); ++plane)
          maximum = std::max(maximum,
                             static_cast<int>(cv::norm(frame.planes[static_cast<std::size_t>(plane)],
                                                       before.planes[static_cast<std::size_t>(plane)], cv::NORM_INF)));
        CHECK(maximum <= (opacity > 1e-6 ? 1 : 0));
      }
}

TEST_CASE("the blended value is monotonic in opacity") {
  const Sort sort = all_sorts().front();
  int before = 60;
  for (int i = 1; i <= 400; ++i) {
    Frame frame = even(sort, {2, 2}, 60);
    blend_over(frame, opaque({0, 0, 2, 2}, {0.8, 0.8, 0.8}, i / 400.0), BlendChoice::linear);
    const int code = frame.planes[0].at<uchar>(0, 0);
    REQUIRE(code >= before);
    REQUIRE(code - before <= 8);  // linear light is steepest at the dark end
    before = code;
  }
}

TEST_CASE("a chroma sample moves by the weight of the pixels that are covered") {
  for (const Sort& sort : all_sorts()) {
    if (sort.step.area() == 1) continue;
    CAPTURE(sort.name);
    const cv::Vec3d red = codes_of(sort, {1, 0, 0});
    for (const cv::Point& pixel : {cv::Point(4, 4), cv::Point(5, 4), cv::Point(4, 5), cv::Point(5, 5)}) {
      CAPTURE(pixel);
      Frame frame = even(sort, {8, 8}, 100);
      blend_over(frame, opaque({pixel, cv::Size(1, 1)}, {1, 0, 0}), BlendChoice::linear);
      for (int plane = 1; plane < 3; ++plane) {
        const cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
        for (int y = 0; y < codes.rows; ++y)
          for (int x = 0; x < codes.cols; ++x) {
            double weight = 0;
            for (const Share& down : shares_down(sort, y, 8))
              for (const Share& across : shares_across(sort, x, 8))
                if (cv::Point(across.pixel, down.pixel) == pixel) weight += across.weight * down.weight;
            CHECK(std::abs(codes.at<uchar>(y, x) - (128 + (red[plane] - 128) * weight)) < 0.501);
          }
      }
    }
  }
}

TEST_CASE("at the edges of an odd image a chroma sample takes the weight of the pixels beyond") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    const cv::Size size(7, 5);
    for (const cv::Point corner : {cv::Point(0, 0), cv::Point(6, 0), cv::Point(0, 4), cv::Point(6, 4)}) {
      CAPTURE(corner);
      Frame frame = even(sort, size, 80);
      blend_over(frame, opaque({corner, cv::Size(1, 1)}, {0, 0, 1}), BlendChoice::linear);
      const cv::Vec3d blue = codes_of(sort, {0, 0, 1});
      CHECK(std::abs(frame.planes[0].at<uchar>(corner) - blue[0]) < 0.501);
      if (frame.plane_count() == 1) continue;
      // Lying on the corner: a half and the quarter beyond. Between it and the next: a half, or all where there is
      // none.
      const bool is_last_column = corner.x == 6;
      const bool is_last_row = corner.y == 4;
      const double wide = sort.step.width == 1 ? 1 : sort.site != ChromaSite::center ? 0.75 : is_last_column ? 1 : 0.5;
      const double high = sort.step.height == 1 ? 1 : sort.site == ChromaSite::top_left ? 0.75 : is_last_row ? 1 : 0.5;
      const bool is_rgb = sort.layout == PixelLayout::rgb;
      for (int plane = 1; plane < 3; ++plane) {
        const double old_code = is_rgb ? 80 : 128;
        const double wanted = old_code + (blue[plane] - old_code) * wide * high;
        const int code = frame.planes[static_cast<std::size_t>(plane)].at<uchar>(corner.y / sort.step.height,
                                                                                 corner.x / sort.step.width);
        CHECK(std::abs(code - std::min(wanted, 255.0)) < 0.501);
      }
    }
  }
}

TEST_CASE("code values beyond black and white are kept where nothing is added") {
  // Limited range footage holds luma below 16 and above 235; half a layer of black must not clip it.
  for (const Sort& sort : all_sorts())
    for (const int code : {0, 3, 240, 255}) {
      CAPTURE(sort.name);
      CAPTURE(code);
      Frame frame = even(sort, {6, 6}, static_cast<uchar>(code));
      const Frame before = cloned(frame);
      blend_over(frame, opaque({0, 0, 6, 6}, {1, 1, 1}, 1e-9), BlendChoice::linear);
      for (int plane = 0; plane < frame.plane_count(); ++plane)
        CHECK(
            same_bytes(frame.planes[static_cast<std::size_t>(plane)], before.planes[static_cast<std::size_t>(plane)]));
    }
}

TEST_CASE("an empty layer changes nothing") {
  for (const Sort& sort : all_sorts()) {
    Frame frame = grainy(sort, {9, 7});
    const Frame before = cloned(frame);
    blend_over(frame, Layer{}, BlendChoice::linear);
    blend_over(frame, opaque({2, 2, 0, 0}, {1, 1, 1}), BlendChoice::display);
    for (int plane = 0; plane < frame.plane_count(); ++plane)
      CHECK(same_bytes(frame.planes[static_cast<std::size_t>(plane)], before.planes[static_cast<std::size_t>(plane)]));
  }
}

TEST_CASE("replace_pixels replaces whole blocks by the image's own code values") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    Frame frame = grainy(sort, {11, 9});
    const cv::Vec3b bgr(180, 40, 220);
    const cv::Vec3d wanted = codes_of(sort, {220 / 255.0, 40 / 255.0, 180 / 255.0});
    replace_pixels(frame, cv::Mat(9, 11, CV_8UC3, cv::Scalar(bgr)), cv::Mat(9, 11, CV_32FC1, cv::Scalar(1)));
    for (int plane = 0; plane < frame.plane_count(); ++plane) {
      const cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
      for (int y = 0; y < codes.rows; ++y)
        for (int x = 0; x < codes.cols; ++x)
          REQUIRE(std::abs(codes.at<uchar>(y, x) - std::min(wanted[plane], 255.0)) < 0.501);  // rounding
    }
  }
}

TEST_CASE("replace_pixels keeps pixels of weight 0 and mixes code values between 0 and 1") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    Frame frame = grainy(sort, {12, 8});
    const Frame before = cloned(frame);
    cv::Mat weight = cv::Mat::zeros(8, 12, CV_32FC1);
    weight(cv::Rect(4, 4, 2, 2)).setTo(0.25);
    replace_pixels(frame, cv::Mat(8, 12, CV_8UC3, cv::Scalar::all(255)), weight);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x) {
        const double old_code = before.planes[0].at<uchar>(y, x);
        const bool inside = cv::Rect(4, 4, 2, 2).contains({x, y});
        const double white = sort.is_limited ? 235 : 255;
        const double wanted = inside ? 0.75 * old_code + 0.25 * white : old_code;
        REQUIRE(std::abs(frame.planes[0].at<uchar>(y, x) - wanted) < 0.501);
      }
    const Layer covered = even_layer({4, 4, 2, 2}, {1, 1, 1, 1});
    for (int plane = 1; plane < frame.plane_count(); ++plane) {
      const cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
      for (int y = 0; y < codes.rows; ++y)
        for (int x = 0; x < codes.cols; ++x) {
          const int old_code = before.planes[static_cast<std::size_t>(plane)].at<uchar>(y, x);
          if (!is_covered(covered, x, y, plane, sort, {12, 8})) REQUIRE(int(codes.at<uchar>(y, x)) == old_code);
        }
    }
  }
}

TEST_CASE("zero weight everywhere leaves every bit unchanged") {
  for (const Sort& sort : all_sorts()) {
    Frame frame = grainy(sort, {13, 7});
    const Frame before = cloned(frame);
    replace_pixels(frame, cv::Mat(7, 13, CV_8UC3, cv::Scalar::all(255)), cv::Mat::zeros(7, 13, CV_32FC1));
    for (int plane = 0; plane < frame.plane_count(); ++plane)
      CHECK(same_bytes(frame.planes[static_cast<std::size_t>(plane)], before.planes[static_cast<std::size_t>(plane)]));
  }
}

}  // namespace sigs::test
