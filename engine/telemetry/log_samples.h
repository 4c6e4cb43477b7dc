// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "telemetry/track.h"

namespace sigs {

// Filling a channel of a Track from a log that may hold anything: what no channel may hold is left out, and counted for
// a warning.

// The largest log that is read, in bytes: an hour of all sensors at their full rate has less.
inline constexpr std::uint64_t kLogLimit_bytes = std::uint64_t{2} << 30;

// Whether the track has a channel that is not empty: a log without any is refused.
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

// The median of the intervals; 0 for fewer than two times.
[[nodiscard]] double median_interval_s(const std::vector<double>& times_s);

// The sample of a channel that is nearest to a time; none of an empty one.
template <class T>
[[nodiscard]] std::optional<T> value_near(const Channel<T>& channel, double time_s) {
  const auto nearest =
      std::ranges::min_element(channel.times_s, {}, [&](double own_s) { return std::abs(own_s - time_s); });
  if (nearest == channel.times_s.end()) return std::nullopt;
  return channel.values[static_cast<std::size_t>(nearest - channel.times_s.begin())];
}

// What becomes of stamps that came late: after stamps that are later than they are.
enum class LateStamps { wait, leave_out, replace };

// Which stamps are wrong: those that came late, or those before them. The ones before are wrong if they are a jump
// ahead, farther than three usual intervals from the stamps on both sides, and no more of them than came late (fewer,
// unless the late ones go on within three intervals where the jump began). A thousand or more are no outliers: the
// clock was set. `wait` where more late stamps would tell.
//   kept_s  not falling, the last of them after late_s.front();  late_s  not falling, at least one
[[nodiscard]] LateStamps judge_late_stamps(const std::vector<double>& kept_s, const std::vector<double>& late_s);

// Up to three stamps at the begin and at the end of a log that lie farther off than all others together are long, and
// than a thousand usual intervals. Of fewer than ten stamps none.
struct LoneStamps {
  std::size_t at_begin = 0;
  std::size_t at_end = 0;
};
[[nodiscard]] LoneStamps lone_stamps(const std::vector<double>& times_s);

// Values with their stamps in the order of a log, of which outliers are left out: a stamp far ahead of its neighbours,
// rather than all that follow it and are before it, and a stamp that is behind them.
template <class T>
class StampedValues {
 public:
  // Adds a value; the stamp is finite. left_out(stamp, value) is called for each that is wrong, once that shows.
  template <class LeftOut>
  void add(double time_s, T value, const LeftOut& left_out) {
    if (times_s_.empty() || time_s >= times_s_.back()) {
      give_up_late(left_out);
      times_s_.push_back(time_s);
      values_.push_back(std::move(value));
      return;
    }
    if (!late_s_.empty() && time_s < late_s_.back()) return left_out(time_s, value);
    late_s_.push_back(time_s);
    late_.push_back(std::move(value));
    const LateStamps verdict = judge_late_stamps(times_s_, late_s_);
    if (verdict == LateStamps::leave_out) give_up_late(left_out);
    if (verdict == LateStamps::replace) replace_by_late(left_out);
  }

  // To be called once, after the last value.
  template <class LeftOut>
  void finish(const LeftOut& left_out) {
    give_up_late(left_out);
    const LoneStamps lone = lone_stamps(times_s_);
    for (std::size_t i = 0; i < lone.at_end; ++i) drop_last(left_out);
    for (std::size_t i = 0; i < lone.at_begin; ++i) left_out(times_s_[i], values_[i]);
    times_s_.erase(times_s_.begin(), times_s_.begin() + static_cast<std::ptrdiff_t>(lone.at_begin));
    values_.erase(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(lone.at_begin));
  }

  [[nodiscard]] std::vector<double>& times_s() { return times_s_; }
  [[nodiscard]] std::vector<T>& values() { return values_; }
  [[nodiscard]] const std::vector<double>& times_s() const { return times_s_; }
  [[nodiscard]] const std::vector<T>& values() const { return values_; }

