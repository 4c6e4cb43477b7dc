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

double start_of_container(const AVFormatContext& input) {
  return input.start_time == AV_NOPTS_VALUE ? 0 : static_cast<double>(input.start_time) / AV_TIME_BASE;
}

void add_packet(DataPackets& read, const AVPacket& packet, double tick_s, double zero_s) {
  DataPacket added{.bytes = std::string(reinterpret_cast<const char*>(packet.data), static_cast<size_t>(packet.size)),
                   .file_offset = packet.pos};
  if (const std::int64_t stamp = libav::stamp_of(packet); stamp != AV_NOPTS_VALUE) {
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

Result<DataPackets> read_packets(const std::filesystem::path& file, int index, double zero_s,
                                 const std::atomic<bool>* cancel) {
  const Result<libav::InputPtr> input = libav::open_input(file, cancel);
  if (!input) return fail(input.error());
  if (index < 0 || index >= static_cast<int>((*input)->nb_streams))
    return fail(file.string(), fmt::format("has no stream {}", index));
  libav::keep_only(**input, index);
  const double tick_s = av_q2d((*input)->streams[index]->time_base);
  const libav::PacketPtr packet = libav::new_packet();
  DataPackets read;
  std::uint64_t bytes = 0;
  bool corrupt = false;  // the container knows that a payload is cut off
  libav::Step step = libav::Step::end;
  while ((step = libav::next_packet(**input, index, *packet)) == libav::Step::packet) {
    bytes += static_cast<std::uint64_t>(packet->size);
    if (bytes > kDataStreamLimit_bytes)
      return fail(file.string(), fmt::format("stream {} has more than {} MiB of data; cut the file into shorter ones",
                                             index, kDataStreamLimit_bytes >> 20));
    corrupt = corrupt || (packet->flags & AV_PKT_FLAG_CORRUPT) != 0;
    add_packet(read, *packet, tick_s, zero_s);
  }
  if (cancel != nullptr && cancel->load()) return libav::interrupted();
  read.broke_off = step == libav::Step::broke_off || corrupt || lists_more(**input, index, read.packets.size());
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
    const std::optional<double> frame_0_s = libav::time_of_frame_0(**input);
    Result<DataPackets> read = read_packets(file, index, frame_0_s.value_or(start_of_container(**input)), cancel);
    if (read) read->on_footage_time = frame_0_s.has_value();
    return read;
  });
}

}  // namespace sigs
