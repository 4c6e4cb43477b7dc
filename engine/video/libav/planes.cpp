// SPDX-License-Identifier: MIT
#include "video/libav/planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <optional>

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

// Whether samples can be picked one by one: whole bytes, or whole 16-bit words.
bool can_pick(const AVPixFmtDescriptor& format) {
  const std::optional<PixelLayout> layout = same_layout(format);
  if ((format.flags & kSpecialFlags) != 0 || !layout) return false;
  if (std::string_view(format.name).starts_with("xyz")) return false;
  const int depth = format.comp[0].depth;
  for (int i = 0; i < plane_count(*layout); ++i)
    if (format.comp[i].depth != depth) return false;
  return depth >= 8 && depth <= 16;
}

// Of floating-point and Bayer images 8 bits are taken: swscale's conversions of them to more are no better.
int nearest_depth(const AVPixFmtDescriptor& format) {
  constexpr uint64_t kEightBitFlags = AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_FLOAT;
  if ((format.flags & kEightBitFlags) != 0) return 8;
  return std::clamp(format.comp[0].depth, 8, 16);
}

PixelLayout nearest_layout(const AVPixFmtDescriptor& format) {
  if ((format.flags & (AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BAYER)) != 0 || is_rgb(format)) return PixelLayout::rgb;
  if (std::string_view(format.name).starts_with("xyz")) return PixelLayout::rgb;
  if (const std::optional<PixelLayout> same = same_layout(format)) return *same;
  // Chroma subsampled in y alone (4:4:0) becomes 4:4:4, otherwise in y 4:2:0, by more than 2 in x (4:1:1) 4:2:2.
  if (format.log2_chroma_h >= 1) return format.log2_chroma_w == 0 ? PixelLayout::yuv444 : PixelLayout::yuv420;
  return PixelLayout::yuv422;
}

