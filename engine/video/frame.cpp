// SPDX-License-Identifier: MIT
#include "video/frame.h"

#include <algorithm>
#include <array>
#include <opencv2/core/hal/intrin.hpp>
#include <type_traits>
#include <vector>

#include "base/ensure.h"
#include "video/chroma.h"
#include "video/frame_quantisers.h"

namespace sigs {

namespace {

// The colour matrices.

// Share of red, green and blue in luma: Rec. ITU-T H.273, table 4 (MatrixCoefficients 6, 1 and 9).
struct LumaShares {
  double red = 0;
  double green = 0;
  double blue = 0;
};

LumaShares luma_shares(ColorMatrix matrix) {
  // Shares of red and blue, in the order of ColorMatrix.
  static constexpr std::array<std::array<double, 2>, 3> kRedBlue{{{0.299, 0.114}, {0.2126, 0.0722}, {0.2627, 0.0593}}};
  const auto& [red, blue] = kRedBlue.at(static_cast<std::size_t>(matrix));
  return {red, 1 - red - blue, blue};
}

// How many code values luma 0..1 and a colour difference of -0.5..0.5 span: H.273, equations 20 to 31.
struct Quantiser {
  double luma_scale = 0;
  double luma_offset = 0;
  double chroma_scale = 0;
  double chroma_offset = 0;
};

Quantiser quantiser(ColorRange range, int bit_depth) {
  const double top = max_code(bit_depth);
  const double step = codes_per_8_bit_step(bit_depth);
  const double middle = 128 * step;
  if (range == ColorRange::full)
    return {.luma_scale = top, .luma_offset = 0, .chroma_scale = top, .chroma_offset = middle};
  return {.luma_scale = 219 * step, .luma_offset = 16 * step, .chroma_scale = 224 * step, .chroma_offset = middle};
}

CodeToRgb rgb_map(int bit_depth) {
  const auto top = static_cast<float>(max_code(bit_depth));
  return {cv::Matx33f::eye() * (1.0F / top), cv::Matx33f::eye() * top, cv::Vec3f(0, 0, 0)};
}

CodeToRgb gray_map(const LumaShares& k, const Quantiser& q) {
  const double s = 1 / q.luma_scale;
  const cv::Matx33d to_rgb(s, 0, 0, s, 0, 0, s, 0, 0);
  const cv::Matx33d from_rgb(k.red * q.luma_scale, k.green * q.luma_scale, k.blue * q.luma_scale, 0, 0, 0, 0, 0, 0);
  return {to_rgb, from_rgb, cv::Vec3f(static_cast<float>(q.luma_offset), 0, 0)};
}

// H.273, equations 38 to 40 and their inverse: E'Cb = (E'B - E'Y) / (2 (1 - KB)), E'Cr = (E'R - E'Y) / (2 (1 - KR)).
CodeToRgb ycbcr_map(const LumaShares& k, const Quantiser& q) {
  const double blue_span = 2 * (1 - k.blue);
  const double red_span = 2 * (1 - k.red);
  const cv::Matx33d rgb_of_ycc(1, 0, red_span,                                                 //
                               1, -k.blue * blue_span / k.green, -k.red * red_span / k.green,  //
                               1, blue_span, 0);
  const cv::Matx33d ycc_of_rgb(k.red, k.green, k.blue,                                              //
                               -k.red / blue_span, -k.green / blue_span, (1 - k.blue) / blue_span,  //
                               (1 - k.red) / red_span, -k.green / red_span, -k.blue / red_span);
  const cv::Matx33d scale(q.luma_scale, 0, 0, 0, q.chroma_scale, 0, 0, 0, q.chroma_scale);
  const cv::Matx33d unscale(1 / q.luma_scale, 0, 0, 0, 1 / q.chroma_scale, 0, 0, 0, 1 / q.chroma_scale);
  return {rgb_of_ycc * unscale, scale * ycc_of_rgb,
          cv::Vec3f(static_cast<float>(q.luma_offset), static_cast<float>(q.chroma_offset),
                    static_cast<float>(q.chroma_offset))};
}

// Whole images as BGR, and back.

template <class Sample>
Sample code_of(float value, float top) {
  return static_cast<Sample>(std::clamp(value, 0.0F, top) + 0.5F);
}

// White in a BGR image of this sample type.
template <class Sample>
constexpr float kWhite = sizeof(Sample) == 1 ? 255.0F : 65535.0F;

template <class Sample>
constexpr int kBgrType = sizeof(Sample) == 1 ? CV_8UC3 : CV_16UC3;

template <class In, class Out>
cv::Mat bgr_of_gray(const Frame& frame) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color, frame.bit_depth);
  std::vector<Out> values(static_cast<size_t>(max_code(frame.bit_depth)) + 1);
  for (size_t code = 0; code < values.size(); ++code)
    values[code] =
        code_of<Out>(kWhite<Out> * map.to_rgb(0, 0) * (static_cast<float>(code) - map.offset[0]), kWhite<Out>);
  const size_t mask = values.size() - 1;
  cv::Mat bgr(frame.size_px(), kBgrType<Out>);
  for (int y = 0; y < bgr.rows; ++y) {
    const In* const in = frame.planes[0].ptr<In>(y);
    Out* const out = bgr.ptr<Out>(y);
    for (int x = 0; x < bgr.cols; ++x) out[3 * x] = out[3 * x + 1] = out[3 * x + 2] = values[in[x] & mask];
  }
  return bgr;
}

