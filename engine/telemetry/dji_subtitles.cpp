// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/pose.h"
#include "base/text.h"
#include "telemetry/dji_cues.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

constexpr int kCoarseDecimals = 5;  // a step of the last decimal is 1.1 m or more
constexpr double kMetresPerDegree = 111e3;
constexpr double kSlow_s = 0.5;

struct HeightKind {
  std::optional<double> DjiValues::*field;
  const char* what;
};
constexpr HeightKind kHeightKinds[] = {
    {&DjiValues::absolute_height_m,
     "heights are abs_alt: above the sea as the drone's barometer has it, not above the "
     "ellipsoid; it can be wrong by tens of metres"},
    {&DjiValues::altitude_m, "heights are \"altitude\": the file does not say above what"},
    {&DjiValues::relative_height_m, "heights are above the place of the start"},
};

// The height that the first place with a height has.
const HeightKind* height_kind(const std::vector<DjiValues>& all) {
  for (const DjiValues& values : all)
    for (const HeightKind& kind : kHeightKinds)
      if (values.has_place && values.*kind.field) return &kind;
  return nullptr;
}

// The first focal length that the subtitles state. Focal lengths "as of 35 mm cameras" are for a sensor 36 mm wide.
std::optional<LoggedLens> lens_in(const std::vector<DjiValues>& all) {
  constexpr double kHalfSensor_mm = 18;
  for (const DjiValues& values : all)
    if (values.focal_length_35mm_mm)
      return LoggedLens{
          .source = "focal_len, " + number_text(*values.focal_length_35mm_mm, 1) + " mm before a sensor 36 mm wide",
          .horizontal_fov_rad = 2 * std::atan(kHalfSensor_mm / *values.focal_length_35mm_mm)};
  return std::nullopt;
}

glm::dquat attitude_of_deg(const std::array<double, 3>& roll_pitch_yaw_deg) {
  return rotation_of_deg(roll_pitch_yaw_deg[0], roll_pitch_yaw_deg[1], roll_pitch_yaw_deg[2]);
}

class DjiReading {
 public:
  explicit DjiReading(const std::vector<DjiCue>& cues) : cues_(cues) {
    for (const DjiCue& cue : cues) all_.push_back(dji_values(cue.text));
    has_time_lines_ = std::all_of(cues.begin(), cues.end(), [](const DjiCue& cue) { return cue.footage_s; });
  }

  [[nodiscard]] bool has_values() const {
    return std::any_of(all_.begin(), all_.end(), [](const DjiValues& values) {
      return values.place_form != DjiPlaceForm::none || values.exposure_s || values.gimbal_roll_pitch_yaw_deg;
    });
  }

  Track track(const std::filesystem::path& file) {
    Track track{.file = file, .format = "DJI subtitles", .on_footage_time = true};
    track.lens = lens_in(all_);
    const HeightKind* const height = height_kind(all_);
    for (std::size_t i = 0; i < all_.size(); ++i) take(i, height);
    finish(track.position, places_, track);
    finish(track.ned_from_camera, gimbal_, track);
    finish(track.ned_from_airframe, airframe_, track);
    finish(track.exposure_s, exposures_, track);
    finish(track.white_cdpm2, whites_, track);
    warn(track, height);
    return track;
  }

 private:
  // One channel, and the dates of its samples.
  template <class T>
  struct Stamped {
    explicit Stamped(std::string source) : samples(std::move(source), "footage") {}
    Samples<T> samples;
    std::vector<std::pair<double, double>> dates;  // time and local time of each sample that was added
    bool all_have_dates = true;
  };

  // The sample's time on the footage's axis; without time lines, the date's difference from the first.
  [[nodiscard]] std::optional<double> time_of(std::size_t i) {
    if (has_time_lines_) return cues_[i].footage_s;
    if (!all_[i].local_time_s) return {};
    if (!first_date_s_) first_date_s_ = all_[i].local_time_s;
    return *all_[i].local_time_s - *first_date_s_;
  }

