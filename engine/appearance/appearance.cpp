// SPDX-License-Identifier: MIT
#include "appearance/appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <thread>
#include <utility>

#include "base/threads.h"
#include "video/frame.h"

namespace sigs {

namespace {

struct NumberedFrame {
  int number = 0;  // of the frame in the footage
  Frame frame;
};

// Decodes the frames of these numbers on a thread of its own, up to 4 ahead of the caller, and gives them in order,
// with 8 bits: deeper samples are rounded. No other code may use the footage while the stream exists.
class SampledFrames {
 public:
  SampledFrames(FrameSource& footage, std::vector<int> numbers, HeatPalette palette);
  ~SampledFrames();
  SampledFrames(const SampledFrames&) = delete;
  SampledFrames& operator=(const SampledFrames&) = delete;

  // The next frame, or the error that ended the decoding; nothing after the last frame or after an error.
  [[nodiscard]] std::optional<Result<NumberedFrame>> next();

 private:
  void decode(FrameSource& footage, const std::vector<int>& numbers, HeatPalette palette);
  void give_up(Error error);

  BoundedQueue<Result<NumberedFrame>> ahead_;
  std::optional<Error> failure_;  // written by the thread until the queue is closed, then read by the caller
  std::thread thread_;
};

constexpr std::size_t kDecodedAhead = 4;

SampledFrames::SampledFrames(FrameSource& footage, std::vector<int> numbers, HeatPalette palette)
    : ahead_(kDecodedAhead) {
  Result<std::thread> thread =
      started_thread([this, &footage, numbers = std::move(numbers), palette] { decode(footage, numbers, palette); },
                     [this](Error error) { give_up(std::move(error)); });
  if (thread)
    thread_ = std::move(*thread);
  else
    give_up(std::move(thread.error()));
}

SampledFrames::~SampledFrames() {
  ahead_.close();
  if (thread_.joinable()) thread_.join();
}

void SampledFrames::give_up(Error error) {
  failure_ = std::move(error);
  ahead_.close();
}

std::optional<Result<NumberedFrame>> SampledFrames::next() {
  std::optional<Result<NumberedFrame>> frame = ahead_.take();
  if (frame || !failure_) return frame;
  return fail(*std::exchange(failure_, std::nullopt));
}

void SampledFrames::decode(FrameSource& footage, const std::vector<int>& numbers, HeatPalette palette) {
  const std::optional<HeatColors> colors = heat_colors(palette);
  for (const int number : numbers) {
    Result<Frame> frame = footage.read(number);
    const bool is_read = frame.has_value();
    const bool is_wanted =
        is_read ? ahead_.put(NumberedFrame{number, colors ? colors->heat_of(*frame).frame : with_bit_depth(*frame, 8)})
                : ahead_.put(fail(frame.error()));
    if (!is_wanted || !is_read) break;
  }
  ahead_.close();
}

// Error against run time: docs/research/appearance.md.
constexpr int kSamples = 24;
constexpr int kSurroundings = 12;  // samples for haze, tone, light and sun, which change little from one to the next
constexpr int kTraces = 4;         // for traces of the codec, likewise

constexpr int kThreads = 2;  // on which the estimators look at a frame, beside the one that decodes

// First frames of the pairs that are looked at.
Result<std::vector<int>> sample_numbers(const VideoInfo& info, const AppearanceFrames& frames) {
  const int last = std::min(frames.last.value_or(info.frame_count() - 1), info.frame_count() - 1);
  if (frames.first < 0 || frames.first > last)
    return fail(info.path.string(),
                fmt::format("frames {} to {} are asked for, and there are {} frames, 0 to {}", frames.first,
                            frames.last.value_or(last), info.frame_count(), info.frame_count() - 1),
                ErrorKind::usage);
  const int count = last - frames.first + 1;
  std::vector<int> numbers;
  if (frames.every > 0) {
    for (int n = frames.first; n <= last && n >= 0; n += frames.every) numbers.push_back(n);
    return numbers;
  }
  // In the middles of equal parts, so that nothing depends on a clip's first and last frame.
  const int samples = std::min(kSamples, std::max(1, count - 1));
  for (int i = 0; i < samples; ++i)
    numbers.push_back(frames.first + static_cast<int>((2LL * i + 1) * (count - 1) / (2LL * samples)));
  return numbers;
}

// Each sample and the frame after it, each once, in order.
std::vector<int> with_followers(const std::vector<int>& samples, int last) {
  std::set<int> numbers;
  for (const int n : samples) {
    numbers.insert(n);
    if (n < last) numbers.insert(n + 1);
  }
  return {numbers.begin(), numbers.end()};
}

// All estimators, fed with the same frames.
class Estimators {
 public:
  Estimators(std::size_t samples, bool sun_is_given, bool is_thermal)
      : surroundings_(!sun_is_given),
        is_thermal_(is_thermal),
        surroundings_every_(std::max(1, static_cast<int>(samples) / kSurroundings)),
        traces_every_(static_cast<int>(samples) / kTraces + 1) {}