cv::Mat bgr_of_rgb(const Frame& frame) {
  cv::Mat bgr;
  cv::merge(std::vector<cv::Mat>{frame.planes[2], frame.planes[1], frame.planes[0]}, bgr);
  return bgr;
}

// Rows of blue, green and red, not rounded, in loops that compilers turn into vector instructions.
template <class In>
void convert_row(const In* luma, const float* cb, const float* cr, int width, const CodeToRgb& map,
                 const cv::Matx33f& to_rgb, std::array<std::vector<float>, 3>& bgr) {
  const cv::Vec3f offset = map.offset;
  for (int c = 0; c < 3; ++c) {
    const float of_y = to_rgb(2 - c, 0), of_u = to_rgb(2 - c, 1), of_v = to_rgb(2 - c, 2);
    bgr[static_cast<std::size_t>(c)].resize(static_cast<std::size_t>(width));
    float* const to = bgr[static_cast<std::size_t>(c)].data();
    for (int x = 0; x < width; ++x)
      to[x] =
          of_y * (static_cast<float>(luma[x]) - offset[0]) + of_u * (cb[x] - offset[1]) + of_v * (cr[x] - offset[2]);
  }
}

// code_of() of as many values as a vector has: packing clamps them.
cv::v_int32x4 rounded_at(const float* values) {
  return cv::v_trunc(cv::v_load(values) + cv::v_setall_f32(0.5F));
}

void codes_at(const float* values, cv::v_uint16x8& codes) {
  codes = cv::v_pack_u(rounded_at(values), rounded_at(values + 4));
}

void codes_at(const float* values, cv::v_uint8x16& codes) {
  codes = cv::v_pack_u(cv::v_pack(rounded_at(values), rounded_at(values + 4)),
                       cv::v_pack(rounded_at(values + 8), rounded_at(values + 12)));
}

template <class Out>
void write_row(const std::array<std::vector<float>, 3>& bgr, int width, Out* to) {
  using Codes = std::conditional_t<sizeof(Out) == 1, cv::v_uint8x16, cv::v_uint16x8>;
  int x = 0;
  for (; x + Codes::nlanes <= width; x += Codes::nlanes) {
    std::array<Codes, 3> codes;
    for (std::size_t c = 0; c < 3; ++c) codes_at(bgr[c].data() + x, codes[c]);
    cv::v_store_interleave(to + 3 * x, codes[0], codes[1], codes[2]);
  }
  for (; x < width; ++x)
    for (std::size_t c = 0; c < 3; ++c)
      to[3 * x + static_cast<int>(c)] = code_of<Out>(bgr[c][static_cast<std::size_t>(x)], kWhite<Out>);
}

