// SPDX-License-Identifier: MIT
#include "ego_motion/clock_sync.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <utility>

#include "base/statistics.h"
#include "geo/utc_time.h"

namespace sigs {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
const double kEven = 1 / std::sqrt(12.0);  // standard deviation of what is even over 1

// Where a part of one sound stands in another.
struct SoundPlace {
  double lag = 0;      // samples from the part's beginning to its place
  double clarity = 0;  // height of the peak, in standard deviations of all others
};

// The spectrum of samples that are followed by zeros; a row with real and imaginary parts.
cv::Mat spectrum_of(std::span<const float> samples, int length) {
  cv::Mat padded = cv::Mat::zeros(1, length, CV_32F);
  std::copy(samples.begin(), samples.end(), padded.ptr<float>());
  cv::Mat spectrum;
  cv::dft(padded, spectrum, cv::DFT_COMPLEX_OUTPUT);
  return spectrum;
}

// Only phases count, so that neither the motors' tone nor a microphone's colour does, between 80 and 3500 Hz.
SoundPlace place_of(std::span<const float> part, const cv::Mat& spectrum_of_all, std::size_t all, double rate_hz) {
  const int length = spectrum_of_all.cols;
  const cv::Mat of_part = spectrum_of(part, length);
  cv::Mat cross;
  cv::mulSpectrums(spectrum_of_all, of_part, cross, 0, true);
  const double hz = rate_hz / length;
  for (int k = 0; k < length; ++k) {
    cv::Vec2f& value = cross.at<cv::Vec2f>(k);
    const double at_hz = hz * std::min(k, length - k);
    const double size = std::hypot(static_cast<double>(value[0]), static_cast<double>(value[1]));
    constexpr double kLow_hz = 80;
    constexpr double kHigh_hz = 3500;
    const double by = at_hz < kLow_hz || at_hz > kHigh_hz || !(size > 1e-12) ? 0 : 1 / size;
    value = {static_cast<float>(value[0] * by), static_cast<float>(value[1] * by)};
  }
  cv::Mat correlation;
  cv::idft(cross, correlation, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
  // Lags from -(part - 1), which stand at the end, to all - 1.
  const auto at = [&](int lag) { return static_cast<double>(correlation.at<float>((lag % length + length) % length)); };
  int best = 0;
  double squares = 0;
  const int from = 1 - static_cast<int>(part.size());
  const int to = static_cast<int>(all);
  for (int lag = from; lag < to; ++lag) {
    squares += at(lag) * at(lag);
    if (at(lag) > at(best)) best = lag;
  }
  const double deviation = std::sqrt(squares / std::max(1, to - from));
  const double bend = at(best - 1) - 2 * at(best) + at(best + 1);
  const double between = bend < 0 ? std::clamp((at(best - 1) - at(best + 1)) / (2 * bend), -0.5, 0.5) : 0;
  return {best + between, deviation > 0 ? at(best) / deviation : 0};
}

struct HeardPart {
  double second_s = 0;  // the middle of the part by the second clock
  double offset_s = 0;  // first less second
};

// Parts of the first sound that the second one clearly has.
std::vector<HeardPart> heard_parts(const Sound& first, const Sound& second, double max_offset_s,
                                   const std::atomic<bool>* cancel) {
  constexpr double kPart_s = 20;
  constexpr std::size_t kMostParts = 16;
  constexpr double kClear = 9;  // of ten million values by chance the highest has some 5.3
  const auto size = std::min(static_cast<std::size_t>(kPart_s * first.rate_hz),
                             std::max(first.samples.size() / 4, static_cast<std::size_t>(2 * first.rate_hz)));
  const std::size_t fitting = std::max<std::size_t>(1, first.samples.size() / size);
  const std::size_t parts = std::min(kMostParts, fitting);
  const int length = cv::getOptimalDFTSize(static_cast<int>(second.samples.size() + size));
  const cv::Mat spectrum = spectrum_of(second.samples, length);
  std::vector<HeardPart> heard;
  for (std::size_t i = 0; i < parts && !is_cancelled(cancel); ++i) {
    const std::size_t begin = i * fitting / parts * size;
    const std::span<const float> part =
        std::span(first.samples).subspan(begin, std::min(size, first.samples.size() - begin));
    const SoundPlace place = place_of(part, spectrum, second.samples.size(), first.rate_hz);
    const double first_s = first.first_s + static_cast<double>(begin) / first.rate_hz;
    const double second_s = second.first_s + place.lag / second.rate_hz;
    if (place.clarity < kClear || std::abs(first_s - second_s) > max_offset_s) continue;
    heard.push_back({second_s + static_cast<double>(part.size()) / 2 / second.rate_hz, first_s - second_s});
  }
  return heard;
}

std::vector<double> offsets_of(const std::vector<HeardPart>& parts) {
  std::vector<double> offsets;
  for (const HeardPart& part : parts) offsets.push_back(part.offset_s);
  return offsets;
}

// The drift by Theil and Sen's line, where parts lie far enough from one another to tell.
double drift_of(const std::vector<HeardPart>& parts) {
  constexpr double kApart_s = 30;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = i + 1; k < parts.size(); ++k)
      if (std::abs(parts[k].second_s - parts[i].second_s) > kApart_s)
        slopes.push_back((parts[k].offset_s - parts[i].offset_s) / (parts[k].second_s - parts[i].second_s));
  return slopes.empty() ? 0.0 : median(std::move(slopes));
}

Result<ClockOffset> agreed(std::vector<HeardPart> parts, std::size_t heard) {
  const double drift = drift_of(parts);
  std::vector<double> middles;
  for (const HeardPart& part : parts) middles.push_back(part.second_s);
  const double middle_s = mean(middles);
  for (HeardPart& part : parts) part.offset_s -= drift * (part.second_s - middle_s);
  const double offset_s = median(offsets_of(parts));
  const double scatter_s = parts.size() > 1 ? robust_standard_deviation(offsets_of(parts)) : 0.001;
  const auto count = static_cast<double>(parts.size());
  constexpr double kImageToSound_s = 0.01;
  constexpr double kScatter_s = 0.0002;  // of one part: a sample or two
  double spread = 0;
  for (const double at_s : middles) spread += (at_s - middle_s) * (at_s - middle_s);
  ClockOffset clock{
      .sd_s = std::hypot(kImageToSound_s, scatter_s / std::sqrt(count)),
      .drift_sd = heard > 2 && spread > 0 ? std::max(scatter_s, kScatter_s) / std::sqrt(spread) : kUnknown,
      .middle_s = middle_s};
  if (std::abs(drift) > 3 * clock.drift_sd) clock.drift = drift;
  clock.offset_s = offset_s - clock.drift * middle_s;
  return clock;
}

// The findings of one source each.
class ClockSearch {
 public:
  ClockSearch(const CameraRecording& first, const CameraRecording& second, const TurnSyncSettings& settings,
              const StepControl& control)
      : first_(first), second_(second), settings_(settings), control_(control) {}

