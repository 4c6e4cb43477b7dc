// SPDX-License-Identifier: MIT
#include "compositor/area_reader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr int kChannels = 4;

// Code values of 8 bits, not rounded: red, green, blue, opacity.
cv::Mat codes_of(const cv::Mat& color) {
  cv::Mat codes;
  cv::sqrt(color.reshape(1), codes);
  for (int j = 0; j < codes.rows; ++j) {
    const float* const from = color.ptr<float>(j);
    float* const to = codes.ptr<float>(j);
    for (int i = 0; i < codes.cols; i += kChannels) {
      for (int c = 0; c < kChannels - 1; ++c) to[i + c] *= 255.0F;
      to[i + kChannels - 1] = 255.0F * from[i + kChannels - 1];
    }
  }
  return codes;
}

// Fills bends for i = kChannels .. size - kChannels - 1.
void find_bends(const cv::Mat& codes, int row, std::vector<float>& bends) {
  const float* const above = codes.ptr<float>(row - 1);
  const float* const here = codes.ptr<float>(row);
  const float* const below = codes.ptr<float>(row + 1);
  for (int i = kChannels; i < codes.cols - kChannels; ++i) {
    const float across = std::abs(here[i - kChannels] + here[i + kChannels] - 2 * here[i]);
    const float down = std::abs(above[i] + below[i] - 2 * here[i]);
    bends[static_cast<std::size_t>(i)] = across > down ? across : down;
  }
}

}  // namespace

cv::Mat bent_pixels(const Layer& layer, double max_bend_codes) {
  ENSURE(layer.color.type() == CV_32FC4 && layer.coverage.type() == CV_32FC1 && layer.color.isContinuous());
  cv::Mat bent = cv::Mat::zeros(layer.coverage.size(), CV_8UC1);
  const cv::Mat codes = codes_of(layer.color);
  const auto limit = static_cast<float>(max_bend_codes);
  std::vector<float> bends(static_cast<std::size_t>(codes.cols), 0.0F);
  for (int j = 1; j + 1 < bent.rows; ++j) {
    find_bends(codes, j, bends);
    const float* const above = layer.coverage.ptr<float>(j - 1);
    const float* const here = layer.coverage.ptr<float>(j);
    const float* const below = layer.coverage.ptr<float>(j + 1);
    unsigned char* const to = bent.ptr<unsigned char>(j);
    for (int i = 1; i + 1 < bent.cols; ++i) {
      const float* const four = &bends[static_cast<std::size_t>(kChannels) * static_cast<std::size_t>(i)];
      const float most = std::max(std::max(four[0], four[1]), std::max(four[2], four[3]));
      const bool is_even =
          here[i - 1] == here[i] && here[i + 1] == here[i] && above[i] == here[i] && below[i] == here[i];
      to[i] = is_even && most <= limit ? 0 : 255;
    }
  }
  return bent;
}

cv::Rect cells_touched(const CoarseView& view, const Quadrilateral& corners) {
  const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), glm::min(corners[2], corners[3]));
  const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), glm::max(corners[2], corners[3]));
  const cv::Size count = view.is_rough.size();
  const double cells_a_pixel = 1.0 / view.step;
  // AreaReader widens what is smaller than a pixel by up to a half on each side.
  const double margin = high.x - low.x < 2 || high.y - low.y < 2 ? 0.5 : 0.0;
  const glm::dvec2 first = (low - margin) * cells_a_pixel;
  const glm::dvec2 last = (high + margin) * cells_a_pixel;
  if (!(last.x > 0 && last.y > 0 && first.x < count.width && first.y < count.height)) return {};  // or no number
  const cv::Point from(static_cast<int>(std::max(first.x, 0.0)), static_cast<int>(std::max(first.y, 0.0)));
  const cv::Point end(std::min(static_cast<int>(std::min(last.x, 1e9)) + 1, count.width),
                      std::min(static_cast<int>(std::min(last.y, 1e9)) + 1, count.height));
  return {from, end};
}

bool is_rough_in(const CoarseView& view, const cv::Rect& cells) {
  unsigned char any = 0;
  for (int j = cells.y; j < cells.y + cells.height; ++j) {
    const unsigned char* const row = view.is_rough.ptr<unsigned char>(j);
    for (int i = cells.x; i < cells.x + cells.width; ++i) any |= row[i];
  }
  return any != 0;
}

AreaMean interpolated(const CoarseView& view, const Quadrilateral& corners) {
  using Channels [[gnu::vector_size(kChannels * sizeof(float))]] = float;
  const glm::dvec2 middle = (corners[0] + corners[1] + corners[2] + corners[3]) * (0.25 / view.step) - 0.5;
  const cv::Size size = view.layer.coverage.size();
  const auto x = static_cast<float>(std::clamp(middle.x, 0.0, double(size.width - 1)));
  const auto y = static_cast<float>(std::clamp(middle.y, 0.0, double(size.height - 1)));
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const int right = std::min(left + 1, size.width - 1);
  const int bottom = std::min(top + 1, size.height - 1);
  const auto at = [&](int row, int column) {
    Channels color;
    std::memcpy(&color, view.layer.color.ptr<cv::Vec4f>(row)[column].val, sizeof(color));
    return color;
  };
  const float across = x - static_cast<float>(left);
  const Channels above = at(top, left) + across * (at(top, right) - at(top, left));
  const Channels below = at(bottom, left) + across * (at(bottom, right) - at(bottom, left));
  const Channels mean = above + (y - static_cast<float>(top)) * (below - above);
  return {{mean[0], mean[1], mean[2], mean[3]}, view.layer.coverage.ptr<float>(top)[left]};  // coverage is even there
}

}  // namespace sigs
