// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "base/least_squares.h"
#include "base/pose.h"
#include "ego_motion/clock_sync.h"

namespace sigs::test {

namespace {

// An aircraft that is shaken at random, as attitudes at 500 steps a second: rates change from knot to knot, those of
// `slow_radps` once in a second and a half, those of `shake_radps` ten times a second.
struct Flight {
  double slow_radps = 0.15;
  double shake_radps = 0.05;
  double length_s = 60;
  unsigned seed = 1;
};
class FlownAircraft {
 public:
  explicit FlownAircraft(const Flight& flight) : length_s_(flight.length_s) {
    std::mt19937 random(flight.seed);
    const auto slow = knots(random, flight.slow_radps, 0.7);
    const auto fast = knots(random, flight.shake_radps, 10);
    attitudes_.emplace_back(1, 0, 0, 0);
    for (double t = 0; t < length_s_; t += kStep_s)
      attitudes_.push_back(glm::normalize(
          attitudes_.back() *
          turn_of(kStep_s * (between(slow, 0.7 * (t + kStep_s / 2)) + between(fast, 10 * (t + kStep_s / 2))))));
  }

  [[nodiscard]] glm::dquat at(double t) const {
    const double place = std::clamp(t / kStep_s, 0.0, static_cast<double>(attitudes_.size()) - 1.001);
    const auto i = static_cast<std::size_t>(place);
    return glm::slerp(attitudes_[i], attitudes_[i + 1], place - std::floor(place));
  }

 private:
  static constexpr double kStep_s = 0.002;

  std::vector<glm::dvec3> knots(std::mt19937& random, double sd_radps, double rate_hz) const {
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> made;
    for (double t = 0; t < length_s_ + 10 / rate_hz; t += 1 / rate_hz)
      made.emplace_back(sd_radps * normal(random), sd_radps * normal(random), sd_radps * normal(random));
    return made;
  }
  static glm::dvec3 between(const std::vector<glm::dvec3>& knots, double place) {
    const auto i = std::min(static_cast<std::size_t>(place), knots.size() - 2);
    const double share = place - std::floor(place);
    const double smooth = share * share * (3 - 2 * share);
    return (1 - smooth) * knots[i] + smooth * knots[i + 1];
  }

  double length_s_;
  std::vector<glm::dquat> attitudes_;
};

// A camera on it. Its footage begins start_s after the flight did, its clock runs fast by `drift`.
struct Recorder {
  double rate_hz = 25;
  double start_s = 0;
  double length_s = 50;
  double drift = 0;
  glm::dquat body_from_camera{1, 0, 0, 0};
  double noise_rad = 0.0002;  // of each attitude; a fifth of a pixel of 900 to the radian
  double walk_rad = 0.0003;   // of what attitudes drift by in one second
  unsigned seed = 1;

  [[nodiscard]] double flight_time_s(double own_s) const { return start_s + own_s / (1 + drift); }
};

// An aircraft that swings about each axis with three frequencies of its own, as the samples' flights do.
class SwingingAircraft {
 public:
  explicit SwingingAircraft(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    for (auto& axis : swings_)
      for (std::size_t i = 0; i < axis.size(); ++i) {
        const double frequency_hz = std::array{0.4, 1.2, 3.0}[i] * (0.7 + 0.8 * share(random));
        axis[i] = {0.02 / frequency_hz * (0.5 + share(random)), 2 * std::numbers::pi * frequency_hz,
                   2 * std::numbers::pi * share(random)};
      }
  }

