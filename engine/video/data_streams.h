// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// The streams of a container that are neither video nor sound: telemetry, subtitles, time codes. Their payloads are
// read as bytes; what they mean is the reader's concern (engine/telemetry).

enum class DataKind {
  gpmf,       // GoPro's telemetry: MP4 handler "meta", tag "gpmd"
  klv,        // SMPTE 336 KLV: MISB metadata in MPEG transport streams, tag "KLVA"
  subtitles,  // text: "mov_text" (MP4, tx3g), "subrip", "ass", "webvtt"
  other,      // anything else, such as KLV in a transport stream that does not say so
};

struct DataStream {
  int index = 0;  // in the container
  DataKind kind = DataKind::other;
  std::string tag;      // four characters, "gpmd"; empty: none or not printable
  std::string codec;    // FFmpeg's name of the codec: "bin_data", "klv", "mov_text"; "none" where it knows none
  std::string handler;  // as the file names the stream's writer, without control characters: "GoPro MET"; may be empty
};

// One payload of a stream.
struct DataPacket {
  std::string bytes;              // of MP4 text, the sample as it is stored: a length of 2 bytes, then the text
  double time_s = 0;              // on the footage's time axis: 0 is the presentation time of its frame 0
  double duration_s = 0;          // 0: the container states none
  std::int64_t file_offset = -1;  // of the payload in the file, in bytes; -1: not known
};

struct DataPackets {
  std::vector<DataPacket> packets;  // in the order of the file
  // False: there is no video whose first frame could be found; time 0 is where the container begins.
  bool on_footage_time = true;
  bool broke_off = false;  // the file ends, or cannot be read on, before the container's index does
  int without_time = 0;    // packets without a time stamp; they have the time of the one before, the first ones 0
};

// The largest number of bytes that the payloads of one stream may have together. GoPro's longest files have 60 MiB.
inline constexpr std::uint64_t kDataStreamLimit_bytes = std::uint64_t{1} << 30;

// The data and subtitle streams of a container, in its order. A file with damaged video, or none, is fine.
//   cancel  while it is true, reading soon ends with the error interrupted; null, or outlives the call
// Errors: cannot_read (missing, not a regular file, no container), bad_data (an MP4 without its index), interrupted.
[[nodiscard]] Result<std::vector<DataStream>> data_streams_of(const std::filesystem::path& file,
                                                              const std::atomic<bool>* cancel = nullptr);

// All payloads of one of them. The video is not read but for its first packets, which give the time 0: that of
// FrameSource's frame 0.
//   index  DataStream::index
// Errors: as data_streams_of(), and bad_data (no such stream, payloads larger than kDataStreamLimit_bytes together).
[[nodiscard]] Result<DataPackets> read_data_stream(const std::filesystem::path& file, int index,
                                                   const std::atomic<bool>* cancel = nullptr);

}  // namespace sigs
