// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/pose.h"
#include "base/text.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

std::optional<glm::dquat> airframe_attitude(const KlvPacket& packet) {
  const std::optional<double>& pitch_deg =
      packet.platform_full_pitch_deg ? packet.platform_full_pitch_deg : packet.platform_pitch_deg;
  const std::optional<double>& roll_deg =
      packet.platform_full_roll_deg ? packet.platform_full_roll_deg : packet.platform_roll_deg;
  if (!packet.platform_heading_deg || !pitch_deg || !roll_deg) return {};
  return rotation_of_deg(*roll_deg, *pitch_deg, *packet.platform_heading_deg);
}

// The two tags for one angle are further apart than the coarser one's steps (0.0006 and 0.0015 degrees) explain.
bool contradicts_itself(const KlvPacket& packet) {
  const auto part = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b && std::abs(*a - *b) > 0.01;
  };
  return part(packet.platform_pitch_deg, packet.platform_full_pitch_deg) ||
         part(packet.platform_roll_deg, packet.platform_full_roll_deg);
}

const std::optional<double>& ellipsoid_height_m(const KlvPacket& packet) {
  return packet.sensor_full_ellipsoid_height_m ? packet.sensor_full_ellipsoid_height_m
                                               : packet.sensor_ellipsoid_height_m;
}

std::optional<glm::dquat> camera_attitude(const KlvPacket& packet) {
  const std::optional<glm::dquat> airframe = airframe_attitude(packet);
  if (!airframe || !packet.sensor_azimuth_deg || !packet.sensor_elevation_deg || !packet.sensor_roll_deg) return {};
  return *airframe * rotation_of_deg(*packet.sensor_roll_deg, *packet.sensor_elevation_deg, *packet.sensor_azimuth_deg);
}

bool has_place(const KlvPacket& packet) {
  return packet.sensor_latitude_deg && packet.sensor_longitude_deg &&
         (ellipsoid_height_m(packet) || packet.sensor_altitude_m);
}

struct KlvSamples {
  explicit KlvSamples(const std::string& clock)
      : position("tags 13, 14 and a height", clock),
        airframe("tags 5, 90 (6), 91 (7)", clock),
        camera("tags 5, 90 (6), 91 (7), 18, 19, 20", clock) {}

  void add(const KlvPacket& packet, double t_s, bool by_ellipsoid) {
    if (has_place(packet)) take_place(packet, t_s, by_ellipsoid);
    if (const std::optional<glm::dquat> attitude = airframe_attitude(packet)) airframe.add(t_s, *attitude);
    if (const std::optional<glm::dquat> attitude = camera_attitude(packet)) camera.add(t_s, *attitude);
  }

  void take_place(const KlvPacket& packet, double t_s, bool by_ellipsoid) {
    const std::optional<double>& height_m = by_ellipsoid ? ellipsoid_height_m(packet) : packet.sensor_altitude_m;
    if (!height_m) return position.leave_out("no height above the mean sea, which others have", t_s);
    add_place(position, t_s, {*packet.sensor_latitude_deg, *packet.sensor_longitude_deg, *height_m});
  }

  Samples<GeodeticPosition> position;
  Samples<glm::dquat> airframe;
  Samples<glm::dquat> camera;
};

// On the footage's axis the packets' own time stamps say what UTC time 0 is: the first that goes with the others.
void add_utc(Track& track, const std::vector<TimedKlvPacket>& packets, bool on_footage_time) {
  StampedValues<const TimedKlvPacket*> stamped;
  const auto leave_out = [](double, const TimedKlvPacket*) {};
  for (const TimedKlvPacket& timed : packets)
    if (timed.packet.unix_s) stamped.add(*timed.packet.unix_s, &timed, leave_out);
  stamped.finish(leave_out);
  if (stamped.values().empty()) return;
  const TimedKlvPacket& first = *stamped.values().front();
  track.utc_at_zero_s = *first.packet.unix_s - (on_footage_time ? *first.footage_s : 0);
}

// With what is wrong with the packets.
Result<Track> finished(Result<Track> track, const KlvPackets& read) {
  if (!track) return track;
  std::vector<Warning>& warnings = track->warnings;
  const std::size_t before = warnings.size();
  if (read.bad_checksums > 0)
    warnings.push_back({"checksum", count_text(read.bad_checksums, "packet") + " left out: the checksum is wrong"});
  if (read.broken > 0)
    warnings.push_back({"", count_text(read.broken, "packet") + " left out: the items do not fit into the packet"});
  if (read.skipped_bytes > 0)
    warnings.push_back({"", count_text(read.skipped_bytes, "byte") + " skipped that belong to no packet"});
  if (read.cut_off) warnings.push_back({"", "a packet is cut off, or its length is damaged"});
  track->damaged |= warnings.size() > before;
  return track;
}

}  // namespace

