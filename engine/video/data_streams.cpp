// SPDX-License-Identifier: MIT
#include "video/data_streams.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "base/threads.h"
#include "video/libav/demuxer.h"

namespace sigs {
namespace {

// More than any codec reorders. Frame 0 is among the first packets.
constexpr int kPacketsForFrame0 = 64;
// A truncated file gives an error for each packet that its index still lists.
constexpr int kMaxReadErrorsInARow = 64;

bool is_printable(char c) {
  return c >= ' ' && c <= '~';
}

std::string tag_text(std::uint32_t tag) {
  std::string text;
  for (int i = 0; i < 4; ++i) text += static_cast<char>(tag >> (8 * i) & 0xff);
  return std::all_of(text.begin(), text.end(), is_printable) ? text : std::string();
}

// QuickTime's names begin with their length as a byte; FFmpeg leaves it in.
std::string handler_of(const AVStream& stream) {
  const AVDictionaryEntry* entry = av_dict_get(stream.metadata, "handler_name", nullptr, 0);
  std::string text = entry != nullptr ? entry->value : "";
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return !is_printable(c); }), text.end());
  return text;
}

DataKind kind_of(const AVCodecParameters& parameters, const std::string& tag) {
  if (tag == "gpmd") return DataKind::gpmf;
  if (parameters.codec_id == AV_CODEC_ID_SMPTE_KLV || tag == "KLVA") return DataKind::klv;
  if (parameters.codec_type == AVMEDIA_TYPE_SUBTITLE) return DataKind::subtitles;
  return DataKind::other;
}

bool is_data(const AVStream& stream) {
  const AVMediaType type = stream.codecpar->codec_type;
  return type == AVMEDIA_TYPE_DATA || type == AVMEDIA_TYPE_SUBTITLE || type == AVMEDIA_TYPE_UNKNOWN;
}

DataStream description_of(const AVStream& stream) {
  DataStream description{.index = stream.index, .tag = tag_text(stream.codecpar->codec_tag)};
  description.kind = kind_of(*stream.codecpar, description.tag);
  description.codec = avcodec_get_name(stream.codecpar->codec_id);
  description.handler = handler_of(stream);
  return description;
}

void keep_only(AVFormatContext& input, int index) {
  for (unsigned i = 0; i < input.nb_streams; ++i)
    input.streams[i]->discard = static_cast<int>(i) == index ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
}

enum class Step { packet, end, broke_off };

// Reads the next packet of a stream; a few that cannot be read are passed over.
Step next_packet(AVFormatContext& input, int index, AVPacket& packet) {
  for (int errors = 0; errors < kMaxReadErrorsInARow;) {
    av_packet_unref(&packet);
    const int result = av_read_frame(&input, &packet);
    libav::check_memory(result);
    if (result == AVERROR_EOF) return errors > 0 ? Step::broke_off : Step::end;
    if (result == AVERROR_EXIT) return Step::broke_off;
    if (result < 0)
      ++errors;
    else if (packet.stream_index == index)
      return Step::packet;
  }
  return Step::broke_off;
}

