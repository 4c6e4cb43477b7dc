// SPDX-License-Identifier: MIT
#include "video/libav/group_encoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>
#include <string_view>
#include <utility>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "video/libav/encoding.h"
#include "video/libav/planes.h"

namespace sigs::libav {
namespace {

bool has_parameter_sets(AVCodecID codec) {
  return codec == AV_CODEC_ID_H264 || codec == AV_CODEC_ID_HEVC;
}

// The name of a number; null where the table has none.
template <class Table, class Number>
const char* known_in(const Table& table, Number number) {
  for (const auto& [known, name] : table)
    if (known == number) return name;
  return nullptr;
}

const char* group_encoder_name(AVCodecID codec) {
  static constexpr std::array<std::pair<AVCodecID, const char*>, 5> kEncoders{{{AV_CODEC_ID_H264, "libx264"},
                                                                               {AV_CODEC_ID_HEVC, "libx265"},
                                                                               {AV_CODEC_ID_MJPEG, "mjpeg"},
                                                                               {AV_CODEC_ID_FFV1, "ffv1"},
                                                                               {AV_CODEC_ID_PRORES, "prores_ks"}}};
  return known_in(kEncoders, codec);
}

AVPixelFormat stored_format_of(const AVCodecParameters& stream) {
  return static_cast<AVPixelFormat>(stream.format);
}

// None: the encoder's choice for the pixel format.
const char* h264_profile_of(int profile) {
  static constexpr std::array<std::pair<int, const char*>, 7> kProfiles{
      {{FF_PROFILE_H264_BASELINE, "baseline"},
       {FF_PROFILE_H264_CONSTRAINED_BASELINE, "baseline"},
       {FF_PROFILE_H264_MAIN, "main"},
       {FF_PROFILE_H264_HIGH, "high"},
       {FF_PROFILE_H264_HIGH_10, "high10"},
       {FF_PROFILE_H264_HIGH_422, "high422"},
       {FF_PROFILE_H264_HIGH_444_PREDICTIVE, "high444"}}};
  return known_in(kProfiles, profile);
}

// By what factor the step of a quantiser differs from one 6 times as fine a QP below: the step doubles every 6.
std::string ratio_text(double qp_difference) {
  return fmt::format("{:.4f}", std::exp2(std::clamp(qp_difference, -12.0, 12.0) / 6));
}

int whole_qp(double qp) {
  return static_cast<int>(std::lround(std::clamp(qp, 1.0, 51.0)));
}

// Keyframes come at the begin of a group alone.
std::string quantiser_parameters(const GroupFormat& format, const GroupQuality& quality) {
  const bool intra = format.is_intra_only;
  const double predicted = intra ? quality.qp_intra : quality.qp_predicted;
  return fmt::format("qp={}:ipratio={}:pbratio={}:scenecut=0:bframes={}", whole_qp(predicted),
                     ratio_text(predicted - quality.qp_intra), ratio_text(quality.qp_bidirectional - predicted),
                     std::min(format.most_bidirectional, 16));
}

void set_up_h264_group(const GroupFormat& format, const GroupQuality& quality, AVCodecContext& context,
                       AVDictionary** options) {
  context.thread_count = kH264Threads;
  context.level = format.stream->level;
  if (const char* const profile = h264_profile_of(format.stream->profile)) av_dict_set(options, "profile", profile, 0);
  const std::string parameters =
      quantiser_parameters(format, quality) + fmt::format(":keyint=infinite:b-pyramid={}:sps-id={}:stitchable=1:{}",
                                                          format.reorder_depth > 1 ? "normal" : "none",
                                                          format.sequence_set, kH264Parameters);
  av_dict_set(options, "x264-params", parameters.c_str(), 0);
}

void set_up_hevc_group(const GroupFormat& format, const GroupQuality& quality, AVDictionary** options) {
  const std::string parameters = quantiser_parameters(format, quality) +
                                 fmt::format(":keyint=-1:open-gop=0:b-pyramid={}:repeat-headers=0:aud=0:{}",
                                             format.reorder_depth > 1 ? 1 : 0, kHevcParameters);
  av_dict_set(options, "x265-params", parameters.c_str(), 0);
}

// The tables themselves: the encoder scales them by its quantiser of 8 eighths. Its first step of each is always 8.
void set_up_mjpeg_group(const GroupQuality& quality, AVCodecContext& context) {
  context.flags |= AV_CODEC_FLAG_QSCALE;
  context.thread_count = 1;
  const bool has_tables = quality.tables.luma[1] > 0;
  const int scale = has_tables ? 8 : 2;
  context.global_quality = FF_QP2LAMBDA * scale;
  context.qmin = context.qmax = scale;
  if (!has_tables) return;
  const auto copied = [](const JpegTable& table) {
    auto* const steps = static_cast<std::uint16_t*>(av_malloc(64 * sizeof(std::uint16_t)));
    if (steps == nullptr) throw std::bad_alloc();
    std::transform(table.begin(), table.end(), steps,
                   [](int step) { return static_cast<std::uint16_t>(std::clamp(step, 1, 255)); });
    return steps;
  };
  context.intra_matrix = copied(quality.tables.luma);
  context.chroma_intra_matrix = copied(quality.tables.chroma);
}

void set_up_prores(const GroupFormat& format, AVDictionary** options) {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kProfiles{
      {{"apco", "proxy"}, {"apcs", "lt"}, {"apcn", "standard"}, {"apch", "hq"}, {"ap4h", "4444"}, {"ap4x", "4444xq"}}};
  const std::uint32_t tag = format.stream->codec_tag;
  for (const auto& [name, profile] : kProfiles)
    if (tag == MKTAG(name[0], name[1], name[2], name[3])) av_dict_set(options, "profile", profile, 0);
  av_dict_set(options, "vendor", "apl0", 0);
}

// The ways in which FFV1 may be set up; which one a stream has is in its header.
struct Ffv1Way {
  const char* coder;
  int context;
  int slices;
  int checksums;
};

std::vector<Ffv1Way> ffv1_ways() {
  std::vector<Ffv1Way> ways;
  for (const int slices : {4, 0, 6, 9, 12, 15, 16, 20, 24, 30})
    for (const int checksums : {1, 0})
      for (const char* const coder : {"rice", "ac", "range_tab", "range_def"})
        for (const int context : {0, 1}) ways.push_back({coder, context, slices, checksums});
  return ways;
}

void set_up_picture(const GroupFormat& format, AVCodecContext& context) {
  const AVCodecParameters& stream = *format.stream;
  context.width = stream.width;
  context.height = stream.height;
  context.pix_fmt = stored_format_of(stream);
  context.time_base = format.tick;
  context.framerate = format.frame_rate;
  context.sample_aspect_ratio = stream.sample_aspect_ratio;
  context.color_range = stream.color_range;
  context.color_primaries = stream.color_primaries;
  context.color_trc = stream.color_trc;
  context.colorspace = stream.color_space;
  context.chroma_sample_location = stream.chroma_location;
  context.flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
  context.max_b_frames = format.most_bidirectional;
}

CodecPtr group_context(const AVCodec& codec, const GroupFormat& format) {
  CodecPtr context = new_context(&codec);
  set_up_picture(format, *context);
  return context;
}

ByteSpan encoder_header(const AVCodecContext& encoder) {
  return {encoder.extradata, static_cast<std::size_t>(encoder.extradata_size)};
}

// The encoder whose header is the stream's, so that its packets are decoded as the stream's are.
Result<CodecPtr> ffv1_like(const AVCodec& codec, const GroupFormat& format) {
  const ByteSpan wanted(format.stream->extradata, static_cast<std::size_t>(format.stream->extradata_size));
  if (wanted.empty())  // versions 0 and 1, which have their parameters in each image
    return fail("", "is FFV1 of version 0 or 1, which this program does not write; use the codec ffv1",
                ErrorKind::usage);
  for (const Ffv1Way& way : ffv1_ways()) {
    CodecPtr context = group_context(codec, format);
    context->level = 3;
    context->gop_size = 1;
    context->slices = way.slices;
    context->thread_count = 1;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "coder", way.coder, 0);
    av_dict_set_int(&options, "context", way.context, 0);
    av_dict_set_int(&options, "slicecrc", way.checksums, 0);
    Result<CodecPtr> encoder = opened(codec, std::move(context), options);
    if (encoder && std::ranges::equal(encoder_header(**encoder), wanted)) return encoder;
  }
  return fail("", "is FFV1 of a kind that this program does not write; use the codec ffv1", ErrorKind::usage);
}

double log2_of(double bytes) {
  return std::log2(std::max(bytes, 1.0));
}

// What x264 and x265 do by themselves: keyframes finer, pictures between others coarser.
GroupQuality around(double qp_predicted) {
  return {.qp_intra = qp_predicted - 3, .qp_predicted = qp_predicted, .qp_bidirectional = qp_predicted + 2};
}

Result<double> bytes_at(double qp, const std::vector<Frame>& frames, const GroupFormat& format) {
  Result<GroupEncoder> encoder = GroupEncoder::open(format, around(qp));
  if (!encoder) return fail(encoder.error());
  std::vector<EncodedPacket> packets;
  std::int64_t pts = 0;
  for (const Frame& frame : frames)
    if (const Result<void> added = encoder->add(frame, pts++, packets); !added) return fail(added.error());
  if (const Result<void> ended = encoder->finish(packets); !ended) return fail(ended.error());
  double bytes = 0;
  for (const EncodedPacket& packet : packets) bytes += static_cast<double>(packet.bytes.size());
  return bytes;
}

}  // namespace

