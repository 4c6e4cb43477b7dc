// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "video/libav/group_encoder.h"

namespace sigs::libav {
namespace {

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