std::int64_t stamp_of(const AVPacket& packet) {
  return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

// The presentation time of frame 0 on the container's clock: the least among the first packets that are shown. Where
// the file may begin in the middle of a group of images, decoders give none before the first keyframe.
std::optional<double> time_of_frame_0(AVFormatContext& input) {
  const int video = libav::video_stream_of(input);
  if (video < 0) return {};
  keep_only(input, video);
  const libav::PacketPtr packet = libav::new_packet();
  const bool all_are_shown = libav::has_true_time_stamps(input);
  std::optional<std::int64_t> first;
  for (int read = 0; read < kPacketsForFrame0 && next_packet(input, video, *packet) == Step::packet;) {
    const bool is_shown = (packet->flags & AV_PKT_FLAG_DISCARD) == 0 && packet->size > 0;
    const bool can_begin = first || all_are_shown || (packet->flags & AV_PKT_FLAG_KEY) != 0;
    if (!is_shown || !can_begin || stamp_of(*packet) == AV_NOPTS_VALUE) continue;
    first = first ? std::min(*first, stamp_of(*packet)) : stamp_of(*packet);
    ++read;
  }
  if (!first) return {};
  return static_cast<double>(*first) * av_q2d(input.streams[video]->time_base);
}

double start_of_container(const AVFormatContext& input) {
  return input.start_time == AV_NOPTS_VALUE ? 0 : static_cast<double>(input.start_time) / AV_TIME_BASE;
}

void add_packet(DataPackets& read, const AVPacket& packet, double tick_s, double zero_s) {
  DataPacket added{.bytes = std::string(reinterpret_cast<const char*>(packet.data), static_cast<size_t>(packet.size)),
                   .file_offset = packet.pos};
  if (const std::int64_t stamp = stamp_of(packet); stamp != AV_NOPTS_VALUE) {
    added.time_s = static_cast<double>(stamp) * tick_s - zero_s;
  } else {
    added.time_s = read.packets.empty() ? 0 : read.packets.back().time_s;
    ++read.without_time;
  }
  added.duration_s = packet.duration > 0 ? static_cast<double>(packet.duration) * tick_s : 0;
  read.packets.push_back(std::move(added));
}

// Whether an MP4's index has more packets of a stream than could be read. FFmpeg takes that for the end of the file.
bool lists_more(const AVFormatContext& input, int index, std::size_t packets) {
  const int listed = avformat_index_get_entries_count(input.streams[index]);
  return std::string_view(input.iformat->name).starts_with("mov,mp4") && listed > 0 &&
         static_cast<std::size_t>(listed) > packets;
}

Result<void> check_cancelled(const std::atomic<bool>* cancel) {
  if (cancel != nullptr && cancel->load()) return libav::interrupted();
  return {};
}

Result<DataPackets> read_packets(const std::filesystem::path& file, int index, double zero_s,
                                 const std::atomic<bool>* cancel) {
  const Result<libav::InputPtr> input = libav::open_input(file, cancel);
  if (!input) return fail(input.error());
  if (index < 0 || index >= static_cast<int>((*input)->nb_streams))
    return fail(file.string(), fmt::format("has no stream {}", index));
  keep_only(**input, index);
  const double tick_s = av_q2d((*input)->streams[index]->time_base);
  const libav::PacketPtr packet = libav::new_packet();
  DataPackets read;
  std::uint64_t bytes = 0;
  bool corrupt = false;  // the container knows that a payload is cut off
  Step step = Step::end;
  while ((step = next_packet(**input, index, *packet)) == Step::packet) {
    bytes += static_cast<std::uint64_t>(packet->size);
    if (bytes > kDataStreamLimit_bytes)
      return fail(file.string(), fmt::format("stream {} has more than {} MiB of data; cut the file into shorter ones",
                                             index, kDataStreamLimit_bytes >> 20));
    corrupt = corrupt || (packet->flags & AV_PKT_FLAG_CORRUPT) != 0;
    add_packet(read, *packet, tick_s, zero_s);
  }
  if (const Result<void> go_on = check_cancelled(cancel); !go_on) return fail(go_on.error());
  read.broke_off = step == Step::broke_off || corrupt || lists_more(**input, index, read.packets.size());
  return read;
}

}  // namespace

Result<std::vector<DataStream>> data_streams_of(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  return guarded([&]() -> Result<std::vector<DataStream>> {
    const Result<libav::InputPtr> input = libav::open_input(file, cancel);
    if (!input) return fail(input.error());
    std::vector<DataStream> streams;
    for (unsigned i = 0; i < (*input)->nb_streams; ++i)
      if (is_data(*(*input)->streams[i])) streams.push_back(description_of(*(*input)->streams[i]));
    return streams;
  });
}

Result<DataPackets> read_data_stream(const std::filesystem::path& file, int index, const std::atomic<bool>* cancel) {
  return guarded([&]() -> Result<DataPackets> {
    const Result<libav::InputPtr> input = libav::open_input(file, cancel);
    if (!input) return fail(input.error());
    const std::optional<double> frame_0_s = time_of_frame_0(**input);
    Result<DataPackets> read = read_packets(file, index, frame_0_s.value_or(start_of_container(**input)), cancel);
    if (read) read->on_footage_time = frame_0_s.has_value();
    return read;
  });
}

}  // namespace sigs
