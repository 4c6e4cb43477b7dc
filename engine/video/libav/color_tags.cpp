// SPDX-License-Identifier: MIT
#include "video/libav/color_tags.h"

#include <fmt/format.h>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "video/color_space.h"

namespace sigs::libav {
namespace {

constexpr int kUnspecified = 2;  // ISO/IEC 23091-2
constexpr int kHighDefinitionLines = 720;

bool is_jpeg_format(AVPixelFormat format) {
  return format == AV_PIX_FMT_YUVJ420P || format == AV_PIX_FMT_YUVJ422P || format == AV_PIX_FMT_YUVJ444P ||
         format == AV_PIX_FMT_YUVJ440P || format == AV_PIX_FMT_YUVJ411P;
}

// Standards in which video without a stated range is limited, gray too.
bool is_limited_by_standard(AVCodecID codec) {
  return codec == AV_CODEC_ID_H264 || codec == AV_CODEC_ID_HEVC || codec == AV_CODEC_ID_VP9 ||
         codec == AV_CODEC_ID_AV1 || codec == AV_CODEC_ID_MPEG4 || codec == AV_CODEC_ID_MPEG2VIDEO;
}

void read_range(ColorInfo& color, const AVFrame& image, AVCodecID codec, PixelLayout layout) {
  const bool jpeg = is_jpeg_format(static_cast<AVPixelFormat>(image.format));
  color.range_stated = jpeg || layout == PixelLayout::rgb || image.color_range != AVCOL_RANGE_UNSPECIFIED;
  const bool full_gray = layout == PixelLayout::gray && !is_limited_by_standard(codec);
  const bool full = jpeg || layout == PixelLayout::rgb || image.color_range == AVCOL_RANGE_JPEG ||
                    (image.color_range == AVCOL_RANGE_UNSPECIFIED && full_gray);
  color.range = full ? ColorRange::full : ColorRange::limited;
}

std::string read_matrix(ColorInfo& color, const AVFrame& image) {
  color.matrix_stated = true;
  switch (image.colorspace) {
    case AVCOL_SPC_BT709:
      color.matrix = ColorMatrix::bt709;
      return {};
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
      color.matrix = ColorMatrix::bt601;
      return {};
    case AVCOL_SPC_BT2020_NCL:
      color.matrix = ColorMatrix::bt2020;
      return {};
    default:
      break;
  }
  color.matrix_stated = false;
  color.matrix = image.height < kHighDefinitionLines ? ColorMatrix::bt601 : ColorMatrix::bt709;
  if (image.colorspace == AVCOL_SPC_UNSPECIFIED || image.colorspace == AVCOL_SPC_RGB) return {};
  const char* name = av_color_space_name(image.colorspace);
  return fmt::format("the colour matrix {} is not known; {} is assumed", name == nullptr ? "of this number" : name,
                     color.matrix == ColorMatrix::bt601 ? "BT.601" : "BT.709");
}

std::string read_site(ColorInfo& color, const AVFrame& image, AVCodecID codec) {
  switch (image.chroma_location) {
    case AVCHROMA_LOC_LEFT:
      color.chroma_site = ChromaSite::left;
      return {};
    case AVCHROMA_LOC_CENTER:
      color.chroma_site = ChromaSite::center;
      return {};
    case AVCHROMA_LOC_TOPLEFT:
      color.chroma_site = ChromaSite::top_left;
      return {};
    default:
      break;
  }
  // JFIF puts chroma midway; every video standard puts it at the left, full range or not.
  color.chroma_site = codec == AV_CODEC_ID_MJPEG ? ChromaSite::center : ChromaSite::left;
  if (image.chroma_location == AVCHROMA_LOC_UNSPECIFIED) return {};
  return fmt::format("chroma siting {} is not known; left is assumed", av_chroma_location_name(image.chroma_location));
}

void add_remark(std::string& remark, const std::string& more) {
  if (!more.empty()) remark += (remark.empty() ? "" : "; ") + more;
}

std::string remark_on_light(const ColorInfo& color) {
  std::string remark;
  if (!transfer_function_of(color.transfer))
    add_remark(remark, fmt::format("the transfer function ({}) is not followed; sRGB's is assumed",
                                   transfer_name(color.transfer)));
  if (!from_bt709(color.primaries))
    add_remark(remark,
               fmt::format("the primaries ({}) are not known; BT.709's are assumed", primaries_name(color.primaries)));
  return remark;
}

int code_point(int stated) {
  return stated == 0 ? kUnspecified : stated;
}

AVColorSpace space_of(ColorMatrix matrix) {
  switch (matrix) {
    case ColorMatrix::bt601:
      return AVCOL_SPC_SMPTE170M;
    case ColorMatrix::bt709:
      return AVCOL_SPC_BT709;
    case ColorMatrix::bt2020:
      return AVCOL_SPC_BT2020_NCL;
  }
  return AVCOL_SPC_UNSPECIFIED;
}

AVChromaLocation location_of(ChromaSite site) {
  switch (site) {
    case ChromaSite::left:
      return AVCHROMA_LOC_LEFT;
    case ChromaSite::center:
      return AVCHROMA_LOC_CENTER;
    case ChromaSite::top_left:
      return AVCHROMA_LOC_TOPLEFT;
  }
  return AVCHROMA_LOC_UNSPECIFIED;
}

}  // namespace

ColorReading color_of(const AVFrame& image, AVCodecID codec, PixelLayout layout) {
  ColorReading reading;
  ColorInfo& color = reading.color;
  color.primaries = code_point(image.color_primaries);
  color.transfer = code_point(image.color_trc);
  read_range(color, image, codec, layout);
  reading.remark = layout == PixelLayout::rgb ? "" : read_matrix(color, image);
  const bool shares_chroma = layout == PixelLayout::yuv420 || layout == PixelLayout::yuv422;
  const std::string site = shares_chroma ? read_site(color, image, codec) : "";
  add_remark(reading.remark, site);
  add_remark(reading.remark, remark_on_light(color));
  return reading;
}

void tag(AVCodecContext& encoder, const ColorInfo& color, PixelLayout layout) {
  encoder.color_primaries = static_cast<AVColorPrimaries>(color.primaries);
  encoder.color_trc = static_cast<AVColorTransferCharacteristic>(color.transfer);
  if (layout == PixelLayout::rgb) {
    encoder.color_range = AVCOL_RANGE_JPEG;
    encoder.colorspace = AVCOL_SPC_RGB;
    return;
  }
  const bool full = color.range == ColorRange::full;
  if (full || color.range_stated) encoder.color_range = full ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
  if (color.matrix_stated) encoder.colorspace = space_of(color.matrix);
  // For 4:2:2 the standards know one site, the left; any other one must be stated.
  const bool is_odd_422 = layout == PixelLayout::yuv422 && color.chroma_site == ChromaSite::center;
  if (layout == PixelLayout::yuv420 || is_odd_422) encoder.chroma_sample_location = location_of(color.chroma_site);
}

}  // namespace sigs::libav
