// SPDX-License-Identifier: MIT
#include "appearance/target_look.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/statistics.h"

namespace sigs {

namespace {

constexpr double kRingFrom_px = 2.5, kRingTo_px = 9;  // beyond the overshoot; a 4x4 or 8x8 transform reaches so far
constexpr double kFarFrom_px = 14;                    // beyond what a macroblock of 16x16 reaches from most edges
constexpr int kMinLookPixels = 8;
constexpr std::size_t kMinFrames = 5;

// Mean absolute response of Immerkaer's operator as the standard deviation of white noise (J. Immerkaer, "Fast noise
// variance estimation", CVIU 64(2), 1996). Planes and straight edges along the axes give nothing.
std::optional<double> noise_over(const cv::Mat& plane, const cv::Mat& where) {
  if (cv::countNonZero(where) < kMinLookPixels) return std::nullopt;
  const cv::Matx33f kernel(1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::Mat response;
  cv::filter2D(plane, response, CV_32F, kernel);
  return std::sqrt(std::numbers::pi / 2) / 6 * cv::mean(cv::abs(response), where)[0];
}

std::optional<double> sd_over(const cv::Mat& plane, const cv::Mat& where) {
  if (cv::countNonZero(where) < kMinLookPixels) return std::nullopt;
  cv::Scalar mean, sd;
  cv::meanStdDev(plane, mean, sd, where);
  return sd[0];
}

std::optional<double> less(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(*a - *b) : std::nullopt;
}

cv::Mat high_pass(const cv::Mat& plane) {
  cv::Mat low;
  cv::GaussianBlur(plane, low, {}, 1.0);
  return plane - low;
}

double rms_over(const cv::Mat& plane, const cv::Mat& where) {
  return std::sqrt(cv::mean(plane.mul(plane), where)[0]);
}

// Values of a plane under a mask.
std::vector<float> values_over(const cv::Mat& plane, const cv::Mat& where) {
  std::vector<float> values;
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      if (where.at<uchar>(y, x) != 0) values.push_back(plane.at<float>(y, x));
  return values;
}

// Where the grain is measured: the silhouette without its outline, where enough is left.
cv::Mat interior_of(const cv::Mat& mask) {
  cv::Mat inner;
  cv::erode(mask, inner, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  return cv::countNonZero(inner) >= kMinLookPixels ? inner : mask;
}

void add_grain(TargetLook& look, const TargetSilhouette& target, const cv::Mat& far) {
  look.grain_inside = noise_over(target.difference, interior_of(target.mask));
  look.grain_excess = less(look.grain_inside, noise_over(target.difference, far));
  look.detail = rms_over(high_pass(target.difference), target.mask) / rms_over(target.difference, target.mask);
}

void add_contrast(TargetLook& look, const TargetSilhouette& target) {
  const double background = std::max(1.0, target.background);
  look.weber_mean = cv::mean(target.difference, target.mask)[0] / background;
  look.weber_rms = rms_over(target.difference, target.mask) / background;
  const std::vector<float> values = values_over(target.difference, target.mask);
  look.darkest_1 = quantile(values, 0.01);
  look.darkest_5 = quantile(values, 0.05);
  look.brightest_95 = quantile(values, 0.95);
  look.brightest_99 = quantile(values, 0.99);
}

cv::Mat length_of(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat length;
  cv::magnitude(a, b, length);
  return length;
}

void add_chroma(TargetLook& look, const TargetSilhouette& target) {
  if (target.cb.empty()) return;
  look.cb_difference = cv::mean(target.cb_difference, target.mask)[0];
  look.cr_difference = cv::mean(target.cr_difference, target.mask)[0];
  look.saturation = cv::mean(length_of(target.cb - 128, target.cr - 128), target.mask)[0];
  const cv::Mat strength = length_of(target.cb_difference, target.cr_difference);
  const double inside = cv::mean(strength, target.mask)[0];
  const cv::Mat beside = (target.distance_px >= 1) & (target.distance_px <= 4);
  if (inside > target.chroma_sd) look.chroma_spill = cv::mean(strength, beside)[0] / inside;
  const cv::Mat near = target.distance_px <= 2;
  look.chroma_detail = std::hypot(rms_over(high_pass(target.cb), near), rms_over(high_pass(target.cr), near));
}

// Mean absolute step between neighbours across the borders of 8x8 blocks, minus that within blocks.
std::optional<double> block_steps(const TargetSilhouette& target, const cv::Mat& where) {
  double sums[2] = {0, 0};
  int counts[2] = {0, 0};
  for (int y = 1; y < where.rows; ++y)
    for (int x = 1; x < where.cols; ++x) {
      if (where.at<uchar>(y, x) == 0) continue;
      const float here = target.difference.at<float>(y, x);
      const int column = (target.patch.x + x) % 8 == 0, row = (target.patch.y + y) % 8 == 0;
      sums[column] += std::abs(here - target.difference.at<float>(y, x - 1));
      sums[row] += std::abs(here - target.difference.at<float>(y - 1, x));
      ++counts[column];
      ++counts[row];
    }
  if (counts[0] < kMinLookPixels || counts[1] < kMinLookPixels) return std::nullopt;
  return sums[1] / counts[1] - sums[0] / counts[0];
}

void add_ringing(TargetLook& look, const TargetSilhouette& target, const cv::Mat& far) {
  const cv::Mat ring = (target.distance_px >= kRingFrom_px) & (target.distance_px <= kRingTo_px);
  look.ringing = less(noise_over(target.difference, ring), noise_over(target.difference, far));
  look.ringing_waves = less(sd_over(target.difference, ring), sd_over(target.difference, far));
  look.block_steps = less(block_steps(target, ring), block_steps(target, far));
}

cv::Point2d centroid_of(const TargetSilhouette& target) {
  cv::Mat weight = cv::Mat::zeros(target.mask.size(), CV_32FC1);
  cv::Mat(cv::abs(target.difference)).copyTo(weight, target.mask);
  const cv::Moments moments = cv::moments(weight);
  return cv::Point2d(moments.m10 / moments.m00, moments.m01 / moments.m00) + cv::Point2d(target.patch.tl());
}

// Root mean square deviation of a course from its best polynomial of second order, per degree of freedom.
double roughness(const std::vector<double>& course) {
  const int count = static_cast<int>(course.size());
  cv::Mat terms(count, 3, CV_64FC1), found;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < 3; ++j) terms.at<double>(i, j) = std::pow(2.0 * i / (count - 1) - 1, j);
  const cv::Mat values(count, 1, CV_64FC1, const_cast<double*>(course.data()));
  cv::solve(terms, values, found, cv::DECOMP_QR);
  return cv::norm(terms * found - values) / std::sqrt(count - 3.0);
}

}  // namespace

std::string_view name_of(LookGroup group) {
  static constexpr std::string_view kNames[] = {"edge",   "grain",       "contrast", "darkest and brightest",
                                                "colour", "chroma edge", "ringing",  "flicker"};
  return kNames[static_cast<std::size_t>(group)];
}

std::span<const LookMeasure> look_measures() {
  using enum LookGroup;
  using Look = TargetLook;
  static constexpr LookMeasure kMeasures[] = {
      {"edge_width_px", edge, "px", "10-90 % width of the outline's luma", &Look::edge_width_px},
      {"edge_slope", edge, "1/px", "steepest slope over the contrast", &Look::edge_slope},
      {"overshoot", edge, "", "halo beyond the outline, share of the contrast", &Look::overshoot},
      {"grain_inside", grain, "codes", "noise within the silhouette", &Look::grain_inside},
      {"grain_excess", grain, "codes", "... beyond that of the background", &Look::grain_excess},
      {"detail", grain, "", "high frequencies, share of the rms contrast", &Look::detail},
      {"weber_mean", contrast, "", "mean difference / background", &Look::weber_mean},
      {"weber_rms", contrast, "", "rms difference / background", &Look::weber_rms},
      {"darkest_1", range, "codes", "1st percentile of the difference", &Look::darkest_1},
      {"darkest_5", range, "codes", "5th percentile", &Look::darkest_5},
      {"brightest_95", range, "codes", "95th percentile", &Look::brightest_95},
      {"brightest_99", range, "codes", "99th percentile", &Look::brightest_99},
      {"cb_difference", color, "codes", "mean Cb minus the background's", &Look::cb_difference},
      {"cr_difference", color, "codes", "mean Cr minus the background's", &Look::cr_difference},
      {"saturation", color, "codes", "mean distance of Cb, Cr from gray", &Look::saturation},
      {"chroma_edge_width_px", chroma_edge, "px", "10-90 % width of the outline's chroma", &Look::chroma_edge_width_px},
      {"chroma_spill", chroma_edge, "", "chroma 1-4 px outside over that inside", &Look::chroma_spill},
      {"chroma_detail", chroma_edge, "codes", "high frequencies of chroma", &Look::chroma_detail},
      {"ringing", ringing, "codes", "noise around the outline beyond the background's", &Look::ringing},
      {"ringing_waves", ringing, "codes", "waves around the outline beyond the background's", &Look::ringing_waves},
      {"block_steps", ringing, "codes", "steps at 8x8 blocks' borders around the outline", &Look::block_steps},
      {"shake_px", flicker, "px", "centroid off a smooth path, rms", &Look::shake_px},
      {"brightness_flicker", flicker, "", "mean difference off a smooth course, rms", &Look::brightness_flicker},
      {"area_flicker", flicker, "", "area off a smooth course, rms", &Look::area_flicker},
  };
  return kMeasures;
}

TargetLook target_look(const TargetSilhouette& target) {
  TargetLook look{.box = target.box,
                  .centroid_px = centroid_of(target),
                  .area_px = static_cast<double>(cv::countNonZero(target.mask)),
                  .background = target.background,
                  .background_sd = target.background_sd,
                  .is_cut = target.is_cut};
  const cv::Mat far = target.distance_px >= kFarFrom_px;
  const EdgeProfiles profiles = edge_profiles(target);
  look.edge_width_px = profiles.width_px;
  look.edge_slope = profiles.slope;
  look.overshoot = profiles.overshoot;
  look.chroma_edge_width_px = profiles.chroma_width_px;
  add_grain(look, target, far);
  add_contrast(look, target);
  add_chroma(look, target);
  add_ringing(look, target, far);
  return look;
}

std::optional<TargetLook> target_look(const Frame& frame, const Box& box) {
  const auto target = target_silhouette(frame, box);
  return target ? std::optional(target_look(*target)) : std::nullopt;
}

void add_flicker(TargetLook& look, std::span<const TargetLook> successive) {
  if (successive.size() < kMinFrames) return;
  const auto roughness_of = [&](const std::function<double(const TargetLook&)>& value) {
    std::vector<double> course;
    for (const TargetLook& one : successive) course.push_back(value(one));
    return roughness(course);
  };
  const auto mean_of = [&](const std::function<double(const TargetLook&)>& value) {
    double sum = 0;
    for (const TargetLook& one : successive) sum += value(one);
    return sum / static_cast<double>(successive.size());
  };
  const auto brightness = [](const TargetLook& one) { return one.weber_mean.value_or(0); };
  const auto rms = [](const TargetLook& one) { return one.weber_rms.value_or(0); };
  const auto area = [](const TargetLook& one) { return one.area_px; };
  look.shake_px = std::hypot(roughness_of([](const TargetLook& one) { return one.centroid_px.x; }),
                             roughness_of([](const TargetLook& one) { return one.centroid_px.y; }));
  look.brightness_flicker = roughness_of(brightness) / std::max(1e-6, mean_of(rms));
  look.area_flicker = roughness_of(area) / std::max(1.0, mean_of(area));
}

}  // namespace sigs