template <class In, class Out>
cv::Mat bgr_of_ycbcr(const Frame& frame) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color, frame.bit_depth);
  const cv::Matx33f to_rgb = map.to_rgb * kWhite<Out>;
  const ChromaReader<In> chroma(frame);
  cv::Mat bgr(frame.size_px(), kBgrType<Out>);
  cv::parallel_for_({0, bgr.rows}, [&](const cv::Range& rows) {
    std::vector<float> samples, cb, cr;
    std::array<std::vector<float>, 3> values;
    for (int y = rows.start; y < rows.end; ++y) {
      chroma.read(frame.planes[1], y, samples, cb);
      chroma.read(frame.planes[2], y, samples, cr);
      convert_row(frame.planes[0].ptr<In>(y), cb.data(), cr.data(), bgr.cols, map, to_rgb, values);
      write_row(values, bgr.cols, bgr.ptr<Out>(y));
    }
  });
  return bgr;
}

template <class Out>
cv::Mat bgr_as(const Frame& frame) {
  ENSURE(!frame.planes[0].empty());
  if (frame.layout == PixelLayout::rgb) return bgr_of_rgb(with_bit_depth(frame, 8 * static_cast<int>(sizeof(Out))));
  return with_sample_type(frame.bit_depth, [&](auto sample) {
    using In = decltype(sample);
    return frame.layout == PixelLayout::gray ? bgr_of_gray<In, Out>(frame) : bgr_of_ycbcr<In, Out>(frame);
  });
}

template <class Out>
cv::Mat rounded(const cv::Mat& values, int bit_depth) {
  const auto top = static_cast<float>(max_code(bit_depth));
  cv::Mat codes(values.size(), plane_type(bit_depth));
  for (int y = 0; y < values.rows; ++y)
    std::transform(values.ptr<float>(y), values.ptr<float>(y) + values.cols, codes.ptr<Out>(y),
                   [top](float value) { return code_of<Out>(value, top); });
  return codes;
}

// Row `which` of the code matrix applied to every pixel, not rounded.
template <class In>
cv::Mat component(const cv::Mat& bgr, const CodeToRgb& map, int which) {
  const cv::Matx33f m = map.from_rgb * (1.0F / kWhite<In>);
  cv::Mat values(bgr.size(), CV_32FC1);
  for (int y = 0; y < bgr.rows; ++y) {
    const In* in = bgr.ptr<In>(y);
    float* out = values.ptr<float>(y);
    for (int x = 0; x < bgr.cols; ++x, in += 3)
      out[x] = m(which, 0) * static_cast<float>(in[2]) + m(which, 1) * static_cast<float>(in[1]) +
               m(which, 2) * static_cast<float>(in[0]) + map.offset[which];
  }
  return values;
}

cv::Mat component_of(const cv::Mat& bgr, const CodeToRgb& map, int which) {
  return bgr.depth() == CV_8U ? component<uchar>(bgr, map, which) : component<ushort>(bgr, map, which);
}

cv::Mat codes_of(const cv::Mat& values, int bit_depth) {
  return with_sample_type(bit_depth, [&](auto sample) { return rounded<decltype(sample)>(values, bit_depth); });
}

Frame rgb_frame_of(const cv::Mat& bgr, const ColorInfo& color, int bit_depth) {
  Frame frame{.layout = PixelLayout::rgb, .bit_depth = bgr.depth() == CV_8U ? 8 : 16, .color = color};
  for (int i = 0; i < 3; ++i) cv::extractChannel(bgr, frame.planes[static_cast<size_t>(i)], 2 - i);
  return with_bit_depth(frame, bit_depth);
}

// Codes of one depth by those of another.
struct DepthChange {
  int from = 8;
  int to = 8;
  bool is_full_range = false;
  bool is_chroma = false;
};

template <class To>
std::vector<To> code_table(const DepthChange& change) {
  const double from_top = max_code(change.from);
  const double to_top = max_code(change.to);
  const double from_middle = change.is_chroma ? 1 << (change.from - 1) : 0;
  const double to_middle = change.is_chroma ? 1 << (change.to - 1) : 0;
  const double scale = change.is_full_range ? to_top / from_top : double(1 << change.to) / double(1 << change.from);
  std::vector<To> table(std::size_t{1} << change.from);
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double value = (static_cast<double>(code) - from_middle) * scale + to_middle;
    table[code] = static_cast<To>(std::clamp(value + 0.5, 0.0, to_top));
  }
  return table;
}

