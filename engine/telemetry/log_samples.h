// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "telemetry/track.h"

namespace sigs {

// Filling a channel of a Track from a log that may hold anything: what no channel may hold is left out, and counted for
// a warning.

// The largest log that is read, in bytes: an hour of all sensors at their full rate has less.
inline constexpr std::uint64_t kLogLimit_bytes = std::uint64_t{2} << 30;

// Whether the track has position, attitude, velocity, rates, forces or exposure: a log without any is refused.
[[nodiscard]] bool has_samples(const Track& track);

// Whether all numbers of a value are finite.
[[nodiscard]] bool all_finite(double value);
[[nodiscard]] bool all_finite(const glm::dvec3& value);
[[nodiscard]] bool all_finite(const glm::dquat& value);
[[nodiscard]] bool all_finite(const GeodeticPosition& value);

// Why the place cannot be one: what check_place() refuses, or within 1e-6 degrees of 0, 0, which receivers write before
// they have a fix. nullptr: it can.
[[nodiscard]] const char* why_no_place(const GeodeticPosition& place);

// Samples that were left out, by reason.
class LeftOutByReason {
 public:
  // One more sample, at a time of the log's own clock in seconds.
  void count(const std::string& reason, double own_time_s);

  // One warning for each reason, with the number of samples and the time of the first. The time is on the track's axis,
  // whose zero is `zero_s` of the log's clock. A time that is not finite is not named.
  //   source  the name of the channel in the file: the warning's `where`
  void report(const std::string& source, double zero_s, std::vector<Warning>& warnings) const;

 private:
  struct Samples {
    std::size_t count = 0;
    double first_s = 0;
  };
  std::map<std::string, Samples> by_reason_;
};

// Names the gaps of a channel: intervals longer than 1 s and than five times the median interval. Names at most five,
// and then how many more there are.
void warn_of_gaps(const std::vector<double>& times_s, const std::string& source, std::vector<Warning>& warnings);

// The median; of an even number of values the upper one of the two in the middle. There must be one at least.
[[nodiscard]] double median_of(std::vector<double> values);

// The median of the intervals; 0 for fewer than two times.
[[nodiscard]] double median_interval_s(const std::vector<double>& times_s);

// A channel that is being filled, with stamps of the log's own clock; into_track() puts the zero of the axis.
template <class T>
class Samples {
 public:
  explicit Samples(std::string source, std::string clock = "time since boot") {
    channel_.source = std::move(source);
    channel_.clock = std::move(clock);
  }

  // Adds a sample, unless its value or time is not finite or the time is before that of the last sample.
  void add(double own_time_s, const T& value) {
    if (!all_finite(own_time_s) || !all_finite(value)) return leave_out("not a finite number", own_time_s);
    if (!channel_.own_times_s.empty() && own_time_s < channel_.own_times_s.back())
      return leave_out("their time is before that of the sample before them", own_time_s);
    channel_.own_times_s.push_back(own_time_s);
    channel_.values.push_back(value);
  }

  void leave_out(const std::string& reason, double own_time_s) { left_out_.count(reason, own_time_s); }

  [[nodiscard]] bool empty() const { return channel_.values.empty(); }
  [[nodiscard]] const Channel<T>& channel() const { return channel_; }
  [[nodiscard]] double first_s() const { return channel_.own_times_s.front(); }

  // The channel with its times from `zero_s` of the log's clock on; what was left out and the gaps go to the warnings.
  // A channel without values is empty, without a source.
  [[nodiscard]] Channel<T> on_axis(double zero_s, std::vector<Warning>& warnings) && {
    left_out_.report(channel_.source, zero_s, warnings);
    if (channel_.empty()) return {};
    channel_.times_s.reserve(channel_.own_times_s.size());
    for (const double own_time_s : channel_.own_times_s) channel_.times_s.push_back(own_time_s - zero_s);
    warn_of_gaps(channel_.times_s, channel_.source, warnings);
    return std::move(channel_);
  }

 private:
  Channel<T> channel_;
  LeftOutByReason left_out_;
};

}  // namespace sigs