 private:
  template <class LeftOut>
  void give_up_late(const LeftOut& left_out) {
    for (std::size_t i = 0; i < late_s_.size(); ++i) left_out(late_s_[i], late_[i]);
    late_s_.clear();
    late_.clear();
  }

  template <class LeftOut>
  void drop_last(const LeftOut& left_out) {
    left_out(times_s_.back(), values_.back());
    times_s_.pop_back();
    values_.pop_back();
  }

  template <class LeftOut>
  void replace_by_late(const LeftOut& left_out) {
    while (!times_s_.empty() && times_s_.back() > late_s_.front()) drop_last(left_out);
    for (std::size_t i = 0; i < late_s_.size(); ++i) {
      times_s_.push_back(late_s_[i]);
      values_.push_back(std::move(late_[i]));
    }
    late_s_.clear();
    late_.clear();
  }

  std::vector<double> times_s_;
  std::vector<T> values_;
  std::vector<double> late_s_;  // before the last of times_s_
  std::vector<T> late_;
};

// A channel that is being filled, with stamps of the log's own clock; on_axis() puts the zero of the axis.
template <class T>
class Samples {
 public:
  explicit Samples(std::string source, std::string clock = "time since boot") {
    channel_.source = std::move(source);
    channel_.clock = std::move(clock);
  }

  // Adds a sample, unless its value or time is not finite. Those whose time does not go with the others' are left out
  // (StampedValues).
  void add(double own_time_s, const T& value) {
    if (!all_finite(own_time_s) || !all_finite(value)) return leave_out("not a finite number", own_time_s);
    stamped_.add(own_time_s, value, out_of_order());
  }

  void leave_out(const std::string& reason, double own_time_s) { left_out_.count(reason, own_time_s); }

  // Of those so far; none of the values has a later time than the last.
  [[nodiscard]] bool empty() const { return stamped_.values().empty(); }
  [[nodiscard]] const std::vector<double>& own_times_s() const { return stamped_.times_s(); }
  [[nodiscard]] const std::vector<T>& values() const { return stamped_.values(); }

  // The channel with its times from `zero_s` of the log's clock on; what was left out and the gaps go to the warnings.
  // A channel without values is empty, without a source.
  [[nodiscard]] Channel<T> on_axis(double zero_s, std::vector<Warning>& warnings) && {
    stamped_.finish(out_of_order());
    channel_.own_times_s = std::move(stamped_.times_s());
    channel_.values = std::move(stamped_.values());
    left_out_.report(channel_.source, zero_s, warnings);
    if (channel_.empty()) return {};
    channel_.times_s.reserve(channel_.own_times_s.size());
    for (const double own_time_s : channel_.own_times_s) channel_.times_s.push_back(own_time_s - zero_s);
    warn_of_gaps(channel_.times_s, channel_.source, warnings);
    return std::move(channel_);
  }

 private:
  [[nodiscard]] auto out_of_order() {
    return
        [this](double own_time_s, const T&) { leave_out("their time does not go with those around it", own_time_s); };
  }

  Channel<T> channel_;
  StampedValues<T> stamped_;
  LeftOutByReason left_out_;
};

// Adds a place, or leaves it out where it cannot be one (why_no_place()).
void add_place(Samples<GeodeticPosition>& places, double own_time_s, const GeodeticPosition& place);

// Warns that a log names images that were taken, where it does.
//   source      the name of their messages in the file
//   captures_s  their times on the log's clock, of which zero_s is the track's zero
void warn_of_captures(const std::vector<double>& captures_s, const std::string& source, double zero_s,
                      std::vector<Warning>& warnings);

// The rotation of an attitude in degrees, as logs have it.
[[nodiscard]] glm::dquat rotation_of_deg(double roll_deg, double pitch_deg, double yaw_deg);

}  // namespace sigs
