// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace sigs::editor {

// Frames that are played, both included. loop: from the end it goes on at the other end.
struct PlayRange {
  int first = 0;
  int last = 0;
  bool loop = false;
};

// Times of the frames: frame n is shown from times_s[n] until times_s[n + 1], the last one for interval_s.
struct PlayTimes {
  // Not decreasing, at least one. Must outlive the call alone.
  std::span<const double> times_s;
  double interval_s = 0.04;  // how long the last frame is shown
};

// The frame to show; over: the range is played to its end and does not loop.
struct PlayedFrame {
  int frame = 0;
  bool over = false;
};

// Tells which frame is due at a time, so that a slow machine drops frames and never lags. Times are seconds of any
// steady clock, which the caller reads. The rate follows the time stamps of the footage.
class Playback {
 public:
  // Plays from the start of a frame on (backwards: from its end). speed: 1 is the footage's own, below 0 backwards.
  void play(double now_s, int frame, double speed);
  void pause() { speed_ = 0; }

  [[nodiscard]] bool playing() const { return speed_ != 0; }
  [[nodiscard]] double speed() const { return speed_; }  // 0: pausing

  // The frame that is due. From a frame outside the range it plays on into the range; where the range lies behind, or
  // ends with that frame, it begins at the range's other end. Frames are clamped to the footage. Pausing: the frame it
  // began at.
  [[nodiscard]] PlayedFrame frame_at(double now_s, const PlayTimes& times, const PlayRange& range) const;

 private:
  // When playing began, and the frame that it began at.
  double start_s_ = 0;
  int start_frame_ = 0;
  double speed_ = 0;
};

}  // namespace sigs::editor
