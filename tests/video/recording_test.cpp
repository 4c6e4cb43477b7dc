// SPDX-License-Identifier: MIT
#include "video/recording.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "support/test_data.h"

namespace sigs::test {

namespace {

// Runs the program ffmpeg, which makes files with sound; false where it is not installed.
bool made_by_ffmpeg(const std::string& arguments) {
  return std::system(("ffmpeg -v error -y " + arguments + " </dev/null >/dev/null 2>&1").c_str()) == 0;
}

// Seconds of the day by counting frame for frame, as the standard says: 2 numbers a minute are left out at 29.97.
double counted_s(int hours, int minutes, int seconds, int frames, int rate, bool drops, double rate_hz) {
  long long count = 0;
  for (int minute = 0; minute < 60 * hours + minutes; ++minute)
    count += 60LL * rate - (drops && minute % 10 != 0 ? 2 : 0);
  count += static_cast<long long>(seconds) * rate + frames;
  if (drops && minutes % 10 != 0) count -= 2;
  return static_cast<double>(count) / rate_hz;
}

}  // namespace

TEST_CASE("a time code is the time of the day by its count of frames, with numbers dropped and without") {
  const auto even = time_code_of("10:20:30:12", 25, 1);
  REQUIRE(even);
  CHECK(even->seconds() == doctest::Approx(10 * 3600 + 20 * 60 + 30 + 12 / 25.0).epsilon(1e-12));
  const auto dropped = time_code_of("01:23:45;28", 30000, 1001);
  REQUIRE(dropped);
  CHECK(dropped->drops_frames);
  CHECK(dropped->seconds() == doctest::Approx(counted_s(1, 23, 45, 28, 30, true, 30000 / 1001.0)).epsilon(1e-12));
  const auto slow = time_code_of("19:26:48:04", 30000, 1001);
  REQUIRE(slow);
  CHECK(slow->seconds() == doctest::Approx(counted_s(19, 26, 48, 4, 30, false, 30000 / 1001.0)).epsilon(1e-12));
  // After a day of dropped numbers the code is right to 86.4 ms (SMPTE ST 12-1).
  const auto last = time_code_of("23:59:59;29", 30000, 1001);
  REQUIRE(last);
  CHECK(std::abs(last->seconds() + 1001 / 30000.0 - 86400) < 0.0865);
}

TEST_CASE("texts that are no time code, and numbers that are dropped, are none") {
  for (const char* const text : {"", "10:20:30", "24:00:00:00", "10:60:00:00", "10:00:60:00", "10:00:00:25", "1:2",
                                 "10:00:00:12x", "10:00:00/12", "-1:00:00:00", "aa:bb:cc:dd", "10:00:00:-1"})
    CHECK_FALSE_MESSAGE(time_code_of(text, 25, 1), text);
  CHECK_FALSE(time_code_of("10:01:00;00", 30000, 1001));  // dropped
  CHECK(time_code_of("10:10:00;00", 30000, 1001));        // each tenth minute has it
  CHECK(time_code_of("10:01:00;02", 30000, 1001));
  CHECK_FALSE(time_code_of("10:00:00;12", 25, 1));  // nobody drops at 25
}

TEST_CASE("sound stands on the footage's time axis, mixed to one channel, whatever codec and container") {
  const TemporaryFolder folder;
  // 440 Hz on the left from 1 s on, nothing on the right; images from 0.5 s on.
  const std::string source =
      "-f lavfi -i testsrc=size=64x48:rate=25:duration=3 -f lavfi -i "
      "\"aevalsrc='if(gte(t,1),sin(2*PI*440*t),0)|0':s=44100:d=3.5\" ";
  for (const auto& [name, codec] : {std::pair("a.mkv", "pcm_s16le"),
                                    {"b.mov", "pcm_s24le"},
                                    {"c.mp4", "aac"},
                                    {"d.mkv", "flac"},
                                    {"e.mkv", "pcm_f32le"}}) {
    const std::string file = (folder / name).string();
    if (!made_by_ffmpeg(source + "-c:v mpeg4 -c:a " + codec + " -strict -2 " + file))
      return say_skipped("ffmpeg is not installed");
    CAPTURE(file);
    const auto sound = read_sound(file);
    REQUIRE(sound);
    REQUIRE(*sound);
    const Sound& heard = **sound;
    CHECK(static_cast<double>(heard.samples.size()) / heard.rate_hz == doctest::Approx(3.5).epsilon(0.03));
    const auto level = [&](double from_s, double to_s) {
      double squares = 0;
      int count = 0;
      for (std::size_t i = 0; i < heard.samples.size(); ++i) {
        const double t = heard.first_s + static_cast<double>(i) / heard.rate_hz;
        if (t < from_s || t >= to_s) continue;
        squares += static_cast<double>(heard.samples[i]) * heard.samples[i];
        ++count;
      }
      return std::sqrt(squares / std::max(1, count));
    };
    CHECK(level(0.1, 0.97) < 0.01);
    // Half of a sine of 1, by the sinc of 440 Hz over an eighth of a millisecond.
    const double x = std::numbers::pi * 440 / heard.rate_hz;
    CHECK(level(1.1, 2.9) == doctest::Approx(0.5 / std::sqrt(2.0) * std::sin(x) / x).epsilon(0.02));
    // Its beginning, to a millisecond.
    std::size_t first = 0;
    while (first < heard.samples.size() && std::abs(heard.samples[first]) < 0.1) ++first;
    CHECK(heard.first_s + static_cast<double>(first) / heard.rate_hz == doctest::Approx(1).epsilon(0.002));
  }
}

TEST_CASE("a file whose images begin later than its sound has sound before time 0, and one without sound none") {
  const TemporaryFolder folder;
  const std::string late = (folder / "late.mkv").string();
  const std::string silent = (folder / "silent.mkv").string();
  if (!made_by_ffmpeg("-itsoffset 0.4 -f lavfi -i testsrc=size=64x48:rate=25:duration=2 -f lavfi -i sine=duration=2 "
                      "-c:v mpeg4 -c:a pcm_s16le " +
                      late) ||
      !made_by_ffmpeg("-f lavfi -i testsrc=size=64x48:rate=25:duration=1 -c:v mpeg4 " + silent))
    return say_skipped("ffmpeg is not installed");
  const auto sound = read_sound(late);
  REQUIRE(sound);
  REQUIRE(*sound);
  CHECK((*sound)->first_s == doctest::Approx(-0.4 + 0.5 / 8000).epsilon(0.01));
  const auto none = read_sound(silent);
  REQUIRE(none);
  CHECK_FALSE(*none);
  const auto missing = read_sound(folder / "nothing.mkv");
  REQUIRE_FALSE(missing);
  CHECK(missing.error().kind == ErrorKind::cannot_read);
}

TEST_CASE("time code and date of a real recording are read") {
  if (!has_real_data()) return;
  const auto time = recording_time_of(real_data() / "video/air_karma_gopro_coast.mp4");
  REQUIRE(time);
  REQUIRE(time->time_code);
  CHECK(*time->time_code == *time_code_of("19:26:48:04", 30000, 1001));
  CHECK(time->created == "2017-04-17T19:27:57.000000Z");
  const auto other = recording_time_of(real_data() / "video/opencv_tree.avi");
  REQUIRE(other);
  CHECK_FALSE(other->time_code);
  CHECK(other->created.empty());
}

}  // namespace sigs::test
