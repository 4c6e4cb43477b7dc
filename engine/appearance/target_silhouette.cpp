// SPDX-License-Identifier: MIT
#include "appearance/target_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/statistics.h"
#include "video/chroma.h"

namespace sigs {

namespace {

constexpr double kThreshold_sd = 4.5;
constexpr double kMinThreshold = 5;  // code values: below it, blocks of the codec would be taken for the target
constexpr double kMinSd = 0.5;       // rounding to 8 bits alone gives 0.29
constexpr int kMinPixels = 12;
constexpr int kMinMargin_px = 22;   // as far as the codec's macroblock at the target's edge reaches, and some more
constexpr double kMinSpeck = 0.03;  // of the largest piece's area
constexpr std::size_t kMaxSamples = 5000;  // of the background; more change the surface by less than its deviation
constexpr int kRefits = 4;
constexpr double kOutlier_sd = 2.5;

using Terms = cv::Matx<double, 6, 1>;

// The six terms of a surface of second order at a pixel, in coordinates of about -1..1.
Terms terms_at(int x, int y, cv::Size size) {
  const double u = 2.0 * x / size.width - 1, v = 2.0 * y / size.height - 1;
  return {1, u, v, u * u, u * v, v * v};
}

// A background's surface, and how the samples that it was fitted to scatter about it.
struct Surface {
  cv::Mat values;  // CV_32FC1
  double sd = 0;
};

struct Sample {
  Terms terms;
  double value = 0;
};

// Pixels under a mask, on a grid that leaves some kMaxSamples of them.
std::vector<Sample> samples_of(const cv::Mat& plane, const cv::Mat& around) {
  // An odd step, which meets both kinds of pixels of a pattern that alternates.
  const int every = static_cast<int>(std::sqrt(plane.total() / kMaxSamples)) / 2 * 2 + 1;
  std::vector<Sample> samples;
  for (int y = 0; y < plane.rows; y += every)
    for (int x = 0; x < plane.cols; x += every)
      if (around.at<uchar>(y, x) != 0) samples.push_back({terms_at(x, y, plane.size()), plane.at<float>(y, x)});
  return samples;
}

// Least squares over the pixels of `around`, several times, each time without what lies far off.
Surface surface_through(const cv::Mat& plane, const cv::Mat& around) {
  const std::vector<Sample> samples = samples_of(plane, around);
  Terms found = Terms::zeros();
  double limit = std::numeric_limits<double>::infinity(), sd = kMinSd;
  for (int fit = 0; fit < kRefits; ++fit) {
    auto normal = 1e-6 * cv::Matx<double, 6, 6>::eye();  // too few samples: the least surface
    Terms right = Terms::zeros();
    for (const Sample& sample : samples) {
      if (std::abs(sample.value - found.dot(sample.terms)) > limit) continue;
      right += sample.value * sample.terms;
      normal += sample.terms * sample.terms.t();
    }
    found = normal.solve(right, cv::DECOMP_CHOLESKY);
    std::vector<double> off;
    for (const Sample& sample : samples) off.push_back(std::abs(sample.value - found.dot(sample.terms)));
    sd = std::max(kMinSd, 1.4826 * median(off));  // of a Gaussian
    limit = kOutlier_sd * sd;
  }
  Surface surface{.values = cv::Mat(plane.size(), CV_32FC1), .sd = sd};
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      surface.values.at<float>(y, x) = static_cast<float>(found.dot(terms_at(x, y, plane.size())));
  return surface;
}

// Luma, and for colour Cb and Cr at luma's resolution, over a part of the image.
std::vector<cv::Mat> planes_of(const Frame& frame, const cv::Rect& patch) {
  if (frame.layout == PixelLayout::rgb)
    return planes_of(frame_of_bgr(bgr_of(frame), PixelLayout::yuv444, {.range = ColorRange::full}), patch);
  std::vector<cv::Mat> planes(static_cast<std::size_t>(frame.plane_count()));
  frame.planes[0](patch).convertTo(planes[0], CV_32F);
  const cv::Size step = chroma_step(frame.layout);
  const auto columns = chroma_taps(frame.size_px().width, step.width, chroma_on_luma_column(frame.color.chroma_site));
  const auto rows = chroma_taps(frame.size_px().height, step.height, chroma_on_luma_row(frame.color.chroma_site));
  for (std::size_t p = 1; p < planes.size(); ++p) {
    planes[p].create(patch.size(), CV_32FC1);
    for (int y = 0; y < patch.height; ++y)
      for (int x = 0; x < patch.width; ++x) {
        const ChromaTap& column = columns[static_cast<std::size_t>(patch.x + x)];
        const ChromaTap& row = rows[static_cast<std::size_t>(patch.y + y)];
        const auto across = [&](int line) {
          const auto* const samples = frame.planes[p].ptr<uchar>(line);
          return samples[column.first] +
                 column.share * static_cast<float>(samples[column.second] - samples[column.first]);
        };
        const float upper = across(row.first);
        planes[p].at<float>(y, x) = upper + row.share * (across(row.second) - upper);
      }
  }
  return planes;
}

// The target's pieces of a mask, and whether its largest one lies on the edge of a rectangle.
struct Pieces {
  cv::Mat mask;
  bool is_cut = false;
};

bool is_on_edge(const cv::Rect& piece, const cv::Rect& inner) {
  return piece.x <= inner.x || piece.y <= inner.y || piece.br().x >= inner.br().x || piece.br().y >= inner.br().y;
}

// The largest piece, and those of the others that are no specks and do not lie on the rectangle's edge, as what belongs
// to the background around does.
Pieces pieces_of(const cv::Mat& mask, const cv::Rect& inner) {
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8);
  const auto area_of = [&](int i) { return statistics.at<int>(i, cv::CC_STAT_AREA); };
  int largest = 0;  // the background's label: none yet
  for (int i = 1; i < count; ++i)
    if (largest == 0 || area_of(i) > area_of(largest)) largest = i;
  Pieces pieces{.mask = cv::Mat::zeros(mask.size(), CV_8UC1)};
  for (int i = 1; i < count; ++i) {
    const cv::Rect piece(statistics.at<int>(i, cv::CC_STAT_LEFT), statistics.at<int>(i, cv::CC_STAT_TOP),
                         statistics.at<int>(i, cv::CC_STAT_WIDTH), statistics.at<int>(i, cv::CC_STAT_HEIGHT));
    if (i == largest) pieces.is_cut = is_on_edge(piece, inner);
    if (i != largest && (area_of(i) < 3 || area_of(i) < kMinSpeck * area_of(largest) || is_on_edge(piece, inner)))
      continue;
    pieces.mask.setTo(255, labels == i);
  }
  return pieces;
}

// The target within `inner`, a rectangle of the image.
std::optional<TargetSilhouette> silhouette_in(const Frame& frame, const cv::Rect& inner) {
  const cv::Rect image({0, 0}, frame.size_px());
  const int margin_px = std::max(kMinMargin_px, std::max(inner.width, inner.height) * 35 / 100);
  const cv::Rect wanted(inner.x - margin_px, inner.y - margin_px, inner.width + 2 * margin_px,
                        inner.height + 2 * margin_px);
  TargetSilhouette found{.patch = wanted & image};
  if (2 * (found.patch.area() - inner.area()) < wanted.area() - inner.area()) return std::nullopt;
  const cv::Rect inner_in_patch = inner - found.patch.tl();
  const std::vector<cv::Mat> planes = planes_of(frame, found.patch);
  cv::Mat around(found.patch.size(), CV_8UC1, cv::Scalar(255));
  around(inner_in_patch).setTo(0);
  const Surface luma = surface_through(planes[0], around);
  found.difference = planes[0] - luma.values;
  found.background_sd = luma.sd;
  cv::Mat differs = cv::Mat::zeros(found.patch.size(), CV_8UC1);
  const cv::Mat inside = cv::abs(found.difference(inner_in_patch)) > std::max(kMinThreshold, kThreshold_sd * luma.sd);
  inside.copyTo(differs(inner_in_patch));
  const Pieces pieces = pieces_of(differs, inner_in_patch);
  found.mask = pieces.mask;
  found.is_cut = pieces.is_cut;
  if (cv::countNonZero(found.mask) < kMinPixels) return std::nullopt;
  found.box = cv::boundingRect(found.mask) + found.patch.tl();
  found.background = cv::mean(luma.values, found.mask)[0];
  cv::distanceTransform(found.mask == 0, found.distance_px, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  if (planes.size() == 3) {
    const Surface cb = surface_through(planes[1], around), cr = surface_through(planes[2], around);
    found.cb = planes[1];
    found.cr = planes[2];
    found.cb_difference = planes[1] - cb.values;
    found.cr_difference = planes[2] - cr.values;
    found.chroma_sd = std::max(cb.sd, cr.sd);
  }
  return found;
}

constexpr double kProfileReach_px = 6;
constexpr int kStepsPerPixel = 4;
constexpr int kSteps = static_cast<int>(2 * kProfileReach_px) * kStepsPerPixel + 1;
constexpr int kMiddle = kSteps / 2;
constexpr double kMinTargetContrast = 12;  // code values
constexpr double kMinTargetContrast_sd = 6;
constexpr double kMinChromaContrast = 4;
constexpr std::size_t kMinProfiles = 6;
constexpr std::size_t kMaxProfiles = 400;  // more do not change a median
constexpr double kFall = 0.9;              // of an extremum: below it, the extremum has been passed

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
  const std::size_t every = outline.size() / kMaxProfiles + 1;
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
std::optional<Edge> falling_edge(const Profile& profile, double min_contrast) {
  int top = std::min(kMiddle + 2 * kStepsPerPixel, kSteps - 1);  // inwards over the first extremum
  for (int j = top; j >= 0; --j) {
    if (profile[static_cast<std::size_t>(j)] > profile[static_cast<std::size_t>(top)]) top = j;
    if (j < kMiddle && profile[static_cast<std::size_t>(j)] < kFall * profile[static_cast<std::size_t>(top)]) break;
  }
  const float contrast = profile[static_cast<std::size_t>(top)];
  if (contrast < min_contrast) return std::nullopt;
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
    if (const auto edge = falling_edge(profile, std::max(kMinChromaContrast, kMinTargetContrast_sd * target.chroma_sd)))
      widths.push_back(edge->width_px);
  }
  if (widths.size() < kMinProfiles) return std::nullopt;
  return median(widths);
}

}  // namespace

