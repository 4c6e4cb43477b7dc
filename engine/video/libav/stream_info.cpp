// SPDX-License-Identifier: MIT
#include "video/libav/stream_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
#include <libavutil/spherical.h>
}

#include "video/chroma.h"
#include "video/color_space.h"
#include "video/libav/planes.h"

namespace sigs::libav {

namespace {

constexpr int kUnspecified = 2;  // ISO/IEC 23091-2
constexpr int kHighDefinitionLines = 720;

// In the order of ColorMatrix and of ChromaSite.
constexpr std::array kSpaces{AVCOL_SPC_SMPTE170M, AVCOL_SPC_BT709, AVCOL_SPC_BT2020_NCL};
constexpr std::array kSites{AVCHROMA_LOC_LEFT, AVCHROMA_LOC_CENTER, AVCHROMA_LOC_TOPLEFT};

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
  // BT.470 System B, G has BT.601's coefficients.
  const AVColorSpace space = image.colorspace == AVCOL_SPC_BT470BG ? AVCOL_SPC_SMPTE170M : image.colorspace;
  const auto* const known = std::ranges::find(kSpaces, space);
  color.matrix_stated = known != kSpaces.end();
  if (color.matrix_stated) {
    color.matrix = static_cast<ColorMatrix>(known - kSpaces.begin());
    return {};
  }
  color.matrix = image.height < kHighDefinitionLines ? ColorMatrix::bt601 : ColorMatrix::bt709;
  if (image.colorspace == AVCOL_SPC_UNSPECIFIED || image.colorspace == AVCOL_SPC_RGB) return {};
  color.unknown_matrix = image.colorspace;
  const char* name = av_color_space_name(image.colorspace);
  return fmt::format("the colour matrix {} is not known; {} is assumed", name == nullptr ? "of this number" : name,
                     color.matrix == ColorMatrix::bt601 ? "BT.601" : "BT.709");
}

std::string read_site(ColorInfo& color, const AVFrame& image, AVCodecID codec) {
  if (const auto* const known = std::ranges::find(kSites, image.chroma_location); known != kSites.end()) {
    color.chroma_site = static_cast<ChromaSite>(known - kSites.begin());
    return {};
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

// The colours of an image as its file states them, with what is assumed.
struct ColorReading {
  ColorInfo color;
  std::string remark;  // what the file states and SIGS does not support; empty: nothing
};

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

// Null where the container states none of that type, or less than so many bytes.
const uint8_t* side_data(const AVStream& stream, AVPacketSideDataType type, size_t bytes) {
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
  const AVPacketSideData* data =
      av_packet_side_data_get(stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, type);
  return data != nullptr && data->size >= bytes ? data->data : nullptr;
#else
  size_t size = 0;
  const uint8_t* data = av_stream_get_side_data(&stream, type, &size);
  return data != nullptr && size >= bytes ? data : nullptr;
#endif
}

const int32_t* display_matrix(const AVStream& stream) {
  return reinterpret_cast<const int32_t*>(side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, 9 * sizeof(int32_t)));
}

std::string projection_of(const AVStream& stream) {
  const auto* const mapping =
      reinterpret_cast<const AVSphericalMapping*>(side_data(stream, AV_PKT_DATA_SPHERICAL, sizeof(AVSphericalMapping)));
  return mapping == nullptr ? "" : av_spherical_projection_name(mapping->projection);
}

// Position of a chroma sample along one axis after an optional flip, in luma samples from an even one: 0 or 0.5 before
// the flip, also 1 or 1.5 after it.
double flipped(double place, int luma_size, bool flip) {
  return flip ? std::fmod(luma_size + 1 - place, 2.0) : place;
}

// Where the chroma samples lie in the upright image. Positions without a name (on odd columns, on rows alone) are taken
// as midway, which is half a pixel off; exact is then false.
struct OrientedSite {
  ChromaSite site = ChromaSite::left;
  bool exact = true;
};

OrientedSite oriented_site(ChromaSite site, PixelLayout layout, cv::Size stored_px, const Orientation& orientation) {
  const cv::Size step = chroma_step(layout);
  if (step == cv::Size(1, 1) || orientation == Orientation{}) return {site, true};
  double column = step.width == 1 || chroma_on_luma_column(site) ? 0 : 0.5;
  double row = step.height == 1 || chroma_on_luma_row(site) ? 0 : 0.5;
  if (orientation.transpose) std::swap(column, row);
  const cv::Size size = oriented(stored_px, orientation);
  if (step.width > 1) column = flipped(column, size.width, orientation.flip_columns);
  if (step.height > 1) row = flipped(row, size.height, orientation.flip_rows);
  for (const ChromaSite named : {ChromaSite::left, ChromaSite::center, ChromaSite::top_left}) {
    const bool same_row = step.height == 1 || row == (chroma_on_luma_row(named) ? 0 : 0.5);
    if (column == (chroma_on_luma_column(named) ? 0 : 0.5) && same_row) return {named, true};
  }
  return {ChromaSite::center, false};
}

// "rotated by 90 degrees clockwise", "mirrored left to right"; empty: as it is stored.
std::string description_of(const Orientation& orientation) {
  if (orientation == Orientation{}) return {};
  if (!orientation.transpose && orientation.flip_columns && orientation.flip_rows) return "rotated by 180 degrees";
  if (!orientation.transpose) return orientation.flip_columns ? "mirrored left to right" : "mirrored top to bottom";
  if (orientation.flip_columns != orientation.flip_rows)
    return std::string("rotated by 90 degrees ") + (orientation.flip_columns ? "clockwise" : "counterclockwise");
  return orientation.flip_columns ? "mirrored and rotated by 90 degrees: about the other diagonal"
                                  : "mirrored and rotated by 90 degrees: about the diagonal";
}

// Whether the times deviate from even spacing by more than the rounding of time stamps to the container's tick.
bool is_variable(const std::vector<double>& times_s, AVRational time_base) {
  if (times_s.size() < 3) return false;
  const double mean_s = times_s.back() / static_cast<double>(times_s.size() - 1);
  const double slack_s = std::max(1.01 * av_q2d(time_base), 0.01 * mean_s);
  for (size_t n = 1; n < times_s.size(); ++n)
    if (std::abs(times_s[n] - times_s[n - 1] - mean_s) > slack_s) return true;
  return false;
}

// Seconds that the header states beyond the last frame. Sound may last longer than the images, so this is known only of
// files without sound; and only a header counts, not an estimate from the bit rate.
double missing_s(const VideoInfo& info, const AVFormatContext& format) {
  if (format.nb_streams != 1 || format.duration <= 0 || info.times_s.empty() ||
      format.duration_estimation_method != AVFMT_DURATION_FROM_STREAM)
    return 0;
  // Some files count their duration from 0, others from their first frame.
  const std::int64_t begin = format.start_time == AV_NOPTS_VALUE ? 0 : std::max<std::int64_t>(0, format.start_time);
  const double promised_s = static_cast<double>(format.duration - begin) / AV_TIME_BASE;
  return promised_s - info.times_s.back() - static_cast<double>(info.frame_rate_den) / info.frame_rate_num;
}

constexpr double kMinReportedGap_s = 0.1;

// FFmpeg opens single images with a demuxer of their own: "png_pipe", "image2".
bool is_image(const Demuxer& demuxer) {
  const std::string_view name = demuxer.format().iformat->name;
  return name.starts_with("image2") || name.ends_with("_pipe");
}

// "frame_%03d.png" of "frame_017.png", by which a sequence of images is named.
std::filesystem::path sequence_pattern(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t digits = stem.size() - (stem.find_last_not_of("0123456789") + 1);  // npos + 1 is 0
  return path.parent_path() / fmt::format("{}%0{}d{}", stem.substr(0, stem.size() - digits),
                                          std::max<std::size_t>(digits, 1), path.extension().string());
}

void add_warnings(VideoInfo& info, const Demuxer& demuxer, const PacketTable& table, const FrameOrder& order) {
  const auto warn = [&](std::string what) { info.warnings.push_back({info.path.string(), std::move(what)}); };
  if (info.declared_frames > 0 && info.declared_frames != table.size() && info.declared_frames != info.frame_count())
    warn(fmt::format("header declares {} frames, {} are there", info.declared_frames, info.frame_count()));
  else if (table.broke_off() || missing_s(info, demuxer.format()) > kMinReportedGap_s)
    warn(fmt::format("the file ends early; {} frames are there", info.frame_count()));
  if (table.any_corrupt()) warn("some packets are damaged");
  if (order.times_are_nominal)
    warn("the container tells no usable times; frames are spaced evenly at the nominal rate");
  if (is_image(demuxer) && info.frame_count() == 1)
    warn(fmt::format("is one image, so the footage has one frame; name a sequence by its pattern, {}, or by its folder",
                     sequence_pattern(info.path).string()));
}

}  // namespace

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
  encoder.colorspace = color.matrix_stated ? kSpaces.at(static_cast<std::size_t>(color.matrix))
                                           : static_cast<AVColorSpace>(color.unknown_matrix);
  // For 4:2:2 the standards know one site, the left; any other one must be stated.
  const bool is_odd_422 = layout == PixelLayout::yuv422 && color.chroma_site == ChromaSite::center;
  if (layout == PixelLayout::yuv420 || is_odd_422)
    encoder.chroma_sample_location = kSites.at(static_cast<std::size_t>(color.chroma_site));
}