Orientation inverse(const Orientation& orientation) {
  if (!orientation.transpose) return orientation;
  return {.transpose = true, .flip_columns = orientation.flip_rows, .flip_rows = orientation.flip_columns};
}

Result<void> check_group_codec(const AVCodecParameters& stream) {
  const char* const name = group_encoder_name(stream.codec_id);
  const char* const own_name = avcodec_get_name(stream.codec_id);
  if (name == nullptr)
    return fail("",
                fmt::format("is {}; the codec source is for footage in h264, hevc, mjpeg, ffv1 and prores: use {}",
                            own_name, stream.codec_id == AV_CODEC_ID_AV1 ? "av1" : "h264, or ffv1 without a loss"),
                ErrorKind::usage);
  if (stream.field_order != AV_FIELD_PROGRESSIVE && stream.field_order != AV_FIELD_UNKNOWN)
    return fail("", "is interlaced, and whole pictures alone are encoded: use h264, or ffv1 without a loss",
                ErrorKind::usage);
  const Result<const AVCodec*> encoder = found_encoder(name);
  if (!encoder) return fail(encoder.error());
  const AVPixelFormat format = stored_format_of(stream);
  const bool is_known = format != AV_PIX_FMT_NONE;
  if (is_known && supports(**encoder, format) && conversion_of(format).text.empty()) return {};
  const char* const format_name = is_known ? av_get_pix_fmt_name(format) : "an unknown format";
  return fail(
      "", fmt::format("has samples ({}) that the encoder {} does not take as they are: use ffv1", format_name, name),
      ErrorKind::usage);
}

