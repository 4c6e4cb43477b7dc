// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// Packets of MISB ST 0601, the UAS Datalink Local Set, in SMPTE ST 336 KLV: a key of 16 bytes, a length, and items of a
// tag, a length and a value each, most significant byte first.

// One packet, in the units of the standard. What the packet lacks, or marks as an error, is not there.
struct KlvPacket {
  std::size_t offset = 0;                                     // of its key within the bytes
  std::optional<double> unix_s = {};                          // tag 2; counts as UTC without leap seconds
  std::optional<double> platform_heading_deg = {};            // tag 5, from true north
  std::optional<double> platform_pitch_deg = {};              // tag 6, up to 20 degrees
  std::optional<double> platform_roll_deg = {};               // tag 7, up to 50 degrees
  std::optional<double> platform_full_pitch_deg = {};         // tag 90, full range, finer steps
  std::optional<double> platform_full_roll_deg = {};          // tag 91
  std::optional<double> sensor_latitude_deg = {};             // tag 13
  std::optional<double> sensor_longitude_deg = {};            // tag 14
  std::optional<double> sensor_altitude_m = {};               // tag 15, above the mean sea
  std::optional<double> sensor_ellipsoid_height_m = {};       // tag 75, steps of 0.3 m
  std::optional<double> sensor_full_ellipsoid_height_m = {};  // tag 104, up to 40 km
  std::optional<double> horizontal_fov_deg = {};              // tag 16
  std::optional<double> vertical_fov_deg = {};                // tag 17
  std::optional<double> sensor_azimuth_deg = {};              // tag 18, of the sensor against the platform: about its Z
  std::optional<double> sensor_elevation_deg = {};            // tag 19, then about the new Y, upwards
  std::optional<double> sensor_roll_deg = {};                 // tag 20, then about the new X, clockwise
  std::optional<double> slant_range_m = {};                   // tag 21
  std::optional<double> target_width_m = {};                  // tag 22
  std::optional<double> frame_center_latitude_deg = {};       // tag 23
  std::optional<double> frame_center_longitude_deg = {};      // tag 24
  std::optional<double> frame_center_elevation_m = {};        // tag 25, above the mean sea
  std::string platform;                                       // tag 10; printable characters only
  std::string sensor;                                         // tag 11
  bool has_checksum = false;                                  // tag 1; a packet whose checksum is wrong is left out
};

struct KlvPackets {
  std::vector<KlvPacket> packets;  // in the order of the bytes
  std::size_t bad_checksums = 0;   // packets that were left out
  std::size_t broken = 0;          // packets that were left out since their items do not fit into them
  std::size_t skipped_bytes = 0;   // that belong to no KLV packet and to no header of a metadata access unit
  bool cut_off = false;            // the last packet does not lie within the bytes
  std::size_t bytes_reread = 0;    // of packets that were left out, in which others were looked for
};

// Reads all packets with the key of ST 0601. Packets with another key are passed over, as are the 5 bytes of a metadata
// access unit's header (ISO/IEC 13818-1, 2.12.4) that may stand before each packet. The length of a packet that is left
// out may be what is damaged, so that others are looked for in it: until as many bytes were read again as there are,
// and 1 MiB. Beyond, as in a file made to take long, damaged packets are passed over whole.
[[nodiscard]] KlvPackets klv_packets(std::string_view bytes);

}  // namespace sigs
