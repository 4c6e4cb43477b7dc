// SPDX-License-Identifier: MIT
#include "ego_motion/clock_sync.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "base/pose.h"
#include "sphere_footage.h"
#include "support/test_data.h"
#include "telemetry/track.h"

namespace sigs::test {

namespace {

// How an aircraft turns, in closed form; motions of several frequencies that have no common period.
glm::dquat aircraft_at(double t) {
  return rotation_of({.roll_rad = 0.03 * std::sin(4.1 * t) + 0.02 * std::sin(1.3 * t * t / 6),
                      .pitch_rad = 0.02 * std::sin(2.9 * t + 1) + 0.015 * std::sin(6.7 * t),
                      .yaw_rad = 0.08 * t + 0.03 * std::sin(1.9 * t) + 0.012 * std::sin(5.3 * t + 2)});
}

EgoMotion motion_in(const std::filesystem::path& path, const Camera& camera) {
  Result<FrameSource> footage = FrameSource::open(path);
  REQUIRE(footage);
  const auto motion = estimate_ego_motion(*footage, camera, {}, nullptr, {}, {});
  REQUIRE(motion);
  return *motion;
}

// Broadband noise that swells, as a microphone beside an engine hears it, from from_s on; with noise of its own.
Sound heard(double from_s, double length_s, double own_noise, unsigned seed) {
  std::mt19937 common(7);
  std::mt19937 own(seed);
  std::normal_distribution<float> of_all;  // one each: a distribution keeps every other value for its next call
  std::normal_distribution<float> of_one;
  Sound sound{.rate_hz = 8000, .first_s = 0, .samples = {}};
  const auto skipped = static_cast<std::size_t>(from_s * 8000);
  float last = 0;
  for (std::size_t i = 0; i < skipped + static_cast<std::size_t>(length_s * 8000); ++i) {
    last = 0.6f * last + of_all(common);
    const double t = static_cast<double>(i) / 8000;
    const double swelling = 0.05 * (1 + 0.5 * std::sin(0.7 * t)) * last;
    if (i >= skipped) sound.samples.push_back(static_cast<float>(swelling + 0.05 * own_noise * of_one(own)));
  }
  return sound;
}

}  // namespace

TEST_CASE("clips rendered for cameras 60 degrees apart, 25 and 30 frames a second, are synchronised within 5 ms") {
  const TemporaryFolder folder_of_first;
  const TemporaryFolder folder_of_second;
  const Camera camera = sphere_camera(LensModel::brown_conrady);
  const glm::dquat mount =
      rotation_of({.roll_rad = rad_of_deg(8), .pitch_rad = rad_of_deg(-12), .yaw_rad = rad_of_deg(60)});
  constexpr double kStartOfSecond_s = 2.137;
  constexpr double kRateOfSecond_hz = 30;
  std::vector<glm::dquat> first;
  std::vector<glm::dquat> second;
  for (int k = 0; k < 300; ++k) first.push_back(aircraft_at(k / 25.0));
  for (int k = 0; k < 270; ++k) second.push_back(aircraft_at(kStartOfSecond_s + k / kRateOfSecond_hz) * mount);
  const EgoMotion by_first =
      motion_in(sphere_footage(folder_of_first.path(), camera, first, std::vector<int>(300, 1)), camera);
  EgoMotion by_second =
      motion_in(sphere_footage(folder_of_second.path(), camera, second, std::vector<int>(270, 2)), camera);
  for (EgoFrame& frame : by_second.frames) frame.time_s *= 25 / kRateOfSecond_hz;  // the writer counts 25 a second
  for (const bool is_known : {true, false}) {
    CAPTURE(is_known);
    const auto sync = clock_by_turns(frame_turns(by_first), frame_turns(by_second),
                                     {.first_from_second = is_known ? std::optional(mount) : std::nullopt});
    REQUIRE(sync);
    MESSAGE("rendered: error " << 1000 * (sync->clock.first_time_s(4) - kStartOfSecond_s - 4) << " ms, stated "
                               << 1000 * sync->clock.sd_s << " ms");
    CHECK(std::abs(sync->clock.first_time_s(4) - kStartOfSecond_s - 4) < 0.005);
    CHECK(std::abs(sync->clock.first_time_s(4) - kStartOfSecond_s - 4) < 4 * sync->clock.sd_s);
    CHECK(glm::length(vector_of(glm::conjugate(mount) * sync->first_from_second)) < rad_of_deg(1));
  }
}

TEST_CASE("a real clip cut twice, the second of every other frame from 2.4 s on, is put together again") {
  if (!has_real_data()) return;
  const auto path = real_data() / "video/air_karma_gopro_coast.mp4";
  const Result<FrameSource> whole = FrameSource::open(path);
  REQUIRE(whole);
  // What its gyroscope says beside the images' motion: 562.8 px a radian.
  const LensParameters lens{.fx = 562.8, .fy = 562.8, .cx = 426.5, .cy = 239.5};
  const Camera camera{.lens = *Lens::make(lens), .size_px = whole->info().size_px};
  // Encoded again, so that its noise is another.
  const TemporaryFolder folder;
  const std::string half = (folder / "half.mkv").string();
  if (std::system(("ffmpeg -v error -y -i '" + path.string() +
                   "' -vf \"trim=start_frame=73,select='not(mod(n,2))',setpts=PTS-STARTPTS,noise=alls=6:allf=t\" "
                   "-fps_mode passthrough -an -c:v mpeg4 -q:v 3 " +
                   half + " </dev/null >/dev/null 2>&1")
                      .c_str()) != 0)
    return say_skipped("ffmpeg is not installed");
  const double start_s = whole->info().times_s[73];
  const std::vector<SeenTurn> of_whole = frame_turns(motion_in(path, camera));
  const std::vector<SeenTurn> of_half = frame_turns(motion_in(half, camera));
  for (const bool is_known : {true, false}) {
    const auto sync = clock_by_turns(
        of_whole, of_half, {.first_from_second = is_known ? std::optional(glm::dquat(1, 0, 0, 0)) : std::nullopt});
    CAPTURE(sync ? "" : sync.error().what);
    REQUIRE(sync);
    const double error_s = sync->clock.first_time_s(sync->clock.middle_s) - start_s - sync->clock.middle_s;
    MESSAGE("real: error " << 1000 * error_s << " ms, stated " << 1000 * sync->clock.sd_s << " ms");
    CHECK(std::abs(error_s) < (is_known ? 0.005 : 0.01));  // a gimbal holds roll and pitch: little tells of the mount
    CHECK(std::abs(error_s) < 3 * sync->clock.sd_s);
    CHECK(glm::length(vector_of(sync->first_from_second)) < 3 * std::sqrt(3.0) * sync->rotation_sd_rad + 1e-9);
  }
}

TEST_CASE("sound of two microphones is found in one another, with noise of its own in each, and drift") {
  for (const double start_s : {0.0, 3.21075}) {
    Sound first = heard(0, 40, 0.5, 1);
    Sound second = heard(start_s, 30, 0.5, 2);
    first.first_s = 0.25;
    second.first_s = -0.125;
    const auto clock = clock_by_sound(first, second);
    REQUIRE(clock);
    CHECK(std::abs(clock->offset_s - (start_s + 0.25 + 0.125)) < 0.001);
    CHECK(clock->sd_s >= 0.01);
    CHECK(clock->sd_s < 0.011);
    CHECK(clock->drift == 0);
    const auto reverse = clock_by_sound(second, first);
    REQUIRE(reverse);
    CHECK(std::abs(reverse->offset_s + clock->offset_s) < 0.001);
  }
  // The second clock runs fast by 200 millionths: its samples are farther apart than it says.
  const Sound first = heard(0, 120, 0.2, 1);
  Sound second{.rate_hz = 8000, .first_s = 0, .samples = {}};
  for (std::size_t i = 0; static_cast<double>(i) / (1 + 200e-6) + 1 < static_cast<double>(first.samples.size()); ++i) {
    const double at = static_cast<double>(i) / (1 + 200e-6);
    const auto k = static_cast<std::size_t>(at);
    const auto part = static_cast<float>(at - static_cast<double>(k));
    second.samples.push_back((1 - part) * first.samples[k] + part * first.samples[k + 1]);
  }
  const auto drifting = clock_by_sound(first, second);
  REQUIRE(drifting);
  CHECK(drifting->drift == doctest::Approx(-200e-6).epsilon(0.1));
  CHECK(std::abs(drifting->first_time_s(100) - 100 / (1 + 200e-6)) < 0.002);
}

TEST_CASE("sound of other places, silence and a click are refused") {
  const Sound first = heard(0, 20, 0, 1);
  Sound other = heard(0, 20, 1000, 2);
  CHECK_FALSE(clock_by_sound(first, other));
  std::fill(other.samples.begin(), other.samples.end(), 0.0F);
  CHECK_FALSE(clock_by_sound(first, other));
  CHECK_FALSE(clock_by_sound(other, first));
  other.samples.resize(1000);
  CHECK_FALSE(clock_by_sound(first, other));
  CHECK_FALSE(clock_by_sound({}, {}));
}

TEST_CASE("time codes give the difference of two frames 0 to a frame, across midnight too") {
  const auto code = [](const char* text, int num, int den) { return *time_code_of(text, num, den); };
  const ClockOffset even = clock_by_time_codes(code("10:00:00:00", 25, 1), code("10:00:02:05", 25, 1));
  CHECK(even.offset_s == doctest::Approx(2.2));
  CHECK(even.sd_s == doctest::Approx(std::sqrt(2.0 / 12) / 25));
  const ClockOffset night = clock_by_time_codes(code("23:59:59:00", 25, 1), code("00:00:01:00", 50, 1));
  CHECK(night.offset_s == doctest::Approx(2));
  // 29.97 without dropped numbers: a second of the code lasts 1.001 s.
  const ClockOffset slow = clock_by_time_codes(code("10:00:00:00", 30000, 1001), code("10:01:40:00", 30000, 1001));
  CHECK(slow.offset_s == doctest::Approx(100.1));
  CHECK(slow.sd_s < 0.02);
  const ClockOffset mixed = clock_by_time_codes(code("10:00:00:00", 30000, 1001), code("10:01:40:00", 25, 1));
  CHECK(mixed.offset_s == doctest::Approx(100));
  CHECK(mixed.sd_s > 30);  // a thousandth of ten hours: which clock set the code, and when, is not known
}

TEST_CASE("all that two files have is tried, each source says what it found or why not, and the most exact wins") {
  if (!has_real_data()) return;
  const auto path = real_data() / "video/air_karma_gopro_coast.mp4";
  const auto other = real_data() / "video/opencv_tree.avi";
  const auto track = read_track(path);
  REQUIRE(track);
  const auto same = found_clocks({.video = path, .log = &*track}, {.video = path, .log = &*track});
  REQUIRE(same);
  REQUIRE(same->size() == 5);
  CHECK_FALSE((*same)[0].clock);
  CHECK((*same)[0].text.find("not estimated") != std::string::npos);
  for (std::size_t i = 1; i < 5; ++i) {
    CAPTURE(i);
    CAPTURE((*same)[i].text);
    REQUIRE((*same)[i].clock);
    CHECK(std::abs((*same)[i].clock->offset_s) < 1e-4);
  }
  const auto best = best_of(*same);
  REQUIRE(best);
  CHECK((*same)[*best].source == ClockSource::sound);
  const auto none = found_clocks({.video = path}, {.video = other});
  REQUIRE(none);
  for (const ClockFinding& finding : *none) {
    CHECK_FALSE(finding.clock);
    CHECK_FALSE(finding.text.empty());
  }
  CHECK((*none)[1].text.find("has no sound") != std::string::npos);
  CHECK_FALSE(best_of(*none));
  const std::vector<ClockSource> two{ClockSource::time_code, ClockSource::log};
  CHECK(found_clocks({.video = path}, {.video = other}, two)->size() == 2);
}

}  // namespace sigs::test
