// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "appearance/light.h"
#include "support/test_data.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

// The light that is found in real clips, beside real aircraft in them.

namespace {

// What a surface of an albedo shows: facing the sun, with half of sky and half of ground; and from below.
double luminance_of(const std::array<Estimate, 3>& color) {
  return luminance({color[0].value, color[1].value, color[2].value});
}

double in_the_sun(const LightEstimate& light, double albedo) {
  const double around = luminance_of(light.sky_color) + luminance_of(light.ground_color);
  return albedo * light.exposure.value * (luminance_of(light.sun_color) + 0.5 * around);
}

double from_below(const LightEstimate& light, double albedo) {
  return albedo * light.exposure.value * luminance_of(light.ground_color);
}

// Luma, as light, of the real aircraft in a box: its darkest and brightest twentieth. The aircraft is what differs from
// the median around it by more than 8 codes and three deviations.
struct Seen {
  double darkest = 0, brightest = 0, sky = 0;
};

double light_of_code(double code) {
  const double v = std::clamp((code - 16) / 219, 0.0, 1.0);
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::optional<Seen> aircraft_in(const cv::Mat& luma, const cv::Rect& box) {
  const int margin = std::max(4, std::max(box.width, box.height) / 4);
  const cv::Rect whole({}, luma.size());
  const cv::Rect wide =
      cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) & whole;
  const cv::Rect near = cv::Rect(box.x - 2, box.y - 2, box.width + 4, box.height + 4);
  std::vector<int> around, inside;
  for (int y = wide.y; y < wide.y + wide.height; ++y)
    for (int x = wide.x; x < wide.x + wide.width; ++x) {
      if (!near.contains({x, y})) around.push_back(luma.at<uchar>(y, x));
      if (box.contains({x, y})) inside.push_back(luma.at<uchar>(y, x));
    }
  if (around.size() < 20 || inside.empty()) return std::nullopt;
  std::sort(around.begin(), around.end());
  const int sky = around[around.size() / 2];
  double variance = 0;
  for (const int code : around) variance += (code - sky) * (code - sky) / static_cast<double>(around.size());
  const double least = std::max(8.0, 3 * std::sqrt(variance));
  std::erase_if(inside, [&](int code) { return std::abs(code - sky) <= least; });
  if (inside.size() < 20) return std::nullopt;
  std::sort(inside.begin(), inside.end());
  return Seen{light_of_code(inside[inside.size() / 20]), light_of_code(inside[inside.size() * 19 / 20]),
              light_of_code(sky)};
}

// The boxes of a clip, by frame; MATLAB's convention, the first pixel is 1.
std::vector<cv::Rect> boxes_of(const std::filesystem::path& file) {
  std::vector<cv::Rect> boxes;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    double x = 0, y = 0, w = 0, h = 0;
    const bool is_there = std::sscanf(line.c_str(), "%*[^,],%*[^,],%lf,%lf,%lf,%lf", &x, &y, &w, &h) == 4;
    boxes.push_back(
        is_there ? cv::Rect(static_cast<int>(x) - 1, static_cast<int>(y) - 1, static_cast<int>(w), static_cast<int>(h))
                 : cv::Rect());
  }
  return boxes;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct RealClip {
  LightEstimate light;
  std::vector<double> darkest, brightest, sky;  // by frame
};

RealClip look_at(const std::string& name) {
  const std::filesystem::path folder = real_data() / "track";
  auto footage = FrameSource::open(folder / (name + ".mp4"));
  REQUIRE(footage);
  const std::vector<cv::Rect> boxes = boxes_of(folder / (name + "_gt.csv"));
  RealClip clip;
  Light light;
  LightImageReader reader;
  const int count = std::min(footage->info().frame_count(), static_cast<int>(boxes.size()));
  for (int n = 5; n < count; n += 40) {
    const Frame frame = footage->read(n).value();
    light.add(reader.read(frame));
    const auto seen = aircraft_in(frame.planes[0], boxes[static_cast<std::size_t>(n)]);
    if (!seen) continue;
    clip.darkest.push_back(seen->darkest);
    clip.brightest.push_back(seen->brightest);
    clip.sky.push_back(seen->sky);
  }
  clip.light = light.finish();
  return clip;
}

}  // namespace

TEST_CASE("real aircraft are as bright and as dark as paint in the light found in their clips") {
  if (!has_real_data()) return;
  for (const char* name : {"V_AIRPLANE_001", "V_AIRPLANE_010", "V_AIRPLANE_013", "V_AIRPLANE_016", "V_AIRPLANE_017",
                           "V_AIRPLANE_020", "V_AIRPLANE_026", "V_AIRPLANE_027", "V_AIRPLANE_037", "V_HELICOPTER_008",
                           "V_HELICOPTER_013", "V_HELICOPTER_024", "V_HELICOPTER_025"}) {
    const RealClip clip = look_at(name);
    CAPTURE(name);
    if (clip.brightest.size() < 3) continue;
    REQUIRE(clip.light.exposure.is_known);
    const double brightest = median_of(clip.brightest), darkest = median_of(clip.darkest);
    // White paint reflects 0.85, and glints more; a third for the light's own deviation.
    CHECK(brightest < 1.33 * in_the_sun(clip.light, 0.85));
    // Nothing of a few pixels is all dark: its edges are mixed with the sky. Dark paint reflects 0.1.
    CHECK(darkest > from_below(clip.light, 0.1));
    // A part of each aircraft is at least as bright as gray paint is in shade, and one no brighter than white in the
    // sun.
    CHECK(brightest > from_below(clip.light, 0.5));
    CHECK(darkest < in_the_sun(clip.light, 0.5));
  }
}

TEST_CASE("under a gray sky the sun found in a real clip is weak, under a deep blue one it gives most of the light") {
  if (!has_real_data()) return;
  CHECK(look_at("V_HELICOPTER_024").light.sun_share.value < 0.25);
  CHECK(look_at("V_AIRPLANE_020").light.sun_share.value > 0.7);
}
