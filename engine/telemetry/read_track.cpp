// SPDX-License-Identifier: MIT
#include "telemetry/track.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <string_view>

#include "base/input_file.h"
#include "base/text.h"
#include "base/threads.h"
#include "telemetry/log_formats.h"
#include "telemetry/log_samples.h"
#include "telemetry/track_csv.h"
#include "video/data_streams.h"

namespace sigs {
namespace {

// A format that is a file of its own, recognised by how the file begins (kHead_bytes, or all of a shorter one).
struct FileFormat {
  const char* name;
  bool (*recognises)(std::string_view head);
  Result<Track> (*track_of)(std::string_view bytes, const std::filesystem::path& file, const std::atomic<bool>* cancel);
  std::uint64_t limit_bytes = kLogLimit_bytes;
};

// A format that is a stream of a container, recognised by what the container says about the stream.
struct StreamFormat {
  const char* name;
  bool (*recognises)(const DataStream& stream);
  Result<Track> (*track_of)(const std::filesystem::path& file, const DataStream& stream, const DataPackets& payloads);
};

// Of a format that is read so fast that nobody stops it.
template <auto kTrackOf>
Result<Track> without_cancel(std::string_view bytes, const std::filesystem::path& file, const std::atomic<bool>*) {
  return kTrackOf(bytes, file);
}

// The first that recognises a file reads it. To add a format: one line here, and README.md.
constexpr FileFormat kFileFormats[] = {
    {"PX4 ULog", is_ulog, without_cancel<ulog_track>},
    {"ArduPilot dataflash", is_dataflash, without_cancel<dataflash_track>},
    {"DJI subtitles", is_dji_subtitles, without_cancel<dji_subtitles_track>, kTextLimit_bytes},
    {"MISB ST 0601", is_klv, without_cancel<klv_file_track>},
    {"CSV", is_track_csv, track_of_csv, kTextLimit_bytes},
};
constexpr StreamFormat kStreamFormats[] = {
    {"GoPro GPMF", is_gopro, [](const auto& file, const auto&, const auto& all) { return track_of_gopro(file, all); }},
    {"MISB ST 0601 in a stream", is_klv_stream,
     [](const auto& file, const auto&, const auto& all) { return klv_stream_track(file, all); }},
    {"DJI subtitles in a stream", is_dji_subtitle_stream, dji_stream_track},
};

constexpr std::size_t kHead_bytes = 65536;

std::string head_of(const std::filesystem::path& file) {
  std::string head(kHead_bytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return head;
}

std::string known_formats() {
  std::vector<std::string> names;
  for (const StreamFormat& format : kStreamFormats) names.emplace_back(format.name);
  for (const FileFormat& format : kFileFormats) names.emplace_back(format.name);
  return listed(names);
}

tl::unexpected<Error> no_format(const std::filesystem::path& file, const std::vector<DataStream>& streams) {
  std::vector<std::string> found;
  for (const DataStream& stream : streams)
    found.push_back(stream.codec + (stream.tag.empty() ? "" : " (" + stream.tag + ")"));
  return fail(file.string(), "there is no telemetry in it that SIGS reads; known are " + known_formats() +
                                 (found.empty() ? "" : "; its data streams are " + listed(found)));
}

// What reads the file, in the format that recognises it. Errors: no_format(), those of data_streams_of().
Result<std::function<Result<Track>()>> reader_of(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  const std::string head = head_of(file);
  for (const FileFormat& format : kFileFormats)
    if (format.recognises(head))
      return [&, cancel]() -> Result<Track> {
        const Result<std::string> bytes = read_text(file, format.limit_bytes);
        return bytes ? format.track_of(*bytes, file, cancel) : fail(bytes.error());
      };
  const Result<std::vector<DataStream>> streams = data_streams_of(file, cancel);
  // What FFmpeg says of a file that is no container would mislead; of an MP4 that was cut short it helps.
  if (!streams) return streams.error().kind == ErrorKind::cannot_read ? no_format(file, {}) : fail(streams.error());
  for (const StreamFormat& format : kStreamFormats)
    for (const DataStream& stream : *streams)
      if (format.recognises(stream))
        return [&, cancel, stream]() -> Result<Track> {
          const Result<DataPackets> payloads = read_data_stream(file, stream.index, cancel);
          return payloads ? format.track_of(file, stream, *payloads) : fail(payloads.error());
        };
  return no_format(file, *streams);
}

}  // namespace

Result<Track> read_track(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  if (const Result<void> there = check_input_file(file, "flight log"); !there) return fail(there.error());
  if (!std::ifstream(file, std::ios::binary))
    return fail(file.string(), "may not be read: permission denied", ErrorKind::cannot_read);
  return guarded([&]() -> Result<Track> {
    const Result<std::function<Result<Track>()>> reader = reader_of(file, cancel);
    return reader ? (*reader)() : fail(reader.error());
  });
}

bool carries_telemetry(const std::filesystem::path& file) {
  return guarded([&]() -> Result<bool> { return reader_of(file, nullptr).has_value(); }).value_or(false);
}

}  // namespace sigs
