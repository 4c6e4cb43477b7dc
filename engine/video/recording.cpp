// SPDX-License-Identifier: MIT
#include "video/recording.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>

extern "C" {
#include <libavutil/samplefmt.h>
}

#include "base/ensure.h"
#include "base/threads.h"
#include "video/libav/demuxer.h"

namespace sigs {
namespace {

constexpr double kSoundLimit_s = 1200;

template <class Number>
double number_at(const uint8_t* data, std::size_t index) {
  Number number{};
  std::memcpy(&number, data + index * sizeof number, sizeof number);
  return static_cast<double>(number);
}

// A sample of one channel, -1 to 1.
double sample_at(const uint8_t* data, std::size_t index, AVSampleFormat packed) {
  switch (packed) {
    case AV_SAMPLE_FMT_U8:
      return number_at<std::uint8_t>(data, index) / 128 - 1;
    case AV_SAMPLE_FMT_S16:
      return number_at<std::int16_t>(data, index) / 32768;
    case AV_SAMPLE_FMT_S32:
      return number_at<std::int32_t>(data, index) / 2147483648.0;
    case AV_SAMPLE_FMT_S64:
      return number_at<std::int64_t>(data, index) / 9223372036854775808.0;
    case AV_SAMPLE_FMT_FLT:
      return number_at<float>(data, index);
    case AV_SAMPLE_FMT_DBL:
      return number_at<double>(data, index);
    default:
      return 0;
  }
}

// Mono samples at equal steps from samples of any rate: means over each step.
class Mixer {
 public:
  // time_s  of the first sample's beginning
  void add(const AVFrame& frame, double time_s) {
    const auto format = static_cast<AVSampleFormat>(frame.format);
    const AVSampleFormat packed = av_get_packed_sample_fmt(format);
    const bool is_planar = av_sample_fmt_is_planar(format) != 0;
    const int channels = frame.ch_layout.nb_channels;
    if (channels < 1 || frame.sample_rate < 1) return;
    const double step_s = 1.0 / frame.sample_rate;
    constexpr double kRounding_s = 0.003;  // of stamps in milliseconds; samples follow one another all the same
    if (sound_.samples.empty() && filled_s_ == 0) {
      begin_s_ = now_s_ = time_s;
    } else if (std::abs(time_s - now_s_) > kRounding_s) {
      if (time_s < now_s_) return;  // a second time
      while (now_s_ < time_s - 1e-9 && !is_full()) put(0, std::min(time_s - now_s_, 1 / sound_.rate_hz));
    }
    for (int i = 0; i < frame.nb_samples && !is_full(); ++i) {
      double sum = 0;
      for (int channel = 0; channel < channels; ++channel)
        sum += is_planar ? sample_at(frame.extended_data[channel], static_cast<std::size_t>(i), packed)
                         : sample_at(frame.extended_data[0],
                                     static_cast<std::size_t>(i) * static_cast<std::size_t>(channels) +
                                         static_cast<std::size_t>(channel),
                                     packed);
      put(std::isfinite(sum) ? sum / channels : 0, step_s);
    }
  }

  [[nodiscard]] bool is_full() const {
    return static_cast<double>(sound_.samples.size()) >= kSoundLimit_s * sound_.rate_hz;
  }

  // zero_s  of frame 0
  [[nodiscard]] Sound taken(double zero_s) {
    sound_.first_s = begin_s_ - zero_s + 0.5 / sound_.rate_hz;
    return std::move(sound_);
  }

 private:
  // A level that lasts for a time, which may end within a step.
  void put(double level, double length_s) {
    now_s_ += length_s;
    const double step_s = 1 / sound_.rate_hz;
    while (filled_s_ + length_s >= step_s) {
      const double part_s = step_s - filled_s_;
      sound_.samples.push_back(static_cast<float>((sum_ + level * part_s) / step_s));
      length_s -= part_s;
      sum_ = filled_s_ = 0;
    }
    sum_ += level * length_s;
    filled_s_ += length_s;
  }