Result<Orientation> orientation_of(const AVStream& stream) {
  return orientation_of(display_matrix(stream));
}

Result<Orientation> orientation_of(const int32_t* matrix) {
  if (matrix == nullptr) return Orientation{};
  // x' = a x + c y, y' = b x + d y
  const int64_t a = matrix[0];
  const int64_t b = matrix[1];
  const int64_t c = matrix[3];
  const int64_t d = matrix[4];
  const int64_t along = std::min(std::abs(a), std::abs(d));
  const int64_t across = std::min(std::abs(b), std::abs(c));
  constexpr int64_t kNegligible = 1000;  // ratio; files have rounded sines
  if (std::max(std::abs(b), std::abs(c)) <= along / kNegligible && along > 0)
    return Orientation{.flip_columns = a < 0, .flip_rows = d < 0};
  if (std::max(std::abs(a), std::abs(d)) <= across / kNegligible && across > 0)
    return Orientation{.transpose = true, .flip_columns = c < 0, .flip_rows = b < 0};
  const double angle_deg = -av_display_rotation_get(matrix);
  const std::string how =
      std::isfinite(angle_deg) ? fmt::format("by {} degrees", std::lround(angle_deg)) : "in a way that makes no image";
  return fail("",
              fmt::format("asks players to rotate the image {}; only right angles can be followed: rotate it with a "
                          "video tool first",
                          how));
}

