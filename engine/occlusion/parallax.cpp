// SPDX-License-Identifier: MIT
#include "occlusion/parallax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "base/ensure.h"
#include "base/statistics.h"
#include "base/threads.h"

namespace sigs {

namespace {

constexpr int kMaxWidth_px = 960;        // wider footage is reduced
constexpr int kComparisons = 3;          // frames on each side
constexpr double kMinKnownShare = 0.01;  // of the image
constexpr double kMinPartShare = 0.002;  // of the image
constexpr double kGoodMatch = 8;         // mean difference, code values
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
using CameraPose = Pose<frame::World, frame::Camera>;

// The image that is looked through, smaller than the footage by `scale`.
struct Reduced {
  cv::Mat bgr;
  cv::Mat gray;
};

Reduced reduced(const Frame& frame, double scale) {
  Reduced image;
  image.bgr = bgr_of(frame);
  if (scale < 1) cv::resize(image.bgr, image.bgr, {}, scale, scale, cv::INTER_AREA);
  cv::cvtColor(image.bgr, image.gray, cv::COLOR_BGR2GRAY);
  return image;
}

// For each pixel of the reduced image: its ray in camera axes, 0 where the lens has none.
class Rays {
 public:
  Rays(const Camera& camera, cv::Size size_px)
      : lens_(camera.lens),
        scale_(static_cast<double>(size_px.width) / camera.size_px.width),
        focal_px_(camera.lens.pinhole().parameters().fx * scale_),
        size_px_(size_px) {
    for (int y = 0; y < size_px.height; ++y)
      for (int x = 0; x < size_px.width; ++x) rays_.push_back(lens_.ray(in_footage({x, y})).value_or(glm::dvec3(0)));
  }

  [[nodiscard]] const glm::dvec3& at(int x, int y) const {
    return rays_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px_.width) + static_cast<std::size_t>(x)];
  }

  // Where in another view, turned like `other_from_this`, the far points of this view's pixels are. CV_32FC2; far
  // outside where they have no image.
  [[nodiscard]] cv::Mat turned(const glm::dquat& other_from_this) const {
    cv::Mat map(size_px_, CV_32FC2, cv::Scalar::all(-1e4));
    for (int y = 0; y < size_px_.height; ++y)
      for (int x = 0; x < size_px_.width; ++x) {
        if (at(x, y) == glm::dvec3(0)) continue;
        if (const std::optional<glm::dvec2> pixel = lens_.pixel(other_from_this * at(x, y)))
          map.at<cv::Vec2f>(y, x) = in_reduced(*pixel);
      }
    return map;
  }

  // Pixels of the reduced image a radian, about.
  [[nodiscard]] double focal_px() const { return focal_px_; }

 private:
  [[nodiscard]] glm::dvec2 in_footage(const glm::dvec2& pixel) const { return (pixel + 0.5) / scale_ - 0.5; }
  [[nodiscard]] cv::Vec2f in_reduced(const glm::dvec2& pixel) const {
    const glm::dvec2 at = (pixel + 0.5) * scale_ - 0.5;
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
  }

  const Lens& lens_;
  double scale_;
  double focal_px_;
  cv::Size size_px_;
  std::vector<glm::dvec3> rays_;
};

cv::Mat flow_between(const cv::Mat& from, const cv::Mat& to) {
  const cv::Ptr<cv::DISOpticalFlow> method = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
  cv::Mat flow;
  method->calc(from, to, flow);
  return flow;
}

