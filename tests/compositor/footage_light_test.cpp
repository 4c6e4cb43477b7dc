// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "compositor/blend.h"
#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

// Light is mixed by the footage's own transfer function and in its own primaries: the standards' formulas written out
// again, in doubles, with 1 for 203 cd/m2.
namespace sigs::test {
namespace {

double pq_display(double nits) {
  const double y = std::pow(nits / 10000, 0.1593017578125);
  return std::pow((0.8359375 + 18.8515625 * y) / (1 + 18.6875 * y), 78.84375);
}

double pq_nits(double display) {
  const double n = std::pow(display, 1 / 78.84375);
  return 10000 * std::pow(std::max(n - 0.8359375, 0.0) / (18.8515625 - 18.6875 * n), 1 / 0.1593017578125);
}

double hlg_display(double scene) {
  return scene <= 1.0 / 12 ? std::sqrt(3 * scene) : 0.17883277 * std::log(12 * scene - 0.28466892) + 0.55991073;
}

double hlg_scene(double display) {
  return display <= 0.5 ? display * display / 3 : (std::exp((display - 0.55991073) / 0.17883277) + 0.28466892) / 12;
}

struct Curve {
  int transfer = 0;
  double (*light)(double display) = nullptr;
  double (*display)(double light) = nullptr;
};

const Curve kCurves[] = {
    {16, [](double v) { return pq_nits(v) / 203; }, [](double l) { return pq_display(203 * l); }},
    {18, [](double v) { return hlg_scene(v) / hlg_scene(0.75); },
     [](double l) { return hlg_display(l * hlg_scene(0.75)); }},
    {4, [](double v) { return std::pow(v, 2.2); }, [](double l) { return std::pow(l, 1 / 2.2); }},
    {5, [](double v) { return std::pow(v, 2.8); }, [](double l) { return std::pow(l, 1 / 2.8); }},
    {8, [](double v) { return v; }, [](double l) { return l; }},
};

// How far a code value may be off: rounding, and the floats between.
constexpr double kLightRounding = 0.51;

}  // namespace

TEST_CASE("half an opacity mixes light by the footage's own transfer function") {
  for (const Sort& sort : all_sorts())
    for (const Curve& curve : kCurves)
      for (const int below : {40, 90, 140, 200})
        for (const float above : {0.0F, 0.1F, 0.5F, 1.0F, 3.0F}) {
          CAPTURE(sort.name);
          CAPTURE(curve.transfer);
          CAPTURE(below);
          CAPTURE(above);
          const double low = sort.is_limited ? 16 : 0;
          const double span = sort.is_limited ? 219 : 255;
          const double old_display = (below - low) / span;
          Frame frame = even(sort, {8, 6}, static_cast<uchar>(below));
          frame.color.transfer = curve.transfer;
          Frame by_codes = cloned(frame);
          const Layer layer = even_layer({0, 0, 8, 6}, {above / 2, above / 2, above / 2, 0.5F});
          blend_over(frame, layer, BlendChoice::linear);
          blend_over(by_codes, layer, BlendChoice::display);
          const double light = low + span * curve.display(0.5 * above + 0.5 * curve.light(old_display));
          const double codes = low + span * (0.5 * curve.display(above) + 0.5 * old_display);
          CHECK(std::abs(frame.planes[0].at<uchar>(3, 4) - std::min(light, 255.0)) < kLightRounding);
          CHECK(std::abs(by_codes.planes[0].at<uchar>(3, 4) - std::min(codes, 255.0)) < kLightRounding);
        }
}

TEST_CASE("diffuse white has the signals of HDR reference white") {
  // Rec. ITU-R BT.2408: 203 cd/m2 is 58 % of PQ and 75 % of HLG.
  const Sort sort = all_sorts().back();
  for (const auto& [transfer, percent] : {std::pair{16, 58.0}, {18, 75.0}, {1, 100.0}}) {
    Frame frame = even(sort, {4, 4}, 10);
    frame.color.transfer = transfer;
    blend_over(frame, even_layer({0, 0, 4, 4}, {1, 1, 1, 1}), BlendChoice::linear);
    for (const cv::Mat& plane : frame.planes) CHECK(std::abs(plane.at<uchar>(1, 1) / 2.55 - percent) < 0.5);
  }
}

TEST_CASE("an intruder's colour comes out in the footage's primaries") {
  // Rec. ITU-R BT.2087: BT.709's red, green and blue in BT.2020, to four digits.
  const double bt2020[3][3] = {{0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}};
  const Sort sort = all_sorts().back();
  for (int primary = 0; primary < 3; ++primary) {
    Frame frame = even(sort, {4, 4}, 10);
    frame.color.transfer = 16;
    frame.color.primaries = 9;
    cv::Vec4f color(0, 0, 0, 1);
    color[primary] = 1;
    blend_over(frame, even_layer({0, 0, 4, 4}, color), BlendChoice::linear);
    for (int c = 0; c < 3; ++c) {
      const double wanted = 255 * pq_display(203 * bt2020[c][primary]);
      // Four digits of the matrix are a twentieth of a code value at PQ's dark end.
      CHECK(std::abs(frame.planes[static_cast<std::size_t>(c)].at<uchar>(1, 1) - wanted) < 0.6);
    }
  }
}

TEST_CASE("footage of standard dynamic range is mixed by one curve whatever its standard") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    Frame unstated = grainy(sort, {21, 15});
    const Layer layer = cloudy_layer({3, 2, 15, 11}, 4);
    Frame plain = cloned(unstated);
    blend_over(plain, layer, BlendChoice::linear);
    for (const int transfer : {1, 6, 7, 11, 13, 14, 15}) {
      Frame frame = cloned(unstated);
      frame.color.transfer = transfer;
      frame.color.primaries = 1;
      blend_over(frame, layer, BlendChoice::linear);
      for (int plane = 0; plane < frame.plane_count(); ++plane)
        CHECK(same_bytes(frame.planes[static_cast<std::size_t>(plane)], plain.planes[static_cast<std::size_t>(plane)]));
    }
  }
}

TEST_CASE("samples that no light reaches keep their bits in footage of high dynamic range") {
  for (const Sort& sort : all_sorts())
    for (const int transfer : {4, 5, 8, 16, 18}) {
      CAPTURE(sort.name);
      CAPTURE(transfer);
      Frame frame = grainy(sort, {13, 9});
      frame.color.transfer = transfer;
      frame.color.primaries = 9;
      const Frame before = cloned(frame);
      blend_over(frame, even_layer({2, 2, 8, 5}, {0, 0, 0, 1e-7F}), BlendChoice::linear);
      for (int plane = 0; plane < frame.plane_count(); ++plane)
        CHECK(
            same_bytes(frame.planes[static_cast<std::size_t>(plane)], before.planes[static_cast<std::size_t>(plane)]));
    }
}

}  // namespace sigs::test
