// SPDX-License-Identifier: MIT
#include "compositor/synthetic_frames.h"

#include <algorithm>
#include <cmath>

namespace sigs::test {

namespace {

cv::Size plane_size(const Sort& sort, cv::Size size, int plane) {
  if (plane == 0) return size;
  return {(size.width + sort.step.width - 1) / sort.step.width,
          (size.height + sort.step.height - 1) / sort.step.height};
}

Frame frame_of(const Sort& sort) {
  Frame frame{.layout = sort.layout, .time_s = 1.25};
  frame.color.range = sort.is_limited ? ColorRange::limited : ColorRange::full;
  frame.color.matrix = sort.matrix;
  frame.color.chroma_site = sort.site;
  return frame;
}

std::vector<Share> shares(int step, bool on_pixel, int chroma, int pixels) {
  if (step == 1) return {{chroma, 1}};
  std::vector<Share> taps{{2 * chroma, 0.5}, {2 * chroma + 1, 0.5}};
  if (on_pixel) taps = {{2 * chroma - 1, 0.25}, {2 * chroma, 0.5}, {2 * chroma + 1, 0.25}};
  for (Share& tap : taps) tap.pixel = std::clamp(tap.pixel, 0, pixels - 1);
  return taps;
}

}  // namespace

std::vector<Sort> all_sorts() {
  struct Named {
    const char* name;
    PixelLayout layout;
    cv::Size step;
    ChromaSite site = ChromaSite::left;
  };
  const Named layouts[] = {{"gray", PixelLayout::gray, {1, 1}},
                           {"4:2:0 left", PixelLayout::yuv420, {2, 2}},
                           {"4:2:0 center", PixelLayout::yuv420, {2, 2}, ChromaSite::center},
                           {"4:2:0 top left", PixelLayout::yuv420, {2, 2}, ChromaSite::top_left},
                           {"4:2:2 left", PixelLayout::yuv422, {2, 1}},
                           {"4:2:2 center", PixelLayout::yuv422, {2, 1}, ChromaSite::center},
                           {"4:4:4", PixelLayout::yuv444, {1, 1}}};
  const std::pair<const char*, ColorMatrix> matrices[] = {
      {"BT.601", ColorMatrix::bt601}, {"BT.709", ColorMatrix::bt709}, {"BT.2020", ColorMatrix::bt2020}};
  std::vector<Sort> sorts;
  for (const Named& layout : layouts)
    for (const auto& [name, matrix] : matrices)
      for (const bool is_limited : {true, false})
        sorts.push_back({std::string(layout.name) + " " + name + (is_limited ? " limited" : " full"), layout.layout,
                         layout.step, is_limited, matrix, layout.site});
  sorts.push_back({"RGB", PixelLayout::rgb, {1, 1}, false, ColorMatrix::bt709});
  return sorts;
}

Frame grainy(const Sort& sort, cv::Size size_px) {
  cv::RNG random(17);
  Frame frame = frame_of(sort);
  for (int plane = 0; plane < frame.plane_count(); ++plane) {
    cv::Mat& samples = frame.planes[static_cast<std::size_t>(plane)];
    samples.create(plane_size(sort, size_px, plane), CV_8UC1);
    const bool is_chroma = plane > 0 && sort.layout != PixelLayout::rgb;
    random.fill(samples, cv::RNG::UNIFORM, is_chroma ? 108 : 0, is_chroma ? 149 : 256);
  }
  return frame;
}

Frame even(const Sort& sort, cv::Size size_px, uchar code) {
  Frame frame = frame_of(sort);
  for (int plane = 0; plane < frame.plane_count(); ++plane) {
    const bool is_chroma = plane > 0 && sort.layout != PixelLayout::rgb;
    frame.planes[static_cast<std::size_t>(plane)] =
        cv::Mat(plane_size(sort, size_px, plane), CV_8UC1, cv::Scalar(is_chroma ? 128 : code));
  }
  return frame;
}

double display_value(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_value(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

cv::Vec3d codes_of(const Sort& sort, const cv::Vec3d& display) {
  if (sort.layout == PixelLayout::rgb) return display * 255.0;
  const double kr = sort.matrix == ColorMatrix::bt601 ? 0.299 : sort.matrix == ColorMatrix::bt709 ? 0.2126 : 0.2627;
  const double kb = sort.matrix == ColorMatrix::bt601 ? 0.114 : sort.matrix == ColorMatrix::bt709 ? 0.0722 : 0.0593;
  const double luma = kr * display[0] + (1 - kr - kb) * display[1] + kb * display[2];
  const double cb = (display[2] - luma) / (2 - 2 * kb);
  const double cr = (display[0] - luma) / (2 - 2 * kr);
  if (sort.is_limited) return {16 + 219 * luma, 128 + 224 * cb, 128 + 224 * cr};
  return {255 * luma, 128 + 255 * cb, 128 + 255 * cr};
}

std::vector<Share> shares_across(const Sort& sort, int chroma, int pixels) {
  return shares(sort.step.width, sort.site != ChromaSite::center, chroma, pixels);
}

std::vector<Share> shares_down(const Sort& sort, int chroma, int pixels) {
  return shares(sort.step.height, sort.site == ChromaSite::top_left, chroma, pixels);
}

bool is_covered(const Layer& layer, int x, int y, int plane, const Sort& sort, cv::Size size_px) {
  const auto covers = [&](int i, int j) {
    return layer.rect.contains({i, j}) && layer.color.at<cv::Vec4f>(j - layer.rect.y, i - layer.rect.x)[3] > 0;
  };
  if (plane == 0) return covers(x, y);
  for (const Share& down : shares_down(sort, y, size_px.height))
    for (const Share& across : shares_across(sort, x, size_px.width))
      if (covers(across.pixel, down.pixel)) return true;
  return false;
}

}  // namespace sigs::test
