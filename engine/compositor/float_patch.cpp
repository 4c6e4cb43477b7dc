// SPDX-License-Identifier: MIT
#include "compositor/float_patch.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "compositor/blur.h"
#include "video/bit_depth.h"
#include "video/chroma.h"

namespace sigs {
namespace {

// Pixels as whole chroma samples have them.
cv::Rect widened(const cv::Rect& rect, const cv::Size& step, cv::Size image_size_px) {
  const int left = rect.x / step.width * step.width;
  const int top = rect.y / step.height * step.height;
  const int right = (rect.br().x + step.width - 1) / step.width * step.width;
  const int bottom = (rect.br().y + step.height - 1) / step.height * step.height;
  return cv::Rect(left, top, right - left, bottom - top) & cv::Rect({0, 0}, image_size_px);
}

cv::Rect in_chroma(const cv::Rect& rect, const cv::Size& step) {
  const int right = (rect.br().x + step.width - 1) / step.width;
  const int bottom = (rect.br().y + step.height - 1) / step.height;
  return {rect.x / step.width, rect.y / step.height, right - rect.x / step.width, bottom - rect.y / step.height};
}

PatchPlane plane_of(const cv::Mat& codes, const cv::Rect& rect) {
  PatchPlane plane{.rect = rect};
  codes(rect).convertTo(plane.before, CV_32F);
  plane.after = plane.before.clone();
  plane.opacity = cv::Mat::zeros(rect.size(), CV_32FC1);
  return plane;
}

// Of the pixels that a sample is the mean of.
cv::Mat free_share(const cv::Mat& own_body, const cv::Rect& pixels, const cv::Rect& samples, const Frame& frame) {
  const cv::Mat open = 1 - own_body(pixels);
  return samples.size() == pixels.size() ? open : shrunk_chroma(open, frame.layout, frame.color.chroma_site);
}

template <class Sample>
void mark_changed(const PatchPlane& plane, const cv::Mat& codes, const cv::Size& step, const cv::Point& corner,
                  cv::Mat& changed) {
  const cv::Rect all({0, 0}, changed.size());
  for (int y = 0; y < plane.rect.height; ++y) {
    const Sample* const now = codes.ptr<Sample>(plane.rect.y + y) + plane.rect.x;
    const float* const before = plane.before.ptr<float>(y);
    for (int x = 0; x < plane.rect.width; ++x) {
      if (static_cast<float>(now[x]) == before[x]) continue;
      const cv::Point first((plane.rect.x + x) * step.width - corner.x, (plane.rect.y + y) * step.height - corner.y);
      changed(cv::Rect(first, step) & all) = 255;
    }
  }
}

template <class Sample>
cv::Mat write_as(const FloatPatch& patch, Frame& frame) {
  const auto top = static_cast<float>(max_code(patch.bit_depth));
  const cv::Point corner = patch.planes[0].rect.tl();
  cv::Mat changed = patch.planes[0].opacity > 0;
  for (int plane = 0; plane < patch.plane_count(); ++plane) {
    const PatchPlane& from = patch.planes[static_cast<std::size_t>(plane)];
    cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
    for (int y = 0; y < from.rect.height; ++y) {
      const float* const after = from.after.ptr<float>(y);
      Sample* const to = codes.ptr<Sample>(from.rect.y + y) + from.rect.x;
      for (int x = 0; x < from.rect.width; ++x) to[x] = static_cast<Sample>(std::clamp(after[x], 0.0F, top) + 0.5F);
    }
    const bool is_shared = plane > 0 && from.rect.size() != patch.planes[0].rect.size();
    mark_changed<Sample>(from, codes, is_shared ? chroma_step(patch.layout) : cv::Size(1, 1), corner, changed);
  }
  return changed;
}

void spread_rgb(FloatPatch& patch, double sigma_px) {
  const cv::Mat of_luma = detail_of_layer(luma_of_rgb(patch), sigma_px);
  for (PatchPlane& plane : patch.planes) add_change(plane, of_luma - detail_of_layer(plane, sigma_px));
}

}  // namespace

FloatPatch patch_of(const Frame& frame, const cv::Rect& pixels, int margin_px, const cv::Mat& own_body) {
  const cv::Size step = chroma_step(frame.layout);
  const int margin = margin_px + (step.area() > 1 ? 2 : 0);
  const cv::Rect luma = widened(grown(pixels, margin) & cv::Rect({0, 0}, frame.size_px()), step, frame.size_px());
  FloatPatch patch{.layout = frame.layout, .bit_depth = frame.bit_depth, .color = frame.color};
  for (int plane = 0; plane < frame.plane_count(); ++plane) {
    const auto index = static_cast<std::size_t>(plane);
    const cv::Rect rect = plane == 0 ? luma : in_chroma(luma, step);
    patch.planes[index] = plane_of(frame.planes[index], rect);
    if (!own_body.empty()) patch.planes[index].free = free_share(own_body, luma, rect, frame);
  }
  return patch;
}

cv::Mat detail_of_layer(const PatchPlane& plane, double sigma_px) {
  const int margin = blur_margin_px(sigma_px);
  const cv::Mat kernel = sampled_gaussian(sigma_px, margin);
  const auto detail = [&](const cv::Mat& codes) {
    cv::Mat spread;
    cv::sepFilter2D(codes, spread, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REFLECT_101);
    return cv::Mat(codes - spread);
  };
  // The same sum by what the layer changes, which is 0 exactly where it changes nothing.
  return detail(plane.after - plane.before) + plane.opacity.mul(detail(plane.before));
}

void add_change(PatchPlane& plane, const cv::Mat& change) {
  ENSURE(change.size() == plane.after.size());
  plane.after += plane.free.empty() ? change : cv::Mat(change.mul(plane.free));
}

cv::Mat write_patch(const FloatPatch& patch, Frame& frame) {
  ENSURE(patch.bit_depth == frame.bit_depth);
  return with_sample_type(frame.bit_depth, [&](auto sample) { return write_as<decltype(sample)>(patch, frame); });
}

void sharpen(FloatPatch& patch, double amount, double sigma_px) {
  if (amount == 0) return;
  if (patch.layout != PixelLayout::rgb) {
    add_change(patch.planes[0], amount * detail_of_layer(patch.planes[0], sigma_px));
    return;
  }
  const cv::Mat change = amount * detail_of_layer(luma_of_rgb(patch), sigma_px);
  for (PatchPlane& plane : patch.planes) add_change(plane, change);
}

int sharpening_margin_px(double amount, double sigma_px) {
  return amount == 0 ? 0 : blur_margin_px(sigma_px);
}

void blur_chroma(FloatPatch& patch, double sigma_samples) {
  if (sigma_samples == 0 || patch.plane_count() == 1) return;
  if (patch.layout == PixelLayout::rgb) return spread_rgb(patch, sigma_samples);
  for (std::size_t plane = 1; plane < 3; ++plane)
    add_change(patch.planes[plane], -detail_of_layer(patch.planes[plane], sigma_samples));
}

int chroma_blur_margin_px(PixelLayout layout, double sigma_samples) {
  if (sigma_samples == 0 || layout == PixelLayout::gray) return 0;
  const cv::Size step = chroma_step(layout);
  return (blur_margin_px(sigma_samples) + 1) * std::max(step.width, step.height);
}

}  // namespace sigs