  [[nodiscard]] glm::dquat at(double t) const {
    glm::dvec3 angles(0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
      for (const Swing& swing : swings_[static_cast<std::size_t>(axis)])
        angles[axis] += swing.angle_rad * std::sin(swing.rate_radps * t + swing.phase_rad);
    return rotation_of({.roll_rad = angles.x, .pitch_rad = angles.y, .yaw_rad = angles.z});
  }

 private:
  struct Swing {
    double angle_rad;
    double rate_radps;
    double phase_rad;
  };
  std::array<std::array<Swing, 3>, 3> swings_{};
};

template <class Aircraft>
EgoMotion recorded(const Aircraft& aircraft, const Recorder& camera) {
  std::mt19937 random(camera.seed);
  std::normal_distribution<double> normal;
  const auto some = [&](double sd) { return sd * glm::dvec3(normal(random), normal(random), normal(random)); };
  EgoMotion motion;
  glm::dquat drifted(1, 0, 0, 0);
  for (int k = 0; k / camera.rate_hz < camera.length_s; ++k) {
    const double own_s = k / camera.rate_hz;
    drifted = drifted * turn_of(some(camera.walk_rad / std::sqrt(camera.rate_hz)));
    motion.frames.push_back({.time_s = own_s,
                             .world_from_camera = drifted * aircraft.at(camera.flight_time_s(own_s)) *
                                                  camera.body_from_camera * turn_of(some(camera.noise_rad))});
  }
  return motion;
}

// Time of the first camera's clock at the second one's time.
double true_first_s(const Recorder& first, const Recorder& second, double second_s) {
  return (second.flight_time_s(second_s) - first.start_s) * (1 + first.drift);
}

glm::dquat mount(double roll_deg, double pitch_deg, double yaw_deg) {
  return rotation_of(
      {.roll_rad = rad_of_deg(roll_deg), .pitch_rad = rad_of_deg(pitch_deg), .yaw_rad = rad_of_deg(yaw_deg)});
}

Result<TurnSync> synced(const EgoMotion& first, const EgoMotion& second, const TurnSyncSettings& settings = {}) {
  return clock_by_turns(frame_turns(first), frame_turns(second), settings);
}

bool says(const Result<TurnSync>& sync, const std::string& part) {
  return !sync && sync.error().text().find(part) != std::string::npos;
}

// Two cameras 60 degrees apart, of other rates and starts.
const Recorder kNose{.rate_hz = 25, .start_s = 2.345, .length_s = 45, .body_from_camera = mount(0, 0, 0), .seed = 11};
const Recorder kSide{
    .rate_hz = 30000.0 / 1001, .start_s = 9.876, .length_s = 50, .body_from_camera = mount(5, -10, 60), .seed = 12};

}  // namespace

TEST_CASE("clocks of cameras 60 degrees apart are found within 5 ms and their deviation, with and without the mount") {
  // Seeds 1 to 40 were looked at while the fit was made; these are others.
  int outside = 0;
  int count = 0;
  double squares = 0;
  double worst_s = 0;
  for (unsigned seed = 1001; seed <= 1040; ++seed) {
    const FlownAircraft aircraft(
        {.slow_radps = seed % 2 == 0 ? 0.15 : 0.04, .shake_radps = seed % 3 == 0 ? 0.01 : 0.05, .seed = seed});
    Recorder first = kNose;
    Recorder second = kSide;
    first.seed = 2 * seed;
    second.seed = 2 * seed + 1;
    if (seed % 4 == 0) second.rate_hz = 60;
    const EgoMotion seen_by_first = recorded(aircraft, first);
    const EgoMotion seen_by_second = recorded(aircraft, second);
    const glm::dquat between = glm::conjugate(first.body_from_camera) * second.body_from_camera;
    for (const bool is_known : {true, false}) {
      CAPTURE(seed);
      CAPTURE(is_known);
      const auto sync = synced(seen_by_first, seen_by_second,
                               {.first_from_second = is_known ? std::optional(between) : std::nullopt});
      REQUIRE(sync);
      const double middle_s = sync->clock.middle_s;
      const double error_s = sync->clock.first_time_s(middle_s) - true_first_s(first, second, middle_s);
      CHECK(std::abs(error_s) < 0.005);
      CHECK(glm::length(vector_of(glm::conjugate(between) * sync->first_from_second)) < 0.02);
      CHECK(sync->overlap_s > 35);
      worst_s = std::max(worst_s, std::abs(error_s));
      squares += std::pow(error_s / sync->clock.sd_s, 2);
      outside += std::abs(error_s) > 3 * sync->clock.sd_s ? 1 : 0;
      ++count;
    }
  }
  MESSAGE("worst error " << 1000 * worst_s << " ms, rms of error over deviation " << std::sqrt(squares / count));
  CHECK(outside <= 2);  // of 80; three deviations
  const double ratio = std::sqrt(squares / count);
  CHECK(ratio > 0.2);
  CHECK(ratio < 1.4);
}

TEST_CASE(
    "clips that share a third of their time are placed, and those that share nothing or do not turn are refused") {
  const FlownAircraft aircraft({.length_s = 130, .seed = 2001});
  Recorder first = kNose;
  Recorder second = kSide;
  second.start_s = 33;
  const auto third = synced(recorded(aircraft, first), recorded(aircraft, second));
  CAPTURE(third ? "" : third.error().what);
  REQUIRE(third);
  CHECK(third->overlap_s < 16);
  CHECK(std::abs(third->clock.first_time_s(5) - true_first_s(first, second, 5)) < 0.005);
  second.start_s = 70;
  CHECK_FALSE(synced(recorded(aircraft, first), recorded(aircraft, second)));
  const auto bounded = synced(recorded(aircraft, first), recorded(aircraft, kSide), {.max_offset_s = 2});
  CHECK_FALSE(bounded);  // it is 7.5 s

  const FlownAircraft hovering({.slow_radps = 0, .shake_radps = 0, .seed = 2002});
  CHECK(says(synced(recorded(hovering, first), recorded(hovering, kSide)), "hardly turn"));
  const FlownAircraft calm({.slow_radps = 0.0002, .shake_radps = 0.0005, .seed = 2003});
  CHECK(says(synced(recorded(calm, first), recorded(calm, kSide)), "hardly turn"));
  CHECK(says(synced(recorded(FlownAircraft({.seed = 2004}), first), recorded(FlownAircraft({.seed = 2005}), kSide)),
             "not alike"));
}

TEST_CASE("of seven seconds, clips of one flight are placed, and those of unrelated flights are refused") {
  // Limits were chosen with other seeds.
  constexpr int kPairs = 60;
  int placed = 0;
  int wrong = 0;
  int mistaken = 0;
  for (unsigned seed = 3001; seed < 3001 + kPairs; ++seed)
    for (const bool swings : {true, false}) {
      const Recorder first{.rate_hz = 25, .start_s = 1, .length_s = 7, .seed = 2 * seed};
      const Recorder second{
          .rate_hz = 30, .start_s = 1.37, .length_s = 7, .body_from_camera = kSide.body_from_camera, .seed = 3 * seed};
      const auto seen = [&](const Recorder& camera, unsigned flight) {
        return swings ? recorded(SwingingAircraft(flight), camera)
                      : recorded(FlownAircraft({.length_s = 10, .seed = flight}), camera);
      };
      const EgoMotion by_first = seen(first, seed);
      const EgoMotion by_second = seen(second, seed);
      const EgoMotion of_another = seen(second, seed + 5000);
      for (const bool is_known : {true, false}) {
        const TurnSyncSettings settings{.first_from_second =
                                            is_known ? std::optional(second.body_from_camera) : std::nullopt};
        if (const auto sync = synced(by_first, by_second, settings)) {
          placed += swings ? 1 : 0;
          wrong += std::abs(sync->clock.first_time_s(3) - 3.37) < 0.005 ? 0 : 1;
        }
        mistaken += synced(by_first, of_another, settings) ? 1 : 0;
      }
    }
  MESSAGE(placed << " of " << 2 * kPairs << " placed that swing, " << wrong << " wrongly, " << mistaken << " of "
                 << 4 * kPairs << " unrelated ones mistaken for a pair");
  CHECK(placed >= 2 * kPairs * 0.95);
  CHECK(wrong == 0);
  CHECK(mistaken <= 4);
}

TEST_CASE("clocks that run apart by 80 millionths are found to, others are not") {
  const FlownAircraft aircraft({.length_s = 320, .seed = 2010});
  Recorder first = kNose;
  Recorder second = kSide;
  first.length_s = second.length_s = 300;
  for (const double drift : {0.0, 80e-6, -1e-3}) {
    second.drift = drift;
    const auto sync = synced(recorded(aircraft, first), recorded(aircraft, second));
    CAPTURE(drift);
    REQUIRE(sync);
    CHECK(std::abs(sync->clock.drift + drift) < 4e-6 + std::abs(drift) * std::abs(drift));
    CHECK((sync->clock.drift == 0) == (drift == 0));
    CHECK(std::abs(sync->clock.drift + drift) < 4 * sync->clock.drift_sd + 2 * drift * drift);
    for (const double t : {0.0, 150.0, 290.0})
      CHECK(std::abs(sync->clock.first_time_s(t) - true_first_s(first, second, t)) < 0.005);
  }
}

TEST_CASE("the deviation covers a drift that is not seen, and grows with the noise of the images") {
  const FlownAircraft aircraft({.seed = 2020});
  Recorder noisy = kSide;
  noisy.noise_rad *= 10;
  const auto good = synced(recorded(aircraft, kNose), recorded(aircraft, kSide));
  const auto bad = synced(recorded(aircraft, kNose), recorded(aircraft, noisy));
  REQUIRE(good);
  REQUIRE(bad);
  CHECK(bad->clock.sd_s > 2 * good->clock.sd_s);
}

TEST_CASE("a pendulum's turns fit at more than one offset, which is said") {
  EgoMotion motion[2];
  for (int camera = 0; camera < 2; ++camera)
    for (int k = 0; k < 1000; ++k) {
      const double t = k / 25.0;
      motion[camera].frames.push_back(
          {.time_s = t,
           .world_from_camera = rotation_of(
               {.roll_rad = 0.2 * std::sin(6.0 * (t + camera)), .pitch_rad = 0.1 * std::cos(6.0 * (t + camera))})});
    }
  CHECK(says(synced(motion[0], motion[1], {.first_from_second = glm::dquat(1, 0, 0, 0)}), "repeats itself"));
}

TEST_CASE("lost and repeated frames, cuts and turns that are no numbers are left out of the comparison") {
  const FlownAircraft aircraft({.seed = 2030});
  EgoMotion first = recorded(aircraft, kNose);
  EgoMotion second = recorded(aircraft, kSide);
  for (std::size_t k = 1; k < first.frames.size(); ++k) {
    if (k % 100 == 0) first.frames[k].is_lost = true;
    if (k % 7 == 0) {
      first.frames[k].is_repeated = true;  // the image of the frame before again
      first.frames[k].world_from_camera = first.frames[k - 1].world_from_camera;
    }
  }
  // From a lost frame on the attitude is against another start.
  for (std::size_t k = 300; k < second.frames.size(); ++k)
    second.frames[k].world_from_camera = mount(20, 30, 40) * second.frames[k].world_from_camera;
  second.frames[300].is_lost = true;
  const auto sync = synced(first, second);
  REQUIRE(sync);
  CHECK(std::abs(sync->clock.first_time_s(20) - true_first_s(kNose, kSide, 20)) < 0.005);

  std::vector<SeenTurn> broken = frame_turns(second);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < broken.size(); k += 90) broken[k].turn_rad.y = kNone;
  for (std::size_t k = 50; k < broken.size(); k += 90) broken[k].to_s = broken[k].from_s;
  const auto of_broken = clock_by_turns(frame_turns(first), broken);
  REQUIRE(of_broken);
  CHECK(std::abs(of_broken->clock.first_time_s(20) - true_first_s(kNose, kSide, 20)) < 0.005);
}

TEST_CASE("too few turns and none are refused, and a search ends where it is cancelled") {
  const FlownAircraft aircraft({.seed = 2040});
  const std::vector<SeenTurn> turns = frame_turns(recorded(aircraft, kNose));
  CHECK(says(clock_by_turns({}, turns), "0 frames"));
  CHECK(says(clock_by_turns(turns, std::span(turns).first(10)), "10 of the other"));
  CHECK(frame_turns({}).empty());
  const std::atomic<bool> cancel = true;
  const auto cancelled = clock_by_turns(turns, turns, {}, {.cancel = &cancel});
  REQUIRE_FALSE(cancelled);
  CHECK(cancelled.error().kind == ErrorKind::interrupted);
  const auto itself = clock_by_turns(turns, turns);
  REQUIRE(itself);
  CHECK(std::abs(itself->clock.offset_s) < 1e-6);
  CHECK(itself->correlation > 0.999999);
}

}  // namespace sigs::test