template <class From, class To>
cv::Mat replaced(const cv::Mat& plane, const DepthChange& change) {
  const std::vector<To> table = code_table<To>(change);
  const std::size_t mask = table.size() - 1;  // codes beyond the depth do not exist; nothing is read beyond the table
  cv::Mat out(plane.size(), plane_type(change.to));
  for (int y = 0; y < plane.rows; ++y)
    std::transform(plane.ptr<From>(y), plane.ptr<From>(y) + plane.cols, out.ptr<To>(y),
                   [&](From code) { return table[code & mask]; });
  return out;
}

}  // namespace

CodeToRgb code_to_rgb(PixelLayout layout, const ColorInfo& color, int bit_depth) {
  if (layout == PixelLayout::rgb) return rgb_map(bit_depth);
  const LumaShares shares = luma_shares(color.matrix);
  const Quantiser steps = quantiser(color.range, bit_depth);
  return layout == PixelLayout::gray ? gray_map(shares, steps) : ycbcr_map(shares, steps);
}

Frame cloned(const Frame& frame) {
  Frame copy = frame;
  for (cv::Mat& plane : copy.planes) plane = plane.clone();
  return copy;
}

Frame part_of(const Frame& frame, const cv::Rect& part) {
  const cv::Size step = chroma_step(frame.layout);
  Frame out = frame;
  out.coded.reset();
  for (std::size_t i = 0; i < out.planes.size(); ++i) {
    cv::Mat& plane = out.planes[i];
    if (plane.empty()) continue;
    const cv::Rect here =
        i == 0 ? part : cv::Rect({part.x / step.width, part.y / step.height}, chroma_size(frame.layout, part.size()));
    plane = plane(here).clone();
  }
  out.quantisers = part_of(frame.quantisers, part);
  return out;
}

Frame blank_frame(PixelLayout layout, cv::Size size_px, const ColorInfo& color, int bit_depth) {
  Frame frame{.layout = layout, .bit_depth = bit_depth, .color = color};
  for (int i = 0; i < frame.plane_count(); ++i)
    frame.planes[static_cast<size_t>(i)] =
        cv::Mat::zeros(i == 0 ? size_px : chroma_size(layout, size_px), plane_type(bit_depth));
  return frame;
}

cv::Size chroma_step(PixelLayout layout) {
  return {layout == PixelLayout::yuv420 || layout == PixelLayout::yuv422 ? 2 : 1,
          layout == PixelLayout::yuv420 ? 2 : 1};
}

cv::Mat bgr_of(const Frame& frame) {
  return bgr_as<uchar>(frame);
}

cv::Mat bgr16_of(const Frame& frame) {
  return bgr_as<ushort>(frame);
}

Frame frame_of_bgr(const cv::Mat& bgr, PixelLayout layout, const ColorInfo& color, int bit_depth) {
  ENSURE((bgr.type() == CV_8UC3 || bgr.type() == CV_16UC3) && !bgr.empty());
  if (layout == PixelLayout::rgb) return rgb_frame_of(bgr, color, bit_depth);
  Frame frame{.layout = layout, .bit_depth = bit_depth, .color = color};
  const CodeToRgb map = code_to_rgb(layout, color, bit_depth);
  frame.planes[0] = codes_of(component_of(bgr, map, 0), bit_depth);
  if (layout == PixelLayout::gray) return frame;
  for (int i = 1; i < 3; ++i)
    frame.planes[static_cast<size_t>(i)] =
        codes_of(shrunk_chroma(component_of(bgr, map, i), layout, color.chroma_site), bit_depth);
  return frame;
}

Frame with_bit_depth(const Frame& frame, int bit_depth) {
  ENSURE(bit_depth >= 8 && bit_depth <= 16);
  if (frame.bit_depth == bit_depth) return frame;
  Frame out = frame;
  out.bit_depth = bit_depth;
  const bool is_rgb = frame.layout == PixelLayout::rgb;
  for (int i = 0; i < frame.plane_count(); ++i) {
    const DepthChange change{.from = frame.bit_depth,
                             .to = bit_depth,
                             .is_full_range = is_rgb || frame.color.range == ColorRange::full,
                             .is_chroma = i > 0 && !is_rgb};
    const auto index = static_cast<std::size_t>(i);
    out.planes[index] = with_sample_type(frame.bit_depth, [&](auto from) {
      return with_sample_type(
          bit_depth, [&](auto to) { return replaced<decltype(from), decltype(to)>(frame.planes[index], change); });
    });
  }
  return out;
}

}  // namespace sigs
