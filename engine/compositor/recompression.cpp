// SPDX-License-Identifier: MIT
#include "compositor/recompression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs {
namespace {

// One generation of the codecs that quantise the cosine transform of 8x8 samples: JPEG, and MPEG-1, -2 and -4 part 2.
// No bits are written: entropy coding loses nothing. Planes are CV_8UC1 and consist of whole blocks.

constexpr int kSide = 8;

using DctBlock = std::array<double, 64>;  // row by row

// Row k: the k-th basis function of the orthonormal cosine transform (T.81, A.3.3).
const DctBlock& basis() {
  static const DctBlock functions = [] {
    DctBlock made{};
    for (int k = 0; k < kSide; ++k)
      for (int i = 0; i < kSide; ++i)
        made[static_cast<std::size_t>(kSide * k + i)] =
            (k == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * i + 1) * k * std::numbers::pi / 16);
    return made;
  }();
  return functions;
}

// The product of two 8x8 matrices, either of them transposed.
template <bool kFirstTransposed, bool kSecondTransposed>
DctBlock product(const DctBlock& a, const DctBlock& b) {
  DctBlock c{};
  for (std::size_t row = 0; row < kSide; ++row)
    for (std::size_t i = 0; i < kSide; ++i) {
      const double factor = a[kFirstTransposed ? kSide * i + row : kSide * row + i];
      for (std::size_t column = 0; column < kSide; ++column)
        c[kSide * row + column] += factor * b[kSecondTransposed ? kSide * column + i : kSide * i + column];
    }
  return c;
}

DctBlock transformed(const DctBlock& samples) {
  return product<false, true>(product<false, false>(basis(), samples), basis());
}

DctBlock inverse_transformed(const DctBlock& coefficients) {
  return product<false, false>(product<true, false>(basis(), coefficients), basis());
}

// Calls change(block of plane, block of other, upper left corner) for each block in which the two planes differ.
template <class Change>
void for_each_difference(cv::Mat& plane, const cv::Mat& other, const Change& change) {
  ENSURE(plane.size() == other.size() && plane.rows % kSide == 0 && plane.cols % kSide == 0);
  for (int y = 0; y < plane.rows; y += kSide)
    for (int x = 0; x < plane.cols; x += kSide) {
      const cv::Rect at(x, y, kSide, kSide);
      cv::Mat block = plane(at);
      const cv::Mat beside = other(at);
      if (cv::norm(block, beside, cv::NORM_INF) > 0) change(block, beside, at.tl());
    }
}

// samples[i] of the block less subtrahend(i, sample).
template <class Subtrahend>
DctBlock difference(const cv::Mat& block, const Subtrahend& subtrahend) {
  DctBlock samples{};
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      samples[static_cast<std::size_t>(kSide * j + i)] = block.at<uchar>(j, i) - subtrahend(j, i);
  return samples;
}

template <class Addend>
void put(cv::Mat& block, const DctBlock& samples, const Addend& addend) {
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      block.at<uchar>(j, i) = cv::saturate_cast<uchar>(samples[static_cast<std::size_t>(kSide * j + i)] + addend(j, i));
}

// H.263, 6.2: a level l stands for (|l| + 1/2) steps.
double mpeg_decoded(double coefficient, double step) {
  const double level = std::floor(std::abs(coefficient) / step - 0.25);
  return level < 1 ? 0 : std::copysign((level + 0.5) * step, coefficient);
}

// Replaces each block in which the plane differs from the other one by what a JPEG decoder gives of it. All other
// blocks keep their samples: they have been through the same tables already.
void code_jpeg(cv::Mat& plane, const cv::Mat& before, const JpegTable& steps) {
  const auto middle = [](int, int) { return 128.0; };
  for_each_difference(plane, before, [&](cv::Mat& block, const cv::Mat&, cv::Point) {
    DctBlock coefficients = transformed(difference(block, middle));
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      const double step = std::max(1, steps[i]);
      coefficients[i] = std::round(coefficients[i] / step) * step;
    }
    put(block, inverse_transformed(coefficients), middle);
  });
}

