// SPDX-License-Identifier: MIT
#include "appearance/thermal_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "base/statistics.h"
#include "horizon/horizon.h"
#include "horizon/sky_map.h"

namespace sigs {

namespace {

constexpr double kMinShare = 0.08, kMaxShare = 0.9;  // of sky: beyond them sky or ground is not told from the other
constexpr double kBrightGround = 0.75;  // quantile of the ground: dark things and the camera's halo are left out

constexpr double kRounding_code2 = 1.0 / 12;  // variance

// 1.4826 times the median deviation from the median, as of a normal distribution, and what else is stated.
Estimate level_of(const std::vector<double>& codes, int frames, double otherwise, const char* what,
                  double variance = kRounding_code2) {
  if (codes.empty() || 2 * static_cast<int>(codes.size()) < frames)
    return {.value = otherwise, .why = std::string("most frames show no ") + what};
  const double middle = median(codes);
  std::vector<double> off;
  for (const double code : codes) off.push_back(std::abs(code - middle));
  return {.value = middle, .sd = std::hypot(1.4826 * median(off), std::sqrt(variance)), .is_known = true};
}

// In widths of the image, but for codes.
constexpr double kFar = 0.28, kBesideEdge = 0.025;  // what is looked at of the sky above a skyline: from here to there
constexpr double kMinSigma = 0.02, kMaxSigma = 0.2, kSigmaStep = 0.005;
constexpr double kWarm_codes = 40, kStillWarm_codes = 20;  // of ground above the sky
constexpr int kGroundRows = 20, kGroundFrom = 3, kGroundTo = 9;
constexpr double kBlack_code = 4, kWhite_code = 250;  // clipped
constexpr double kMaxOff_codes = 5, kMinDip_codes = 40;
constexpr std::size_t kMinHaloFrames = 3;

// The sky above the skyline of a frame.
struct SkyProfile {
  std::vector<double> codes;  // at 1, 2, ... px above it, medians over the columns; empty: there is no warm skyline
  double ground = 0;          // code just below it
};

SkyProfile sky_profile(const cv::Mat& luma, const cv::Mat& hidden) {
  const int far_px = static_cast<int>(kFar * luma.cols);
  std::vector<std::vector<double>> above(static_cast<std::size_t>(far_px));
  std::vector<double> grounds;
  const int columns = (luma.cols - 2) / 4;
  for (int i = 0; i < columns; ++i) {
    const cv::Mat three = luma.colRange(4 * i, 4 * i + 3);
    if (!hidden.empty() && cv::countNonZero(hidden.colRange(4 * i, 4 * i + 3)) > 0) continue;
    cv::Mat column;
    cv::reduce(three, column, 1, cv::REDUCE_AVG, CV_64F);
    const double* const codes = column.ptr<double>();
    const double sky = median(std::vector<double>(codes, codes + luma.rows / 4));
    int y = luma.rows / 4;
    while (y < luma.rows && codes[y] <= sky + kWarm_codes) ++y;
    if (y <= far_px || y + kGroundRows > luma.rows) continue;
    const auto warm =
        std::count_if(codes + y, codes + y + kGroundRows, [&](double code) { return code > sky + kStillWarm_codes; });
    if (5 * warm < 4 * kGroundRows) continue;
    for (int d = 1; d <= far_px; ++d) above[static_cast<std::size_t>(d - 1)].push_back(codes[y - d]);
    grounds.push_back(median(std::vector<double>(codes + y + kGroundFrom, codes + y + kGroundTo)));
  }
  if (5 * static_cast<int>(grounds.size()) < columns) return {};
  SkyProfile profile{.ground = median(grounds)};
  for (std::vector<double>& codes : above) profile.codes.push_back(median(std::move(codes)));
  return profile;
}

struct Halo {
  double sky = 0, dip = 0, sigma_px = 0, off_codes = 0;
};

// Of the course sky - dip Q(d / sigma) to what is not black.
std::optional<Halo> fitted_halo(const std::vector<double>& codes, double width_px) {
  std::optional<Halo> best;
  for (double share = kMinSigma; share <= kMaxSigma; share += kSigmaStep) {
    const double sigma_px = share * width_px;
    double n = 0, q = 0, qq = 0, c = 0, cq = 0, cc = 0;
    for (auto i = static_cast<std::size_t>(kBesideEdge * width_px); i < codes.size(); ++i) {
      if (codes[i] <= kBlack_code) continue;
      const double tail = 0.5 * std::erfc((static_cast<double>(i) + 1) / sigma_px * std::numbers::sqrt2 / 2);
      n += 1, q += tail, qq += tail * tail, c += codes[i], cq += codes[i] * tail, cc += codes[i] * codes[i];
    }
    const double determinant = n * qq - q * q;
    if (3 * n < static_cast<double>(codes.size()) || !(determinant > 1e-9)) continue;
    const double dip = (q * c - n * cq) / determinant, sky = (c + dip * q) / n;
    const double squares = cc - sky * c + dip * cq;  // of what is left over, by the normal equations
    const double off_codes = std::sqrt(std::max(squares, 0.0) / n);
    if (!best || off_codes < best->off_codes) best = Halo{sky, dip, sigma_px, off_codes};
  }
  if (!best || best->off_codes > kMaxOff_codes || best->dip < kMinDip_codes) return std::nullopt;
  const bool is_at_end = best->sigma_px < 1.01 * kMinSigma * width_px || best->sigma_px > 0.98 * kMaxSigma * width_px;
  return is_at_end ? std::nullopt : best;
}

Estimate halo_of(const std::vector<double>& found, int frames, double otherwise) {
  if (found.size() < kMinHaloFrames || 3 * static_cast<int>(found.size()) < frames)
    return {.value = otherwise, .why = "no warm skyline with the sky darker above it"};
  constexpr double kOfMethod = 0.1;  // a skyline is not level, nor the ground even
  Estimate estimate = level_of(found, 0, 0, "");
  estimate.sd = std::hypot(estimate.sd, kOfMethod * estimate.value);
  return estimate;
}

// Variance of what the sky has beyond the mean of 7 x 7 pixels, less that of rounding, square codes: the median over
// squares of that size, which passes over targets and the edges of clouds.
std::optional<double> sky_noise(const Frame& frame, const SkyMap& sky, double scale, const cv::Mat& own_body) {
  constexpr int kSide_px = 7, kApart_px = 4;
  constexpr std::size_t kMinSquares = 200;
  constexpr double kLeft = 1 - 1.0 / (kSide_px * kSide_px);
  cv::Mat luma, mean, squares;
  frame.planes[frame.layout == PixelLayout::rgb ? 1 : 0].convertTo(luma, CV_32F,
                                                                   1.0 / codes_per_8_bit_step(frame.bit_depth));
  cv::blur(luma, mean, {kSide_px, kSide_px});
  cv::blur((luma - mean).mul(luma - mean), squares, {kSide_px, kSide_px});
  std::vector<double> variances;
  for (int y = kSide_px; y < luma.rows - kSide_px; y += kApart_px)
    for (int x = kSide_px; x < luma.cols - kSide_px; x += kApart_px)
      if (sky.is_sky(x / scale, y / scale) && !is_own_body(own_body, x, y))
        variances.push_back(squares.at<float>(y, x));
  if (variances.size() < kMinSquares) return std::nullopt;
  return std::max(median(std::move(variances)) / kLeft - kRounding_code2, 0.0);
}

// A frame's display codes on a reduced grid, and which of them the own body hides.
struct DisplayCodes {
  ReducedLuma reduced;
  cv::Mat hidden;  // CV_8UC1, above 127; may be empty
};

DisplayCodes display_codes(const Frame& frame, const cv::Mat& own_body) {
  cv::Mat gray;
  cv::extractChannel(bgr_of(frame), gray, 1);
  DisplayCodes codes{.reduced = reduced_luma(gray), .hidden = {}};
  if (!own_body.empty()) cv::resize(own_body, codes.hidden, codes.reduced.luma.size(), 0, 0, cv::INTER_NEAREST);
  return codes;
}

SkyAndGround sky_and_ground_in(const DisplayCodes& codes, const SkyMap& map) {
  const cv::Mat& luma = codes.reduced.luma;
  std::vector<double> sky, ground, all;
  for (int y = 0; y < luma.rows; ++y)
    for (int x = 0; x < luma.cols; ++x) {
      if (!codes.hidden.empty() && codes.hidden.at<uchar>(y, x) > 127) continue;
      const double code = luma.at<uchar>(y, x);
      all.push_back(code);
      (map.is_sky(x, y) ? sky : ground).push_back(code);
    }
  SkyAndGround found;
  if (all.empty()) return found;
  found.all = median(all);
  if (map.share >= kMinShare && !sky.empty()) found.sky = median(sky);
  if (map.share <= kMaxShare && !ground.empty()) found.ground = quantile(ground, kBrightGround);
  return found;
}

}  // namespace

SkyAndGround sky_and_ground_of(const Frame& frame, const cv::Mat& own_body) {
  const DisplayCodes codes = display_codes(frame, own_body);
  return sky_and_ground_in(codes, sky_map_of(codes.reduced.luma, own_body));
}

void ThermalLevels::add(const Frame& frame, const cv::Mat& own_body) {
  if (frame.planes[0].empty()) return;
  const DisplayCodes codes = display_codes(frame, own_body);
  const SkyMap sky = sky_map_of(codes.reduced.luma, own_body);
  const SkyAndGround found = sky_and_ground_in(codes, sky);
  if (found.sky) skies_.push_back(*found.sky);
  if (found.ground) grounds_.push_back(*found.ground);
  ++frames_;
  if (found.sky)
    if (const std::optional<double> noise = sky_noise(frame, sky, codes.reduced.scale, own_body))
      noises_.push_back(std::sqrt(*noise));
  SkyProfile profile = sky_profile(codes.reduced.luma, codes.hidden);
  std::optional<Halo> halo = fitted_halo(profile.codes, codes.reduced.luma.cols);
  if (!halo) {  // what is warm may be dark
    profile = sky_profile(255 - codes.reduced.luma, codes.hidden);
    halo = fitted_halo(profile.codes, codes.reduced.luma.cols);
  }
  if (!halo) return;
  halos_px_.push_back(halo->sigma_px * codes.reduced.scale);
  const double step = profile.ground - (halo->sky - halo->dip / 2);
  if (profile.ground < kWhite_code && step > 0) halos_.push_back(halo->dip / step);
}

LevelsEstimate ThermalLevels::finish() const {
  return {.sky = level_of(skies_, frames_, ThermalSettings{}.sky, "sky"),
          .ground = level_of(grounds_, frames_, 0, "ground"),
          .halo = halo_of(halos_, frames_, ThermalSettings{}.halo),
          .halo_px = halo_of(halos_px_, frames_, ThermalSettings{}.halo_px),
          .noise = level_of(noises_, frames_, 0, "sky", 0)};
}

void even_out_noise(AppearanceSettings& appearance, const Estimate& noise_of_sky) {
  GrainSettings& grain = appearance.grain;
  const double dark = grain.sd_dark * grain.sd_dark, bright = grain.sd_bright * grain.sd_bright;
  const double at_sky = dark + std::clamp(appearance.thermal.sky / 255, 0.0, 1.0) * (bright - dark);
  const double sd = noise_of_sky.is_known ? noise_of_sky.value : std::sqrt(at_sky);
  grain.sd_dark = grain.sd_bright = std::round(1000 * sd) / 1000;
}

}  // namespace sigs