// Length of the flow, unknown where the way there and back does not end within a pixel of its start, or where the other
// image shows nothing.
cv::Mat trusted_length(const cv::Mat& there, const cv::Mat& back, const cv::Mat& has_image) {
  constexpr double kMaxGap_px = 1;
  cv::Mat length(there.size(), CV_32FC1, cv::Scalar(kUnknown));
  for (int y = 0; y < there.rows; ++y)
    for (int x = 0; x < there.cols; ++x) {
      const auto& way = there.at<cv::Vec2f>(y, x);
      const int to_x = cvRound(static_cast<float>(x) + way[0]);
      const int to_y = cvRound(static_cast<float>(y) + way[1]);
      if (to_x < 0 || to_y < 0 || to_x >= there.cols || to_y >= there.rows) continue;
      if (has_image.at<uchar>(y, x) == 0 || has_image.at<uchar>(to_y, to_x) == 0) continue;
      const cv::Vec2f gap = way + back.at<cv::Vec2f>(to_y, to_x);
      if (cv::norm(gap) < kMaxGap_px) length.at<float>(y, x) = static_cast<float>(cv::norm(way));
    }
  return length;
}

// 255 where a patch has texture both ways (the smaller eigenvalue of the structure tensor), so that its motion shows.
cv::Mat textured(const cv::Mat& gray) {
  constexpr double kMinGradient = 6;  // code values a pixel
  cv::Mat eigenvalue;
  cv::cornerMinEigenVal(gray, eigenvalue, 7, 3);  // of gradients in units of 255 * 4 * 2 * 49
  const double unit = 1.0 / (255.0 * 4 * 2 * 49);
  cv::Mat has_texture = eigenvalue > kMinGradient * kMinGradient * unit * unit * 49;
  return has_texture;
}

// Over the comparisons in which a pixel is known; unknown without texture. A third of the values are smaller: beside
// something near, what is far is covered in the frames of one side, and its flow there is that of the near; in those of
// the other side it is right, and smaller.
cv::Mat combined(const std::vector<cv::Mat>& all, const cv::Mat& has_texture) {
  cv::Mat out(has_texture.size(), CV_32FC1, cv::Scalar(kUnknown));
  std::vector<float> known;
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) {
      if (has_texture.at<uchar>(y, x) == 0) continue;
      known.clear();
      for (const cv::Mat& one : all)
        if (const float value = one.at<float>(y, x); !std::isnan(value)) known.push_back(value);
      if (!known.empty()) out.at<float>(y, x) = static_cast<float>(quantile(known, 1.0 / 3));
    }
  return out;
}

// Shift across the line of sight that a metre of distance makes of the camera's way, px times metres.
double across_px_m(const glm::dvec3& way_in_camera_m, const glm::dvec3& ray, double focal_px) {
  return focal_px * glm::length(way_in_camera_m - glm::dot(way_in_camera_m, ray) * ray);
}

// 255 where a pixel is near, 128 where it is far, 0 where nothing is known.
cv::Mat verdicts(const cv::Mat& parallax_px, const ParallaxSettings& settings, const CameraPoseAt& pose_at,
                 const Rays& rays, double scale) {
  const CameraPose here = pose_at(settings.frame);
  const CameraPose there = pose_at(settings.frame + settings.span);
  const glm::dvec3 way_m = glm::conjugate(here.rotation) * (there.translation_m - here.translation_m);
  cv::Mat verdict = cv::Mat::zeros(parallax_px.size(), CV_8UC1);
  for (int y = 0; y < verdict.rows; ++y)
    for (int x = 0; x < verdict.cols; ++x) {
      const float parallax = parallax_px.at<float>(y, x);
      if (std::isnan(parallax)) continue;
      const double limit_px = settings.max_m ? across_px_m(way_m, rays.at(x, y), rays.focal_px()) / *settings.max_m
                                             : settings.min_parallax_px * scale;
      // Around the focus of expansion nothing shows a distance.
      if (settings.max_m && limit_px < 0.5) continue;
      verdict.at<uchar>(y, x) = parallax > limit_px ? 255 : 128;
    }
  return verdict;
}

// Without parts below kMinPartShare of the image.
cv::Mat without_specks(const cv::Mat& mask) {
  cv::Mat parts;
  cv::Mat sizes;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(mask, parts, sizes, centers, 8);
  cv::Mat kept = cv::Mat::zeros(mask.size(), CV_8UC1);
  for (int part = 1; part < count; ++part)
    if (sizes.at<int>(part, cv::CC_STAT_AREA) >= kMinPartShare * static_cast<double>(mask.total()))
      kept.setTo(255, parts == part);
  return kept;
}

