// SPDX-License-Identifier: MIT
#include "video/frame.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "compositor/blend.h"
#include "compositor/float_patch.h"
#include "compositor/haze.h"
#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

constexpr int kDepths[] = {10, 12, 16};

// The relation of code values to R'G'B' in doubles: Rec. ITU-T H.273, equations 20 to 40, for any depth.
struct DeepCodes {
  const Sort& sort;
  int depth;

  [[nodiscard]] double kr() const {
    return sort.matrix == ColorMatrix::bt601 ? 0.299 : sort.matrix == ColorMatrix::bt709 ? 0.2126 : 0.2627;
  }
  [[nodiscard]] double kb() const {
    return sort.matrix == ColorMatrix::bt601 ? 0.114 : sort.matrix == ColorMatrix::bt709 ? 0.0722 : 0.0593;
  }
  [[nodiscard]] double step() const { return std::pow(2.0, depth - 8); }
  [[nodiscard]] double top() const { return std::pow(2.0, depth) - 1; }
  [[nodiscard]] double luma_span() const { return sort.is_limited ? 219 * step() : top(); }
  [[nodiscard]] double chroma_span() const { return sort.is_limited ? 224 * step() : top(); }
  [[nodiscard]] double black() const { return sort.is_limited ? 16 * step() : 0; }
  [[nodiscard]] double middle() const { return 128 * step(); }

  [[nodiscard]] cv::Vec3d of(const cv::Vec3d& rgb) const {
    if (sort.layout == PixelLayout::rgb) return rgb * top();
    const double y = kr() * rgb[0] + (1 - kr() - kb()) * rgb[1] + kb() * rgb[2];
    return {y * luma_span() + black(), (rgb[2] - y) / (2 * (1 - kb())) * chroma_span() + middle(),
            (rgb[0] - y) / (2 * (1 - kr())) * chroma_span() + middle()};
  }

  [[nodiscard]] cv::Vec3d to_rgb(const cv::Vec3d& codes) const {
    if (sort.layout == PixelLayout::rgb) return codes / top();
    const double y = (codes[0] - black()) / luma_span();
    if (sort.layout == PixelLayout::gray) return {y, y, y};
    const double b = y + 2 * (1 - kb()) * (codes[1] - middle()) / chroma_span();
    const double r = y + 2 * (1 - kr()) * (codes[2] - middle()) / chroma_span();
    return {r, (y - kr() * r - kb() * b) / (1 - kr() - kb()), b};
  }
};

// The grainy frame of 8 bits with noise in the lower bits.
Frame deep_grainy(const Sort& sort, cv::Size size_px, int depth) {
  Frame frame = grainy(sort, size_px);
  frame.bit_depth = depth;
  unsigned state = 12345;
  for (int plane = 0; plane < frame.plane_count(); ++plane) {
    cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
    cv::Mat deep(codes.size(), CV_16UC1);
    for (int y = 0; y < codes.rows; ++y)
      for (int x = 0; x < codes.cols; ++x) {
        state = state * 1664525U + 1013904223U;
        deep.at<ushort>(y, x) =
            static_cast<ushort>(codes.at<uchar>(y, x) << (depth - 8) | (state >> 16) % (1U << (depth - 8)));
      }
    codes = deep;
  }
  return frame;
}

Frame evenly_colored(const Sort& sort, cv::Size size_px, int depth, const cv::Vec3d& codes) {
  Frame frame = deep_grainy(sort, size_px, depth);
  for (int plane = 0; plane < frame.plane_count(); ++plane)
    frame.planes[static_cast<std::size_t>(plane)].setTo(std::round(codes[plane]));
  return frame;
}

// Codes beyond black stand for negative values; both curves are mirrored there.
double mirrored_curve(double (*curve)(double), double value) {
  return std::copysign(curve(std::abs(value)), value);
}

cv::Vec3d over(const cv::Vec4f& layer, const cv::Vec3d& below, BlendChoice space) {
  cv::Vec3d out;
  const double through = 1 - double{layer[3]};
  for (int c = 0; c < 3; ++c)
    out[c] = space == BlendChoice::linear
                 ? mirrored_curve(display_value, layer[c] + through * mirrored_curve(linear_value, below[c]))
                 : layer[3] * display_value(double{layer[c]} / layer[3]) + through * below[c];
  return out;
}

// Half a code of rounding, and what floats of 24 bits lose of codes of the depth.
double tolerance(int depth) {
  return 0.5 + std::pow(2.0, depth) * 2e-6;
}

}  // namespace

