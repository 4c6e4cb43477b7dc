// SPDX-License-Identifier: MIT
#include "video/chroma.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace sigs {
namespace {

cv::Mat halved_columns(const cv::Mat& full, bool on_luma) {
  const int width = (full.cols + 1) / 2;
  cv::Mat half(full.rows, width, CV_32FC1);
  for (int y = 0; y < full.rows; ++y) {
    const float* in = full.ptr<float>(y);
    float* out = half.ptr<float>(y);
    for (int j = 0; j < width; ++j) {
      const float here = in[2 * j];
      const float right = in[std::min(2 * j + 1, full.cols - 1)];
      const float left = in[std::max(2 * j - 1, 0)];
      out[j] = on_luma ? 0.5F * here + 0.25F * (left + right) : 0.5F * (here + right);
    }
  }
  return half;
}

cv::Mat halved_rows(const cv::Mat& full, bool on_luma) {
  const int height = (full.rows + 1) / 2;
  cv::Mat half(height, full.cols, CV_32FC1);
  for (int j = 0; j < height; ++j) {
    const float* here = full.ptr<float>(2 * j);
    const float* below = full.ptr<float>(std::min(2 * j + 1, full.rows - 1));
    const float* above = full.ptr<float>(std::max(2 * j - 1, 0));
    float* out = half.ptr<float>(j);
    for (int x = 0; x < full.cols; ++x)
      out[x] = on_luma ? 0.5F * here[x] + 0.25F * (above[x] + below[x]) : 0.5F * (here[x] + below[x]);
  }
  return half;
}

}  // namespace

bool chroma_on_luma_column(ChromaSite site) {
  return site != ChromaSite::center;
}
bool chroma_on_luma_row(ChromaSite site) {
  return site == ChromaSite::top_left;
}

std::vector<ChromaTap> chroma_taps(int luma_size, int step, bool on_luma) {
  std::vector<ChromaTap> taps(static_cast<size_t>(luma_size));
  const int last = (luma_size + step - 1) / step - 1;
  for (int i = 0; i < luma_size; ++i) {
    ChromaTap& tap = taps[static_cast<size_t>(i)];
    if (step == 1) {
      tap = {i, i, 0};
    } else if (on_luma) {
      tap = {i / 2, std::min(i / 2 + 1, last), i % 2 == 0 ? 0.0F : 0.5F};
    } else {  // luma i lies at (i - 0.5) / 2 among the chroma samples
      const int first = i % 2 == 0 ? i / 2 - 1 : i / 2;
      tap = {std::max(first, 0), std::min(first + 1, last), i % 2 == 0 ? 0.75F : 0.25F};
    }
  }
  return taps;
}

std::vector<ChromaShare> chroma_shares(int luma_size, int step, bool on_luma) {
  std::vector<ChromaShare> shares(static_cast<size_t>(luma_size));
  const int last = luma_size - 1;
  for (int i = 0; i <= last; ++i) {
    ChromaShare& share = shares[static_cast<size_t>(i)];
    const bool is_even = i % 2 == 0;
    // Beyond the edge the outermost luma sample is repeated, so it has the weight of the missing one too.
    if (step == 1)
      share = {i, 1, 0};
    else if (!on_luma)
      share = {i / 2, is_even && i == last ? 1.0F : 0.5F, 0};
    else if (is_even)
      share = {i / 2, 0.5F + (i == 0 ? 0.25F : 0) + (i == last ? 0.25F : 0), 0};
    else
      share = {i / 2, 0.25F, i < last ? 0.25F : 0};
  }
  return shares;
}

cv::Mat shrunk_chroma(const cv::Mat& full, PixelLayout layout, ChromaSite site) {
  const cv::Size step = chroma_step(layout);
  cv::Mat chroma = full;
  if (step.width == 2) chroma = halved_columns(chroma, chroma_on_luma_column(site));
  if (step.height == 2) chroma = halved_rows(chroma, chroma_on_luma_row(site));
  return chroma;
}

cv::Size chroma_size(PixelLayout layout, cv::Size luma_size) {
  const cv::Size step = chroma_step(layout);
  return {(luma_size.width + step.width - 1) / step.width, (luma_size.height + step.height - 1) / step.height};
}

}  // namespace sigs