// Replaces each block by what an MPEG decoder gives of it where `predicted` is its prediction: the difference is
// quantised by one step for all coefficients, with H.263's dead zone of 5/4 steps on either side of 0.
//   step  CV_16SC1: code values, one for each macroblock
//   macroblock_px  its size in samples of this plane
void code_mpeg(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& step, cv::Size macroblock_px) {
  for_each_difference(plane, predicted, [&](cv::Mat& block, const cv::Mat& prediction, cv::Point at) {
    const auto predicted_sample = [&](int j, int i) { return static_cast<double>(prediction.at<uchar>(j, i)); };
    const double here = std::max<short>(1, step.at<short>(at.y / macroblock_px.height, at.x / macroblock_px.width));
    DctBlock coefficients = transformed(difference(block, predicted_sample));
    for (double& coefficient : coefficients) coefficient = mpeg_decoded(coefficient, here);
    put(block, inverse_transformed(coefficients), predicted_sample);
  });
}

constexpr int kBlock_px = FrameQuantisers::kBlock_px;

cv::Mat clamped(const cv::Mat& quantisers, int low, int high) {
  cv::Mat within;
  cv::max(quantisers, low, within);
  cv::min(within, high, within);
  return within;
}

cv::Mat chroma_qps(const cv::Mat& luma_qp, int offset) {
  cv::Mat qp = luma_qp.clone();
  for (int row = 0; row < qp.rows; ++row)
    for (int column = 0; column < qp.cols; ++column)
      qp.at<short>(row, column) = static_cast<short>(chroma_qp(qp.at<short>(row, column), offset));
  return qp;
}

// Planes of colour that are as large as luma's are coded as luma is. Which of their blocks are filtered is luma's
// choice.
void code_full_plane(cv::Mat& plane, const cv::Mat& before, const cv::Mat& qp, const cv::Mat& coded_luma) {
  code_luma(plane, before, qp);
  deblock_luma(plane, {coded_luma, qp});
}

void code_h264(Frame& patch, const Frame& before, const PatchCoding& coding) {
  const cv::Size step = chroma_step(patch.layout);
  const CodedBlocks luma = code_luma(patch.planes[0], before.planes[0], clamped(coding.quantisers, 0, 51));
  deblock_luma(patch.planes[0], luma);
  for (int i = 1; i < patch.plane_count(); ++i) {
    const auto which = static_cast<std::size_t>(i);
    const int offset = i == 1 ? coding.cb_offset : coding.cr_offset;
    if (patch.layout == PixelLayout::rgb) {
      code_full_plane(patch.planes[which], before.planes[which], luma.qp, luma.coded);
    } else if (step == cv::Size(1, 1)) {
      code_full_plane(patch.planes[which], before.planes[which], chroma_qps(luma.qp, offset), luma.coded);
    } else {
      code_chroma(patch.planes[which], before.planes[which], luma.qp, step, offset);
      deblock_chroma(patch.planes[which], luma, step, offset);
    }
  }
}

void code_plane(Frame& patch, const Frame& before, const PatchCoding& coding, std::size_t which) {
  const bool is_chroma = which > 0 && patch.layout != PixelLayout::rgb;
  const cv::Size step = is_chroma ? chroma_step(patch.layout) : cv::Size(1, 1);
  if (coding.kind == QuantiserKind::jpeg)
    code_jpeg(patch.planes[which], before.planes[which], is_chroma ? coding.tables.chroma : coding.tables.luma);
  else
    code_mpeg(patch.planes[which], before.planes[which], clamped(coding.quantisers, 1, 255),
              {kBlock_px / step.width, kBlock_px / step.height});
}

// Weights of the samples 2 before to 3 behind the one that a place is at or behind.
using Weights = std::array<float, 6>;

// Catmull and Rom's cubic.
Weights cubic(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0,
          static_cast<float>(-0.5 * t + t2 - 0.5 * t3),
          static_cast<float>(1 - 2.5 * t2 + 1.5 * t3),
          static_cast<float>(0.5 * t + 2 * t2 - 1.5 * t3),
          static_cast<float>(-0.5 * t2 + 0.5 * t3),
          0};
}

Weights linear(double t) {
  return {0, 0, static_cast<float>(1 - t), static_cast<float>(t), 0, 0};
}

// H.264, section 8.4.2.2.1: half a sample by six taps, a quarter as the mean of its two neighbours.
Weights six_taps(double t) {
  constexpr Weights kHalf{1 / 32.0F, -5 / 32.0F, 20 / 32.0F, 20 / 32.0F, -5 / 32.0F, 1 / 32.0F};
  const int quarter = static_cast<int>(std::lround(4 * t));
  if (quarter == 0) return {0, 0, 1, 0, 0, 0};
  if (quarter == 4) return {0, 0, 0, 1, 0, 0};
  Weights weights = kHalf;
  if (quarter == 2) return weights;
  for (float& weight : weights) weight *= 0.5F;
  weights[quarter == 1 ? 2 : 3] += 0.5F;
  return weights;
}

