// SPDX-License-Identifier: MIT
#include "video/libav/frame_order.h"

#include <algorithm>

namespace sigs::libav {
namespace {

// Codecs in which one packet is one shown image. This does not hold for MPEG-4 part 2 (packed and empty images), VP8
// (hidden ones), or H.264 in fields (two packets per image).
bool one_frame_per_packet(const AVCodecParameters& parameters) {
  switch (parameters.codec_id) {
    case AV_CODEC_ID_H264:
      return parameters.field_order == AV_FIELD_PROGRESSIVE || parameters.field_order == AV_FIELD_UNKNOWN;
    case AV_CODEC_ID_HEVC:
    case AV_CODEC_ID_VP9:
    case AV_CODEC_ID_AV1:
      return true;
    default:
      return is_intra_only(parameters.codec_id);
  }
}

bool is_in_fields(const AVCodecParameters& parameters) {
  return parameters.field_order != AV_FIELD_PROGRESSIVE && parameters.field_order != AV_FIELD_UNKNOWN;
}

// FFV1 and PNG may refer to the image before, but only in packets that are no keyframes.
bool each_stands_alone(const PacketTable& table, AVCodecID codec) {
  if (is_intra_only(codec)) return true;
  if (codec != AV_CODEC_ID_FFV1 && codec != AV_CODEC_ID_PNG) return false;
  for (int i = 0; i < table.size(); ++i)
    if (!table[i].key) return false;
  return true;
}

bool is_shown(const PacketMark& mark) {
  return !mark.discarded && mark.size > 0;
}

// The largest number of packets that come before another in decoding although they are shown after it.
int reorder_depth(const PacketTable& table, const std::vector<int>& ordinals) {
  int deepest = 0;
  // An image's place in presentation against its place in decoding; the depth is the greatest lag.
  std::vector<int> shown;
  for (int i = 0; i < table.size(); ++i)
    if (is_shown(table[i])) shown.push_back(i);
  for (size_t place = 0; place < ordinals.size(); ++place) {
    const auto decoded = std::lower_bound(shown.begin(), shown.end(), ordinals[place]) - shown.begin();
    deepest = std::max(deepest, static_cast<int>(decoded) - static_cast<int>(place));
  }
  return deepest;
}

struct StreamBasics {
  double tick_s = 0;  // of its time stamps
  double frame_period_s = 0;
};

std::vector<double> times_of(const std::vector<int64_t>& stamps, double tick_s) {
  std::vector<double> times_s;
  for (const int64_t stamp : stamps) times_s.push_back(static_cast<double>(stamp - stamps.front()) * tick_s);
  return times_s;
}

// The time stamps of the images, sorted: decoders give images in the order of their time stamps. Decoding times serve
// as well: they are the same set of instants, earlier by a constant. Nothing where stamps are missing or repeated.
std::optional<std::vector<int64_t>> sorted_stamps(const PacketTable& table, const std::vector<int>& ordinals,
                                                  int64_t PacketMark::*stamp) {
  std::vector<int64_t> stamps;
  for (const int ordinal : ordinals) stamps.push_back(table[ordinal].*stamp);
  std::sort(stamps.begin(), stamps.end());
  if (stamps.empty() || stamps.front() == AV_NOPTS_VALUE) return {};
  if (std::adjacent_find(stamps.begin(), stamps.end()) != stamps.end()) return {};
  return stamps;
}

void set_times(FrameOrder& order, const PacketTable& table, const StreamBasics& stream) {
  for (int64_t PacketMark::*stamp : {&PacketMark::pts, &PacketMark::dts})
    if (const auto stamps = sorted_stamps(table, order.ordinals, stamp)) {
      order.times_s = times_of(*stamps, stream.tick_s);
      return;
    }
  order.times_are_nominal = true;
  for (size_t n = 0; n < order.ordinals.size(); ++n)
    order.times_s.push_back(static_cast<double>(n) * stream.frame_period_s);
}

}  // namespace

std::optional<FrameOrder> order_from_packets(const PacketTable& table, const AVFormatContext& format,
                                             const AVStream& stream) {
  if (!one_frame_per_packet(*stream.codecpar) || !has_true_time_stamps(format)) return {};
  const AVCodecID codec = stream.codecpar->codec_id;
  FrameOrder order{.intra_only = each_stands_alone(table, codec), .decodes_ahead = decodes_ahead(codec)};
  for (int i = 0; i < table.size(); ++i)
    if (is_shown(table[i])) order.ordinals.push_back(i);
  std::stable_sort(order.ordinals.begin(), order.ordinals.end(),
                   [&](int a, int b) { return table[a].pts < table[b].pts; });
  const auto stamps = sorted_stamps(table, order.ordinals, &PacketMark::pts);
  if (!stamps) return {};
  order.times_s = times_of(*stamps, av_q2d(stream.time_base));
  for (const int ordinal : order.ordinals) order.can_start.push_back(table[ordinal].key);
  order.reorder_depth = reorder_depth(table, order.ordinals);
  return order;
}

Result<FrameOrder> order_from_decoding(const PacketTable& table, FrameDecoder& images, AVRational frame_rate) {
  // Copied first: each start may open the file again, and the former stream then no longer exists.
  const AVStream& stream = images.demuxer().stream();
  const StreamBasics basics{.tick_s = av_q2d(stream.time_base), .frame_period_s = 1 / av_q2d(frame_rate)};
  const AVCodecID codec = stream.codecpar->codec_id;
  const bool in_fields = is_in_fields(*stream.codecpar);
  FrameOrder order;
  const auto decode_all = [&](int threads) -> Result<void> {
    order = {
        .intra_only = each_stands_alone(table, codec), .in_fields = in_fields, .decodes_ahead = decodes_ahead(codec)};
    if (const Result<void> started = images.start(0, {.threads = threads}); !started) return fail(started.error());
    while (true) {
      Result<std::optional<DecodedFrame>> image = images.next();
      if (!image) return fail(image.error());
      if (!*image) return {};
      order.ordinals.push_back((*image)->ordinal);
      order.can_start.push_back(is_key(*(*image)->frame));
    }
  };
  Result<void> decoded = decode_all(2);
  // With two threads the result of a damaged stream can depend on their timing.
  if (decoded && !images.damaged().empty()) decoded = decode_all(1);
  if (!decoded) return fail(decoded.error());
  set_times(order, table, basics);
  return order;
}

}  // namespace sigs::libav