bool is_klv_stream(const DataStream& stream) {
  return stream.kind == DataKind::klv;
}

Result<Track> klv_track(const std::vector<TimedKlvPacket>& packets, const std::filesystem::path& file) {
  const bool on_footage_time =
      !packets.empty() && std::ranges::all_of(packets, [](const auto& timed) { return timed.footage_s.has_value(); });
  Track track{.file = file, .format = "MISB ST 0601", .on_footage_time = on_footage_time};
  for (const TimedKlvPacket& timed : packets)
    if (const std::optional<double>& fov_deg = timed.packet.horizontal_fov_deg; !track.lens && fov_deg && *fov_deg > 0)
      track.lens = LoggedLens{.source = "tag 16", .horizontal_fov_rad = rad_of_deg(*fov_deg)};
  const bool by_ellipsoid = std::ranges::all_of(packets, [](const TimedKlvPacket& timed) {
    return !has_place(timed.packet) || ellipsoid_height_m(timed.packet);
  });
  add_utc(track, packets, on_footage_time);
  const double zero_s = on_footage_time ? 0 : track.utc_at_zero_s.value_or(0);
  KlvSamples samples(on_footage_time ? "footage" : "UTC");
  std::size_t without_time = 0;
  std::size_t without_checksum = 0;
  std::size_t contradictions = 0;
  for (const TimedKlvPacket& timed : packets) {
    const std::optional<double> t_s = on_footage_time ? timed.footage_s : timed.packet.unix_s;
    without_checksum += timed.packet.has_checksum ? 0 : 1;
    without_time += t_s ? 0 : 1;
    contradictions += contradicts_itself(timed.packet) ? 1 : 0;
    if (t_s) samples.add(timed.packet, *t_s, by_ellipsoid);
    if (track.device.empty())
      track.device = timed.packet.platform + (timed.packet.sensor.empty() ? "" : " (" + timed.packet.sensor + ")");
  }
  track.position = std::move(samples.position).on_axis(zero_s, track.warnings);
  track.height_above_ellipsoid = by_ellipsoid && !track.position.empty();
  track.ned_from_airframe = std::move(samples.airframe).on_axis(zero_s, track.warnings);
  track.ned_from_camera = std::move(samples.camera).on_axis(zero_s, track.warnings);
  if (without_time > 0)
    track.warnings.push_back({"tag 2", count_text(without_time, "packet") + " left out: no precision time stamp"});
  if (contradictions > 0)
    track.warnings.push_back({"tags 90, 91", "in " + count_text(contradictions, "packet") +
                                                 " pitch or roll is not that of tags 6 and 7; 90 and 91 are taken"});
  if (without_checksum > 0)
    track.warnings.push_back({"tag 1", count_text(without_checksum, "packet") + " without a checksum"});
  if (!track.position.empty() && !by_ellipsoid)
    track.warnings.push_back({"tag 15", "heights are above the mean sea, not above the ellipsoid"});
  if (!has_samples(track))
    return fail(file.string(), "has no intact ST 0601 packet with a time and a place or attitude");
  return track;
}

Result<Track> klv_file_track(std::string_view bytes, const std::filesystem::path& file) {
  const KlvPackets read = klv_packets(bytes);
  std::vector<TimedKlvPacket> packets;
  for (const KlvPacket& packet : read.packets) packets.push_back({.packet = packet});
  return finished(klv_track(packets, file), read);
}

// The payloads of a stream may each hold one packet, several, or a part of one: they are joined, and a packet has the
// time of the payload in which its key begins.
Result<Track> klv_stream_track(const std::filesystem::path& file, const DataPackets& payloads) {
  const bool has_times = payloads.on_footage_time && payloads.without_time == 0;
  std::string bytes;
  std::vector<std::size_t> ends;
  for (const DataPacket& payload : payloads.packets) ends.push_back((bytes += payload.bytes).size());
  const KlvPackets read = klv_packets(bytes);
  std::vector<TimedKlvPacket> packets;
  for (const KlvPacket& packet : read.packets) {
    const auto payload = std::upper_bound(ends.begin(), ends.end(), packet.offset) - ends.begin();
    const double time_s = payloads.packets[static_cast<std::size_t>(payload)].time_s;
    packets.push_back({.packet = packet, .footage_s = has_times ? std::optional(time_s) : std::nullopt});
  }
  Result<Track> track = finished(klv_track(packets, file), read);
  if (!track) return track;
  track->damaged |= payloads.broke_off;
  if (!has_times)
    track->warnings.push_back({"KLV stream",
                               "its packets have no presentation times (asynchronous KLV); times are those "
                               "of the precision time stamp, and the time of frame 0 has to be found"});
  return track;
}

}  // namespace sigs
