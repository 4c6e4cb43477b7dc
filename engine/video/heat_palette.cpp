// SPDX-License-Identifier: MIT
#include "video/heat_palette.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "video/color_space.h"

namespace sigs {

namespace {

constexpr int kColors = 256;
constexpr int kCell_codes = 4, kCells = 256 / kCell_codes;
constexpr int kBeside = 6;  // colours beside that of a cell, of which one is the nearest
constexpr int kLookedAt_px = 160;
constexpr double kMinColor_codes = 12;  // largest less least of red, green and blue, in the mean
constexpr double kMinRange = 24;        // colours of the palette between the coldest and the warmest twentieth

// A colour of a palette, by its place; between two of them colours change linearly.
struct Knot {
  int place;
  cv::Vec3b rgb;
};

// Measured in tables of cameras with FLIR's sensors; no colour is off by more than 4 codes.
const std::vector<Knot> kIron = {{0, {0, 0, 0}},        {32, {31, 0, 118}},    {66, {116, 1, 136}},
                                 {94, {181, 7, 141}},   {102, {194, 16, 127}}, {128, {223, 55, 59}},
                                 {129, {224, 57, 49}},  {159, {238, 109, 12}}, {193, {247, 171, 13}},
                                 {223, {255, 224, 30}}, {225, {255, 227, 39}}, {255, {255, 255, 249}}};
const std::vector<Knot> kRainbow = {
    {0, {1, 3, 74}},        {8, {0, 3, 82}},        {23, {0, 49, 133}},     {30, {0, 56, 145}},
    {49, {0, 90, 203}},     {64, {0, 113, 223}},    {70, {2, 124, 216}},    {75, {4, 133, 202}},
    {81, {10, 144, 166}},   {85, {13, 147, 149}},   {87, {17, 151, 132}},   {88, {22, 153, 120}},
    {90, {28, 156, 109}},   {96, {67, 171, 60}},    {103, {105, 185, 26}},  {116, {164, 204, 2}},
    {128, {212, 215, 3}},   {137, {232, 211, 6}},   {143, {237, 208, 8}},   {158, {252, 183, 17}},
    {163, {254, 165, 21}},  {169, {255, 155, 24}},  {192, {251, 33, 59}},   {198, {250, 27, 63}},
    {206, {247, 25, 79}},   {215, {248, 59, 96}},   {220, {250, 93, 108}},  {225, {251, 102, 113}},
    {242, {255, 191, 165}}, {248, {255, 216, 185}}, {251, {255, 222, 200}}, {255, {255, 233, 208}}};

cv::Mat colors_between(const std::vector<Knot>& knots) {
  cv::Mat colors(kColors, 1, CV_8UC3);
  std::size_t next = 1;
  for (int i = 0; i < kColors; ++i) {
    while (next + 1 < knots.size() && knots[next].place < i) ++next;
    const Knot &from = knots[next - 1], &to = knots[next];
    const double share = static_cast<double>(i - from.place) / (to.place - from.place);
    for (int k = 0; k < 3; ++k)  // to blue, green, red
      colors.at<cv::Vec3b>(i)[2 - k] = cv::saturate_cast<uchar>(from.rgb[k] + share * (to.rgb[k] - from.rgb[k]));
  }
  return colors;
}

cv::Mat colors_of(HeatPalette palette) {
  if (palette == HeatPalette::iron) return colors_between(kIron);
  if (palette == HeatPalette::rainbow) return colors_between(kRainbow);
  constexpr std::array kMaps{cv::COLORMAP_HOT,     cv::COLORMAP_JET,   cv::COLORMAP_TURBO,
                             cv::COLORMAP_INFERNO, cv::COLORMAP_MAGMA, cv::COLORMAP_PLASMA};
  ENSURE(palette >= HeatPalette::hot);
  cv::Mat places(kColors, 1, CV_8UC1), colors;
  for (int i = 0; i < kColors; ++i) places.at<uchar>(i) = static_cast<uchar>(i);
  cv::applyColorMap(places, colors,
                    kMaps.at(static_cast<std::size_t>(palette) - static_cast<std::size_t>(HeatPalette::hot)));
  return colors;
}

int squared_distance(const cv::Vec3b& a, const cv::Vec3b& b) {
  const int blue = a[0] - b[0], green = a[1] - b[1], red = a[2] - b[2];
  return blue * blue + green * green + red * red;
}

// Of the colours from..to the nearest.
int nearest_of(const cv::Mat& colors, int from, int to, const cv::Vec3b& bgr) {
  int best = from, least = std::numeric_limits<int>::max();
  for (int i = from; i <= to; ++i)
    if (const int distance = squared_distance(colors.at<cv::Vec3b>(i), bgr); distance < least)
      best = i, least = distance;
  return best;
}

}  // namespace

HeatColors::HeatColors(HeatPalette palette)
    : palette_(palette),
      colors_(colors_of(palette)),
      coarse_(static_cast<std::size_t>(kCells) * kCells * kCells, std::int16_t{-1}) {}

int HeatColors::nearest(const cv::Vec3b& bgr) const {
  const auto cell = [&](int k) { return static_cast<std::size_t>(bgr[k] / kCell_codes); };
  std::int16_t& near = coarse_[(cell(0) * kCells + cell(1)) * kCells + cell(2)];
  if (near < 0) {
    const auto middle = [&](int k) { return static_cast<uchar>(bgr[k] / kCell_codes * kCell_codes + kCell_codes / 2); };
    near = static_cast<std::int16_t>(nearest_of(colors_, 0, kColors - 1, {middle(0), middle(1), middle(2)}));
  }
  return nearest_of(colors_, std::max(near - kBeside, 0), std::min(near + kBeside, kColors - 1), bgr);
}

HeatColors::Heat HeatColors::heat_of(const Frame& frame) const {
  const cv::Mat bgr = bgr_of(frame);
  cv::Mat heat(bgr.size(), CV_8UC1);
  double off = 0;
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* const colors = bgr.ptr<cv::Vec3b>(y);
    auto* const places = heat.ptr<uchar>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const int place = nearest(colors[x]);
      places[x] = static_cast<uchar>(place);
      off += std::sqrt(static_cast<double>(squared_distance(colors_.at<cv::Vec3b>(place), colors[x])));
    }
  }
  Heat made{.frame = {.layout = PixelLayout::gray, .color = frame.color, .time_s = frame.time_s},
            .off_codes = off / static_cast<double>(bgr.total())};
  made.frame.planes[0] = heat;
  made.frame.color.range = ColorRange::full;
  made.frame.damaged = frame.damaged;
  made.frame.quantisers = frame.quantisers;
  return made;
}

