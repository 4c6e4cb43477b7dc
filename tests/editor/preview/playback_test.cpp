// SPDX-License-Identifier: MIT
#include "editor/preview/playback.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace sigs::editor;

namespace {

std::vector<double> even_times(int count, double interval_s) {
  std::vector<double> times_s;
  for (int i = 0; i < count; ++i) times_s.push_back(i * interval_s);
  return times_s;
}

const std::vector<double> kEven = even_times(100, 0.04);
const PlayTimes k25Hz{kEven, 0.04};

Playback playing(double now_s, int frame, double speed) {
  Playback playback;
  playback.play(now_s, frame, speed);
  return playback;
}

}  // namespace

TEST_CASE("at an even rate the frame is the clock's") {
  const double start_s = 12345.678;
  for (const double speed : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    const Playback playback = playing(start_s, 10, speed);
    for (int turn = 0; turn < 60; ++turn) {
      const double after_s = (turn + 0.5) / 60;  // between the moments at which frames change
      const int expected = std::min(99, 10 + static_cast<int>(std::floor(after_s * speed / 0.04)));
      CHECK(playback.frame_at(start_s + after_s, k25Hz, {0, 99, false}).frame == expected);
    }
  }
}

TEST_CASE("a frame is due at its own time stamp and not an update later") {
  for (const double start_s : {0.0, 0.1, 1e3, 1e6})
    for (int i = 0; i < 90; ++i) {
      const Playback playback = playing(start_s, 0, 1);
      CHECK(playback.frame_at(start_s + i * 0.04, k25Hz, {0, 99, false}).frame == i);
    }
}

TEST_CASE("variable rates are played by their time stamps") {
  const std::vector<double> times_s{0, 0.1, 0.15, 0.5, 0.51, 2.0};
  const PlayTimes times{times_s, 0.25};
  const Playback playback = playing(0, 0, 1);
  for (double now_s = 0.0005; now_s < 2.25; now_s += 0.001) {
    int expected = 0;
    while (expected + 1 < 6 && times_s[static_cast<std::size_t>(expected + 1)] <= now_s) ++expected;
    CHECK(playback.frame_at(now_s, times, {0, 5, false}).frame == expected);
    CHECK_FALSE(playback.frame_at(now_s, times, {0, 5, false}).over);
  }
  CHECK(playback.frame_at(2.251, times, {0, 5, false}).over);
  CHECK(playback.frame_at(2.251, times, {0, 5, false}).frame == 5);
}

TEST_CASE("backwards each frame stays for its own duration") {
  const std::vector<double> times_s{0, 0.1, 0.15, 0.5};
  const PlayTimes times{times_s, 0.2};
  const Playback playback = playing(7, 3, -2);
  // Durations 0.2, 0.35, 0.05, 0.1 at double speed.
  const std::vector<std::pair<double, int>> due{{0, 3},     {0.099, 3}, {0.101, 2}, {0.274, 2},
                                                {0.276, 1}, {0.299, 1}, {0.301, 0}, {0.349, 0}};
  for (const auto& [after_s, frame] : due) {
    CHECK(playback.frame_at(7 + after_s, times, {0, 3, false}).frame == frame);
    CHECK_FALSE(playback.frame_at(7 + after_s, times, {0, 3, false}).over);
  }
  CHECK(playback.frame_at(7.351, times, {0, 3, false}).over);
  CHECK(playback.frame_at(7.351, times, {0, 3, false}).frame == 0);
}

TEST_CASE("playback of a range stops at its end and reports this") {
  const Playback forwards = playing(0, 20, 1);
  CHECK(forwards.frame_at(0.39, k25Hz, {15, 29, false}).frame == 29);
  CHECK_FALSE(forwards.frame_at(0.39, k25Hz, {15, 29, false}).over);
  CHECK(forwards.frame_at(0.41, k25Hz, {15, 29, false}).over);
  CHECK(forwards.frame_at(1e6, k25Hz, {15, 29, false}).frame == 29);
  const Playback backwards = playing(0, 20, -1);
  CHECK(backwards.frame_at(1e6, k25Hz, {15, 29, false}).frame == 15);
  CHECK(backwards.frame_at(1e6, k25Hz, {15, 29, false}).over);
}

TEST_CASE("a loop repeats without end and shows each frame for the same time") {
  for (const double speed : {1.0, -1.0, 4.0, -8.0}) {
    const Playback playback = playing(0, 20, speed);
    std::vector<int> observed(100, 0);
    const int samples = 20 * 15 * 100;
    for (int i = 0; i < samples; ++i) {  // 100 rounds of 15 frames, 20 queries a frame
      const double now_s = (i + 0.5) * 0.04 / 20 / std::abs(speed);
      const PlayedFrame played = playback.frame_at(now_s, k25Hz, {15, 29, true});
      REQUIRE_FALSE(played.over);
      ++observed[static_cast<std::size_t>(played.frame)];
    }
    for (int frame = 0; frame < 100; ++frame)
      CHECK(observed[static_cast<std::size_t>(frame)] == (frame >= 15 && frame <= 29 ? samples / 15 : 0));
  }
}

TEST_CASE("play begins at the playhead wherever something is left to play") {
  const PlayRange range{30, 60, false};
  CHECK(playing(0, 40, 1).frame_at(0, k25Hz, range).frame == 40);
  CHECK(playing(0, 10, 1).frame_at(0, k25Hz, range).frame == 10);   // plays on into the range
  CHECK(playing(0, 80, -1).frame_at(0, k25Hz, range).frame == 80);  // likewise
  CHECK(playing(0, 60, 1).frame_at(0, k25Hz, range).frame == 30);   // nothing left: from the other end
  CHECK(playing(0, 80, 1).frame_at(0, k25Hz, range).frame == 30);
  CHECK(playing(0, 30, -1).frame_at(0, k25Hz, range).frame == 60);
  CHECK(playing(0, 60, 1).frame_at(0.039, k25Hz, {30, 60, true}).frame == 60);  // a loop has always something left
  CHECK(playing(0, 60, 1).frame_at(0.041, k25Hz, {30, 60, true}).frame == 30);
}

TEST_CASE("invalid values are clamped") {
  const std::vector<double> one{0.0};
  const std::vector<double> still{0, 0, 0, 0};
  for (const double speed : {1.0, -1.0})
    for (const bool loop : {false, true}) {
      const Playback playback = playing(5, 1000, speed);
      CHECK(playback.frame_at(6, {one, 0.04}, {-5, 7, loop}).frame == 0);
      // A range upside down is its first frame; a clock that runs backwards makes no step.
      CHECK(playback.frame_at(4, k25Hz, {90, 10, loop}).frame == (speed > 0 ? 90 : 99));
      const int frame = playback.frame_at(6, {still, 0}, {0, 3, loop}).frame;
      CHECK(frame >= 0);
      CHECK(frame <= 3);
    }
}

TEST_CASE("a paused playhead does not move") {
  Playback playback = playing(0, 12, 1);
  CHECK(playback.playing());
  playback.pause();
  CHECK_FALSE(playback.playing());
  CHECK(playback.speed() == 0);
  CHECK(playback.frame_at(100, k25Hz, {0, 99, true}).frame == 12);
}