  [[nodiscard]] ClockFinding by(ClockSource source) const {
    static constexpr std::array kWays{&ClockSearch::by_turns, &ClockSearch::by_sound, &ClockSearch::by_log,
                                      &ClockSearch::by_time_code, &ClockSearch::by_creation_time};
    ClockFinding finding = (this->*kWays.at(static_cast<std::size_t>(source)))();
    finding.source = source;
    return finding;
  }

 private:
  [[nodiscard]] ClockFinding by_turns() const {
    if (first_.motion == nullptr || second_.motion == nullptr) return {.text = "the cameras' turns were not estimated"};
    const Result<TurnSync> sync =
        clock_by_turns(frame_turns(*first_.motion), frame_turns(*second_.motion), settings_, control_);
    if (!sync) return {.text = sync.error().text()};
    return {.clock = sync->clock,
            .text = fmt::format("correlation {:.3f} over {:.1f} s", sync->correlation, sync->overlap_s),
            .turns = *sync};
  }

  [[nodiscard]] ClockFinding by_sound() const {
    std::optional<Sound> sounds[2];
    const CameraRecording* const cameras[]{&first_, &second_};
    for (int i = 0; i < 2; ++i) {
      Result<std::optional<Sound>> sound = read_sound(cameras[i]->video, control_.cancel);
      if (!sound) return {.text = sound.error().text()};
      if (!*sound) return {.text = cameras[i]->video.filename().string() + " has no sound"};
      sounds[i] = *std::move(sound);
    }
    const Result<ClockOffset> clock = clock_by_sound(*sounds[0], *sounds[1], settings_.max_offset_s, control_.cancel);
    if (!clock) return {.text = clock.error().text()};
    return {.clock = *clock, .text = "image and sound taken to be recorded within 10 ms"};
  }

  [[nodiscard]] ClockFinding by_log() const {
    for (const CameraRecording* camera : {&first_, &second_})
      if (const Track* const log = camera->log; !log || !log->on_footage_time || !log->utc_at_zero_s)
        return {.text =
                    camera->video.filename().string() + (!log                   ? " has no log"
                                                         : log->on_footage_time ? " has a log without UTC"
                                                                                : " has a log with times of its own")};
    // Receivers tell their time up to ten times a second, recorders stamp it when it arrives.
    constexpr double kOneLog_s = 0.1;
    return {.clock = ClockOffset{.offset_s = *second_.log->utc_at_zero_s - *first_.log->utc_at_zero_s,
                                 .sd_s = kOneLog_s * std::sqrt(2.0),
                                 .drift_sd = kUnknown},
            .text = fmt::format("UTC of {} and {}", first_.log->format, second_.log->format)};
  }

  [[nodiscard]] ClockFinding by_time_code() const {
    std::optional<TimeCode> codes[2];
    const CameraRecording* const cameras[]{&first_, &second_};
    for (int i = 0; i < 2; ++i) {
      const Result<RecordingTime> time = recording_time_of(cameras[i]->video, control_.cancel);
      if (time) codes[i] = time->time_code;
      if (!codes[i])
        return {.text = time ? cameras[i]->video.filename().string() + " has no time code" : time.error().text()};
    }
    return {.clock = clock_by_time_codes(*codes[0], *codes[1]),
            .text = "right where the recorders' clocks were set alike"};
  }