void HeatColors::show(const cv::Mat& before, const cv::Mat& after, Frame& image) const {
  cv::Mat differs;
  cv::compare(before, after, differs, cv::CMP_NE);
  cv::Rect part = cv::boundingRect(differs);
  if (part.empty()) return;
  // Whole chroma samples, and what they are averaged over.
  constexpr int kAround_px = 4;
  part = cv::Rect(part.x / 2 * 2 - kAround_px, part.y / 2 * 2 - kAround_px, part.width + 2 * kAround_px + 1,
                  part.height + 2 * kAround_px + 1) &
         cv::Rect({0, 0}, image.size_px());
  const auto shown = [&](const cv::Mat& heat) {
    cv::Mat places, bgr;
    cv::cvtColor(heat(part), places, cv::COLOR_GRAY2BGR);
    cv::LUT(places, colors_.reshape(3, 1), bgr);
    return frame_of_bgr(bgr, image.layout, image.color, image.bit_depth);
  };
  const Frame from = shown(before), to = shown(after);
  const cv::Size step = chroma_step(image.layout);
  for (std::size_t i = 0; i < static_cast<std::size_t>(image.plane_count()); ++i) {
    const cv::Size each = i == 0 ? cv::Size(1, 1) : step;
    cv::Mat codes = image.planes[i](cv::Rect({part.x / each.width, part.y / each.height}, from.planes[i].size()));
    cv::Mat change;
    cv::subtract(to.planes[i], from.planes[i], change, cv::noArray(), CV_32S);
    cv::add(codes, change, change, cv::noArray(), CV_32S);
    const double highest = (1 << image.bit_depth) - 1;
    cv::min(change, highest, change);
    cv::max(change, 0, change);
    change.convertTo(codes, codes.type());
  }
}

std::optional<HeatColors> heat_colors(HeatPalette palette) {
  return palette == HeatPalette::gray ? std::nullopt : std::optional<HeatColors>(palette);
}

void PaletteSearch::add(const Frame& frame) {
  cv::Mat bgr = bgr_of(frame);
  const double scale = std::min(1.0, static_cast<double>(kLookedAt_px) / std::max(bgr.cols, bgr.rows));
  cv::resize(bgr, bgr, {}, scale, scale, cv::INTER_NEAREST);
  std::vector<cv::Mat> planes;
  cv::split(bgr, planes);
  const cv::Mat high = cv::max(cv::max(planes[0], planes[1]), planes[2]);
  const cv::Mat low = cv::min(cv::min(planes[0], planes[1]), planes[2]);
  color_codes_ += cv::mean(high)[0] - cv::mean(low)[0];
  small_.push_back(frame_of_bgr(bgr, PixelLayout::rgb, {}));
}

std::optional<PaletteSearch::Found> PaletteSearch::found() const {
  const auto count = static_cast<double>(small_.size());
  if (small_.empty() || color_codes_ < kMinColor_codes * count) return std::nullopt;
  std::optional<Found> best;
  for (std::size_t i = 1; i < kHeatPaletteNames.size(); ++i) {
    const HeatColors colors(static_cast<HeatPalette>(i));
    std::vector<uchar> places;
    double off = 0;
    for (const Frame& frame : small_) {
      const HeatColors::Heat heat = colors.heat_of(frame);
      off += heat.off_codes / count;
      places.insert(places.end(), heat.frame.planes[0].begin<uchar>(), heat.frame.planes[0].end<uchar>());
    }
    std::sort(places.begin(), places.end());
    const std::size_t twentieth = places.size() / 20;
    const int range = places[places.size() - 1 - twentieth] - places[twentieth];
    if (off < kMaxOffPalette_codes && range >= kMinRange && (!best || off < best->off_codes))
      best = Found{static_cast<HeatPalette>(i), off};
  }
  return best;
}

}  // namespace sigs
