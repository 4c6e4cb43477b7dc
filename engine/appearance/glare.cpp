// SPDX-License-Identifier: MIT
#include "appearance/glare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "base/statistics.h"
#include "project/look_settings.h"
#include "video/color_space.h"

namespace sigs {

namespace {

constexpr double kDark_code = 25;      // half of a dark frame is below it
constexpr int kRings = 40;             // of a point's surroundings
constexpr int kPoint_px = 8;           // beyond it nothing else may be bright
constexpr double kBright = 0.05;       // linear light of a point's brightest pixel, at least
constexpr double kOther = 0.15;        // of it, what another point in the surroundings may have
constexpr double kMostPoint_px2 = 80;  // of a point above half of its light
constexpr int kClipped_code = 250;
constexpr std::size_t kPointsOfFrame = 20, kMinPoints = 4;
constexpr double kOwnError = 0.05;    // of a ring's light: points are no exact Gaussians
constexpr double kCode_light = 3e-4;  // one code of 8 bits in the dark
constexpr std::array<double, 16> kShares{0.003, 0.005, 0.008, 0.012, 0.018, 0.025, 0.035, 0.05,
                                         0.07,  0.1,   0.14,  0.19,  0.25,  0.33,  0.43,  0.55};
constexpr double kMinLikelihood = 12;  // by how much a sum of squares must fall for a glare to be there

bool is_dark(const Frame& frame) {
  const cv::Mat& luma = frame.planes[0];
  const bool is_limited = frame.layout != PixelLayout::rgb && frame.color.range == ColorRange::limited;
  const double limit = is_limited ? 16 + kDark_code * 219 / 255 : kDark_code;
  std::int64_t dark = 0, all = 0;
  for (int y = 0; y < luma.rows; y += 4)
    for (int x = 0; x < luma.cols; x += 4, ++all) dark += luma.at<uchar>(y, x) < limit ? 1 : 0;
  return 2 * dark > all;
}

struct NightImage {
  cv::Mat light;    // CV_32FC1, luminance of linear light
  cv::Mat clipped;  // CV_8UC1, 255 where a channel is, or where the own body hides all
};

NightImage night_image(const Frame& frame, const cv::Mat& own_body) {
  const cv::Mat bgr = bgr_of(frame);
  const TransferFunction function = transfer_function_of(frame.color.transfer).value_or(TransferFunction::srgb);
  std::array<float, 256> linear{};
  for (std::size_t code = 0; code < linear.size(); ++code)
    linear[code] = static_cast<float>(linear_of_display(function, static_cast<double>(code) / 255));
  NightImage image{.light = cv::Mat(bgr.size(), CV_32FC1), .clipped = cv::Mat(bgr.size(), CV_8UC1)};
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec3b& code = bgr.at<cv::Vec3b>(y, x);
      image.light.at<float>(y, x) = 0.0722F * linear[code[0]] + 0.7152F * linear[code[1]] + 0.2126F * linear[code[2]];
      const bool is_hidden = !own_body.empty() && own_body.at<uchar>(y, x) > 127;
      image.clipped.at<uchar>(y, x) = is_hidden || std::max({code[0], code[1], code[2]}) >= kClipped_code ? 255 : 0;
    }
  return image;
}

// Brightest pixels of their surroundings, from the brightest on, as far apart as they reach and from the border.
std::vector<cv::Point> bright_points(const cv::Mat& light) {
  cv::Mat highest;
  cv::dilate(light, highest, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  std::vector<cv::Point> found;
  for (int y = kRings; y < light.rows - kRings; ++y)
    for (int x = kRings; x < light.cols - kRings; ++x)
      if (light.at<float>(y, x) >= kBright && light.at<float>(y, x) == highest.at<float>(y, x))
        found.emplace_back(x, y);
  std::ranges::stable_sort(found, [&](cv::Point a, cv::Point b) { return light.at<float>(a) > light.at<float>(b); });
  std::vector<cv::Point> apart;
  for (const cv::Point& point : found)
    if (std::ranges::none_of(apart, [&](cv::Point one) { return cv::norm(one - point) < kPoint_px; }))
      apart.push_back(point);
  return apart;
}

// The middle of a point that stands alone and is small; none of another.
std::optional<cv::Point2d> middle_of(const cv::Mat& light, cv::Point brightest) {
  const double half = light.at<float>(brightest) / 2;
  double sum = 0, across = 0, down = 0, core_px2 = 0;
  for (int dy = -kRings; dy <= kRings; ++dy)
    for (int dx = -kRings; dx <= kRings; ++dx) {
      const double there = light.at<float>(brightest.y + dy, brightest.x + dx);
      if (dx * dx + dy * dy > kPoint_px * kPoint_px) {
        if (there > 2 * kOther * half) return std::nullopt;
        continue;
      }
      if (there < half) continue;
      sum += there, across += there * dx, down += there * dy, ++core_px2;
    }
  if (core_px2 > kMostPoint_px2) return std::nullopt;
  return cv::Point2d(brightest.x + across / sum, brightest.y + down / sum);
}

// Share of a Gaussian of unit sum in each pixel of a ring around it, in the mean.
std::vector<double> rings_of(double sigma_px) {
  const double variance = sigma_px * sigma_px + 1.0 / 12;  // and that of a pixel
  std::vector<double> rings;
  for (int r = 0; r < kRings; ++r) {
    const double low = std::exp(-r * r / (2 * variance)), high = std::exp(-(r + 1.0) * (r + 1.0) / (2 * variance));
    rings.push_back((low - high) / (std::numbers::pi * (2 * r + 1)));
  }
  return rings;
}

// Least sum of squares of one point's rings by its light and its background, for the shape of a light of 1.
double off_by(const std::vector<double>& light, const std::vector<double>& weight, const std::vector<double>& shape) {
  double n = 0, x = 0, xx = 0, y = 0, xy = 0, yy = 0;
  for (std::size_t r = 0; r < light.size(); ++r) {
    const double w = weight[r];
    n += w, x += w * shape[r], xx += w * shape[r] * shape[r];
    y += w * light[r], xy += w * shape[r] * light[r], yy += w * light[r] * light[r];
  }
  const double determinant = n * xx - x * x;
  if (!(determinant > 1e-12 * n * xx)) return yy - (n > 0 ? y * y / n : 0);
  const double slope = std::max((n * xy - x * y) / determinant, 0.0);
  const double level = (y - slope * x) / n;
  return std::max(yy - 2 * slope * xy - 2 * level * y + slope * slope * xx + 2 * slope * level * x + level * level * n,
                  0.0);
}

// from, from * step, ... to
std::vector<double> geometric(double from, double to, double step) {
  std::vector<double> values;
  for (double value = from; value <= to * (1 + 1e-9); value *= step) values.push_back(value);
  return values;
}

}  // namespace

struct Glare::Fit {
  double share = 0, sigma_px = 0, core_px = 0;
  double off = 0, off_without = 0;  // sums of squares with it and without any glare
  bool tells_share = false;         // other shares fit worse
};

void Glare::add(const Frame& frame, const cv::Mat& own_body) {
  if (frame.planes[0].empty() || !is_dark(frame)) return;
  ++dark_frames_;
  const NightImage image = night_image(frame, own_body);
  std::size_t of_frame = 0;
  for (const cv::Point& brightest : bright_points(image.light)) {
    const std::optional<cv::Point2d> middle = middle_of(image.light, brightest);
    if (!middle) continue;
    std::vector<std::vector<double>> rings(kRings);
    std::vector<char> is_clipped(kRings, 0);
    for (int y = brightest.y - kRings; y <= brightest.y + kRings; ++y)
      for (int x = brightest.x - kRings; x <= brightest.x + kRings; ++x) {
        const auto r = static_cast<std::size_t>(std::hypot(x - middle->x, y - middle->y));
        if (r >= rings.size()) continue;
        rings[r].push_back(image.light.at<float>(y, x));
        if (image.clipped.at<uchar>(y, x) != 0) is_clipped[r] = 1;
      }
    Point point;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const double light = rings[r].empty() ? 0 : mean(rings[r]);
      const double samples = static_cast<double>(rings[r].size());
      const double variance = kCode_light * kCode_light / std::max(samples, 1.0) + std::pow(kOwnError * light, 2);
      point.light.push_back(light);
      point.weight.push_back(rings[r].empty() || is_clipped[r] != 0 ? 0 : 1 / variance);
    }
    points_.push_back(std::move(point));
    if (++of_frame == kPointsOfFrame) break;
  }
}

