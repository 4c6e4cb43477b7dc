// SPDX-License-Identifier: MIT
#include "appearance/target_look.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

using namespace sigs;

namespace {

constexpr double kSky = 150, kBody = 90;
const Box kLoose{40, 30, 80, 60};                 // around the target below
const cv::Rect_<double> kTarget(60, 45, 40, 30);  // its true outline, continuous pixels

// Share of a Gaussian of sigma_px around `at` that lies between two edges: closed form of a blurred rectangle.
double between(double at, double low, double high, double sigma_px) {
  const double scale = 1 / (std::numbers::sqrt2 * sigma_px);
  return 0.5 * (std::erf((high - at) * scale) - std::erf((low - at) * scale));
}

double share_at(int x, int y, double sigma_px, cv::Point2d shift = {}) {
  return between(x - shift.x, kTarget.x, kTarget.x + kTarget.width, sigma_px) *
         between(y - shift.y, kTarget.y, kTarget.y + kTarget.height, sigma_px);
}

uchar code(double value) {
  return cv::saturate_cast<uchar>(value);
}

// A frame of 160x120 whose luma is given by pixel, with chroma at 128.
Frame frame_with(const std::function<double(int x, int y)>& luma) {
  Frame frame = blank_frame(PixelLayout::yuv420, {160, 120}, {});
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) frame.planes[0].at<uchar>(y, x) = code(luma(x, y));
  frame.planes[1].setTo(128);
  frame.planes[2].setTo(128);
  return frame;
}

// A dark rectangle before a sky, blurred by a Gaussian.
Frame rectangle(double sigma_px, cv::Point2d shift = {}, double body = kBody) {
  return frame_with([&](int x, int y) { return kSky + (body - kSky) * share_at(x, y, sigma_px, shift); });
}

// Normally distributed numbers, the same on every machine.
class WhiteNoise {
 public:
  double operator()() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) {
      state_ = state_ * 6364136223846793005U + 1442695040888963407U;
      sum += static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    return sum;
  }

 private:
  std::uint64_t state_ = 7;
};

}  // namespace

TEST_CASE("the silhouette of a rectangle in a loose box is the rectangle") {
  const auto target = target_silhouette(rectangle(0.3), kLoose);
  REQUIRE(target);
  CHECK(target->box == cv::Rect(60, 45, 41, 31));  // at 60 and 100 half of the contrast is left
  CHECK_FALSE(target->is_cut);
  CHECK(target->background == doctest::Approx(kSky).epsilon(0.001));
}

TEST_CASE("a sky that shades off and has clouds' curvature is no target") {
  const auto sky = [](int x, int y) { return 120 + 0.3 * x + 0.002 * (y - 60) * (y - 60); };
  CHECK_FALSE(target_silhouette(frame_with(sky), kLoose).has_value());
  const auto target =
      target_silhouette(frame_with([&](int x, int y) { return sky(x, y) - 60 * share_at(x, y, 0.5); }), kLoose);
  REQUIRE(target);
  CHECK(target->box.width == doctest::Approx(41).epsilon(0.06));
}

TEST_CASE("what is no box in the image has no silhouette") {
  const Frame frame = rectangle(0.5);
  CHECK_FALSE(target_silhouette(frame, {500, 500, 20, 20}).has_value());
  CHECK_FALSE(target_silhouette(frame, {40, 30, 0, 60}).has_value());
  CHECK_FALSE(target_silhouette(frame, {40, 30, std::nan(""), 60}).has_value());
  CHECK_FALSE(target_silhouette(frame, {0, 0, 160, 120}).has_value());  // no surroundings
}

TEST_CASE("a target that goes on beyond its box is said to be cut") {
  const auto target = target_silhouette(rectangle(0.5), {70, 30, 80, 60});
  REQUIRE(target);
  CHECK(target->is_cut);
}

