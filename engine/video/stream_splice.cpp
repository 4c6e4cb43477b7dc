// SPDX-License-Identifier: MIT
#include "video/stream_splice.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"
#include "base/threads.h"
#include "video/image_sequence.h"
#include "video/libav/splice_file.h"
#include "video/video_writer.h"

namespace sigs {
namespace {

namespace fs = std::filesystem;

bool codes_each_alone(AVCodecID codec) {
  return libav::is_intra_only(codec) || codec == AV_CODEC_ID_FFV1;
}

// Of a container that can be written as it was.
Result<void> check_container(const libav::Demuxer& demuxer, const libav::Orientation& orientation) {
  const std::string_view format = demuxer.format().iformat->name;
  const bool is_avi_of_images = format == "avi" && codes_each_alone(demuxer.stream().codecpar->codec_id);
  if (!libav::has_true_time_stamps(demuxer.format()) && !is_avi_of_images)
    return fail("",
                fmt::format("is in the container {}, whose index or times cannot be relied on: copy it into mp4 or mkv "
                            "first (ffmpeg -i FILE -map 0 -c copy OUT.mkv), or use the codec h264",
                            format),
                ErrorKind::usage);
  if (!(orientation == libav::Orientation{}) && format.starts_with("matroska"))
    return fail("", "is turned by its container, which FFmpeg does not write into mkv; use the codec h264",
                ErrorKind::usage);
  return {};
}

// Footage that can be spliced, opened.
struct Allowed {
  libav::Demuxer demuxer;
  libav::Orientation orientation;
};

Result<Allowed> allowed(const VideoInfo& footage, const std::atomic<bool>* cancel) {
  if (is_image_sequence(footage.path))
    return fail("", "is a sequence of images, which has no packets to copy: use png", ErrorKind::usage);
  Result<libav::Demuxer> demuxer = libav::Demuxer::open(footage.path, cancel);
  if (!demuxer) return fail(demuxer.error());
  if (const Result<void> known = libav::check_group_codec(*demuxer->stream().codecpar); !known)
    return fail(known.error());
  const Result<libav::Orientation> orientation = libav::orientation_of(demuxer->stream());
  if (!orientation) return fail(orientation.error());
  if (const Result<void> kept = check_container(*demuxer, *orientation); !kept) return fail(kept.error());
  return Allowed{std::move(*demuxer), *orientation};
}

// By the packets; in AVI, of codecs that code each picture alone, as they come.
Result<libav::FrameOrder> packet_order(const libav::PacketTable& table, const libav::Demuxer& demuxer) {
  if (auto order = libav::order_from_packets(table, demuxer.format(), demuxer.stream())) return std::move(*order);
  if (!codes_each_alone(demuxer.stream().codecpar->codec_id))
    return fail("", "does not tell by its packets which picture is shown when; use the codec h264", ErrorKind::usage);
  libav::FrameOrder order{.intra_only = true};
  for (int i = 0; i < table.size(); ++i)
    if (table[i].size > 0 && !table[i].discarded) order.ordinals.push_back(i);
  return order;
}

int free_id(const std::set<int>& used, int from, int down_to) {
  for (int id = from; id >= down_to; --id)
    if (!used.contains(id)) return id;
  return -1;
}

// Numbers for parameter sets that the stream does not use.
Result<void> number_parameter_sets(libav::GroupFormat& format, const AVCodecParameters& stream) {
  const bool is_h264 = stream.codec_id == AV_CODEC_ID_H264;
  libav::ParameterSetIds used = libav::ids_of(libav::parameter_sets_in(stream), stream.codec_id);
  if (is_h264) used.sequence.merge(used.picture);  // x264 gives both the same number
  format.sequence_set = free_id(used.sequence, is_h264 ? 31 : 15, 0);
  format.picture_set = is_h264 ? format.sequence_set : free_id(used.picture, 30, 15);
  format.video_set = is_h264 ? 0 : free_id(used.video, 15, 0);
  if (std::min({format.sequence_set, format.picture_set, format.video_set}) >= 0) return {};
  return fail("", "uses all numbers of parameter sets; use the codec h264", ErrorKind::usage);
}

// Opens an encoder once, to see that there is one for such a stream, and adds its parameter sets to the header.
Result<void> try_encoder(libav::Splice& splice, const AVCodecParameters& stream) {
  const bool has_sets = stream.codec_id == AV_CODEC_ID_H264 || stream.codec_id == AV_CODEC_ID_HEVC;
  if (has_sets)
    if (const Result<void> numbered = number_parameter_sets(splice.format, stream); !numbered) return numbered;
  libav::GroupFormat format = splice.format;
  format.stream = &stream;
  const Result<libav::GroupEncoder> encoder = libav::GroupEncoder::open(format, {});
  if (!encoder) return fail(encoder.error());
  if (!has_sets) return {};
  splice.parameter_sets = encoder->parameter_sets();
  splice.header = libav::with_parameter_sets(stream, splice.parameter_sets);
  if (!splice.header.empty()) return {};
  return fail("", "has no place for more parameter sets; use the codec h264", ErrorKind::usage);
}

void set_format(libav::Splice& splice, const libav::Demuxer& demuxer) {
  const libav::SpliceLayout& layout = splice.layout;
  splice.format.tick = demuxer.stream().time_base;
  splice.format.frame_rate = libav::frame_rate_of(demuxer);
  splice.format.is_intra_only = layout.is_intra_only;
  splice.format.reorder_depth = layout.reorder_depth;
  splice.format.most_bidirectional = layout.reorder_depth == 0 ? 0 : layout.most_bidirectional;
}

// Frames of groups that are encoded though none of their frames changes, for want of a place to begin copying at.
int encoded_in_vain(const libav::SpliceLayout& layout, const ChangedFrames& frames) {
  int in_vain = 0;
  for (const libav::EncodedPart& part : layout.parts)
    for (const libav::EncodedGroup& group : part.groups) {
      const auto begin = frames.changed.begin() + (group.first - frames.first);
      const auto end = frames.changed.begin() + (group.last - frames.first) + 1;
      if (std::find(begin, end, true) == end) in_vain += group.last - group.first + 1;
    }
  return in_vain;
}

std::vector<bool> encoded_frames(const libav::SpliceLayout& layout, const ChangedFrames& frames) {
  std::vector<bool> encoded(frames.changed.size(), false);
  for (const libav::EncodedPart& part : layout.parts)
    for (const libav::EncodedGroup& group : part.groups)
      for (int n = group.first; n <= group.last; ++n) encoded[static_cast<std::size_t>(n - frames.first)] = true;
  return encoded;
}

Result<SplicePlan> planned(const VideoInfo& footage, const ChangedFrames& frames, const std::atomic<bool>* cancel) {
  Result<Allowed> opened = allowed(footage, cancel);
  if (!opened) return fail(opened.error());
  libav::Demuxer& demuxer = opened->demuxer;
  const libav::PacketTable table = libav::PacketTable::read(demuxer);
  if (const Result<void> on = demuxer.check_interrupt(); !on) return fail(on.error());
  const Result<libav::FrameOrder> order = packet_order(table, demuxer);
  if (!order) return fail(order.error());
  if (static_cast<int>(order->ordinals.size()) != footage.frame_count())
    return fail("", "begins with pictures that cannot be decoded, or shows some twice; use the codec h264",
                ErrorKind::usage);
  Result<libav::Demuxer> second = demuxer.reopened(footage.path);
  if (!second) return fail(second.error());
  libav::PacketReader reader(footage.path, std::move(*second), table);
  auto splice = std::make_shared<libav::Splice>();
  splice->input = footage.path;
  splice->muxer = libav::muxer_of(container_of(footage));
  splice->format.orientation = opened->orientation;
  Result<libav::SpliceLayout> layout = libav::splice_layout(table, *order, frames, *demuxer.stream().codecpar, reader);
  if (!layout) return fail("", layout.error().what + "; use the codec h264", ErrorKind::usage);
  splice->layout = *std::move(layout);
  set_format(*splice, demuxer);
  if (const Result<void> sets = try_encoder(*splice, *demuxer.stream().codecpar); !sets) return fail(sets.error());
  SplicePlan plan{.encoded = encoded_frames(splice->layout, frames)};
  if (const Result<void> streams = libav::choose_streams(*splice, plan.warnings, cancel); !streams)
    return fail(streams.error());
  if (const int in_vain = encoded_in_vain(splice->layout, frames); in_vain > 0)
    plan.warnings.push_back(
        {footage.path.string(),
         fmt::format("encoded too, though without an intruder: {}, whose groups of pictures are cut by the range, or "
                     "follow an encoded one without an IDR picture",
                     count_text(in_vain, "frame"))});
  plan.splice = std::move(splice);
  return plan;
}

}  // namespace

Result<void> check_splice(const VideoInfo& footage, const std::atomic<bool>* cancel) {
  const Result<Allowed> opened = guarded([&] { return allowed(footage, cancel); });
  return opened ? Result<void>() : fail(libav::named(opened.error(), footage.path));
}

Result<SplicePlan> plan_splice(const VideoInfo& footage, const ChangedFrames& frames, const std::atomic<bool>* cancel) {
  ENSURE(!frames.changed.empty() && frames.first >= 0 && frames.last() < footage.frame_count());
  Result<SplicePlan> plan = guarded([&] { return planned(footage, frames, cancel); });
  if (cancel != nullptr && cancel->load()) return libav::interrupted();
  if (!plan) return fail(libav::named(plan.error(), footage.path));
  return plan;
}

}  // namespace sigs
