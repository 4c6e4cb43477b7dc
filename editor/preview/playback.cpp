// SPDX-License-Identifier: MIT
#include "editor/preview/playback.h"

#include <algorithm>
#include <cmath>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

constexpr double kTolerance_s = 1e-6;  // sums of clock readings miss a time stamp by less

// A footage and a range within it, as stretches of time.
class PlayedStretch {
 public:
  PlayedStretch(const PlayTimes& times, const PlayRange& range)
      : times_(times),
        count_(static_cast<int>(times.times_s.size())),
        first_(std::clamp(range.first, 0, count_ - 1)),
        last_(std::clamp(range.last, first_, count_ - 1)) {}

  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }
  [[nodiscard]] int clamped(int frame) const { return std::clamp(frame, 0, count_ - 1); }
  [[nodiscard]] double begin_s(int frame) const { return times_.times_s[static_cast<std::size_t>(frame)]; }
  [[nodiscard]] double end_s(int frame) const {
    return frame + 1 < count_ ? begin_s(frame + 1) : begin_s(frame) + times_.interval_s;
  }

  // The last frame that has begun; looked at backwards, the first that has not ended.
  [[nodiscard]] int frame_of(double at_s, bool backwards) const {
    const auto& all = times_.times_s;
    const auto next = backwards ? std::ranges::lower_bound(all, at_s - kTolerance_s)
                                : std::ranges::upper_bound(all, at_s + kTolerance_s);
    return clamped(static_cast<int>(next - all.begin()) - 1);
  }

 private:
  PlayTimes times_;
  int count_;
  int first_;
  int last_;
};

// After playing for some time from the start of a frame on, or backwards from its end.
PlayedFrame played(const PlayedStretch& stretch, int start, double played_s, bool backwards, bool loop) {
  const double begin_s = stretch.begin_s(stretch.first());
  const double end_s = stretch.end_s(stretch.last());
  double at_s = backwards ? stretch.end_s(start) - played_s : stretch.begin_s(start) + played_s;
  if (backwards ? at_s <= begin_s + kTolerance_s : at_s >= end_s - kTolerance_s) {
    if (!loop || end_s <= begin_s) return {backwards ? stretch.first() : stretch.last(), !loop};
    const double past_s = backwards ? end_s - at_s : at_s - begin_s;
    const double again_s = std::fmod(past_s + kTolerance_s, end_s - begin_s);
    at_s = backwards ? end_s - again_s : begin_s + again_s;
  }
  const int frame = stretch.frame_of(at_s, backwards);
  return {backwards ? std::max(frame, stretch.first()) : std::min(frame, stretch.last()), false};
}

}  // namespace

void Playback::play(double now_s, int frame, double speed) {
  ENSURE(std::isfinite(now_s) && std::isfinite(speed));
  start_s_ = now_s;
  start_frame_ = frame;
  speed_ = speed;
}

PlayedFrame Playback::frame_at(double now_s, const PlayTimes& times, const PlayRange& range) const {
  ENSURE(!times.times_s.empty());
  const PlayedStretch stretch(times, range);
  const int start = stretch.clamped(start_frame_);
  if (!playing()) return {start, false};
  const double played_s = std::max(0.0, now_s - start_s_) * std::abs(speed_);
  const int spent = range.loop ? 0 : 1;  // without a loop there is nothing left to play at the range's end
  const bool is_past = speed_ > 0 ? start + spent > stretch.last() : start - spent < stretch.first();
  const int begin = !is_past ? start : speed_ > 0 ? stretch.first() : stretch.last();
  return played(stretch, begin, played_s, speed_ < 0, range.loop);
}

}  // namespace sigs::editor