TEST_CASE("samples of more than 8 bits that a layer does not cover are bit-identical in every layout") {
  for (const int depth : kDepths)
    for (const Sort& sort : all_sorts()) {
      CAPTURE(sort.name);
      CAPTURE(depth);
      Frame frame = deep_grainy(sort, {37, 23}, depth);
      const Frame before = cloned(frame);
      const Layer layer = cloudy_layer({5, 4, 21, 15}, 11);
      blend_over(frame, layer, BlendChoice::linear);
      int changed = 0;
      for (int plane = 0; plane < frame.plane_count(); ++plane) {
        const cv::Mat& old_plane = before.planes[static_cast<std::size_t>(plane)];
        const cv::Mat& new_plane = frame.planes[static_cast<std::size_t>(plane)];
        for (int y = 0; y < old_plane.rows; ++y)
          for (int x = 0; x < old_plane.cols; ++x) {
            const bool same = old_plane.at<ushort>(y, x) == new_plane.at<ushort>(y, x);
            if (is_covered(layer, x, y, plane, sort, {37, 23}))
              changed += same ? 0 : 1;
            else
              REQUIRE(same);
          }
      }
      CHECK(changed > 50);
    }
}

TEST_CASE("where pixels have samples of their own, blending is right to half a code of the footage's depth") {
  for (const int depth : kDepths)
    for (const Sort& sort : all_sorts())
      for (const BlendChoice space : {BlendChoice::linear, BlendChoice::display}) {
        if (sort.step != cv::Size(1, 1)) continue;
        CAPTURE(sort.name);
        CAPTURE(depth);
        const DeepCodes codes{sort, depth};
        Frame frame = deep_grainy(sort, {37, 23}, depth);
        const Frame before = cloned(frame);
        const Layer layer = cloudy_layer({5, 4, 21, 15}, 11);
        blend_over(frame, layer, space);
        double largest = 0;
        for (int y = 0; y < layer.rect.height; ++y)
          for (int x = 0; x < layer.rect.width; ++x) {
            const cv::Vec4f color = layer.color.at<cv::Vec4f>(y, x);
            if (!(color[3] > 0)) continue;
            const cv::Point at = layer.rect.tl() + cv::Point(x, y);
            cv::Vec3d below(0, codes.middle(), codes.middle());
            for (int plane = 0; plane < frame.plane_count(); ++plane)
              below[plane] = before.planes[static_cast<std::size_t>(plane)].at<ushort>(at);
            const cv::Vec3d want = codes.of(over(color, codes.to_rgb(below), space));
            for (int plane = 0; plane < frame.plane_count(); ++plane)
              largest = std::max(largest, std::abs(frame.planes[static_cast<std::size_t>(plane)].at<ushort>(at) -
                                                   std::clamp(want[plane], 0.0, codes.top())));
          }
        CHECK(largest <= tolerance(depth));
      }
}

TEST_CASE("over an even colour a half-transparent layer gives the same codes in every layout of a depth") {
  const cv::Vec4f color(0.21F, 0.1F, 0.05F, 0.6F);
  for (const int depth : kDepths)
    for (const Sort& sort : all_sorts()) {
      CAPTURE(sort.name);
      CAPTURE(depth);
      const DeepCodes codes{sort, depth};
      cv::Vec3d below = codes.of({0.3, 0.45, 0.55});
      for (int c = 0; c < 3; ++c) below[c] = std::round(below[c]);
      Frame frame = evenly_colored(sort, {40, 32}, depth, below);
      blend_over(frame, even_layer({8, 8, 24, 16}, color), BlendChoice::linear);
      const cv::Vec3d want = codes.of(over(color, codes.to_rgb(below), BlendChoice::linear));
      for (int plane = 0; plane < frame.plane_count(); ++plane) {
        const cv::Size step = plane == 0 ? cv::Size(1, 1) : sort.step;
        const int code = frame.planes[static_cast<std::size_t>(plane)].at<ushort>(16 / step.height, 20 / step.width);
        CHECK(std::abs(code - want[plane]) <= tolerance(depth));
      }
    }
}

