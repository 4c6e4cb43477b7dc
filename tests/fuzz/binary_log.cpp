// SPDX-License-Identifier: MIT
#include "base/ensure.h"
#include "fuzz/fuzz_input.h"
#include "fuzz/track_promises.h"
#include "telemetry/klv_packets.h"
#include "telemetry/log_formats.h"

namespace sigs::fuzz {

namespace {

// The payloads of a stream: the input in two halves, so that the second may continue the first.
DataPackets payloads_of(std::string_view bytes) {
  DataPackets payloads;
  const std::string_view halves[]{bytes.substr(0, bytes.size() / 2), bytes.substr(bytes.size() / 2)};
  for (const std::string_view payload : {bytes, halves[0], halves[1]})
    payloads.packets.push_back({.bytes = std::string(payload),
                                .time_s = static_cast<double>(payloads.packets.size()),
                                .duration_s = 1,
                                .file_offset = 0});
  return payloads;
}

void try_klv(std::string_view bytes) {
  std::vector<TimedKlvPacket> timed;
  for (const KlvPacket& packet : klv_packets(bytes).packets) {
    ENSURE(packet.offset < bytes.size());
    timed.push_back({.packet = packet});
  }
  check_track_or_message(klv_track(timed, "log.klv"));
}

}  // namespace

void try_binary_log(const FuzzInput& input) {
  check_track_or_message(ulog_track(input.bytes, "log.ulg"));
  check_track_or_message(dataflash_track(input.bytes, "log.bin"));
  check_track_or_message(track_of_gopro("clip.mp4", payloads_of(input.bytes)));
  try_klv(input.bytes);
}

}  // namespace sigs::fuzz