  [[nodiscard]] ClockFinding by_creation_time() const {
    std::optional<UtcInstant> instants[2];
    const CameraRecording* const cameras[]{&first_, &second_};
    for (int i = 0; i < 2; ++i) {
      const Result<RecordingTime> time = recording_time_of(cameras[i]->video, control_.cancel);
      if (time) instants[i] = utc_instant_of(time->created);
      if (!instants[i])
        return {.text = time ? cameras[i]->video.filename().string() + " has no creation time" : time.error().text()};
    }
    // Whole seconds, of the beginning of the recording or of its end.
    return {
        .clock = ClockOffset{.offset_s = instants[1]->time_s - instants[0]->time_s, .sd_s = 1, .drift_sd = kUnknown},
        .text = "to the second, and right where the recorders' clocks were set alike"};
  }

  const CameraRecording& first_;
  const CameraRecording& second_;
  const TurnSyncSettings& settings_;
  const StepControl& control_;
};

}  // namespace

Result<ClockOffset> clock_by_sound(const Sound& first, const Sound& second, double max_offset_s,
                                   const std::atomic<bool>* cancel) {
  const auto enough = [](const Sound& sound) { return static_cast<double>(sound.samples.size()) >= sound.rate_hz; };
  if (!enough(first) || !enough(second) || first.rate_hz != second.rate_hz)
    return fail("", "the sound of one of the files is shorter than a second");
  std::vector<HeardPart> parts = heard_parts(first, second, max_offset_s, cancel);
  if (is_cancelled(cancel)) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
  if (parts.empty()) return fail("", "nothing that one of the files sounds like is heard in the other");
  const double drift = drift_of(parts);
  const double middle = median(offsets_of(parts));
  const std::size_t heard = parts.size();
  const double at_s = parts[heard / 2].second_s;
  constexpr double kAgree_s = 0.05;
  std::erase_if(parts, [&](const HeardPart& part) {
    return std::abs(part.offset_s - middle - drift * (part.second_s - at_s)) > kAgree_s + std::abs(drift) * 100;
  });
  if (2 * parts.size() <= heard)
    return fail("", fmt::format("parts of the sound agree on no offset: {} of {}", parts.size(), heard));
  return agreed(std::move(parts), heard);
}

ClockOffset clock_by_time_codes(const TimeCode& first, const TimeCode& second) {
  constexpr double kDay_s = 86400;
  const auto frame_s = [](const TimeCode& code) { return static_cast<double>(code.rate_den) / code.rate_num; };
  const auto by_label_s = [](const TimeCode& code) {
    return 3600.0 * code.hours + 60.0 * code.minutes + code.whole_seconds;
  };
  const bool same_count =
      first.rate_num * second.rate_den == second.rate_num * first.rate_den && first.drops_frames == second.drops_frames;
  const auto is_slow = [](const TimeCode& code) { return code.rate_den != 1 && !code.drops_frames; };
  // Hours that are a thousandth too long, since a clock set the code when the recorder was switched on, or never.
  constexpr double kSlow = 0.001;
  const double of_hours_s =
      same_count ? 0 : kSlow * ((is_slow(first) ? by_label_s(first) : 0) + (is_slow(second) ? by_label_s(second) : 0));
  // Of frame 0 of the second camera by the first one's time.
  double offset_s = std::remainder(second.seconds() - first.seconds(), kDay_s);
  if (!same_count) {
    const auto of_day_s = [&](const TimeCode& code) {
      return is_slow(code) ? by_label_s(code) + code.frames * frame_s(code) : code.seconds();
    };
    offset_s = std::remainder(of_day_s(second) - of_day_s(first), kDay_s);
  }
  return {.offset_s = offset_s,
          .sd_s = std::hypot(kEven * frame_s(first), kEven * frame_s(second), of_hours_s),
          .drift_sd = kUnknown};
}

const char* name_of(ClockSource source) {
  static constexpr std::array kNames{"turns", "sound", "log", "time code", "creation time"};
  return kNames.at(static_cast<std::size_t>(source));
}

Result<std::vector<ClockFinding>> found_clocks(const CameraRecording& first, const CameraRecording& second,
                                               std::span<const ClockSource> sources, const TurnSyncSettings& settings,
                                               const StepControl& control) {
  const ClockSearch search(first, second, settings, control);
  std::vector<ClockFinding> findings;
  for (const ClockSource source :
       {ClockSource::turns, ClockSource::sound, ClockSource::log, ClockSource::time_code, ClockSource::creation_time}) {
    if (!sources.empty() && std::find(sources.begin(), sources.end(), source) == sources.end()) continue;
    findings.push_back(search.by(source));
    if (control.is_cancelled()) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
  }
  return findings;
}

std::optional<std::size_t> best_of(std::span<const ClockFinding> findings) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < findings.size(); ++i)
    if (findings[i].clock && (!best || findings[i].clock->sd_s < findings[*best].clock->sd_s)) best = i;
  return best;
}

}  // namespace sigs