// One direction of a shift: the whole samples, and the weights of those around the rest.
struct Shift {
  int whole = 0;
  Weights weights{};

  Shift(double shift, Weights (*weights_of)(double))
      : whole(static_cast<int>(std::floor(-shift))), weights(weights_of(-shift - std::floor(-shift))) {}
};

// A plane moved to the right and down. Beyond its edge are the samples at the edge.
cv::Mat1f moved(const cv::Mat1f& plane, cv::Point2d shift_px, Weights (*weights_of)(double)) {
  const Shift right(shift_px.x, weights_of), down(shift_px.y, weights_of);
  cv::Mat1f rows(plane.size()), result(plane.size());
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x) {
      float sum = 0;
      for (int i = 0; i < 6; ++i)
        sum += right.weights[static_cast<std::size_t>(i)] *
               plane(y, std::clamp(x + right.whole + i - 2, 0, plane.cols - 1));
      rows(y, x) = sum;
    }
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x) {
      float sum = 0;
      for (int i = 0; i < 6; ++i)
        sum +=
            down.weights[static_cast<std::size_t>(i)] * rows(std::clamp(y + down.whole + i - 2, 0, plane.rows - 1), x);
      result(y, x) = sum;
    }
  return result;
}

cv::Size step_of(const Frame& frame, int plane) {
  return plane == 0 ? cv::Size(1, 1) : chroma_step(frame.layout);
}

cv::Mat1f floats(const cv::Mat& plane) {
  cv::Mat1f values;
  plane.convertTo(values, CV_32F);
  return values;
}

cv::Mat codes(const cv::Mat1f& plane) {
  cv::Mat rounded(plane.size(), CV_8UC1);
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      rounded.at<uchar>(y, x) = static_cast<uchar>(std::clamp(std::floor(plane(y, x) + 0.5F), 0.0F, 255.0F));
  return rounded;
}

cv::Point2d in_samples(cv::Point2d shift_px, cv::Size step) {
  return {shift_px.x / step.width, shift_px.y / step.height};
}

// The target's opacity in the samples of a plane, 0..1.
cv::Mat1f opacity_of_plane(const cv::Mat& opacity, const cv::Mat& plane) {
  cv::Mat small = opacity;
  if (opacity.size() != plane.size()) cv::resize(opacity, small, plane.size(), 0, 0, cv::INTER_AREA);
  cv::Mat1f share;
  small.convertTo(share, CV_32F, 1.0 / 255);
  return share;
}

// The image in which the target was somewhere else: what it adds to the background that it leaves is moved, and so is
// what it leaves of the background.
Frame earlier(const Frame& patch, const Frame& before, const cv::Mat& opacity, cv::Point2d shift_px) {
  Frame image = cloned(before);
  for (int i = 0; i < patch.plane_count(); ++i) {
    const auto which = static_cast<std::size_t>(i);
    const cv::Point2d shift = in_samples(shift_px, step_of(patch, i));
    const cv::Mat1f background = floats(before.planes[which]);
    const cv::Mat1f share = opacity_of_plane(opacity, before.planes[which]);
    cv::Mat1f added;
    cv::multiply(background, share, added);
    added += floats(patch.planes[which]);
    added -= background;
    cv::Mat1f there = moved(share, shift, cubic);
    cv::min(cv::max(there, 0.0F), 1.0F, there);
    cv::Mat1f sum = moved(added, shift, cubic);
    sum += background;
    cv::multiply(background, there, there);
    sum -= there;
    image.planes[which] = codes(sum);
  }
  return image;
}

Frame compensated(const Frame& decoded, cv::Point2d motion_px) {
  Frame image = cloned(decoded);
  for (int i = 0; i < decoded.plane_count(); ++i) {
    const auto which = static_cast<std::size_t>(i);
    const cv::Size step = step_of(decoded, i);
    image.planes[which] = codes(
        moved(floats(decoded.planes[which]), in_samples(motion_px, step), step == cv::Size(1, 1) ? six_taps : linear));
  }
  return image;
}

std::int64_t difference_of(const cv::Mat& a, const cv::Mat& b, const cv::Rect& block) {
  std::int64_t sum = 0;
  for (int y = block.y; y < block.br().y; ++y)
    for (int x = block.x; x < block.br().x; ++x) sum += std::abs(a.at<uchar>(y, x) - b.at<uchar>(y, x));
  return sum;
}

