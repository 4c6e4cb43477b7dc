// SPDX-License-Identifier: MIT
#include "horizon/cloud_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/image.h"
#include "base/statistics.h"
#include "horizon/horizon.h"
#include "video/color_space.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

constexpr int kCell_px = SkyMap::kCell_px;
constexpr int kMinCells = 60;        // of sky
constexpr double kSlack = 0.08;      // of saturation, beyond noise, by which clear sky may be less blue
constexpr double kMostSlack = 0.12;  // noise included
constexpr double kSlackOfColour = 0.03, kSlackOfGray = 0.01;
constexpr double kNoises = 3;                // medians of what clear sky is off, which no cloud is taken from
constexpr double kMostNoise = 0.06;          // of clear sky's blue, that counts as noise
constexpr double kWhiteOfCloud = 0.8;        // luminance of an opaque cloud where the sky shows no brighter one
constexpr double kLargestHole = 0.02;        // of the image, in the sky
constexpr double kAsBright = 0.9;            // of clear sky, what is its cloud and no thing before it
constexpr double kSkyBlue = 0.7;             // saturation of what is sky though it lies below sky's end
constexpr double kDarkestSky = 0.02;         // luminance of that
constexpr int kBesideSky = 3;                // cells to the sky above
constexpr double kMinRange = 0.05;           // between the luminances of clear sky and opaque cloud
constexpr double kOvercast = 0.38;           // saturation of the bluest sky: less is overcast ...
constexpr double kBlue = 0.5;                // ... and more is not
constexpr double kMinChroma = 0.012;         // of R'G'B', in a hundredth of the image: else the footage is gray
constexpr double kBrighterThanClear = 0.03;  // luminance, of a cloud that ends the sky by its edge
constexpr float kMinWeight = 0.01F;          // of clear or cloudy sky about a pixel
constexpr int kSmoothReach_px = 5;
constexpr double kSmooth_px = 1.5;  // of the reduced image, against noise

double luminance(const cv::Vec3f& light) {
  return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
}

void smooth(cv::Mat& image) {
  cv::GaussianBlur(image, image, {2 * kSmoothReach_px + 1, 2 * kSmoothReach_px + 1}, kSmooth_px);
}

double blueness(const cv::Vec3f& light) {
  return light[2] - light[0];
}

// Blue less red, of the luminance.
double saturation(const cv::Vec3f& light) {
  return blueness(light) / std::max(luminance(light), 1e-3);
}

// All planes at the size of the reduced luma, as codes of 8 bits or more.
cv::Mat_<cv::Vec3f> reduced_codes(const Frame& frame, const cv::Size& size, const cv::Vec3f& offset) {
  std::vector<cv::Mat> planes;
  for (int i = 0; i < 3; ++i) {
    if (i >= frame.plane_count()) {
      planes.emplace_back(size, CV_32F, cv::Scalar(offset[i]));
      continue;
    }
    cv::Mat codes, small;
    const cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    const bool shrinks = plane.cols >= size.width && plane.rows >= size.height;
    cv::resize(plane, small, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    small.convertTo(codes, CV_32F);
    planes.push_back(codes);
  }
  cv::Mat merged;
  cv::merge(planes, merged);
  return merged;
}

// Sky ends below a bright cloud, where blue sky begins: that is darker, as ground is. Parts that are blue and lie
// beside sky are sky too.
cv::Mat_<uchar> with_blue_sky(const cv::Mat_<uchar>& sky, const cv::Mat_<cv::Vec3f>& light) {
  cv::Mat_<uchar> blue(sky.size(), uchar{0});
  for (int y = 0; y < sky.rows; ++y)
    for (int x = 0; x < sky.cols; ++x) {
      const double bright = luminance(light(y, x));
      if (bright > kDarkestSky && blueness(light(y, x)) > kSkyBlue * bright && light(y, x)[2] > light(y, x)[1])
        blue(y, x) = 255;
    }
  cv::Mat labels, boxes, centres, near;
  const int count = cv::connectedComponentsWithStats(blue, labels, boxes, centres, 4);
  cv::dilate(sky != 0, near, cv::Mat::ones(2 * kBesideSky + 1, 2 * kBesideSky + 1, CV_8U));
  cv::Mat_<uchar> all = sky.clone();
  for (int label = 1; label < count; ++label) {
    if (boxes.at<int>(label, cv::CC_STAT_AREA) < kMinCells) continue;
    const cv::Mat part = labels == label;
    if (cv::countNonZero(part & near) > 0) all.setTo(255, part);
  }
  return all;
}

}  // namespace