TEST_CASE("the edge's width is that of a Gaussian's integral") {
  for (const double sigma_px : {0.6, 1.0, 1.5}) {
    const auto look = target_look(rectangle(sigma_px), kLoose);
    REQUIRE(look);
    REQUIRE(look->edge_width_px);
    // From 10 to 90 % an error function takes 2.563 sigma; its steepest slope is 1/(sqrt(2 pi) sigma).
    // Interpolation between pixels adds a tenth of a pixel.
    CHECK(*look->edge_width_px == doctest::Approx(2.563 * sigma_px).epsilon(0.1));
    CHECK(*look->edge_slope == doctest::Approx(1 / (std::sqrt(2 * std::numbers::pi) * sigma_px)).epsilon(0.12));
    CHECK(*look->overshoot < 0.03);
  }
}

TEST_CASE("a halo of a sixth of the contrast is measured as that") {
  // Unsharp masking of a straight edge: e + a (e - wider e) has its least value where the derivative vanishes.
  const double sigma = 0.8, wide = 2.0, amount = 0.6;
  double lowest = 0;
  for (double d = 0; d < 8; d += 0.01) {
    const auto edge = [&](double s) { return 0.5 * std::erfc(d / (std::numbers::sqrt2 * s)); };
    lowest = std::min(lowest, edge(sigma) + amount * (edge(sigma) - edge(wide)));
  }
  const auto look = target_look(frame_with([&](int x, int y) {
                                  const double sharp = share_at(x, y, sigma);
                                  return kSky + (kBody - kSky) * (sharp + amount * (sharp - share_at(x, y, wide)));
                                }),
                                kLoose);
  REQUIRE(look);
  CHECK(*look->overshoot == doctest::Approx(-lowest).epsilon(0.15));
}

TEST_CASE("contrast and percentiles are those of the two brightnesses") {
  const auto look = target_look(rectangle(0.3), kLoose);
  REQUIRE(look);
  CHECK(*look->weber_rms == doctest::Approx((kSky - kBody) / kSky).epsilon(0.05));  // the outline is half as dark
  CHECK(*look->weber_mean == doctest::Approx(-(kSky - kBody) / kSky).epsilon(0.05));
  CHECK(*look->darkest_5 == doctest::Approx(kBody - kSky).epsilon(0.02));
  CHECK(look->area_px == 41 * 31);
}

TEST_CASE("noise within the silhouette is measured, and beyond the background's") {
  WhiteNoise noise;
  const auto look = target_look(frame_with([&](int x, int y) {
                                  const double share = share_at(x, y, 0.5);
                                  return kSky + (kBody - kSky) * share + (share > 0.5 ? 4.0 : 1.0) * noise();
                                }),
                                kLoose);
  REQUIRE(look);
  CHECK(*look->grain_inside == doctest::Approx(4).epsilon(0.08));
  CHECK(*look->grain_excess == doctest::Approx(3).epsilon(0.1));
}

TEST_CASE("waves around the outline are ringing, waves everywhere are not") {
  const auto wave = [](int x, int y) { return ((x + y) % 2 == 0 ? 2.0 : -2.0); };
  const auto at = [&](bool everywhere) {
    return target_look(frame_with([&](int x, int y) {
                         const double dx = std::max({kTarget.x - x, x - kTarget.x - kTarget.width, 0.0});
                         const double dy = std::max({kTarget.y - y, y - kTarget.y - kTarget.height, 0.0});
                         const bool rings = everywhere || std::hypot(dx, dy) < 10;
                         return kSky + (kBody - kSky) * share_at(x, y, 0.5) + (rings ? wave(x, y) : 0);
                       }),
                       kLoose);
  };
  const auto around = at(false), everywhere = at(true);
  REQUIRE(around);
  REQUIRE(everywhere);
  CHECK(*around->ringing > 5);  // the operator answers a chessboard of +-2 with 16 * 2 / 6 * 1.25
  CHECK(std::abs(*everywhere->ringing) < 0.1);
  CHECK(*around->ringing_waves == doctest::Approx(2).epsilon(0.1));
}

