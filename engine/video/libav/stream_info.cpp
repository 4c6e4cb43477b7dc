// SPDX-License-Identifier: MIT
#include "video/libav/stream_info.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "video/libav/color_tags.h"
#include "video/libav/planes.h"

namespace sigs::libav {
namespace {

// The container rounds time stamps to its tick; more than that is a rate that varies.
bool is_variable(const std::vector<double>& times_s, AVRational time_base) {
  if (times_s.size() < 3) return false;
  const double mean_s = times_s.back() / static_cast<double>(times_s.size() - 1);
  const double slack_s = std::max(1.01 * av_q2d(time_base), 0.01 * mean_s);
  for (size_t n = 1; n < times_s.size(); ++n)
    if (std::abs(times_s[n] - times_s[n - 1] - mean_s) > slack_s) return true;
  return false;
}

std::string counted(long long declared, int there) {
  return "header declares " + std::to_string(declared) + " frames, " + std::to_string(there) + " are there";
}

// Seconds that the header promises beyond the last frame. Sound may last longer than the image, so only video alone
// tells; and only a header, not a guess from the bit rate.
double missing_s(const VideoInfo& info, const AVFormatContext& format) {
  if (format.nb_streams != 1 || format.duration <= 0 || info.times_s.empty() ||
      format.duration_estimation_method != AVFMT_DURATION_FROM_STREAM)
    return 0;
  const double promised_s = static_cast<double>(format.duration) / AV_TIME_BASE;
  return promised_s - info.times_s.back() - static_cast<double>(info.frame_rate_den) / info.frame_rate_num;
}

constexpr double kMissingWorthTelling_s = 0.1;

// FFmpeg opens single images with a demuxer of their own: "png_pipe", "image2".
bool is_image(const Demuxer& demuxer) {
  const std::string_view name = demuxer.format().iformat->name;
  return name.starts_with("image2") || name.ends_with("_pipe");
}

// "frame_%03d.png" of "frame_017.png", as FFmpeg names a sequence.
std::string sequence_pattern(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t digits = stem.size() - (stem.find_last_not_of("0123456789") + 1);  // npos + 1 is 0
  return stem.substr(0, stem.size() - digits) + "%0" + std::to_string(std::max<std::size_t>(digits, 1)) + "d" +
         path.extension().string();
}

void add_warnings(VideoInfo& info, const Demuxer& demuxer, const PacketTable& table, const FrameOrder& order) {
  const auto warn = [&](std::string what) { info.warnings.push_back({info.path.string(), std::move(what)}); };
  if (info.declared_frames > 0 && info.declared_frames != table.size() && info.declared_frames != info.frame_count())
    warn(counted(info.declared_frames, info.frame_count()));
  else if (table.broke_off() || missing_s(info, demuxer.format()) > kMissingWorthTelling_s)
    warn("the file ends early; " + std::to_string(info.frame_count()) + " frames are there");
  if (table.any_corrupt()) warn("some packets are damaged");
  if (order.times_are_nominal)
    warn("the container tells no usable times; frames are spaced evenly at the nominal rate");
  if (is_image(demuxer) && info.frame_count() == 1)
    warn("is one image, so the footage has one frame; of a sequence make a video first: ffmpeg -framerate 25 -i " +
         sequence_pattern(info.path.filename()) + " -c:v ffv1 sequence.mkv");
}

void set_oriented(VideoInfo& info, cv::Size stored_px, const Orientation& orientation) {
  if (orientation == Orientation{}) return;
  const OrientedSite site = oriented_site(info.color.chroma_site, info.layout, stored_px, orientation);
  info.color.chroma_site = site.site;
  info.warnings.push_back(
      {info.path.string(),
       "is " + description_of(orientation) + ", as the file asks" +
           (site.exact ? "" : "; its chroma is taken as midway between pixels, half a pixel beside")});
}

}  // namespace

AVRational frame_rate_of(const Demuxer& demuxer) {
  const AVRational rate = av_guess_frame_rate(&demuxer.format(), &demuxer.stream(), nullptr);
  return rate.num > 0 && rate.den > 0 ? rate : AVRational{25, 1};
}

VideoInfo video_info_of(const std::filesystem::path& path, const Demuxer& demuxer, const PacketTable& table,
                        const FrameOrder& order, const AVFrame& first, const Orientation& orientation) {
  const AVStream& stream = demuxer.stream();
  const AVPixelFormat pixel_format = static_cast<AVPixelFormat>(first.format);
  const Conversion conversion = conversion_of(pixel_format);
  const ColorReading reading = color_of(first, stream.codecpar->codec_id, conversion.layout);
  VideoInfo info;
  info.path = path;
  info.size_px = oriented(cv::Size(first.width, first.height), orientation);
  info.layout = conversion.layout;
  info.color = reading.color;
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
  info.codec = avcodec_get_name(stream.codecpar->codec_id);
  info.pixel_format = av_get_pix_fmt_name(pixel_format);
  info.conversion = conversion.text;
  info.container = demuxer.format().iformat->name;
  info.declared_frames = stream.nb_frames;
  add_warnings(info, demuxer, table, order);
  set_oriented(info, {first.width, first.height}, orientation);
  if (!reading.remark.empty()) info.warnings.push_back({path.string(), reading.remark});
  return info;
}

}  // namespace sigs::libav