struct CloudMap::Cells {
  cv::Mat_<cv::Vec3f> light;
  cv::Mat_<uchar> sky;
};

CloudMap::CloudMap(const Frame& frame, const cv::Mat& own_body)
    : map_(code_to_rgb(frame.layout, frame.color, frame.bit_depth)),
      color_(frame.color),
      to_bt709_(cv::Matx33f(from_bt709(frame.color.primaries).value_or(cv::Matx33d::eye()).inv())) {
  const ReducedLuma reduced = reduced_luma(luma_of(frame));
  codes_ = reduced_codes(frame, reduced.luma.size(), map_.offset);
  reduction_ = {static_cast<double>(frame.size_px().width) / codes_.cols,
                static_cast<double>(frame.size_px().height) / codes_.rows};
  const SkyMap sky = sky_map_of(reduced.luma, own_body);
  if (sky.empty() || cv::countNonZero(sky.sky == 255) < kMinCells) return;
  Cells cells{.light = {}, .sky = sky.sky};
  cv::Mat means;
  cv::resize(codes_(cv::Rect(0, 0, sky.sky.cols * kCell_px, sky.sky.rows * kCell_px)), means, sky.sky.size(), 0, 0,
             cv::INTER_AREA);
  cells.light = means;
  for (cv::Vec3f& cell : cells.light) cell = linear(cell);
  std::vector<double> chroma;
  for (const cv::Vec3f& cell : cells.light) chroma.push_back(std::abs(blueness(cell)));
  has_colour_ = quantile(std::move(chroma), 0.99) > kMinChroma;
  has_sky_ = true;
  if (has_colour_) cells.sky = with_blue_sky(cells.sky, cells.light);
  find_clear_sky(cells);
  sky_ = cells.sky.clone();
  add_bright_clouds(cells);
  fill_holes(cells);
  const cv::Mat whole = sky_ != 0;
  cv::erode(whole, inner_, cv::Mat::ones(3, 3, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  inner_ &= sky_ == 255;
}

cv::Vec3f CloudMap::linear(const cv::Vec3f& codes) const {
  const TransferCurve curve = transfer_curve_of(color_);
  cv::Vec3f rgb = map_.to_rgb * (codes - map_.offset);
  for (int c = 0; c < 3; ++c) rgb[c] = curve.linear_of_display(rgb[c]);
  return to_bt709_ * rgb;
}

SkyTerms CloudMap::terms_at(double x_px, double y_px) const {
  const double u = 2 * x_px / codes_.cols - 1;
  const double v = 2 * std::clamp(y_px, rows_px_[0], rows_px_[1]) / codes_.rows - 1;
  return sky_terms(u, v);
}

cv::Vec3f CloudMap::clear_light(const SkyTerms& terms) const {
  cv::Vec3f light;
  for (int c = 0; c < 3; ++c) light[c] = static_cast<float>(value_of(clear_.light[static_cast<std::size_t>(c)], terms));
  return light;
}

// The first row in which clear sky is seen: it is bluer upwards, and rows above that are less blue are full of clouds.
int CloudMap::first_clear_row(const Cells& cells) const {
  constexpr double kAsBlue = 0.6;  // of the bluest row
  constexpr std::size_t kFew = 5;
  std::vector<double> bluest(static_cast<std::size_t>(cells.sky.rows), -1);
  for (int y = 0; y < cells.sky.rows; ++y) {
    std::vector<double> saturations;
    for (int x = 0; x < cells.sky.cols; ++x)
      if (cells.sky(y, x) == 255) saturations.push_back(saturation(cells.light(y, x)));
    if (saturations.size() >= kFew) bluest[static_cast<std::size_t>(y)] = quantile(std::move(saturations), 0.95);
  }
  auto row = std::max_element(bluest.begin(), bluest.end());
  const double least = kAsBlue * *row;
  while (row != bluest.begin() && (*(row - 1) >= least || *(row - 1) < 0)) --row;
  return static_cast<int>(row - bluest.begin());
}

void CloudMap::find_clear_sky(const Cells& cells) {
  rows_px_ = {0, static_cast<double>(codes_.rows)};
  std::vector<SkyPlace> samples;
  std::vector<double> luminances;
  double first_px = codes_.rows, last_px = 0;
  const int first_row = has_colour_ ? first_clear_row(cells) : 0;
  for (int y = 0; y < cells.sky.rows; ++y)
    for (int x = 0; x < cells.sky.cols; ++x) {
      if (cells.sky(y, x) != 255) continue;
      const double y_px = (y + 0.5) * kCell_px;
      const cv::Vec3f& light = cells.light(y, x);
      luminances.push_back(luminance(light));
      if (y < first_row) continue;
      // In gray footage the darkest sky is the clear one.
      const double clarity = has_colour_ ? saturation(light) : -luminance(light);
      samples.push_back({terms_at((x + 0.5) * kCell_px, y_px), light, clarity});
      first_px = std::min(first_px, y_px);
      last_px = std::max(last_px, y_px);
    }
  rows_px_ = {first_px, last_px};
  brightest_ = std::max(quantile(std::move(luminances), 0.99), kWhiteOfCloud);
  clear_.saturation = bluest(samples);
  std::vector<double> above, bluest_of;
  for (const SkyPlace& sample : samples) {
    const double expected = value_of(clear_.saturation, sample.terms);
    bluest_of.push_back(expected);
    if (sample.saturation > expected) above.push_back(sample.saturation - expected);
  }
  const double noise = above.empty() ? 0 : 1.5 * median(std::move(above));
  const double slack = has_colour_ ? kSlackOfColour : kSlackOfGray;
  std::erase_if(samples, [&](const SkyPlace& sample) {
    const double expected = value_of(clear_.saturation, sample.terms);
    const double allowed = 3 * noise + slack + kSlack * std::abs(expected);
    return sample.saturation <= expected - std::min(allowed, kMostSlack * std::abs(expected));
  });
  for (int c = 0; c < 3; ++c)
    clear_.light[static_cast<std::size_t>(c)] = fitted(
        samples, [c](const SkyPlace& sample) { return sample.light[c]; }, [](const SkyPlace&) { return 1.0; });
  // By night lamps colour the sky, and nothing of it is blue.
  constexpr double kNight = 0.01;  // of white
  std::vector<double> brightness;
  for (const SkyPlace& sample : samples) brightness.push_back(luminance(sample.light));
  if (has_colour_ && !brightness.empty() && median(std::move(brightness)) >= kNight)
    overcast_ = std::clamp((kBlue - quantile(std::move(bluest_of), 0.9)) / (kBlue - kOvercast), 0.0, 1.0);
  measure_noise(samples);
}

// By how much clear sky is off what was fitted to it.
void CloudMap::measure_noise(const std::vector<SkyPlace>& clear_samples) {
  if (clear_samples.empty()) return;
  std::vector<double> bright_off, blue_off, blue;
  for (const SkyPlace& sample : clear_samples) {
    const cv::Vec3f clear = clear_light(sample.terms);
    bright_off.push_back(std::abs(luminance(sample.light) - luminance(clear)));
    blue.push_back(blueness(clear));
    blue_off.push_back(std::abs(blueness(sample.light) - blueness(clear)));
  }
  bright_noise_ = kNoises * median(std::move(bright_off));
  blue_noise_ = std::min(kNoises * median(std::move(blue_off)), kMostNoise * median(std::move(blue)));
}

// Sky ends at the edge of a bright cloud. What lies beside it, brighter and less blue than clear sky, is cloud.
void CloudMap::add_bright_clouds(const Cells& cells) {
  std::vector<cv::Point> open;
  for (int y = 0; y < sky_.rows; ++y)
    for (int x = 0; x < sky_.cols; ++x)
      if (sky_(y, x) == 255) open.emplace_back(x, y);
  while (!open.empty()) {
    const cv::Point from = open.back();
    open.pop_back();
    for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point to = from + step;
      if (!cv::Rect({0, 0}, sky_.size()).contains(to) || sky_(to) != 0) continue;
      const SkyTerms terms = terms_at((to.x + 0.5) * kCell_px, (to.y + 0.5) * kCell_px);
      const cv::Vec3f clear = clear_light(terms);
      const cv::Vec3f& light = cells.light(to);
      const double bright = luminance(light);
      if (bright < luminance(clear) + kBrighterThanClear) continue;
      if (has_colour_ && saturation(light) > value_of(clear_.saturation, terms)) continue;
      sky_(to) = 255;
      open.push_back(to);
    }
  }
}

// Small holes in the sky are edges of clouds where they are as bright as clear sky, else things before it.
void CloudMap::fill_holes(const Cells& cells) {
  const cv::Mat holes = sky_ == 0;
  cv::Mat labels, boxes, centres;
  const int count = cv::connectedComponentsWithStats(holes, labels, boxes, centres, 4);
  const auto box = [&](int label, int which) { return boxes.at<int>(label, which); };
  for (int label = 1; label < count; ++label) {
    const bool is_at_border = box(label, cv::CC_STAT_LEFT) == 0 || box(label, cv::CC_STAT_TOP) == 0 ||
                              box(label, cv::CC_STAT_LEFT) + box(label, cv::CC_STAT_WIDTH) == sky_.cols ||
                              box(label, cv::CC_STAT_TOP) + box(label, cv::CC_STAT_HEIGHT) == sky_.rows;
    if (is_at_border || box(label, cv::CC_STAT_AREA) > kLargestHole * static_cast<double>(sky_.total())) continue;
    for (int y = box(label, cv::CC_STAT_TOP); y < box(label, cv::CC_STAT_TOP) + box(label, cv::CC_STAT_HEIGHT); ++y)
      for (int x = box(label, cv::CC_STAT_LEFT); x < box(label, cv::CC_STAT_LEFT) + box(label, cv::CC_STAT_WIDTH);
           ++x) {
        if (labels.at<int>(y, x) != label) continue;
        const cv::Vec3f clear = clear_light(terms_at((x + 0.5) * kCell_px, (y + 0.5) * kCell_px));
        sky_(y, x) = luminance(cells.light(y, x)) > kAsBright * luminance(clear) ? 255 : 128;
      }
  }
}

double CloudMap::opacity_of(const cv::Vec3f& light, const cv::Vec3f& clear) const {
  const double base = luminance(clear) + bright_noise_;
  double opacity = (luminance(light) - base) / std::max(brightest_ - base, kMinRange);
  const double blue = std::max<double>(blueness(clear), blue_noise_) - blue_noise_;
  if (has_colour_ && blue > 0) opacity = std::max(opacity, 1 - blueness(light) / blue);
  opacity = std::clamp(opacity, 0.0, 1.0);
  return opacity + (1 - opacity) * overcast_;
}

cv::Point2d CloudMap::in_reduced(double x_px, double y_px) const {
  return {(x_px + 0.5) / reduction_.width - 0.5, (y_px + 0.5) / reduction_.height - 0.5};
}

cv::Point CloudMap::cell_of(const cv::Point& pixel) const {
  return {std::min(pixel.x / kCell_px, sky_.cols - 1), std::min(pixel.y / kCell_px, sky_.rows - 1)};
}

CloudPart CloudMap::window_of(const cv::Rect& around) const {
  const auto pixel_of = [&](int x, int y) {
    return cv::Point(std::clamp(around.x + x, 0, codes_.cols - 1), std::clamp(around.y + y, 0, codes_.rows - 1));
  };
  CloudPart window{.opacity = cv::Mat_<float>(around.size(), 0.0F), .brightness = cv::Mat_<cv::Vec3f>(around.size())};
  cv::Mat_<float> weight(around.size(), 0.0F);
  for (int y = 0; y < around.height; ++y)
    for (int x = 0; x < around.width; ++x) window.brightness(y, x) = linear(codes_(pixel_of(x, y)));
  smooth(window.brightness);
  for (int y = 0; y < around.height; ++y)
    for (int x = 0; x < around.width; ++x) {
      cv::Vec3f& light = window.brightness(y, x);
      if (inner_(cell_of(pixel_of(x, y))) == 0) {
        light = {0, 0, 0};
        continue;
      }
      const cv::Vec3f clear = clear_light(terms_at(around.x + x + 0.5, around.y + y + 0.5));
      window.opacity(y, x) = static_cast<float>(opacity_of(light, clear));
      light -= clear;
      weight(y, x) = 1;
    }
  // At the sky's border, and where something is in it, the clouds beside count.
  smooth(window.opacity);
  smooth(window.brightness);
  smooth(weight);
  for (int y = 0; y < around.height; ++y)
    for (int x = 0; x < around.width; ++x) {
      const bool is_sky = sky_(cell_of(pixel_of(x, y))) != 0 && weight(y, x) > kMinWeight;
      const float share = is_sky ? 1 / weight(y, x) : 0;
      window.opacity(y, x) *= share;
      window.brightness(y, x) *= share;
    }
  return window;
}

double CloudMap::cover(double least_opacity) const {
  if (!has_sky_) return 0;
  int sky = 0, cloudy = 0;
  for (int y = 0; y < inner_.rows; ++y)
    for (int x = 0; x < inner_.cols; ++x) {
      if (inner_(y, x) == 0) continue;
      const cv::Point middle(x * kCell_px + kCell_px / 2, y * kCell_px + kCell_px / 2);
      const cv::Vec3f clear = clear_light(terms_at(middle.x, middle.y));
      ++sky;
      cloudy += opacity_of(linear(codes_(middle)), clear) >= least_opacity ? 1 : 0;
    }
  return sky > 0 ? double(cloudy) / sky : 0;
}

CloudPart CloudMap::part(const cv::Rect& rect) const {
  CloudPart part{.opacity = cv::Mat_<float>(rect.size(), 0.0F),
                 .brightness = cv::Mat_<cv::Vec3f>(rect.size(), cv::Vec3f(0, 0, 0))};
  if (!has_sky_ || rect.empty()) return part;
  const cv::Point2d low = in_reduced(rect.x, rect.y), high = in_reduced(rect.br().x, rect.br().y);
  const cv::Rect seen({cvFloor(low.x), cvFloor(low.y)}, cv::Point(cvCeil(high.x) + 1, cvCeil(high.y) + 1));
  const cv::Rect around = grown(seen, 2 * kSmoothReach_px);
  const CloudPart window = window_of(around);
  cv::Mat_<cv::Vec2f> places(rect.size());
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x) {
      const cv::Point2d at = in_reduced(rect.x + x, rect.y + y);
      places(y, x) = {static_cast<float>(at.x - around.x), static_cast<float>(at.y - around.y)};
    }
  cv::remap(window.opacity, part.opacity, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(window.brightness, part.brightness, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return part;
}

}  // namespace sigs
