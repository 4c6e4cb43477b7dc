// SPDX-License-Identifier: MIT
#include "video/carried_recompression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr int kBlock_px = FrameQuantisers::kBlock_px;

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

// The image in which the target was somewhere else.
Frame earlier(const Frame& patch, const Frame& before, cv::Point2d shift_px) {
  Frame image = cloned(before);
  for (int i = 0; i < patch.plane_count(); ++i) {
    const auto which = static_cast<std::size_t>(i);
    const cv::Mat1f background = floats(before.planes[which]);
    cv::Mat1f difference = floats(patch.planes[which]);
    difference -= background;
    cv::Mat1f sum = moved(difference, in_samples(shift_px, step_of(patch, i)), cubic);
    sum += background;
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

// What a macroblock each is predicted from: the decoded image before, as it is or moved.
Frame prediction_of(const Frame& image, const Frame& decoded, cv::Point2d motion_px) {
  const cv::Point2d quarters(std::round(4 * motion_px.x) / 4, std::round(4 * motion_px.y) / 4);
  Frame prediction = cloned(decoded);
  if (quarters == cv::Point2d(0, 0)) return prediction;
  const Frame other = compensated(decoded, quarters);
  for (int y = 0; y < image.planes[0].rows; y += kBlock_px)
    for (int x = 0; x < image.planes[0].cols; x += kBlock_px) {
      const cv::Rect block(x, y, kBlock_px, kBlock_px);
      if (difference_of(image.planes[0], other.planes[0], block) >=
          difference_of(image.planes[0], decoded.planes[0], block))
        continue;
      for (int i = 0; i < image.plane_count(); ++i) {
        const cv::Size step = step_of(image, i);
        const cv::Rect part(x / step.width, y / step.height, kBlock_px / step.width, kBlock_px / step.height);
        const auto which = static_cast<std::size_t>(i);
        other.planes[which](part).copyTo(prediction.planes[which](part));
      }
    }
  return prediction;
}

}  // namespace

bool can_be_followed(cv::Point2d earlier_px) {
  return std::abs(earlier_px.x) <= kMaxCarriedMotion_px && std::abs(earlier_px.y) <= kMaxCarriedMotion_px;
}

Frame recompressed_after(const Frame& patch, const Frame& before, const PatchCoding& coding,
                         std::span<const cv::Point2d> earlier_px) {
  ENSURE(patch.layout == before.layout && patch.size_px() == before.size_px());
  const auto far_one = std::find_if_not(earlier_px.begin(), earlier_px.end(), can_be_followed);
  const auto count = static_cast<std::size_t>(far_one - earlier_px.begin());
  const bool predicts = coding.kind == QuantiserKind::h264 || coding.kind == QuantiserKind::mpeg;
  if (count == 0 || !predicts) return recompressed(patch, before, coding);
  Frame decoded = recompressed(earlier(patch, before, earlier_px[count - 1]), before, coding);
  for (std::size_t k = count; k-- > 0;) {
    const cv::Point2d now = k == 0 ? cv::Point2d(0, 0) : earlier_px[k - 1];
    const Frame image = k == 0 ? patch : earlier(patch, before, now);
    decoded = recompressed(image, prediction_of(image, decoded, now - earlier_px[k]), coding);
  }
  return decoded;
}

}  // namespace sigs