Result<void> check_orientation(const Orientation& orientation, PixelLayout layout) {
  if (orientation.transpose && layout == PixelLayout::yuv422)
    return fail("", fmt::format("is to be {}, but its 4:2:2 chroma on its side is no layout that can be written: "
                                "convert it to 4:2:0 or 4:4:4 with a video tool first",
                                description_of(orientation)));
  return {};
}

cv::Size oriented(cv::Size size, const Orientation& orientation) {
  return orientation.transpose ? cv::Size(size.height, size.width) : size;
}

Frame oriented(const Frame& frame, const Orientation& orientation) {
  Frame upright = frame;
  for (cv::Mat& plane : upright.planes) {
    if (plane.empty()) continue;
    cv::Mat moved;
    if (orientation.transpose)
      cv::transpose(plane, moved);
    else
      moved = plane;
    if (orientation.flip_columns || orientation.flip_rows) {
      cv::Mat in_reverse;
      cv::flip(moved, in_reverse,
               orientation.flip_columns && orientation.flip_rows ? -1
               : orientation.flip_columns                        ? 1
                                                                 : 0);
      moved = in_reverse;
    }
    plane = moved;
  }
  return upright;
}

AVRational frame_rate_of(const Demuxer& demuxer) {
  const AVRational rate = av_guess_frame_rate(&demuxer.format(), &demuxer.stream(), nullptr);
  return rate.num > 0 && rate.den > 0 ? rate : AVRational{25, 1};
}

void add_image(VideoInfo& info, const AVFrame& image, AVCodecID codec, const Orientation& orientation) {
  const cv::Size stored_px(image.width, image.height);
  const auto pixel_format = static_cast<AVPixelFormat>(image.format);
  const Conversion conversion = conversion_of(pixel_format);
  const ColorReading reading = color_of(image, codec, conversion.layout);
  info.size_px = oriented(stored_px, orientation);
  info.layout = conversion.layout;
  info.bit_depth = conversion.bit_depth;
  info.color = reading.color;
  info.codec = avcodec_get_name(codec);
  info.pixel_format = av_get_pix_fmt_name(pixel_format);
  info.conversion = conversion.text;
  if (orientation != Orientation{}) {
    const OrientedSite site = oriented_site(info.color.chroma_site, info.layout, stored_px, orientation);
    info.color.chroma_site = site.site;
    info.warnings.push_back(
        {info.path.string(),
         fmt::format("is {}, as the file asks{}", description_of(orientation),
                     site.exact ? "" : "; its chroma is taken as midway between pixels, half a pixel beside")});
  }
  if (!reading.remark.empty()) info.warnings.push_back({info.path.string(), reading.remark});
}

VideoInfo video_info_of(const std::filesystem::path& path, const Demuxer& demuxer, const PacketTable& table,
                        const FrameOrder& order, const AVFrame& first, const Orientation& orientation) {
  const AVStream& stream = demuxer.stream();
  VideoInfo info;
  info.path = path;
  info.times_s = order.times_s;
  const AVRational rate = frame_rate_of(demuxer);
  info.frame_rate_num = rate.num;
  info.frame_rate_den = rate.den;
  const AVRational aspect =
      av_guess_sample_aspect_ratio(&demuxer.format(), &demuxer.stream(), const_cast<AVFrame*>(&first));
  if (aspect.num > 0 && aspect.den > 0) {
    info.pixel_aspect_num = aspect.num;
    info.pixel_aspect_den = aspect.den;
    if (orientation.transpose) std::swap(info.pixel_aspect_num, info.pixel_aspect_den);
  }
  info.variable_frame_rate = is_variable(order.times_s, stream.time_base);
  info.container = demuxer.format().iformat->name;
  info.projection = projection_of(stream);
  info.declared_frames = stream.nb_frames;
  add_warnings(info, demuxer, table, order);
  add_image(info, first, stream.codecpar->codec_id, orientation);
  return info;
}

}  // namespace sigs::libav
