// SPDX-License-Identifier: MIT
#include "appearance/edge_profiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sigs {

namespace {

constexpr double kProfileReach_px = 6;
constexpr int kStepsPerPixel = 4;
constexpr int kSteps = static_cast<int>(2 * kProfileReach_px) * kStepsPerPixel + 1;
constexpr int kMiddle = kSteps / 2;
constexpr double kLeastContrast = 12;  // code values
constexpr double kLeastContrast_sd = 6;
constexpr double kLeastChromaContrast = 4;
constexpr std::size_t kLeastProfiles = 6;
constexpr std::size_t kMostProfiles = 400;  // more do not change a median
constexpr double kFall = 0.9;               // of an extremum: below it, the extremum has been passed

using Profile = std::array<float, kSteps>;  // from the inside to the outside

// A line across the outline.
struct Normal {
  cv::Point2f at;       // on the outline, in the patch
  cv::Point2f outward;  // unit vector
};

std::vector<Normal> normals_of(const cv::Mat& mask) {
  cv::Mat inner, soft, across_x, across_y;
  cv::erode(mask, inner, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  mask.convertTo(soft, CV_32F);
  cv::GaussianBlur(soft, soft, {}, 1.5);
  cv::Sobel(soft, across_x, CV_32F, 1, 0);
  cv::Sobel(soft, across_y, CV_32F, 0, 1);
  std::vector<cv::Point> outline;
  cv::findNonZero(mask - inner, outline);
  const std::size_t every = outline.size() / kMostProfiles + 1;
  std::vector<Normal> normals;
  for (std::size_t i = 0; i < outline.size(); i += every) {
    const cv::Point2f inward(across_x.at<float>(outline[i]), across_y.at<float>(outline[i]));
    const auto length = static_cast<float>(cv::norm(inward));
    if (length > 1) normals.push_back({outline[i], -inward / length});
  }
  return normals;
}

// One row for each normal.
cv::Mat read_along(const cv::Mat& plane, const std::vector<Normal>& normals) {
  cv::Mat at(static_cast<int>(normals.size()), kSteps, CV_32FC2), values;
  for (int i = 0; i < at.rows; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Normal& normal = normals[static_cast<std::size_t>(i)];
      const cv::Point2f point = normal.at + normal.outward * (static_cast<float>(j - kMiddle) / kStepsPerPixel);
      at.at<cv::Vec2f>(i, j) = {point.x, point.y};
    }
  cv::remap(plane, values, at, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return values;
}

// Where, in steps, a falling stretch from `from` on passes a level; none where it does not.
std::optional<double> crossing(const Profile& profile, int from, float level) {
  for (int j = from; j + 1 < kSteps; ++j) {
    const float here = profile[static_cast<std::size_t>(j)], next = profile[static_cast<std::size_t>(j) + 1];
    if (here >= level && next < level) return j + static_cast<double>((here - level) / (here - next));
  }
  return std::nullopt;
}

struct Edge {
  double width_px = 0;
  double slope = 0;
  double middle = 0;  // step at which half the contrast is passed
  float contrast = 0;
};

// The falling edge of a profile that is positive inside.
std::optional<Edge> falling_edge(const Profile& profile, double least_contrast) {
  int top = std::min(kMiddle + 2 * kStepsPerPixel, kSteps - 1);  // inwards over the first extremum
  for (int j = top; j >= 0; --j) {
    if (profile[static_cast<std::size_t>(j)] > profile[static_cast<std::size_t>(top)]) top = j;
    if (j < kMiddle && profile[static_cast<std::size_t>(j)] < kFall * profile[static_cast<std::size_t>(top)]) break;
  }
  const float contrast = profile[static_cast<std::size_t>(top)];
  if (contrast < least_contrast) return std::nullopt;
  const auto upper = crossing(profile, top, 0.9F * contrast), half = crossing(profile, top, 0.5F * contrast),
             lower = crossing(profile, top, 0.1F * contrast);
  if (!upper || !half || !lower) return std::nullopt;
  for (int j = kSteps - kStepsPerPixel; j < kSteps; ++j)  // it comes to rest outside
    if (std::abs(profile[static_cast<std::size_t>(j)]) > 0.35F * contrast) return std::nullopt;
  float steepest = 0;
  for (int j = top; j + 1 < kSteps && j <= *lower + 1; ++j)
    steepest = std::max(steepest, profile[static_cast<std::size_t>(j)] - profile[static_cast<std::size_t>(j) + 1]);
  return Edge{.width_px = (*lower - *upper) / kStepsPerPixel,
              .slope = kStepsPerPixel * steepest / contrast,
              .middle = *half,
              .contrast = contrast};
}

Profile profile_at(const cv::Mat& values, int row) {
  Profile profile;
  std::copy_n(values.ptr<float>(row), kSteps, profile.begin());
  return profile;
}

// The profile, positive where the target is.
Profile upright(Profile profile) {
  float inside = 0;
  for (int j = kMiddle - 2 * kStepsPerPixel; j <= kMiddle; ++j) inside += profile[static_cast<std::size_t>(j)];
  if (inside < 0)
    for (float& value : profile) value = -value;
  return profile;
}

double quantile_of_profile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Mean of the profiles over their contrasts, shifted so that their edges coincide; negated lowest value outside.
double overshoot_of(const std::vector<Profile>& profiles, const std::vector<Edge>& edges) {
  constexpr int kOutside = 4 * kStepsPerPixel;
  std::array<double, kOutside> sum{};
  double weight = 0;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const int first = static_cast<int>(std::lround(edges[i].middle));
    if (first + kOutside > kSteps) continue;
    for (int j = 0; j < kOutside; ++j)
      sum[static_cast<std::size_t>(j)] += profiles[i][static_cast<std::size_t>(first + j)];
    weight += edges[i].contrast;
  }
  return weight > 0 ? -*std::min_element(sum.begin(), sum.end()) / weight : 0;
}

std::optional<double> chroma_width(const TargetSilhouette& target, const std::vector<Normal>& normals) {
  if (target.cb.empty()) return std::nullopt;
  const cv::Mat cb = read_along(target.cb_difference, normals), cr = read_along(target.cr_difference, normals);
  std::vector<double> widths;
  for (int i = 0; i < cb.rows; ++i) {
    cv::Point2f inside;
    for (int j = kMiddle - 3 * kStepsPerPixel; j < kMiddle; ++j)
      inside += cv::Point2f(cb.at<float>(i, j), cr.at<float>(i, j)) / (3.0F * kStepsPerPixel);
    const auto length = static_cast<float>(cv::norm(inside));
    if (length < 0.5F) continue;
    Profile profile;
    for (int j = 0; j < kSteps; ++j)
      profile[static_cast<std::size_t>(j)] = (cb.at<float>(i, j) * inside.x + cr.at<float>(i, j) * inside.y) / length;
    if (const auto edge = falling_edge(profile, std::max(kLeastChromaContrast, kLeastContrast_sd * target.chroma_sd)))
      widths.push_back(edge->width_px);
  }
  if (widths.size() < kLeastProfiles) return std::nullopt;
  return quantile_of_profile(widths, 0.5);
}

}  // namespace

EdgeProfiles edge_profiles(const TargetSilhouette& target) {
  const std::vector<Normal> normals = normals_of(target.mask);
  if (normals.empty()) return {};
  const cv::Mat values = read_along(target.difference, normals);
  std::vector<Profile> profiles;
  std::vector<Edge> edges;
  for (int i = 0; i < values.rows; ++i) {
    const Profile profile = upright(profile_at(values, i));
    const auto edge = falling_edge(profile, std::max(kLeastContrast, kLeastContrast_sd * target.background_sd));
    if (!edge) continue;
    profiles.push_back(profile);
    edges.push_back(*edge);
  }
  EdgeProfiles found{.count = static_cast<int>(edges.size()), .chroma_width_px = chroma_width(target, normals)};
  if (edges.size() < kLeastProfiles) return found;
  std::vector<double> widths, slopes;
  for (const Edge& edge : edges) {
    widths.push_back(edge.width_px);
    slopes.push_back(edge.slope);
  }
  found.width_px = quantile_of_profile(widths, 0.5);
  found.slope = quantile_of_profile(slopes, 0.75);
  found.overshoot = overshoot_of(profiles, edges);
  return found;
}

}  // namespace sigs