Result<GroupEncoder> GroupEncoder::open(const GroupFormat& format, const GroupQuality& quality) {
  if (const Result<void> known = check_group_codec(*format.stream); !known) return fail(known.error());
  const AVCodec& codec = *avcodec_find_encoder_by_name(group_encoder_name(format.stream->codec_id));
  if (format.stream->codec_id == AV_CODEC_ID_FFV1) {
    Result<CodecPtr> encoder = ffv1_like(codec, format);
    if (!encoder) return fail(encoder.error());
    return GroupEncoder(format, std::move(*encoder));
  }
  CodecPtr context = group_context(codec, format);
  AVDictionary* options = nullptr;
  if (format.stream->codec_id == AV_CODEC_ID_H264) set_up_h264_group(format, quality, *context, &options);
  if (format.stream->codec_id == AV_CODEC_ID_HEVC) set_up_hevc_group(format, quality, &options);
  if (format.stream->codec_id == AV_CODEC_ID_MJPEG) set_up_mjpeg_group(quality, *context);
  if (format.stream->codec_id == AV_CODEC_ID_PRORES) set_up_prores(format, &options);
  Result<CodecPtr> encoder = opened(codec, std::move(context), options);
  if (!encoder) return fail(encoder.error());
  return GroupEncoder(format, std::move(*encoder));
}

std::vector<Bytes> GroupEncoder::parameter_sets() const {
  const AVCodecID codec = format_.stream->codec_id;
  std::vector<Bytes> sets;
  if (!has_parameter_sets(codec)) return sets;
  const HevcNumbers numbers{format_.video_set, format_.sequence_set, format_.picture_set, format_.stream->level};
  for (const ByteSpan unit : nal_units_of(encoder_header(*encoder_), 0)) {
    if (!is_parameter_set(unit, codec)) continue;
    sets.push_back(codec == AV_CODEC_ID_HEVC ? renumbered(unit, numbers) : Bytes(unit.begin(), unit.end()));
  }
  return sets;
}

