// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

constexpr int kSkyCode = 100;
const cv::Size kHeatImage(320, 240);

// A block of 12 m by 10 m, 60 m ahead: 50 px high.
void add_block(Scenario& scenario) {
  write_obj(scenario.path("block.obj"), {{{-1, -6, -5}, {1, 6, 5}, {0.9, 0.1, 0.1}}}, 1);
  scenario.add("block.obj", {60, 0, -150});
  scenario.project.footage.spectrum = Spectrum::thermal;
  scenario.project.appearance.thermal = {.sky = kSkyCode, .halo = 0};
  scenario.project.appearance.psf_sigma_px = 0;
}

ComposedFrame composed_gray(const Scenario& scenario) {
  return composed(scenario.opened(), 1, grainy_frame(kHeatImage, 1, PixelLayout::gray));
}

Frame full_range(Frame frame) {
  frame.color.range = ColorRange::full;
  return frame;
}

}  // namespace

TEST_CASE("a warm body has the sky's code and its heat, whatever its paint, the light and the footage's curve") {
  for (const int transfer : {1, 13, 16, 8}) {  // BT.709, sRGB, PQ, linear
    CAPTURE(transfer);
    Scenario scenario(kHeatImage);
    add_block(scenario);
    scenario.project.intruders[0].heat.skin = 80;
    scenario.project.light.color = {0.2, 0.9, 0.1};
    Frame background = full_range(even_frame(kHeatImage, kSkyCode, PixelLayout::yuv420));
    background.color.transfer = transfer;
    const ComposedFrame done = composed(scenario.opened(), 1, background);
    CHECK(std::abs(int(done.image.planes[0].at<uchar>(120, 160)) - 180) <= 1);
    for (const int plane : {1, 2}) CHECK(std::abs(int(done.image.planes[plane].at<uchar>(60, 80)) - 128) <= 1);
    CHECK(done.image.planes[0].at<uchar>(10, 10) == kSkyCode);
  }
}

TEST_CASE("thermal footage in colours is refused with a reason, gray footage with chroma is not") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  const Scene scene = scenario.opened();
  ComposeContext context;
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::rgb}) {
    Frame background = full_range(even_frame(kHeatImage, kSkyCode, layout));
    if (layout == PixelLayout::rgb) background.planes[1] = background.planes[2] = background.planes[0].clone();
    CHECK(compose_frame(scene, 1, background, context));
    background.planes[2] = background.planes[2].clone();
    background.planes[2].setTo(180);
    const Result<ComposedFrame> done = compose_frame(scene, 1, background, context);
    REQUIRE_FALSE(done);
    CHECK(done.error().where == "footage.spectrum");
    CHECK(done.error().kind == ErrorKind::bad_project);
  }
}

TEST_CASE("heat in colours is what colours of the heat are: composing and colouring may be exchanged") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  scenario.project.intruders[0].heat.skin = 120;
  scenario.project.appearance.psf_sigma_px = 1.2;
  scenario.project.appearance.thermal.halo = 0.4;
  // From cold to warm from left to right.
  Frame gray = full_range(even_frame(kHeatImage, kSkyCode, PixelLayout::gray));
  for (int x = 0; x < kHeatImage.width; ++x) gray.planes[0].col(x).setTo(60 + x / 4);
  const ComposedFrame in_gray = composed(scenario.opened(), 1, gray);
  const auto colored = [&](const Frame& heat, PixelLayout layout) {  // OpenCV's own map
    cv::Mat bgr;
    cv::applyColorMap(heat.planes[0], bgr, cv::COLORMAP_INFERNO);
    return frame_of_bgr(bgr, layout, gray.color);
  };
  scenario.project.footage.palette = HeatPalette::inferno;
  const ComposedFrame exact = composed(scenario.opened(), 1, colored(gray, PixelLayout::rgb));
  CHECK(same_planes(exact.image, colored(in_gray.image, PixelLayout::rgb)));
  CHECK(cv::norm(exact.mask, in_gray.mask, cv::NORM_INF) == 0);
  CHECK(exact.truth.intruders[0].visible_box == in_gray.truth.intruders[0].visible_box);

  // With halved chroma colours are known less well: by some codes in the mean.
  const Frame background = colored(gray, PixelLayout::yuv420);
  const ComposedFrame shared = composed(scenario.opened(), 1, background);
  cv::Mat off;
  cv::absdiff(bgr_of(shared.image), bgr_of(colored(in_gray.image, PixelLayout::yuv420)), off);
  CHECK(cv::mean(off(cv::Rect(130, 90, 60, 60)))[0] < 2);
  cv::Mat changed;
  cv::compare(shared.image.planes[0], background.planes[0], changed, cv::CMP_NE);
  CHECK(cv::countNonZero(changed & (shared.mask == 0)) == 0);

  // Of 10 bits the colours are the same.
  const Frame deep = with_bit_depth(background, 10);
  const ComposedFrame ten = composed(scenario.opened(), 1, deep);
  CHECK(ten.image.bit_depth == 10);
  cv::absdiff(bgr_of(ten.image), bgr_of(shared.image), off);
  CHECK(cv::norm(off, cv::NORM_INF) <= 4);

  // Where nothing is drawn, each sample keeps its bits.
  scenario.project.intruders[0].trajectory.waypoints[0].position_m.y = 5000;
  CHECK(same_planes(composed(scenario.opened(), 1, background).image, background));
}

