// SPDX-License-Identifier: MIT
#include "video/heat_palette.h"

#include <doctest/doctest.h>

#include <map>
#include <opencv2/imgproc.hpp>

namespace sigs {
namespace {

const ColorInfo kVideo{.range = ColorRange::limited, .matrix = ColorMatrix::bt709};

// Codes 0 to 255 from left to right, with some texture.
cv::Mat ramp() {
  cv::Mat heat(240, 512, CV_8UC1);
  for (int y = 0; y < heat.rows; ++y)
    for (int x = 0; x < heat.cols; ++x) heat.at<uchar>(y, x) = cv::saturate_cast<uchar>(x / 2 + y / 8 % 3);
  return heat;
}

}  // namespace

TEST_CASE("a palette's colours give back the heat that OpenCV coloured") {
  struct Map {
    HeatPalette palette;
    int opencv;
  };
  for (const Map& map : {Map{HeatPalette::hot, cv::COLORMAP_HOT}, Map{HeatPalette::inferno, cv::COLORMAP_INFERNO},
                         Map{HeatPalette::turbo, cv::COLORMAP_TURBO}, Map{HeatPalette::plasma, cv::COLORMAP_PLASMA}}) {
    CAPTURE(kHeatPaletteNames[static_cast<std::size_t>(map.palette)]);
    cv::Mat bgr;
    cv::applyColorMap(ramp(), bgr, map.opencv);
    const HeatColors colors(map.palette);
    const HeatColors::Heat exact = colors.heat_of(frame_of_bgr(bgr, PixelLayout::rgb, {}));
    CHECK(exact.off_codes == 0);
    CHECK(cv::norm(exact.frame.planes[0], ramp(), cv::NORM_INF) <= 1);  // some neighbours have the same colour
    // Through the code values of a video.
    const HeatColors::Heat video = colors.heat_of(frame_of_bgr(bgr, PixelLayout::yuv420, kVideo));
    CHECK(video.off_codes < 4);
    CHECK(cv::norm(video.frame.planes[0], ramp(), cv::NORM_L1) / static_cast<double>(ramp().total()) < 2);
  }
}

TEST_CASE("what iron and rainbow show as cold, warm and hot") {
  const auto place_of = [](HeatPalette palette, int red, int green, int blue) {
    const cv::Mat bgr(4, 4, CV_8UC3, cv::Scalar(blue, green, red));
    return int{HeatColors(palette).heat_of(frame_of_bgr(bgr, PixelLayout::rgb, {})).frame.planes[0].at<uchar>(0)};
  };
  // Black, blue, purple, red, orange, yellow, white.
  CHECK(place_of(HeatPalette::iron, 0, 0, 0) == 0);
  CHECK(place_of(HeatPalette::iron, 31, 0, 118) == 32);
  CHECK(place_of(HeatPalette::iron, 181, 7, 141) == 94);
  CHECK(place_of(HeatPalette::iron, 223, 55, 59) == 128);
  CHECK(place_of(HeatPalette::iron, 239, 112, 12) == doctest::Approx(161).epsilon(0.02));
  CHECK(place_of(HeatPalette::iron, 255, 224, 30) == doctest::Approx(223).epsilon(0.01));
  CHECK(place_of(HeatPalette::iron, 255, 255, 249) == 255);
  // Blue, cyan to green, yellow, red, white.
  CHECK(place_of(HeatPalette::rainbow, 0, 3, 74) <= 4);
  CHECK(place_of(HeatPalette::rainbow, 0, 113, 223) == doctest::Approx(64).epsilon(0.04));
  CHECK(place_of(HeatPalette::rainbow, 128, 193, 14) == doctest::Approx(108).epsilon(0.04));
  CHECK(place_of(HeatPalette::rainbow, 251, 33, 59) == doctest::Approx(192).epsilon(0.02));
  CHECK(place_of(HeatPalette::rainbow, 255, 233, 208) == 255);
}

TEST_CASE("the palette is found by its colours; gray, single tones and footage by light have none") {
  const auto found = [](const cv::Mat& bgr) {
    PaletteSearch search;
    search.add(frame_of_bgr(bgr, PixelLayout::yuv420, kVideo));
    return search.found();
  };
  const auto by_opencv = [](int map) {
    cv::Mat bgr;
    cv::applyColorMap(ramp(), bgr, map);
    return bgr;
  };
  // The coldest colour, changed by what heat changes.
  const auto shown = [](HeatPalette palette, const cv::Scalar& coldest) {
    Frame image = frame_of_bgr(cv::Mat(ramp().size(), CV_8UC3, coldest), PixelLayout::rgb, {});
    HeatColors(palette).show(cv::Mat::zeros(ramp().size(), CV_8UC1), ramp(), image);
    return bgr_of(image);
  };
  const std::map<HeatPalette, cv::Mat> images = {
      {HeatPalette::iron, shown(HeatPalette::iron, {0, 0, 0})},
      {HeatPalette::rainbow, shown(HeatPalette::rainbow, {74, 3, 1})},
      {HeatPalette::hot, by_opencv(cv::COLORMAP_HOT)},
      {HeatPalette::jet, by_opencv(cv::COLORMAP_JET)},
      {HeatPalette::turbo, by_opencv(cv::COLORMAP_TURBO)},
      {HeatPalette::inferno, by_opencv(cv::COLORMAP_INFERNO)},
      {HeatPalette::magma, by_opencv(cv::COLORMAP_MAGMA)},
      {HeatPalette::plasma, by_opencv(cv::COLORMAP_PLASMA)},
  };
  REQUIRE(images.size() + 1 == kHeatPaletteNames.size());
  for (const auto& [palette, bgr] : images) {
    const std::string_view name = kHeatPaletteNames[static_cast<std::size_t>(palette)];
    INFO(name);
    const auto best = found(bgr);
    REQUIRE(best);
    CHECK(best->palette == palette);
    CHECK(best->off_codes < 5);
  }
  cv::Mat gray;
  cv::cvtColor(ramp(), gray, cv::COLOR_GRAY2BGR);
  CHECK_FALSE(found(gray));
  CHECK_FALSE(found(cv::Mat(240, 320, CV_8UC3, cv::Scalar(141, 7, 181))));
  // Blue sky above green land.
  cv::Mat land(240, 320, CV_8UC3, cv::Scalar(210, 160, 110));
  land.rowRange(140, 240).setTo(cv::Scalar(60, 110, 90));
  CHECK_FALSE(found(land));
}

}  // namespace sigs