Glare::Fit Glare::fitted(const std::vector<const Point*>& points) {
  Fit best;
  best.off = best.off_without = std::numeric_limits<double>::infinity();
  const auto off_of = [&](const std::vector<double>& shape) {
    double off = 0;
    for (const Point* point : points) off += off_by(point->light, point->weight, shape);
    return off;
  };
  std::vector<double> at_share(kShares.size(), best.off);
  for (const double core_px : geometric(0.4, 2.6, 1.17)) {
    const std::vector<double> core = rings_of(core_px);
    best.off_without = std::min(best.off_without, off_of(core));
    for (const double sigma_px : geometric(std::max(2.5 * core_px, 2.0), 20, 1.12)) {
      const std::vector<double> wide = rings_of(sigma_px);
      for (std::size_t k = 0; k < kShares.size(); ++k) {
        std::vector<double> shape;
        for (std::size_t r = 0; r < core.size(); ++r) shape.push_back(std::lerp(core[r], wide[r], kShares[k]));
        const double off = off_of(shape);
        at_share[k] = std::min(at_share[k], off);
        if (off < best.off)
          best = {.share = kShares[k],
                  .sigma_px = sigma_px,
                  .core_px = core_px,
                  .off = off,
                  .off_without = best.off_without};
      }
    }
  }
  best.tells_share = at_share.front() > best.off + kMinLikelihood && at_share.back() > best.off + kMinLikelihood;
  return best;
}

GlareFound Glare::finish() const {
  const AppearanceSettings usual;
  GlareFound found{.share = {.value = usual.glare}, .sigma_px = {.value = usual.glare_px}};
  const auto unknown = [&](const std::string& why) {
    found.share.why = found.sigma_px.why = why;
    return found;
  };
  if (dark_frames_ == 0) return unknown("no frame is dark");
  if (points_.size() < kMinPoints) return unknown("no bright points that stand alone");
  std::vector<const Point*> all, halves[2];
  for (std::size_t i = 0; i < points_.size(); ++i) {
    all.push_back(&points_[i]);
    halves[i % 2].push_back(&points_[i]);
  }
  const Fit fit = fitted(all);
  if (fit.off_without < fit.off + kMinLikelihood) return unknown("bright points have no glare that can be told");
  const Fit one = fitted(halves[0]), other = fitted(halves[1]);
  constexpr double kOfGrid = 0.05;
  const auto estimate = [&](double value, double a, double b) {
    return Estimate{.value = value, .sd = std::hypot((a - b) / 2, kOfGrid * value), .is_known = true};
  };
  found.sigma_px = estimate(fit.sigma_px, one.sigma_px, other.sigma_px);
  if (fit.tells_share)
    found.share = estimate(fit.share, one.share, other.share);
  else
    found.share.why = "bright points are clipped but for their glare";
  return found;
}

}  // namespace sigs
