// SPDX-License-Identifier: MIT
#include "fuzz/track_promises.h"

#include <cmath>

#include "base/ensure.h"
#include "telemetry/track.h"

namespace sigs::fuzz {

namespace {

bool is_finite(double number) {
  return std::isfinite(number);
}
bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_finite(const glm::dquat& q) {
  return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}
bool is_finite(const GeodeticPosition& place) {
  return check_place(place).has_value();
}

template <class T>
void check_channel(const Channel<T>& channel) {
  ENSURE(channel.times_s.size() == channel.values.size());
  ENSURE(channel.own_times_s.empty() || channel.own_times_s.size() == channel.values.size());
  for (std::size_t i = 0; i < channel.values.size(); ++i) {
    ENSURE(std::isfinite(channel.times_s[i]));
    ENSURE(i == 0 || channel.times_s[i] >= channel.times_s[i - 1]);
    ENSURE(is_finite(channel.values[i]));
  }
}

}  // namespace

void check_track_or_message(const Result<Track>& track) {
  if (!track) return check_message(track.error());
  check_messages(track->warnings);
  for_each_channel(*track, [](const char*, const auto& channel) { check_channel(channel); });
}

}  // namespace sigs::fuzz