  // next: the frame that follows directly; null: it is not there or damaged.
  void add(const Frame& frame, const Frame* next, const View& view) {
    const bool look_around = added_ % surroundings_every_ == 0;
    const bool look_for_traces = added_ % traces_every_ == 0;
    const std::array<std::function<void()>, 3> parts{[&] { noise_.add(frame, next); },
                                                     [&] { point_spread_.add(frame, view.own_body); },
                                                     [&] {
                                                       if (look_around) surroundings_.add(frame, view);
                                                       if (look_around && is_thermal_)
                                                         levels_.add(frame, view.own_body);
                                                       if (look_around && !is_thermal_)
                                                         glare_.add(frame, view.own_body);
                                                       codec_.add(frame, look_for_traces);
                                                     }};
    // Each estimator has state of its own; they share nothing but the frames, which none of them changes.
    parallel_for(static_cast<int>(parts.size()), kThreads, [&](int i) { parts[static_cast<std::size_t>(i)](); });
    ++added_;
    if (next != nullptr) codec_.add(*next, false);
  }

  void finish(Appearance& appearance, const std::optional<GivenSun>& sun) const {
    appearance.point_spread = point_spread_.finish();
    appearance.noise = noise_.finish();
    appearance.surroundings = surroundings_.finish(sun);
    if (is_thermal_) appearance.levels = levels_.finish();
    if (glare_.has_dark_frames()) appearance.glare = glare_.finish();
    appearance.tone_histogram = surroundings_.tone().histogram();
    appearance.codec = codec_.finish();
    appearance.haze_curve = surroundings_.haze().curve();
  }

 private:
  PointSpread point_spread_;
  Noise noise_;
  Surroundings surroundings_;
  ThermalLevels levels_;
  Glare glare_;
  bool is_thermal_;
  CodecEstimator codec_;
  int surroundings_every_;
  int traces_every_;
  int added_ = 0;
};

// By time and place, over the samples.
std::optional<GivenSun> given_sun(const AppearanceHints& hints, const std::vector<int>& samples) {
  if (!hints.to_sun_in_world || samples.empty()) return std::nullopt;
  const glm::dvec3 first = hints.to_sun_in_world(samples.front()), last = hints.to_sun_in_world(samples.back());
  const auto azimuth_rad = [](const glm::dvec3& to_sun) { return std::atan2(to_sun.y, to_sun.x); };
  const auto elevation_rad = [](const glm::dvec3& to_sun) { return std::asin(std::clamp(-to_sun.z, -1.0, 1.0)); };
  return GivenSun{
      .to_sun_in_world = hints.to_sun_in_world(samples[samples.size() / 2]),
      .azimuth_range_rad = std::abs(std::remainder(azimuth_rad(last) - azimuth_rad(first), 2 * std::numbers::pi)),
      .elevation_range_rad = std::abs(elevation_rad(last) - elevation_rad(first))};
}

Result<Appearance> estimated(FrameSource& footage, const AppearanceFrames& frames, const AppearanceHints& hints,
                             const AppearanceControl& control) {
  Appearance appearance{.footage = footage.info()};
  const Result<std::vector<int>> samples = sample_numbers(footage.info(), frames);
  if (!samples) return fail(samples.error());
  const std::set<int> is_sample(samples->begin(), samples->end());
  const int last = std::min(frames.last.value_or(footage.info().frame_count() - 1), footage.info().frame_count() - 1);
  const std::optional<GivenSun> sun = given_sun(hints, *samples);
  Estimators estimators(samples->size(), sun.has_value(), hints.is_thermal);
  SampledFrames stream(footage, with_followers(*samples, last), hints.palette);
  std::optional<NumberedFrame> waiting;  // a sample whose follower may come
  const auto use = [&](const Frame* next) {
    estimators.add(waiting->frame, next, hints.view ? hints.view(waiting->number) : View{});
    ++appearance.frames_used;
    if (control.progress) control.progress(appearance.frames_used, static_cast<int>(is_sample.size()));
    waiting.reset();
  };
  while (std::optional<Result<NumberedFrame>> frame = stream.next()) {
    if (!*frame) return fail(frame->error());
    if (const Result<void> on = check_interrupt(control.cancel, footage.info().path.string()); !on)
      return fail(on.error());
    NumberedFrame& current = **frame;
    if (waiting) use(current.number == waiting->number + 1 && !current.frame.damaged ? &current.frame : nullptr);
    if (is_sample.contains(current.number) && !current.frame.damaged) waiting = std::move(current);
  }
  if (waiting) use(nullptr);
  estimators.finish(appearance, sun);
  return appearance;
}

}  // namespace

Result<Appearance> estimate_appearance(FrameSource& footage, const AppearanceFrames& frames,
                                       const AppearanceHints& hints, const AppearanceControl& control) {
  return guarded([&] { return estimated(footage, frames, hints, control); }, footage.info().path.string());
}

}  // namespace sigs
