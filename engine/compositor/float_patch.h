// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "base/image.h"
#include "project/project.h"
#include "video/frame.h"

namespace sigs {

// One plane of a patch. All images are CV_32FC1 of rect's size.
struct PatchPlane {
  cv::Rect rect;    // in samples of this plane
  cv::Mat before;   // code values of the frame without the layer
  cv::Mat after;    // with it, as they have become so far: codes after blending, beyond their range after later stages
  cv::Mat opacity;  // of the layer at each sample, 0..1; at subsampled chroma the mean of its pixels
  cv::Mat free;     // what the own body leaves of a sample, 0..1; empty: everything
};

// The part of a frame that a layer, and the stages which follow its blending, can change: its samples as code values of
// the frame's depth, in floats. The stages (sharpening, chroma blur, grain) work on what the layer changed. A
// sample that nothing changes keeps its bits, and so does every sample that the own body hides wholly.
struct FloatPatch {
  PixelLayout layout = PixelLayout::yuv420;
  int bit_depth = 8;
  ColorInfo color;
  std::array<PatchPlane, 3> planes;  // unused ones are empty

  [[nodiscard]] int plane_count() const { return sigs::plane_count(layout); }
};

// The samples around a rectangle of pixels, with nothing blended yet: after is before, opacity is 0.
//   margin_px  of the patch beyond the pixels, on each side, as far as the image goes; of subsampled chroma all samples
//   are
//              taken that any of these pixels has weight in
//   own_body   CV_32FC1 of the frame's size, 1 where the own body hides everything; empty: nowhere
[[nodiscard]] FloatPatch patch_of(const Frame& frame, const cv::Rect& pixels, int margin_px, const cv::Mat& own_body);

// Detail of the plane that a layer brings into it: of the blended image, less that which the footage itself has where
// it shows through:
//   H(after) - (1 - opacity) H(before),  H(c) = c - Gaussian(c)
// An opaque layer so has its own detail, and nothing is left of the detail that it hides. CV_32FC1 of the plane's size;
// 0 where nothing is changed within the Gaussian's margin. Beyond the patch the image is mirrored.
[[nodiscard]] cv::Mat detail_of_layer(const PatchPlane& plane, double sigma_px);

// Adds a change to `after`, weakened where the own body hides a part.
void add_change(PatchPlane& plane, const cv::Mat& change);

// Rounds the patch into the frame. Gives back which pixels are rewritten: CV_8UC1 of the luma plane's rectangle, 255
// where the layer has opacity, and where a sample of the pixel, or a chroma sample that it shares, has other bits than
// before; else 0.
cv::Mat write_patch(const FloatPatch& patch, Frame& frame);

// BT.709's weights of R', G' and B' in luma, for footage that is stored as R'G'B'.
inline constexpr std::array<double, 3> kLumaOfRgb{0.2126, 0.7152, 0.0722};

// Luma of a patch in R'G'B', as a plane of its own.
[[nodiscard]] inline PatchPlane luma_of_rgb(const FloatPatch& patch) {
  const auto [r, g, b] = kLumaOfRgb;
  const auto& planes = patch.planes;
  return {.rect = planes[0].rect,
          .before = r * planes[0].before + g * planes[1].before + b * planes[2].before,
          .after = r * planes[0].after + g * planes[1].after + b * planes[2].after,
          .opacity = planes[0].opacity,
          .free = planes[0].free};
}

// Sharpens what a layer changed of luma, as cameras sharpen their whole image in code values (unsharp masking): adds
// amount times the detail that the layer brings, told by a Gaussian of sigma_px (detail_of_layer). The footage itself
// has been sharpened by its camera and is left as it is. Of R'G'B' the same is added to all three planes, by BT.709's
// luma. amount 0 leaves the patch as it is.
void sharpen(FloatPatch& patch, double amount, double sigma_px);

// Pixels beyond the layer that sharpening can change.
[[nodiscard]] int sharpening_margin_px(double amount, double sigma_px);

// Spreads the colours of a layer as the footage's camera and codec did: a Gaussian over the samples of the chroma
// planes (as they are stored: of 4:2:0 a sample is two pixels wide) takes away the detail that the layer brings into
// them (detail_of_layer). Luma stays as it is. Of R'G'B' the differences from luma are spread, over pixels. Gray has no
// chroma. sigma 0 leaves the patch as it is.
void blur_chroma(FloatPatch& patch, double sigma_samples);

// Pixels beyond the layer whose chroma this can change.
[[nodiscard]] int chroma_blur_margin_px(PixelLayout layout, double sigma_samples);

// A field of noise with mean 0 and variance 1 over rect: a function of its arguments alone, so that any part of any
// frame can be made by itself, on any thread.
//
// In space: white noise through a Gaussian of sigma correlation_length_px, whose squares sum to one; the correlation of
// samples n apart is exp(-n^2 / (4 correlation_length_px^2)). In time: first-order autoregression, cut after as many
// frames as keep the correlation of neighbouring frames within 1 %: sum over k of correlation^k e(frame - k), by its
// norm. Each value of e is a hash of seed, plane, frame, x and y, as the sum of four uniform numbers.
//   plane     0, 1, 2: fields that are independent of each other
//   intruder  likewise: where one shows through another, the noise of both is there
[[nodiscard]] cv::Mat noise_field(const GrainSettings& grain, int plane, std::int64_t frame, const cv::Rect& rect,
                                  int intruder = 0);

// Adds noise to a patch where its layer hides the footage's own: with variance (1 - (1 - opacity)^2) times that of the
// footage, so that both together have the footage's. Rounding to whole codes of the patch's depth adds a variance of
// 1/12 of such a code by itself, which is left out of the noise; of 8 bits, grain below a standard deviation of 0.29 so
// adds nothing. Gives back how many samples of noise were made.
//
// GrainSource::footage: in place of it comes what the layer hides of the noise that the footage has in this very place,
// so that what is fixed to the sensor stays and what the codec did to it is in it: r = before - Gaussian(before), times
// opacity and the ratio of the standard deviations at the two brightnesses. Where r has more than twice the variance v
// of the footage's noise, there is texture: r is weighted by w = 2 v / mean(r^2), and sqrt(1 - w^2) of noise that is
// made is added. w is 0 where the footage is clipped. Noise below a fortieth of an 8-bit code is not looked for.
std::int64_t add_grain(FloatPatch& patch, const GrainSettings& grain, std::int64_t frame, int intruder = 0);

// Pixels beyond the layer that are looked at for it.
[[nodiscard]] int grain_margin_px(PixelLayout layout, const GrainSettings& grain);

}  // namespace sigs