// The border through what has no texture, by colour.
cv::Mat cut_by_color(const cv::Mat& bgr, const cv::Mat& verdict) {
  cv::Mat labels(verdict.size(), CV_8UC1, cv::Scalar(cv::GC_PR_BGD));
  cv::Mat near_share;
  cv::Mat far_share;
  const cv::Size patch(9, 9);
  cv::boxFilter((verdict == 255) / 255, near_share, CV_32F, patch);
  cv::boxFilter((verdict == 128) / 255, far_share, CV_32F, patch);
  labels.setTo(cv::GC_PR_FGD, (near_share > far_share) & (near_share > 0.3));
  labels.setTo(cv::GC_FGD, (near_share > 0.8) & (far_share < 0.02));
  labels.setTo(cv::GC_BGD, (far_share > 0.8) & (near_share < 0.02));
  const int near_count = cv::countNonZero((labels == cv::GC_FGD) | (labels == cv::GC_PR_FGD));
  if (near_count == 0) return cv::Mat::zeros(verdict.size(), CV_8UC1);
  if (near_count == static_cast<int>(labels.total())) return cv::Mat(verdict.size(), CV_8UC1, cv::Scalar(255));
  cv::Mat background;
  cv::Mat foreground;
  cv::setRNGSeed(1);
  cv::grabCut(bgr, labels, {}, background, foreground, 4, cv::GC_INIT_WITH_MASK);
  cv::Mat mask = (labels == cv::GC_FGD) | (labels == cv::GC_PR_FGD);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disc);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, disc);
  return without_specks(mask);
}

// Frames that the reference frame is compared with.
std::vector<int> compared_frames(const ParallaxSettings& settings, int frame_count) {
  std::vector<int> frames;
  for (int side : {-1, 1})
    for (int i = 1; i <= kComparisons; ++i) {
      const int step = std::max(1, settings.span * i / kComparisons);
      const int frame = settings.frame + side * step;
      const bool is_new = frames.empty() || frames.back() != frame;
      if (frame >= 0 && frame < frame_count && is_new) frames.push_back(frame);
    }
  return frames;
}

