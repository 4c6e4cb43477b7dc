// SPDX-License-Identifier: MIT
#include "video/frame.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "base/ensure.h"
#include "video/chroma.h"

namespace sigs {
namespace {

uchar code_of(float value) {
  return static_cast<uchar>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
}

float between(float first, float second, float share) {
  return first + share * (second - first);
}

// Chroma at every luma sample of a row, as code values. What chroma_taps says, in loops that compilers turn into
// vector instructions.
class ChromaReader {
 public:
  explicit ChromaReader(const Frame& frame)
      : step_(chroma_step(frame.layout).width),
        on_luma_(chroma_on_luma_column(frame.color.chroma_site)),
        rows_(chroma_taps(frame.size_px().height, chroma_step(frame.layout).height,
                          chroma_on_luma_row(frame.color.chroma_site))) {}

  // Leaves at least as many values as the row has pixels.
  void read(const cv::Mat& plane, int y, std::vector<float>& samples, std::vector<float>& out) const {
    read_samples(plane, rows_[static_cast<size_t>(y)], samples);
    const auto count = static_cast<size_t>(plane.cols);
    const float* here = samples.data() + 1;
    out.resize(count * static_cast<size_t>(step_));
    float* const to = out.data();
    if (step_ == 1) {
      std::copy_n(here, count, to);
    } else if (on_luma_) {
      for (size_t x = 0; x < count; ++x) {
        to[2 * x] = here[x];
        to[2 * x + 1] = between(here[x], here[x + 1], 0.5F);
      }
    } else {
      for (size_t x = 0; x < count; ++x) {
        to[2 * x] = between(here[x - 1], here[x], 0.75F);
        to[2 * x + 1] = between(here[x], here[x + 1], 0.25F);
      }
    }
  }

 private:
  // The chroma row between two of the plane's, its ends repeated once on either side.
  static void read_samples(const cv::Mat& plane, const ChromaTap& row, std::vector<float>& samples) {
    const uchar* first = plane.ptr<uchar>(row.first);
    const uchar* second = plane.ptr<uchar>(row.second);
    const auto count = static_cast<size_t>(plane.cols);
    samples.resize(count + 2);
    float* const to = samples.data() + 1;
    for (size_t x = 0; x < count; ++x)
      to[x] = static_cast<float>(first[x]) + row.share * static_cast<float>(second[x] - first[x]);
    samples.front() = to[0];
    samples.back() = to[count - 1];
  }

  int step_;
  bool on_luma_;
  std::vector<ChromaTap> rows_;
};

cv::Mat bgr_of_gray(const Frame& frame) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  cv::Mat lut(1, 256, CV_8UC1);
  for (int code = 0; code < 256; ++code)
    lut.at<uchar>(code) = code_of(255.0F * map.to_rgb(0, 0) * (static_cast<float>(code) - map.offset[0]));
  cv::Mat value;
  cv::LUT(frame.planes[0], lut, value);
  cv::Mat bgr;
  cv::merge(std::vector<cv::Mat>{value, value, value}, bgr);
  return bgr;
}

cv::Mat bgr_of_rgb(const Frame& frame) {
  cv::Mat bgr;
  cv::merge(std::vector<cv::Mat>{frame.planes[2], frame.planes[1], frame.planes[0]}, bgr);
  return bgr;
}

uchar converted(const cv::Matx33f& m, int row, float y, float u, float v) {
  return code_of(m(row, 0) * y + m(row, 1) * u + m(row, 2) * v);
}

void convert_row(const uchar* luma, const float* cb, const float* cr, int width, const CodeToRgb& map, uchar* bgr) {
  const cv::Matx33f m = map.to_rgb * 255.0F;
  for (int x = 0; x < width; ++x) {
    const float y = static_cast<float>(luma[x]) - map.offset[0];
    const float u = cb[x] - map.offset[1];
    const float v = cr[x] - map.offset[2];
    for (int c = 0; c < 3; ++c) bgr[3 * x + c] = converted(m, 2 - c, y, u, v);
  }
}

cv::Mat bgr_of_ycbcr(const Frame& frame) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  const ChromaReader chroma(frame);
  cv::Mat bgr(frame.size_px(), CV_8UC3);
  cv::parallel_for_({0, bgr.rows}, [&](const cv::Range& rows) {
    std::vector<float> samples, cb, cr;
    for (int y = rows.start; y < rows.end; ++y) {
      chroma.read(frame.planes[1], y, samples, cb);
      chroma.read(frame.planes[2], y, samples, cr);
      convert_row(frame.planes[0].ptr<uchar>(y), cb.data(), cr.data(), bgr.cols, map, bgr.ptr<uchar>(y));
    }
  });
  return bgr;
}

cv::Mat rounded(const cv::Mat& values) {
  cv::Mat codes(values.size(), CV_8UC1);
  for (int y = 0; y < values.rows; ++y)
    std::transform(values.ptr<float>(y), values.ptr<float>(y) + values.cols, codes.ptr<uchar>(y), code_of);
  return codes;
}

// Row `which` of the code matrix applied to every pixel, not rounded.
cv::Mat component(const cv::Mat& bgr, const CodeToRgb& map, int which) {
  const cv::Matx33f m = map.from_rgb * (1.0F / 255.0F);
  cv::Mat values(bgr.size(), CV_32FC1);
  for (int y = 0; y < bgr.rows; ++y) {
    const uchar* in = bgr.ptr<uchar>(y);
    float* out = values.ptr<float>(y);
    for (int x = 0; x < bgr.cols; ++x, in += 3)
      out[x] = m(which, 0) * static_cast<float>(in[2]) + m(which, 1) * static_cast<float>(in[1]) +
               m(which, 2) * static_cast<float>(in[0]) + map.offset[which];
  }
  return values;
}

}  // namespace

cv::Mat bgr_of(const Frame& frame) {
  ENSURE(!frame.planes[0].empty());
  if (frame.layout == PixelLayout::gray) return bgr_of_gray(frame);
  if (frame.layout == PixelLayout::rgb) return bgr_of_rgb(frame);
  return bgr_of_ycbcr(frame);
}

Frame frame_of_bgr(const cv::Mat& bgr, PixelLayout layout, const ColorInfo& color) {
  ENSURE(bgr.type() == CV_8UC3 && !bgr.empty());
  Frame frame{.layout = layout, .color = color};
  if (layout == PixelLayout::rgb) {
    for (int i = 0; i < 3; ++i) cv::extractChannel(bgr, frame.planes[static_cast<size_t>(i)], 2 - i);
    return frame;
  }
  const CodeToRgb map = code_to_rgb(layout, color);
  frame.planes[0] = rounded(component(bgr, map, 0));
  if (layout == PixelLayout::gray) return frame;
  for (int i = 1; i < 3; ++i)
    frame.planes[static_cast<size_t>(i)] = rounded(shrunk_chroma(component(bgr, map, i), layout, color.chroma_site));
  return frame;
}

}  // namespace sigs