Bytes GroupEncoder::stream_bytes(ByteSpan packet) const {
  const AVCodecID codec = format_.stream->codec_id;
  if (!has_parameter_sets(codec)) return {packet.begin(), packet.end()};
  const HevcNumbers numbers{format_.video_set, format_.sequence_set, format_.picture_set, format_.stream->level};
  const int length_bytes = nal_length_bytes(*format_.stream);
  Bytes bytes;
  if (length_bytes == 0 && !has_begun_)
    for (const Bytes& set : parameter_sets()) append_nal(bytes, set, 0);
  for (const ByteSpan unit : nal_units_of(packet, 0)) {
    if (is_dispensable(unit, codec) || is_parameter_set(unit, codec)) continue;
    if (codec == AV_CODEC_ID_HEVC)
      append_nal(bytes, renumbered(unit, numbers), length_bytes);
    else
      append_nal(bytes, unit, length_bytes);
  }
  return bytes;
}

Result<void> GroupEncoder::add(const Frame& frame, std::int64_t pts, std::vector<EncodedPacket>& packets) {
  const FramePtr image = new_image(*encoder_);
  if (av_frame_get_buffer(image.get(), 0) < 0) throw std::bad_alloc();
  fill(*image, oriented(frame, inverse(format_.orientation)));
  image->pts = pts;
  image->quality = encoder_->global_quality;
  return encode(image.get(), packets);
}

Result<void> GroupEncoder::finish(std::vector<EncodedPacket>& packets) {
  return encode(nullptr, packets);
}

Result<void> GroupEncoder::encode(const AVFrame* image, std::vector<EncodedPacket>& packets) {
  const auto failed = [](int error) {
    check_memory(error);
    return fail("", "could not be encoded: " + text_of(error), ErrorKind::write_failed);
  };
  if (const int sent = avcodec_send_frame(encoder_.get(), image); sent < 0) return failed(sent);
  while (true) {
    const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
    if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return {};
    if (received < 0) return failed(received);
    packets.push_back({.bytes = stream_bytes({packet_->data, static_cast<std::size_t>(packet_->size)}),
                       .pts = packet_->pts,
                       .key = (packet_->flags & AV_PKT_FLAG_KEY) != 0});
    has_begun_ = true;
    av_packet_unref(packet_.get());
  }
}

std::optional<GroupQuality> stated_quality(const std::vector<Frame>& first, const GroupFormat& format) {
  std::array<double, 4> sums{};
  std::array<int, 4> counts{};
  GroupQuality quality;
  const cv::Size upright_px = oriented(cv::Size(format.stream->width, format.stream->height), format.orientation);
  for (const Frame& frame : first) {
    if (!frame.quantisers) continue;
    if (frame.quantisers->kind == QuantiserKind::jpeg)
      quality.tables = oriented(frame.quantisers, upright_px, inverse(format.orientation))->tables;
    if (frame.quantisers->kind != QuantiserKind::h264) continue;
    const auto type = static_cast<std::size_t>(frame.quantisers->type);
    sums[type] += frame.quantisers->mean;
    ++counts[type];
  }
  const AVCodecID codec = format.stream->codec_id;
  if (codec != AV_CODEC_ID_H264 && codec != AV_CODEC_ID_HEVC) return quality;
  const auto mean_of = [&](PictureType type) -> std::optional<double> {
    const auto i = static_cast<std::size_t>(type);
    return counts[i] > 0 ? std::optional(sums[i] / counts[i]) : std::nullopt;
  };
  const std::optional<double> intra = mean_of(PictureType::intra);
  const std::optional<double> predicted = mean_of(PictureType::predicted);
  const std::optional<double> bidirectional = mean_of(PictureType::bidirectional);
  if (!intra && !predicted && !bidirectional) return std::nullopt;
  quality = around(predicted ? *predicted : intra ? *intra + 3 : *bidirectional - 2);
  quality.qp_intra = intra.value_or(quality.qp_intra);
  quality.qp_bidirectional = bidirectional.value_or(quality.qp_bidirectional);
  return quality;
}

// Interpolated between two, as the logarithm of the size is nearly straight over QP.
Result<GroupQuality> quality_by_size(const std::vector<Frame>& first, double bytes, const GroupFormat& format) {
  constexpr double kFine = 22;
  constexpr double kCoarse = 34;
  const Result<double> most = bytes_at(kFine, first, format);
  if (!most) return fail(most.error());
  const Result<double> least = bytes_at(kCoarse, first, format);
  if (!least) return fail(least.error());
  const double fall = log2_of(*most) - log2_of(*least);
  if (!(fall > 0.01)) return around(kFine);
  return around(std::clamp(kFine + (kCoarse - kFine) * (log2_of(*most) - log2_of(bytes)) / fall, 4.0, 48.0));
}

}  // namespace sigs::libav