  template <class T>
  static void add(Stamped<T>& stamped, double t_s, const std::optional<double>& local_s, const T& value) {
    stamped.samples.add(t_s, value);
    stamped.all_have_dates &= local_s.has_value();
    stamped.dates.emplace_back(t_s, local_s.value_or(0));
  }

  void take(std::size_t i, const HeightKind* height) {
    const DjiValues& values = all_[i];
    const std::optional<double> t_s = time_of(i);
    if (!t_s) {
      ++without_time_;
      return;
    }
    if (values.place_form != DjiPlaceForm::none) take_place(values, *t_s, height);
    if (values.exposure_s) add(exposures_, *t_s, values.local_time_s, *values.exposure_s);
    if (values.white_cdpm2) add(whites_, *t_s, values.local_time_s, *values.white_cdpm2);
    if (values.gimbal_roll_pitch_yaw_deg)
      add(gimbal_, *t_s, values.local_time_s, attitude_of_deg(*values.gimbal_roll_pitch_yaw_deg));
    if (values.airframe_roll_pitch_yaw_deg)
      add(airframe_, *t_s, values.local_time_s, attitude_of_deg(*values.airframe_roll_pitch_yaw_deg));
  }

  void take_place(const DjiValues& values, double t_s, const HeightKind* height) {
    if (!values.has_place) return places_.samples.leave_out("latitude or longitude is not a number", t_s);
    const std::optional<double> height_m = height ? values.*height->field : std::optional<double>(0);
    GeodeticPosition place = values.place;
    place.height_m = height_m.value_or(0);
    if (const char* const why = why_no_place(place)) {
      const bool by_order = values.place_form != DjiPlaceForm::named;
      return places_.samples.leave_out(
          by_order ? fmt::format("{}; {}", why, order_text(values.place_form)) : std::string(why), t_s);
    }
    if (!height_m) return places_.samples.leave_out("no height of the kind that the others have", t_s);
    decimals_ = std::max(decimals_, values.place_decimals);
    form_ = values.place_form;
    add(places_, t_s, values.local_time_s, place);
  }

  static std::string order_text(DjiPlaceForm form) {
    return form == DjiPlaceForm::latitude_first ? "read as GPS(latitude, longitude, height)"
                                                : "read as GPS(longitude, latitude, satellites)";
  }

  template <class T>
  void finish(Channel<T>& channel, Stamped<T>& stamped, Track& track) {
    channel = std::move(stamped.samples).on_axis(0, track.warnings);
    channel.own_times_s.clear();
    // Of those that were not left out, which stand in the order in which they were added.
    if (stamped.all_have_dates)
      for (const auto& [t_s, local_s] : stamped.dates)
        if (const std::size_t next = channel.own_times_s.size();
            next < channel.times_s.size() && channel.times_s[next] == t_s)
          channel.own_times_s.push_back(local_s);
    if (!has_time_lines_ && !channel.empty()) channel.clock = "local date";
  }

  void warn(Track& track, const HeightKind* height) {
    const auto say = [&](const std::string& where, const std::string& what) {
      track.warnings.push_back({where, what});
    };
    if (!has_time_lines_)
      say("time", "the subtitles have no times of the footage; times are their dates, with the first at 0");
    if (without_time_ > 0) say("time", count_text(without_time_, "subtitle") + " left out: no time and no date");
    if (std::any_of(all_.begin(), all_.end(), [](const DjiValues& values) { return values.local_time_s; }))
      say("date", "dates are local time of an unknown zone, so UTC is not known");
    if (track.position.empty()) say("position", "there is no place in these subtitles");
    if (!track.position.empty()) warn_of_places(track, height);
    warn_of_end(track);
  }

  void warn_of_places(Track& track, const HeightKind* height) const {
    const auto say = [&](const std::string& what) { track.warnings.push_back({"GPS", what}); };
    if (form_ != DjiPlaceForm::named) say(order_text(form_));
    say(height ? height->what : "there is no height; 0 stands for it");
    if (decimals_ <= kCoarseDecimals)
      say("places have " + std::to_string(decimals_) + " decimals: steps of " +
          short_number_text(std::round(kMetresPerDegree * std::pow(10, -decimals_) * 10) / 10) + " m");
    if (const double interval_s = median_interval_s(track.position.times_s); interval_s >= kSlow_s)
      say("one place in " + short_number_text(interval_s) + " s; between them the flight is not known");
  }