TEST_CASE("colour is that of the chroma planes, and blurred chroma has wide edges and spills") {
  const auto coloured = [](double sigma_px) {
    Frame frame = rectangle(0.5);
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 80; ++x) {
        // Samples lie on every other column, midway between two rows.
        const double share = between(2 * x, kTarget.x, kTarget.x + kTarget.width, sigma_px) *
                             between(2 * y + 0.5, kTarget.y, kTarget.y + kTarget.height, sigma_px);
        frame.planes[1].at<uchar>(y, x) = code(128 + 24 * share);
        frame.planes[2].at<uchar>(y, x) = code(128 - 32 * share);
      }
    return target_look(frame, kLoose);
  };
  const auto sharp = coloured(0.7), blurred = coloured(3);
  REQUIRE(sharp);
  REQUIRE(blurred);
  const double filled = 40 * 30 / (41.0 * 31.0);  // the silhouette has the pixels of the outline, half of them sky
  CHECK(*sharp->cb_difference == doctest::Approx(24 * filled).epsilon(0.04));
  CHECK(*sharp->cr_difference == doctest::Approx(-32 * filled).epsilon(0.04));
  CHECK(*sharp->saturation == doctest::Approx(40 * filled).epsilon(0.04));  // 24, 32, 40
  REQUIRE(blurred->chroma_edge_width_px);
  CHECK(*blurred->chroma_edge_width_px == doctest::Approx(2.563 * 3).epsilon(0.15));
  CHECK(*blurred->chroma_spill > 2 * *sharp->chroma_spill);
  CHECK(*sharp->chroma_detail > 2 * *blurred->chroma_detail);
}

TEST_CASE("gray footage has no colour, but all else") {
  Frame frame = rectangle(0.8);
  frame.layout = PixelLayout::gray;
  frame.planes[1] = frame.planes[2] = cv::Mat();
  const auto look = target_look(frame, kLoose);
  REQUIRE(look);
  CHECK_FALSE(look->saturation.has_value());
  CHECK_FALSE(look->chroma_edge_width_px.has_value());
  CHECK(look->edge_width_px.has_value());
}

TEST_CASE("shake is the distance from a smooth path, a smooth path has none") {
  const auto course = [](bool shakes) {
    std::vector<TargetLook> looks;
    for (int n = 0; n < 9; ++n) {
      const double off = shakes ? (n % 2 == 0 ? 0.5 : -0.5) : 0;
      looks.push_back(*target_look(rectangle(0.7, {0.7 * n + 0.03 * n * n + off, -0.4 * n}), {40, 20, 90, 80}));
    }
    TargetLook look = looks[4];
    add_flicker(look, looks);
    return look;
  };
  CHECK(*course(false).shake_px < 0.05);
  // An alternation of +-a is nearly free of the polynomial; over 9 - 3 degrees of freedom its norm is a sqrt(9 / 6).
  CHECK(*course(true).shake_px == doctest::Approx(0.5 * std::sqrt(9 / 6.0)).epsilon(0.1));
}

TEST_CASE("brightness that alternates flickers by its share of the contrast") {
  std::vector<TargetLook> looks;
  for (int n = 0; n < 8; ++n)
    looks.push_back(*target_look(rectangle(0.5, {}, n % 2 == 0 ? kBody : kBody + 12), kLoose));
  TargetLook look = looks[4];
  add_flicker(look, looks);
  // +-6 about a contrast of 54, over 8 - 3 degrees of freedom.
  CHECK(*look.brightness_flicker == doctest::Approx(6 / 54.0 * std::sqrt(8 / 5.0)).epsilon(0.1));
  CHECK(*look.shake_px < 0.02);
  TargetLook alone = looks[4];
  add_flicker(alone, std::span(looks).first(4));
  CHECK_FALSE(alone.shake_px.has_value());
}