// What swscale converts other formats to: RGB in packed formats, which it knows best.
AVPixelFormat plain_format(PixelLayout layout, int bit_depth) {
  if (layout == PixelLayout::rgb) return bit_depth == 8 ? AV_PIX_FMT_RGB24 : AV_PIX_FMT_RGB48;
  return pixel_format_of(layout, bit_depth);
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

uint16_t word_at(const uchar* in, bool swap) {
  const unsigned low = in[swap ? 1 : 0];
  const unsigned high = in[swap ? 0 : 1];
  return static_cast<uint16_t>(std::endian::native == std::endian::big ? low << 8 | high : high << 8 | low);
}

// Where every sample is a word of its own, in this machine's byte order, and nothing else is in it.
bool is_plain(const AVComponentDescriptor& component, bool swap) {
  return component.step == 2 && component.shift == 0 && !swap;
}

cv::Mat picked_words(const AVFrame& image, const AVComponentDescriptor& component, cv::Size size, bool swap) {
  cv::Mat plane(size, CV_16UC1);
  const auto mask = static_cast<unsigned>(max_code(component.depth));
  for (int y = 0; y < size.height; ++y) {
    const uchar* in = sample_row(image, component, y);
    ushort* const out = plane.ptr<ushort>(y);
    if (is_plain(component, swap)) {
      std::memcpy(out, in, static_cast<size_t>(size.width) * sizeof *out);
      for (int x = 0; x < size.width; ++x) out[x] = static_cast<ushort>(out[x] & mask);
    } else {
      for (int x = 0; x < size.width; ++x)
        out[x] = static_cast<ushort>(unsigned{word_at(in + x * component.step, swap)} >> component.shift & mask);
    }
  }
  return plane;
}

// Whether the words of a format have the other byte order than this machine's.
bool has_swapped_words(const AVPixFmtDescriptor& format) {
  const bool big_endian = (format.flags & AV_PIX_FMT_FLAG_BE) != 0;
  return big_endian != (std::endian::native == std::endian::big);
}

cv::Size plane_size(PixelLayout layout, int plane, cv::Size size_px) {
  return plane > 0 && layout != PixelLayout::rgb ? chroma_size(layout, size_px) : size_px;
}

Frame picked(const AVFrame& image, const AVPixFmtDescriptor& format, PixelLayout layout, const ColorInfo& color) {
  Frame frame{.layout = layout, .bit_depth = format.comp[0].depth, .color = color};
  const cv::Size size(image.width, image.height);
  const bool swap = has_swapped_words(format);
  for (int i = 0; i < plane_count(layout); ++i) {
    const cv::Size of_plane = plane_size(layout, i, size);
    frame.planes[static_cast<size_t>(i)] = frame.bit_depth == 8 ? picked_bytes(image, format.comp[i], of_plane)
                                                                : picked_words(image, format.comp[i], of_plane, swap);
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

Result<FramePtr> scaled(const AVFrame& image, const Conversion& wanted, ColorRange range) {
  FramePtr plain = new_frame();
  plain->format = plain_format(wanted.layout, wanted.bit_depth);
  plain->width = image.width;
  plain->height = image.height;
  if (av_frame_get_buffer(plain.get(), 0) < 0) throw std::bad_alloc();
  const ScalerPtr scaler(sws_getContext(image.width, image.height, static_cast<AVPixelFormat>(image.format),
                                        plain->width, plain->height, static_cast<AVPixelFormat>(plain->format),
                                        SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT, nullptr,
                                        nullptr, nullptr));
  if (scaler == nullptr)
    return fail("", fmt::format("the pixel format {} cannot be converted to planes of samples",
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
  const size_t bytes =
      static_cast<size_t>(plane.rows - 1) * plane.step + static_cast<size_t>(plane.cols) * plane.elemSize();
  AVBufferRef* share = av_buffer_create(plane.data, bytes, release_plane, held.get(), AV_BUFFER_FLAG_READONLY);
  if (share == nullptr) throw std::bad_alloc();
  static_cast<void>(held.release());
  return share;
}

}  // namespace

AVPixelFormat pixel_format_of(PixelLayout layout, int bit_depth, bool packed_rgb) {
  if (layout == PixelLayout::rgb && bit_depth == 8 && packed_rgb) return AV_PIX_FMT_0RGB32;
  // In the order of PixelLayout.
  static constexpr std::array kPlanar{"gray", "yuv420p", "yuv422p", "yuv444p", "gbrp"};
  const std::string name = kPlanar.at(static_cast<std::size_t>(layout));
  return av_get_pix_fmt((bit_depth == 8 ? name : name + std::to_string(bit_depth)).c_str());
}

Conversion conversion_of(AVPixelFormat pixel_format) {
  const AVPixFmtDescriptor& format = descriptor_of(pixel_format);
  Conversion conversion{.layout = nearest_layout(format), .bit_depth = nearest_depth(format)};
  // FFmpeg lacks some depths of some layouts; 16 bits it has of all.
  if (plain_format(conversion.layout, conversion.bit_depth) == AV_PIX_FMT_NONE && !can_pick(format))
    conversion.bit_depth = 16;
  if (conversion.layout == PixelLayout::rgb && conversion.bit_depth > 8 && !can_pick(format)) conversion.bit_depth = 16;
  const bool has_alpha = (format.flags & AV_PIX_FMT_FLAG_ALPHA) != 0 && (format.flags & AV_PIX_FMT_FLAG_PAL) == 0;
  if (pixel_format == AV_PIX_FMT_PAL8)
    conversion.text = "pal8 to RGB through its palette";
  else if (!can_pick(format))
    conversion.text = fmt::format("{} to {} through swscale", format.name,
                                  av_get_pix_fmt_name(plain_format(conversion.layout, conversion.bit_depth)));
  if (has_alpha) conversion.text += conversion.text.empty() ? "opacity is left out" : "; opacity is left out";
  return conversion;
}

Result<Frame> frame_of(const AVFrame& image, const Conversion& wanted, const ColorInfo& color) {
  const auto pixel_format = static_cast<AVPixelFormat>(image.format);
  const AVPixFmtDescriptor& format = descriptor_of(pixel_format);
  if (image.format == AV_PIX_FMT_PAL8 && wanted.layout == PixelLayout::rgb && wanted.bit_depth == 8)
    return looked_up(image, color);
  const Conversion own = conversion_of(pixel_format);
  if (can_pick(format) && own.layout == wanted.layout && own.bit_depth == wanted.bit_depth)
    return picked(image, format, wanted.layout, color);
  const Result<FramePtr> plain = scaled(image, wanted, color.range);
  if (!plain) return fail(plain.error());
  return picked(**plain, descriptor_of(plain_format(wanted.layout, wanted.bit_depth)), wanted.layout, color);
}

Result<Frame> luma_frame_of(const AVFrame& image, const Conversion& wanted, const ColorInfo& color) {
  const auto pixel_format = static_cast<AVPixelFormat>(image.format);
  const AVPixFmtDescriptor& format = descriptor_of(pixel_format);
  const Conversion own = conversion_of(pixel_format);
  if (!can_pick(format) || own.layout == PixelLayout::rgb || own.layout != wanted.layout ||
      own.bit_depth != wanted.bit_depth)
    return frame_of(image, wanted, color);
  return picked(image, format, PixelLayout::gray, color);
}

void fill(AVFrame& image, const Frame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(static_cast<AVPixelFormat>(image.format));
  for (int i = 0; i < frame.plane_count(); ++i) {
    const AVComponentDescriptor& component = format.comp[i];
    const cv::Mat& plane = frame.planes[static_cast<size_t>(i)];
    const auto sample_bytes = static_cast<int>(plane.elemSize());
    for (int y = 0; y < plane.rows; ++y) {
      const uchar* in = plane.ptr<uchar>(y);
      uchar* out = const_cast<uchar*>(sample_row(image, component, y));
      if (component.step == sample_bytes)
        std::memcpy(out, in, static_cast<size_t>(plane.cols) * plane.elemSize());
      else
        for (int x = 0; x < plane.cols; ++x)
          std::memcpy(out + x * component.step, in + x * sample_bytes, plane.elemSize());
    }
  }
}

bool can_wrap_planes(AVPixelFormat format) {
  const AVPixFmtDescriptor& descriptor = descriptor_of(format);
  for (int i = 0; i < descriptor.nb_components; ++i) {
    const AVComponentDescriptor& component = descriptor.comp[i];
    const int sample_bytes = component.depth > 8 ? 2 : 1;
    if (component.plane != i || component.step != sample_bytes || component.offset != 0 || component.shift != 0)
      return false;
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
