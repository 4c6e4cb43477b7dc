// SPDX-License-Identifier: MIT
#include "video/libav/planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <vector>

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include "base/ensure.h"
#include "video/chroma.h"

namespace sigs::libav {
namespace {

constexpr uint64_t kSpecialFlags = AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL |
                                   AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_FLOAT;

const AVPixFmtDescriptor& descriptor_of(AVPixelFormat format) {
  const AVPixFmtDescriptor* descriptor = av_pix_fmt_desc_get(format);
  ENSURE(descriptor != nullptr);
  return *descriptor;
}

bool is_rgb(const AVPixFmtDescriptor& format) {
  return (format.flags & AV_PIX_FMT_FLAG_RGB) != 0;
}

// The layout with the same components and chroma subsampling, if there is one.
std::optional<PixelLayout> same_layout(const AVPixFmtDescriptor& format) {
  const cv::Size step(1 << format.log2_chroma_w, 1 << format.log2_chroma_h);
  if (format.nb_components < 3) return PixelLayout::gray;
  if (is_rgb(format)) return PixelLayout::rgb;
  if (step == cv::Size(2, 2)) return PixelLayout::yuv420;
  if (step == cv::Size(2, 1)) return PixelLayout::yuv422;
  if (step == cv::Size(1, 1)) return PixelLayout::yuv444;
  return std::nullopt;
}

// Whether samples can be picked one by one: whole bytes, or whole 16-bit words of this machine's byte order.
bool can_pick(const AVPixFmtDescriptor& format) {
  const std::optional<PixelLayout> layout = same_layout(format);
  if ((format.flags & kSpecialFlags) != 0 || !layout) return false;
  if (std::string_view(format.name).starts_with("xyz")) return false;
  const int depth = format.comp[0].depth;
  for (int i = 0; i < plane_count(*layout); ++i)
    if (format.comp[i].depth != depth) return false;
  if (depth == 8) return true;
  const bool big_endian = (format.flags & AV_PIX_FMT_FLAG_BE) != 0;
  return depth > 8 && depth <= 16 && big_endian == (std::endian::native == std::endian::big);
}

PixelLayout nearest_layout(const AVPixFmtDescriptor& format) {
  if ((format.flags & (AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BAYER)) != 0 || is_rgb(format)) return PixelLayout::rgb;
  if (std::string_view(format.name).starts_with("xyz")) return PixelLayout::rgb;
  if (const std::optional<PixelLayout> same = same_layout(format)) return *same;
  // Chroma subsampled in y alone (4:4:0) becomes 4:4:4, otherwise in y 4:2:0, by more than 2 in x (4:1:1) 4:2:2.
  if (format.log2_chroma_h >= 1) return format.log2_chroma_w == 0 ? PixelLayout::yuv444 : PixelLayout::yuv420;
  return PixelLayout::yuv422;
}

AVPixelFormat plain_format(PixelLayout layout) {
  switch (layout) {
    case PixelLayout::gray:
      return AV_PIX_FMT_GRAY8;
    case PixelLayout::yuv420:
      return AV_PIX_FMT_YUV420P;
    case PixelLayout::yuv422:
      return AV_PIX_FMT_YUV422P;
    case PixelLayout::yuv444:
      return AV_PIX_FMT_YUV444P;
    case PixelLayout::rgb:
      break;
  }
  return AV_PIX_FMT_RGB24;
}

// Deeper codes to 8 bits within the same range. Limited range: a code of d bits is the 8-bit one times 2^(d - 8).
// Full range: 0..2^d - 1 becomes 0..255, chroma about its own middle.
std::vector<uchar> rounding_table(int depth, bool is_chroma, ColorRange range) {
  const double top = (1 << depth) - 1;
  const double middle = is_chroma ? 1 << (depth - 1) : 0;
  const double scale = range == ColorRange::full ? 255 / top : 1.0 / (1 << (depth - 8));
  std::vector<uchar> table(size_t{1} << depth);
  for (size_t code = 0; code < table.size(); ++code) {
    const double value = (static_cast<double>(code) - middle) * scale + (is_chroma ? 128 : 0);
    table[code] = static_cast<uchar>(std::clamp(value + 0.5, 0.0, 255.0));
  }
  return table;
}

const uchar* sample_row(const AVFrame& image, const AVComponentDescriptor& component, int y) {
  return image.data[component.plane] + static_cast<ptrdiff_t>(y) * image.linesize[component.plane] + component.offset;
}

cv::Mat picked_bytes(const AVFrame& image, const AVComponentDescriptor& component, cv::Size size) {
  cv::Mat plane(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    const uchar* in = sample_row(image, component, y);
    uchar* out = plane.ptr<uchar>(y);
    if (component.step == 1)
      std::memcpy(out, in, static_cast<size_t>(size.width));
    else
      for (int x = 0; x < size.width; ++x) out[x] = in[x * component.step];
  }
  return plane;
}

cv::Mat picked_words(const AVFrame& image, const AVComponentDescriptor& component, cv::Size size,
                     const std::vector<uchar>& table) {
  cv::Mat plane(size, CV_8UC1);
  const size_t mask = table.size() - 1;
  for (int y = 0; y < size.height; ++y) {
    const uchar* in = sample_row(image, component, y);
    uchar* out = plane.ptr<uchar>(y);
    for (int x = 0; x < size.width; ++x, in += component.step) {
      uint16_t word = 0;
      std::memcpy(&word, in, sizeof word);
      out[x] = table[(word >> component.shift) & mask];
    }
  }
  return plane;
}

Frame picked(const AVFrame& image, const AVPixFmtDescriptor& format, PixelLayout layout, const ColorInfo& color) {
  Frame frame{.layout = layout, .color = color};
  const cv::Size size(image.width, image.height);
  const ColorRange range = layout == PixelLayout::rgb ? ColorRange::full : color.range;
  for (int i = 0; i < plane_count(layout); ++i) {
    const AVComponentDescriptor& component = format.comp[i];
    const bool is_chroma = i > 0 && layout != PixelLayout::rgb;
    const cv::Size plane_size = is_chroma ? chroma_size(layout, size) : size;
    frame.planes[static_cast<size_t>(i)] =
        component.depth == 8
            ? picked_bytes(image, component, plane_size)
            : picked_words(image, component, plane_size, rounding_table(component.depth, is_chroma, range));
  }
  return frame;
}

// The image of a palette format: data[1] has 256 words of opacity, red, green and blue, from the highest byte down.
Frame looked_up(const AVFrame& image, const ColorInfo& color) {
  Frame frame{.layout = PixelLayout::rgb, .color = color};
  for (cv::Mat& plane : frame.planes) plane.create(image.height, image.width, CV_8UC1);
  for (int y = 0; y < image.height; ++y) {
    const uchar* in = image.data[0] + static_cast<ptrdiff_t>(y) * image.linesize[0];
    for (int x = 0; x < image.width; ++x) {
      uint32_t word = 0;
      std::memcpy(&word, image.data[1] + 4 * in[x], sizeof word);
      for (int i = 0; i < 3; ++i)
        frame.planes[static_cast<size_t>(i)].at<uchar>(y, x) = static_cast<uchar>(word >> (16 - 8 * i));
    }
  }
  return frame;
}

// Sets the same range on both sides, so that swscale only rearranges and resamples.
void keep_range(SwsContext& scaler, ColorRange range) {
  const int full = range == ColorRange::full ? 1 : 0;
  const int* coefficients = sws_getCoefficients(SWS_CS_DEFAULT);
  sws_setColorspaceDetails(&scaler, coefficients, full, coefficients, full, 0, 1 << 16, 1 << 16);
}

Result<FramePtr> scaled(const AVFrame& image, PixelLayout layout, ColorRange range) {
  FramePtr plain = new_frame();
  plain->format = plain_format(layout);
  plain->width = image.width;
  plain->height = image.height;
  if (av_frame_get_buffer(plain.get(), 0) < 0) throw std::bad_alloc();
  const ScalerPtr scaler(sws_getContext(image.width, image.height, static_cast<AVPixelFormat>(image.format),
                                        plain->width, plain->height, static_cast<AVPixelFormat>(plain->format),
                                        SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT, nullptr,
                                        nullptr, nullptr));
  if (scaler == nullptr)
    return fail("", fmt::format("the pixel format {} cannot be converted to 8-bit planes",
                                av_get_pix_fmt_name(static_cast<AVPixelFormat>(image.format))));
  keep_range(*scaler, range);
  sws_scale(scaler.get(), image.data, image.linesize, 0, image.height, plain->data, plain->linesize);
  return plain;
}

void release_plane(void* plane, uint8_t* /*samples*/) {
  delete static_cast<cv::Mat*>(plane);
}

// A buffer that keeps the plane's samples alive until FFmpeg drops the last reference to it.
AVBufferRef* buffer_of(const cv::Mat& plane) {
  auto held = std::make_unique<cv::Mat>(plane);
  const size_t bytes = static_cast<size_t>(plane.rows - 1) * plane.step + static_cast<size_t>(plane.cols);
  AVBufferRef* share = av_buffer_create(plane.data, bytes, release_plane, held.get(), AV_BUFFER_FLAG_READONLY);
  if (share == nullptr) throw std::bad_alloc();
  static_cast<void>(held.release());
  return share;
}

}  // namespace

Conversion conversion_of(AVPixelFormat pixel_format) {
  const AVPixFmtDescriptor& format = descriptor_of(pixel_format);
  Conversion conversion{.layout = nearest_layout(format)};
  const bool has_alpha = (format.flags & AV_PIX_FMT_FLAG_ALPHA) != 0 && (format.flags & AV_PIX_FMT_FLAG_PAL) == 0;
  if (pixel_format == AV_PIX_FMT_PAL8)
    conversion.text = "pal8 to RGB through its palette";
  else if (!can_pick(format))
    conversion.text =
        fmt::format("{} to {} through swscale", format.name, av_get_pix_fmt_name(plain_format(conversion.layout)));
  else if (format.comp[0].depth > 8)
    conversion.text = fmt::format("{} to 8 bits, rounded", format.name);
  if (has_alpha) conversion.text += conversion.text.empty() ? "opacity is left out" : "; opacity is left out";
  return conversion;
}

Result<Frame> frame_of(const AVFrame& image, PixelLayout layout, const ColorInfo& color) {
  const AVPixFmtDescriptor& format = descriptor_of(static_cast<AVPixelFormat>(image.format));
  if (can_pick(format) && nearest_layout(format) == layout) return picked(image, format, layout, color);
  if (image.format == AV_PIX_FMT_PAL8 && layout == PixelLayout::rgb) return looked_up(image, color);
  const Result<FramePtr> plain = scaled(image, layout, color.range);
  if (!plain) return fail(plain.error());
  return picked(**plain, descriptor_of(plain_format(layout)), layout, color);
}

void fill(AVFrame& image, const Frame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(static_cast<AVPixelFormat>(image.format));
  for (int i = 0; i < frame.plane_count(); ++i) {
    const AVComponentDescriptor& component = format.comp[i];
    const cv::Mat& plane = frame.planes[static_cast<size_t>(i)];
    for (int y = 0; y < plane.rows; ++y) {
      const uchar* in = plane.ptr<uchar>(y);
      uchar* out = const_cast<uchar*>(sample_row(image, component, y));
      if (component.step == 1)
        std::memcpy(out, in, static_cast<size_t>(plane.cols));
      else
        for (int x = 0; x < plane.cols; ++x) out[x * component.step] = in[x];
    }
  }
}

bool can_wrap_planes(AVPixelFormat format) {
  const AVPixFmtDescriptor& descriptor = descriptor_of(format);
  for (int i = 0; i < descriptor.nb_components; ++i) {
    const AVComponentDescriptor& component = descriptor.comp[i];
    if (component.plane != i || component.step != 1 || component.offset != 0 || component.depth != 8) return false;
  }
  return true;
}

void wrap_planes(AVFrame& image, const Frame& frame) {
  for (int i = 0; i < frame.plane_count(); ++i) {
    const cv::Mat& plane = frame.planes[static_cast<size_t>(i)];
    image.buf[i] = buffer_of(plane);
    image.data[i] = plane.data;
    image.linesize[i] = static_cast<int>(plane.step);
  }
}

}  // namespace sigs::libav