  Sound sound_;
  double begin_s_ = 0;
  double now_s_ = 0;
  double sum_ = 0;
  double filled_s_ = 0;  // of the step that is not complete
};

libav::CodecPtr sound_decoder(const AVCodecParameters& parameters) {
  const AVCodec* const codec = avcodec_find_decoder(parameters.codec_id);
  if (codec == nullptr) return nullptr;
  libav::CodecPtr context = libav::new_context(codec);
  if (avcodec_parameters_to_context(context.get(), &parameters) < 0) return nullptr;
  if (const int error = avcodec_open2(context.get(), codec, nullptr); error < 0) {
    libav::check_memory(error);
    return nullptr;
  }
  return context;
}

// All that the decoder has ready. Stamps count in the stream's ticks.
void take_frames(AVCodecContext& decoder, AVFrame& frame, AVRational tick, Mixer& mixer, double& next_s) {
  while (avcodec_receive_frame(&decoder, &frame) >= 0) {
    const double time_s = frame.best_effort_timestamp != AV_NOPTS_VALUE
                              ? static_cast<double>(frame.best_effort_timestamp) * av_q2d(tick)
                              : next_s;
    mixer.add(frame, time_s);
    next_s = time_s + static_cast<double>(frame.nb_samples) / std::max(1, frame.sample_rate);
  }
}

Result<std::optional<Sound>> decoded_sound(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  const Result<libav::InputPtr> looked_at = libav::open_input(file, cancel);
  if (!looked_at) return fail(looked_at.error());
  if (av_find_best_stream(looked_at->get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0) < 0) return std::nullopt;
  const double zero_s = libav::time_of_frame_0(**looked_at).value_or(0);
  const Result<libav::InputPtr> input = libav::open_input(file, cancel);  // at its beginning again
  if (!input) return fail(input.error());
  const int index = av_find_best_stream(input->get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
  if (index < 0) return std::nullopt;
  libav::keep_only(**input, index);
  AVStream& stream = *(*input)->streams[index];
  const libav::CodecPtr decoder = sound_decoder(*stream.codecpar);
  if (decoder == nullptr) return std::nullopt;
  decoder->pkt_timebase = stream.time_base;
  const libav::PacketPtr packet = libav::new_packet();
  const libav::FramePtr frame = libav::new_frame();
  Mixer mixer;
  double next_s = zero_s;
  while (!mixer.is_full() && libav::next_packet(**input, index, *packet) == libav::Step::packet) {
    libav::check_memory(avcodec_send_packet(decoder.get(), packet.get()));  // what is damaged is passed over
    take_frames(*decoder, *frame, stream.time_base, mixer, next_s);
  }
  if (cancel != nullptr && cancel->load()) return libav::interrupted();
  static_cast<void>(avcodec_send_packet(decoder.get(), nullptr));
  take_frames(*decoder, *frame, stream.time_base, mixer, next_s);
  Sound sound = mixer.taken(zero_s);
  if (sound.samples.empty()) return std::nullopt;
  return std::optional(std::move(sound));
}

std::string tag_in(AVDictionary* tags, const char* key) {
  const AVDictionaryEntry* const entry = av_dict_get(tags, key, nullptr, 0);
  return entry != nullptr ? entry->value : "";
}

std::string tag_of_file(AVFormatContext& input, int video, const char* key) {
  std::string text = video >= 0 ? tag_in(input.streams[video]->metadata, key) : "";
  for (unsigned i = 0; i < input.nb_streams && text.empty(); ++i) text = tag_in(input.streams[i]->metadata, key);
  return text.empty() ? tag_in(input.metadata, key) : text;
}

// Frames that a second of the code counts.
int counted_rate(int rate_num, int rate_den) {
  return static_cast<int>(std::lround(static_cast<double>(rate_num) / rate_den));
}

// Numbers that are left out at the beginning of a minute, of codes that drop any.
int dropped_numbers(int counted) {
  return 2 * std::max(1, counted / 30);
}

}  // namespace

double TimeCode::seconds() const {
  const int counted = counted_rate(rate_num, rate_den);
  const std::int64_t whole_minutes = 60 * hours + minutes;
  std::int64_t number = counted * (60 * whole_minutes + whole_seconds) + frames;
  if (drops_frames) number -= dropped_numbers(counted) * (whole_minutes - whole_minutes / 10);
  return static_cast<double>(number) * rate_den / rate_num;
}

std::optional<TimeCode> time_code_of(const std::string& text, int rate_num, int rate_den) {
  ENSURE(rate_num > 0 && rate_den > 0);
  TimeCode code{.rate_num = rate_num, .rate_den = rate_den};
  char separator = 0;
  int end = 0;
  const int count = std::sscanf(text.c_str(), "%2d:%2d:%2d%c%3d%n", &code.hours, &code.minutes, &code.whole_seconds,
                                &separator, &code.frames, &end);
  if (count != 5 || static_cast<std::size_t>(end) != text.size()) return std::nullopt;
  const int counted = counted_rate(rate_num, rate_den);
  code.drops_frames = separator == ';' || separator == '.';
  if (!code.drops_frames && separator != ':') return std::nullopt;
  const auto within = [](int number, int limit) { return number >= 0 && number < limit; };
  if (!within(code.hours, 24) || !within(code.minutes, 60) || !within(code.whole_seconds, 60) ||
      !within(code.frames, counted))
    return std::nullopt;
  if (code.drops_frames && (counted % 30 != 0 || (code.whole_seconds == 0 && code.minutes % 10 != 0 &&
                                                  code.frames < dropped_numbers(counted))))
    return std::nullopt;
  return code;
}

Result<std::optional<Sound>> read_sound(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  return guarded([&] { return decoded_sound(file, cancel); }, file.string());
}

Result<RecordingTime> recording_time_of(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  return guarded(
      [&]() -> Result<RecordingTime> {
        const Result<libav::InputPtr> input = libav::open_input(file, cancel);
        if (!input) return fail(input.error());
        const int video = libav::video_stream_of(**input);
        RecordingTime time{.time_code = {}, .created = tag_of_file(**input, video, "creation_time")};
        if (video < 0) return time;
        const AVStream& stream = *(*input)->streams[video];
        const AVRational rate = stream.avg_frame_rate.num > 0 ? stream.avg_frame_rate : stream.r_frame_rate;
        if (rate.num > 0 && rate.den > 0)
          time.time_code = time_code_of(tag_of_file(**input, video, "timecode"), rate.num, rate.den);
        return time;
      },
      file.string());
}

}  // namespace sigs