// Mean difference of brightness around each pixel between an image and another one that is read beside it by `flow`, or
// in place where that is empty. CV_32FC1.
cv::Mat mismatch(const cv::Mat& here, const cv::Mat& other, const cv::Mat& flow) {
  cv::Mat read;
  if (flow.empty()) {
    read = other;
  } else {
    cv::Mat map(flow.size(), CV_32FC2);
    for (int y = 0; y < map.rows; ++y)
      for (int x = 0; x < map.cols; ++x)
        map.at<cv::Vec2f>(y, x) = flow.at<cv::Vec2f>(y, x) + cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    cv::remap(other, read, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  cv::Mat difference;
  cv::absdiff(here, read, difference);
  cv::boxFilter(difference, difference, CV_32F, {5, 5});
  return difference;
}

// How far each pixel of one view has moved in another frame, once that is turned back; px of the reduced image.
cv::Mat motion_against(const Reduced& here, const Reduced& other, const glm::dquat& other_from_here, const Rays& rays) {
  const cv::Mat map = rays.turned(other_from_here);
  cv::Mat turned;
  cv::Mat has_image;
  cv::remap(other.gray, turned, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(cv::Mat(other.gray.size(), CV_8UC1, cv::Scalar(255)), has_image, map, cv::noArray(), cv::INTER_NEAREST,
            cv::BORDER_CONSTANT, 0);
  const cv::Mat there = flow_between(here.gray, turned);
  cv::Mat length = trusted_length(there, flow_between(turned, here.gray), has_image);
  // Dense flow carries the motion of what is near over its border. What fits better in place has not moved, if it fits.
  const cv::Mat in_place = mismatch(here.gray, turned, {});
  const cv::Mat is_better = in_place <= mismatch(here.gray, turned, there);
  length.setTo(kUnknown, is_better);
  length.setTo(0, is_better & (in_place < kGoodMatch) & (has_image != 0));
  return length;
}

double known_share_of(const cv::Mat& values) {
  return static_cast<double>(cv::countNonZero(values == values)) / static_cast<double>(values.total());
}

double known_quantile(const cv::Mat& values, double share) {
  std::vector<float> known;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (!std::isnan(values.at<float>(y, x))) known.push_back(values.at<float>(y, x));
  return known.empty() ? 0 : quantile(std::move(known), share);
}

// Motion against infinity within the span, from all frames that are compared; px of the reduced image.
Result<cv::Mat> parallax_around(const Reduced& here, FrameSource& footage, const Rays& rays,
                                const CameraPoseAt& pose_at, const ParallaxSettings& settings,
                                const ParallaxControl& control, double scale) {
  const std::string place = footage.info().path.string();
  const std::vector<int> others = compared_frames(settings, footage.info().frame_count());
  if (others.empty()) return fail(place, "has no other frame to compare with; parallax needs two");
  std::vector<cv::Mat> motions;
  for (const int frame : others) {
    if (const Result<void> on = check_interrupt(control.cancel, place); !on) return fail(on.error());
    const Result<Frame> other = footage.read(frame);
    if (!other) return fail(other.error());
    const glm::dquat other_from_here = glm::conjugate(pose_at(frame).rotation) * pose_at(settings.frame).rotation;
    const double per_span = static_cast<double>(settings.span) / std::abs(frame - settings.frame);
    motions.push_back(motion_against(here, reduced(*other, scale), other_from_here, rays) * per_span);
    if (control.progress) control.progress(static_cast<int>(motions.size()), static_cast<int>(others.size()));
  }
  return combined(motions, textured(here.gray));
}

}  // namespace

Result<NearScenery> near_scenery(FrameSource& footage, const Camera& camera, const CameraPoseAt& pose_at,
                                 const ParallaxSettings& settings, const ParallaxControl& control) {
  ENSURE(settings.frame >= 0 && settings.frame < footage.info().frame_count() && settings.span > 0);
  const std::string place = footage.info().path.string();
  const Result<Frame> reference = footage.read(settings.frame);
  if (!reference) return fail(reference.error());
  const double scale = std::min(1.0, static_cast<double>(kMaxWidth_px) / camera.size_px.width);
  const Reduced here = reduced(*reference, scale);
  const Rays rays(camera, here.gray.size());
  const Result<cv::Mat> parallax_px = parallax_around(here, footage, rays, pose_at, settings, control, scale);
  if (!parallax_px) return fail(parallax_px.error());
  NearScenery found;
  found.known_share = known_share_of(*parallax_px);
  if (found.known_share < kMinKnownShare)
    return fail(place, fmt::format("frame {} has texture in {:.1f} % of the image, too little to see a parallax in",
                                   settings.frame, 100 * found.known_share));
  found.largest_parallax_px = known_quantile(*parallax_px, 0.95) / scale;
  const cv::Mat mask = cut_by_color(here.bgr, verdicts(*parallax_px, settings, pose_at, rays, scale));
  cv::resize(mask, found.mask, camera.size_px, 0, 0, cv::INTER_LINEAR);
  found.mask = found.mask >= 128;
  cv::resize(*parallax_px / scale, found.parallax_px, camera.size_px, 0, 0, cv::INTER_NEAREST);
  if (found.largest_parallax_px < settings.min_parallax_px && !settings.max_m)
    found.warnings.push_back(
        {place,
         fmt::format("95 % of the texture moves by less than {:.2g} px against infinity in {} frames: the camera "
                     "hardly travels, or nothing is near; a longer span may show it",
                     found.largest_parallax_px, settings.span)});
  return found;
}

}  // namespace sigs
