// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <string_view>

#include "telemetry/track.h"

namespace sigs::test {

// Whether a channel keeps the promises of track.h.
template <class T>
bool is_in_order(const Channel<T>& channel) {
  if (channel.times_s.size() != channel.values.size()) return false;
  if (!channel.own_times_s.empty() && channel.own_times_s.size() != channel.values.size()) return false;
  for (std::size_t i = 0; i < channel.times_s.size(); ++i)
    if (!std::isfinite(channel.times_s[i]) || (i > 0 && channel.times_s[i] < channel.times_s[i - 1])) return false;
  return true;
}

inline bool is_in_order(const Track& track) {
  return is_in_order(track.position) && is_in_order(track.local_position_ned_m) &&
         is_in_order(track.velocity_ned_mps) && is_in_order(track.ned_from_airframe) &&
         is_in_order(track.ned_from_camera) && is_in_order(track.airframe_rate_radps) &&
         is_in_order(track.airframe_force_mps2) && is_in_order(track.exposure_s);
}

// Reads the bytes cut at `cuts` places, then `flips` times with one to eight bits changed within the first `front`
// bytes. True: each reading gave a sound track or an error that says something.
inline bool survives(const std::string& bytes, const std::function<Result<Track>(std::string_view)>& read, int cuts,
                     int flips, std::size_t front) {
  const auto is_fine = [&](std::string_view broken) {
    const Result<Track> track = read(broken);
    return track ? is_in_order(*track) : !track.error().what.empty();
  };
  std::mt19937 random(20260101);
  bool all = is_fine("");
  for (int i = 0; i < cuts; ++i) {
    const std::size_t size = i < 100 ? static_cast<std::size_t>(i) : random() % bytes.size();
    all = is_fine(std::string(bytes.substr(0, size))) && all;  // a copy: reading behind its end is seen by sanitizers
  }
  for (int i = 0; i < flips; ++i) {
    std::string broken = bytes;
    for (unsigned flip = 0; flip < 1 + random() % 8; ++flip)
      broken[random() % std::min(front, broken.size())] ^= static_cast<char>(1U << random() % 8);
    all = is_fine(broken) && all;
  }
  return all;
}

// The number of warnings with these words.
inline int warnings_with(const Track& track, std::string_view words) {
  int found = 0;
  for (const Warning& warning : track.warnings) found += warning.text().find(words) != std::string::npos ? 1 : 0;
  return found;
}

}  // namespace sigs::test
