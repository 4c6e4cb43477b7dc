// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"
#include "telemetry/klv_packets.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"
#include "video/data_streams.h"

namespace sigs {

// MISB ST 0601 metadata, in a stream of an MPEG transport stream or bare in a file.

// Whether a stream of a container is KLV; whether a file that begins so is bare KLV.
[[nodiscard]] bool is_klv_stream(const DataStream& stream);
[[nodiscard]] bool is_klv(std::string_view head);

// Reads it. In a stream whose packets have presentation times (synchronous KLV), these are the times; else the time is
// that of the packets' own precision time stamp from the first on, with UTC, and a warning that the footage's frame 0
// has to be found. The camera's attitude is the platform's times the sensor's against the platform, each yaw, then
// pitch, then roll; a packet without one of the six angles has no camera attitude. The height is that above the
// ellipsoid where every packet with a place has it, else that above the mean sea. Errors as those of read_track().
[[nodiscard]] Result<Track> read_klv_stream(const std::filesystem::path& file, const DataStream& stream,
                                            const ReadTrackOptions& options);
[[nodiscard]] Result<Track> read_klv(const std::filesystem::path& file, const ReadTrackOptions& options);

// A packet, and the time at which the container says that it is presented, if it does.
struct TimedKlvPacket {
  KlvPacket packet;
  std::optional<double> footage_s = {};
};

// The track of packets in the order of the file.
[[nodiscard]] Result<Track> klv_track(const std::vector<TimedKlvPacket>& packets, const std::filesystem::path& file);

}  // namespace sigs