std::optional<TargetSilhouette> target_silhouette(const Frame& frame, const Box& box) {
  const cv::Rect image({0, 0}, frame.size_px());
  if (!(box.width > 0 && box.height > 0) || !std::isfinite(box.x + box.y + box.width + box.height)) return std::nullopt;
  const cv::Rect loose = pixels_touched(box, 2, image);
  if (loose.width < 3 || loose.height < 3) return std::nullopt;
  const auto first = silhouette_in(frame, loose);
  if (!first) return std::nullopt;
  // Again with the box of what was found: whoever drew the loose box has no say in what counts as surroundings.
  const cv::Rect tight = first->box;
  const cv::Rect grown = cv::Rect(tight.x - 3, tight.y - 3, tight.width + 6, tight.height + 6) & image;
  auto second = silhouette_in(frame, grown);
  if (second) second->is_cut = first->is_cut;
  return second;
}

EdgeProfiles edge_profiles(const TargetSilhouette& target) {
  const std::vector<Normal> normals = normals_of(target.mask);
  if (normals.empty()) return {};
  const cv::Mat values = read_along(target.difference, normals);
  std::vector<Profile> profiles;
  std::vector<Edge> edges;
  for (int i = 0; i < values.rows; ++i) {
    const Profile profile = upright(profile_at(values, i));
    const auto edge = falling_edge(profile, std::max(kMinTargetContrast, kMinTargetContrast_sd * target.background_sd));
    if (!edge) continue;
    profiles.push_back(profile);
    edges.push_back(*edge);
  }
  EdgeProfiles found{.count = static_cast<int>(edges.size()), .chroma_width_px = chroma_width(target, normals)};
  if (edges.size() < kMinProfiles) return found;
  std::vector<double> widths, slopes;
  for (const Edge& edge : edges) {
    widths.push_back(edge.width_px);
    slopes.push_back(edge.slope);
  }
  found.width_px = median(widths);
  found.slope = quantile(slopes, 0.75);
  found.overshoot = overshoot_of(profiles, edges);
  return found;
}

}  // namespace sigs