void copy_macroblock(const Frame& from, cv::Point at, Frame& to) {
  for (int i = 0; i < to.plane_count(); ++i) {
    const cv::Size step = step_of(to, i);
    const cv::Rect part(at.x / step.width, at.y / step.height, kBlock_px / step.width, kBlock_px / step.height);
    const auto which = static_cast<std::size_t>(i);
    from.planes[which](part).copyTo(to.planes[which](part));
  }
}

// What an encoder pays for a reference elsewhere, in the sum of luma's differences that it saves by it: some bits, each
// worth 0.4 quantiser steps (x264's lambda). How many: so that traces before sky and before ground are about x264's.
std::int64_t price_of_reference(const PatchCoding& coding, cv::Point macroblock) {
  constexpr double kBits = 128, kStepsOfBit = 0.4;
  const int quantiser = coding.quantisers.at<short>(macroblock);
  const double step = coding.kind == QuantiserKind::h264 ? std::exp2((quantiser - 4) / 6.0) : 2.0 * quantiser;
  return std::llround(kBits * kStepsOfBit * step);
}

// What a macroblock each is predicted from: the decoded image before, as it is or moved; or the background, which
// stands for what a search elsewhere in that image finds.
Frame prediction_of(const Frame& image, const Frame& decoded, const Frame& before, const PatchCoding& coding,
                    cv::Point2d motion_px) {
  const cv::Point2d quarters(std::round(4 * motion_px.x) / 4, std::round(4 * motion_px.y) / 4);
  Frame prediction = cloned(decoded);
  const Frame other = quarters == cv::Point2d(0, 0) ? decoded : compensated(decoded, quarters);
  for (int y = 0; y < image.planes[0].rows; y += kBlock_px)
    for (int x = 0; x < image.planes[0].cols; x += kBlock_px) {
      const cv::Rect block(x, y, kBlock_px, kBlock_px);
      const auto off = [&](const Frame& from) { return difference_of(image.planes[0], from.planes[0], block); };
      const std::int64_t in_place = off(decoded), moved_on = off(other);
      const std::int64_t price = price_of_reference(coding, {x / kBlock_px, y / kBlock_px});
      if (off(before) + price < std::min(moved_on, in_place))
        copy_macroblock(before, block.tl(), prediction);
      else if (moved_on < in_place)
        copy_macroblock(other, block.tl(), prediction);
    }
  return prediction;
}

}  // namespace

Frame recompressed(const Frame& patch, const Frame& before, const PatchCoding& coding) {
  const cv::Size size = patch.size_px();
  ENSURE(patch.layout == before.layout && size == before.size_px());
  ENSURE(size.width % kBlock_px == 0 && size.height % kBlock_px == 0);
  Frame coded = cloned(patch);
  if (coding.kind == QuantiserKind::none) return coded;
  ENSURE(coding.kind == QuantiserKind::jpeg || coding.quantisers.size() == size / kBlock_px);
  if (coding.kind == QuantiserKind::h264)
    code_h264(coded, before, coding);
  else
    for (int i = 0; i < coded.plane_count(); ++i) code_plane(coded, before, coding, static_cast<std::size_t>(i));
  return coded;
}

bool can_be_followed(cv::Point2d earlier_px) {
  return std::abs(earlier_px.x) <= kMaxCarriedMotion_px && std::abs(earlier_px.y) <= kMaxCarriedMotion_px;
}

Frame recompressed_after(const Frame& patch, const Frame& before, const PatchCoding& coding,
                         std::span<const cv::Point2d> earlier_px, const cv::Mat& opacity) {
  ENSURE(patch.layout == before.layout && patch.size_px() == before.size_px());
  ENSURE(opacity.size() == patch.size_px());
  const auto far_one = std::find_if_not(earlier_px.begin(), earlier_px.end(), can_be_followed);
  const auto count = static_cast<std::size_t>(far_one - earlier_px.begin());
  const bool predicts = coding.kind == QuantiserKind::h264 || coding.kind == QuantiserKind::mpeg;
  if (count == 0 || !predicts) return recompressed(patch, before, coding);
  Frame decoded = recompressed(earlier(patch, before, opacity, earlier_px[count - 1]), before, coding);
  for (std::size_t k = count; k-- > 0;) {
    const cv::Point2d now = k == 0 ? cv::Point2d(0, 0) : earlier_px[k - 1];
    const Frame image = k == 0 ? patch : earlier(patch, before, opacity, now);
    decoded = recompressed(image, prediction_of(image, decoded, before, coding, now - earlier_px[k]), coding);
  }
  return decoded;
}

}  // namespace sigs