TEST_CASE("colours that are not those of the palette are refused, with how far they are off") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  scenario.project.footage.palette = HeatPalette::iron;
  const Scene scene = scenario.opened();
  ComposeContext context;
  cv::Mat green(kHeatImage, CV_8UC3, cv::Scalar(40, 200, 60));
  const Result<ComposedFrame> done = compose_frame(
      scene, 1, frame_of_bgr(green, PixelLayout::yuv420, even_frame(kHeatImage, 0, PixelLayout::gray).color), context);
  REQUIRE_FALSE(done);
  CHECK(done.error().where == "footage.palette");
  CHECK(done.error().what.find("not those of iron") != std::string::npos);
}

TEST_CASE("half of a pixel that a body covers has half of its heat; beyond white it clips after the edge") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  scenario.project.appearance.psf_sigma_px = 1.5;
  scenario.project.appearance.thermal.halo = 1e-6;  // so that nothing clips before
  scenario.project.intruders[0].heat.skin = 100;
  const Frame background = full_range(even_frame(kHeatImage, kSkyCode, PixelLayout::gray));
  const ComposedFrame mild = composed(scenario.opened(), 1, background);
  scenario.project.intruders[0].heat.skin = 1000;
  const ComposedFrame hot = composed(scenario.opened(), 1, background);
  int edges = 0;
  for (int x = 100; x < 160; ++x) {
    const double share = (double(mild.image.planes[0].at<uchar>(120, x)) - kSkyCode) / 100;
    const double expected = std::min(kSkyCode + 1000 * share, 255.0);
    CHECK(std::abs(hot.image.planes[0].at<uchar>(120, x) - expected) <= 5.5);  // ten times the rounding of the mild one
    edges += share > 0.02 && share < 0.98 ? 1 : 0;
  }
  CHECK(edges >= 5);
  CHECK(hot.image.planes[0].at<uchar>(120, 160) == 255);
}

TEST_CASE("the halo takes away the mean of what the body adds, by OpenCV's own Gaussian") {
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420}) {
    Scenario scenario(kHeatImage);
    add_block(scenario);
    scenario.project.intruders[0].heat.skin = 140;
    const Frame background = full_range(even_frame(kHeatImage, kSkyCode, layout));
    const ComposedFrame plain = composed(scenario.opened(), 1, background);
    for (const double sigma_px : {9.0, 23.0, 50.0}) {
      scenario.project.appearance.thermal.halo = 0.4;
      scenario.project.appearance.thermal.halo_px = sigma_px;
      const ComposedFrame done = composed(scenario.opened(), 1, background);
      cv::Mat added, mean;
      plain.image.planes[0].convertTo(added, CV_64F, 1, -kSkyCode);
      cv::GaussianBlur(added, mean, {}, sigma_px, sigma_px, cv::BORDER_CONSTANT);
      double darkest = 255;
      for (int y = 0; y < kHeatImage.height; ++y)
        for (int x = 0; x < kHeatImage.width; ++x) {
          const double expected = kSkyCode + added.at<double>(y, x) - 0.4 * mean.at<double>(y, x);
          const int code = done.image.planes[0].at<uchar>(y, x);
          CHECK(std::abs(code - std::clamp(expected, 0.0, 255.0)) <= 1.0);
          darkest = std::min(darkest, double(code));
        }
      CHECK(darkest < kSkyCode - (sigma_px < 30 ? 9 : 4));
      // What the mask has is what was rewritten.
      for (int y = 0; y < kHeatImage.height; ++y)
        for (int x = 0; x < kHeatImage.width; ++x)
          if (done.image.planes[0].at<uchar>(y, x) != kSkyCode) CHECK(done.mask.at<uchar>(y, x) > 0);
    }
  }
}

TEST_CASE("heat has no effect in footage by light, nor light in thermal footage") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  const auto image = [&] { return composed_gray(scenario).image; };
  const Frame thermal = image();
  scenario.project.light.ambient = 0.9;
  scenario.project.light.kind = LightKind::sun;
  scenario.project.light.sun = {.azimuth_deg = 10, .elevation_deg = 30};
  CHECK(same_planes(image(), thermal));
  scenario.project.footage.spectrum = Spectrum::visible;
  const Frame visible = image();
  CHECK_FALSE(same_planes(visible, thermal));
  scenario.project.intruders[0].heat.skin = 7;
  scenario.project.appearance.thermal = {.sky = 3, .hot = HotChoice::black, .halo = 2, .halo_px = 30};
  CHECK(same_planes(image(), visible));
}

TEST_CASE("a thermal camera's scene has no contrail, of which the heat is not known") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  IntruderSettings& jet = scenario.project.intruders[0];
  jet.trajectory.waypoints = {{.frame = 0, .position_m = {60, -40, -150}}, {.frame = 2, .position_m = {60, 40, -150}}};
  const Frame without = composed_gray(scenario).image;
  jet.contrail.strands = 2;
  const ComposedFrame with = composed_gray(scenario);
  CHECK(same_planes(with.image, without));
  CHECK_FALSE(with.truth.intruders[0].has_contrail);
  scenario.project.footage.spectrum = Spectrum::visible;
  CHECK(composed_gray(scenario).truth.intruders[0].has_contrail);
}

TEST_CASE("warm is dark where the camera shows it so, and the halo is bright") {
  Scenario scenario(kHeatImage);
  add_block(scenario);
  scenario.project.intruders[0].heat.skin = 60;
  scenario.project.appearance.thermal = {.sky = kSkyCode, .hot = HotChoice::black, .halo = 0.4, .halo_px = 9};
  const ComposedFrame done =
      composed(scenario.opened(), 1, full_range(even_frame(kHeatImage, kSkyCode, PixelLayout::gray)));
  CHECK(done.image.planes[0].at<uchar>(120, 160) < 80);
  CHECK(done.image.planes[0].at<uchar>(120, 124) > kSkyCode + 5);
}

}  // namespace sigs::test