  // A file that was cut off has a last subtitle without what the one before has.
  void warn_of_end(Track& track) const {
    if (all_.size() < 2) return;
    const DjiValues& last = all_.back();
    const DjiValues& before = all_[all_.size() - 2];
    const bool lacks_place = before.place_form != DjiPlaceForm::none && last.place_form == DjiPlaceForm::none;
    if (!lacks_place && (!before.exposure_s || last.exposure_s)) return;
    track.damaged = true;
    track.warnings.push_back({cues_.back().line > 0 ? "line " + std::to_string(cues_.back().line) : "last subtitle",
                              "the last subtitle is incomplete: the file was cut off"});
  }

  const std::vector<DjiCue>& cues_;
  std::vector<DjiValues> all_;
  bool has_time_lines_ = true;
  std::optional<double> first_date_s_;
  Stamped<GeodeticPosition> places_{"GPS"};
  Stamped<glm::dquat> gimbal_{"gimbal (gb_yaw, G.PRY)"};
  Stamped<glm::dquat> airframe_{"F.PRY"};
  Stamped<double> exposures_{"shutter"};
  Stamped<double> whites_{"shutter, iso, fnum"};
  DjiPlaceForm form_ = DjiPlaceForm::none;
  int decimals_ = 0;
  std::size_t without_time_ = 0;
};

Result<Track> track_of_cues(const std::vector<DjiCue>& cues, const std::filesystem::path& file) {
  if (cues.empty()) return fail(file.string(), "has no subtitle: the recording may have been broken off at its start");
  DjiReading reading(cues);
  if (!reading.has_values())
    return fail(file.string(), "its subtitles have neither place nor exposure, as those of DJI have");
  Track track = reading.track(file);
  if (!has_samples(track)) return fail(file.string(), "has no subtitle with a time and a possible place or exposure");
  return track;
}

// A subtitle's number, and nothing else.
bool is_lone_number(std::string_view text) {
  text = trimmed(without_bom(text));
  while (!text.empty() && text.back() == '\n') text = trimmed(text.substr(0, text.size() - 1));
  return !text.empty() && text.size() <= 9 && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// MP4 text: a length of 2 bytes, then the text, then boxes of style.
std::string_view stream_text(std::string_view bytes) {
  if (bytes.size() < 2) return bytes;
  const std::size_t length =
      static_cast<std::size_t>(static_cast<unsigned char>(bytes[0])) * 256 + static_cast<unsigned char>(bytes[1]);
  return length <= bytes.size() - 2 && static_cast<unsigned char>(bytes[0]) < 32 ? bytes.substr(2, length) : bytes;
}

}  // namespace

bool is_dji_subtitles(std::string_view head) {
  if (is_lone_number(head)) return true;
  const std::vector<DjiCue> cues = dji_cues(head);
  return !cues.empty() && DjiReading(cues).has_values();
}

bool is_dji_subtitle_stream(const DataStream& stream) {
  return stream.kind == DataKind::subtitles;
}

Result<Track> dji_subtitles_track(std::string_view text, const std::filesystem::path& file) {
  return track_of_cues(dji_cues(text), file);
}

Result<Track> dji_stream_track(const std::filesystem::path& file, const DataStream& stream,
                               const DataPackets& payloads) {
  std::vector<DjiCue> cues;
  for (const DataPacket& payload : payloads.packets) {
    const std::string_view text = stream.codec == "mov_text" ? stream_text(payload.bytes) : payload.bytes;
    if (!trimmed(text).empty()) cues.push_back({.text = text, .footage_s = payload.time_s});
  }
  Result<Track> track = track_of_cues(cues, file);
  if (!track) return track;
  track->on_footage_time = payloads.on_footage_time;
  track->damaged |= payloads.broke_off;
  return track;
}

}  // namespace sigs