TEST_CASE("PQ light of 10 bits is blended to half a code") {
  // SMPTE ST 2084, written out again; 1 is 203 cd/m2 of 10000.
  const auto light_of = [](double display) {
    const double p = std::pow(display, 1 / 78.84375);
    return 10000.0 / 203 * std::pow(std::max(p - 0.8359375, 0.0) / (18.8515625 - 18.6875 * p), 1 / 0.1593017578125);
  };
  const auto display_of = [](double light) {
    const double p = std::pow(light * 203 / 10000, 0.1593017578125);
    return std::pow((0.8359375 + 18.8515625 * p) / (1 + 18.6875 * p), 78.84375);
  };
  const Sort sort{"PQ", PixelLayout::yuv444, {1, 1}, true, ColorMatrix::bt2020};
  const DeepCodes codes{sort, 10};
  Frame frame = evenly_colored(sort, {16, 16}, 10, {430, 520, 505});
  frame.color.transfer = 16;
  const cv::Vec4f color(0.2F, 0.5F, 1.1F, 0.5F);
  blend_over(frame, even_layer({4, 4, 8, 8}, color), BlendChoice::linear);
  const cv::Vec3d below = codes.to_rgb({430, 520, 505});
  cv::Vec3d mixed;
  for (int c = 0; c < 3; ++c) mixed[c] = display_of(color[c] + 0.5 * light_of(below[c]));
  const cv::Vec3d want = codes.of(mixed);
  for (int plane = 0; plane < 3; ++plane)
    CHECK(std::abs(frame.planes[static_cast<std::size_t>(plane)].at<ushort>(8, 8) - want[plane]) <= tolerance(10));
}

TEST_CASE("a gradient under a transparent layer has no steps of 8 bits") {
  const Sort sort{"ramp", PixelLayout::gray, {1, 1}, true, ColorMatrix::bt709};
  Frame frame = evenly_colored(sort, {512, 8}, 10, {0, 0, 0});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 512; ++x) frame.planes[0].at<ushort>(y, x) = static_cast<ushort>(400 + x / 4);
  blend_over(frame, even_layer({0, 0, 512, 8}, {0.03F, 0.03F, 0.03F, 0.3F}), BlendChoice::linear);
  std::set<int> codes;
  int largest_step = 0;
  for (int x = 0; x < 512; ++x) {
    codes.insert(frame.planes[0].at<ushort>(4, x));
    if (x > 0)
      largest_step =
          std::max(largest_step, std::abs(frame.planes[0].at<ushort>(4, x) - frame.planes[0].at<ushort>(4, x - 1)));
  }
  // 128 codes of 10 bits are 32 of 8 bits. What is let through, 70 % of the light, spans more than half of them.
  CHECK(codes.size() > 80);
  CHECK(largest_step <= 2);
}

TEST_CASE("a patch that nothing changes leaves every bit of a deep frame") {
  for (const int depth : kDepths)
    for (const Sort& sort : all_sorts()) {
      Frame frame = deep_grainy(sort, {37, 23}, depth);
      const Frame before = cloned(frame);
      const cv::Mat changed = write_patch(patch_of(frame, {3, 5, 20, 10}, 4, {}), frame);
      CHECK(cv::countNonZero(changed) == 0);
      for (int plane = 0; plane < frame.plane_count(); ++plane)
        CHECK(cv::norm(frame.planes[static_cast<std::size_t>(plane)], before.planes[static_cast<std::size_t>(plane)],
                       cv::NORM_INF) == 0);
    }
}

TEST_CASE("grain of one 8-bit code has four codes of 10 bits, and fine grain is not lost in rounding") {
  const Sort sort{"gray", PixelLayout::gray, {1, 1}, true, ColorMatrix::bt709};
  for (const double sd_code : {1.0, 0.25}) {
    Frame frame = evenly_colored(sort, {128, 128}, 10, {500, 0, 0});
    FloatPatch patch =
        blended_patch(frame, even_layer({0, 0, 128, 128}, {0.2F, 0.2F, 0.2F, 1}), BlendChoice::linear, 0, {});
    add_grain(patch, {.sd_dark = sd_code, .sd_bright = sd_code}, 3);
    (void)write_patch(patch, frame);
    cv::Scalar mean, deviation;
    cv::meanStdDev(frame.planes[0], mean, deviation);
    // Of 16384 samples the standard deviation is known to 1/sqrt(2 * 16384), 0.6 %; five times that.
    CHECK(deviation[0] == doctest::Approx(4 * sd_code).epsilon(0.03));
  }
}

TEST_CASE("the haze's colour is the footage's, whatever the depth") {
  const Sort sort{"4:2:0", PixelLayout::yuv420, {2, 2}, true, ColorMatrix::bt709};
  const DeepCodes codes{sort, 10};
  const Frame frame = evenly_colored(sort, {64, 64}, 10, codes.of({0.5, 0.6, 0.7}));
  const auto light = airlight_around(frame, {20, 20, 10, 10}, {});
  REQUIRE(light.has_value());
  const cv::Vec3d display(0.5, 0.6, 0.7);
  // Codes are rounded to 1/876 of luma and 1/896 of chroma, the light's slope is below 2.
  for (int c = 0; c < 3; ++c) CHECK(std::abs((*light)[c] - linear_value(display[c])) < 4.0 / 876);
}

}  // namespace sigs::test
