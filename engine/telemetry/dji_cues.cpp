// SPDX-License-Identifier: MIT
#include "telemetry/dji_cues.h"

#include <charconv>
#include <cmath>

#include "base/text.h"
#include "geo/utc_time.h"

namespace sigs {
namespace {

constexpr double kScaledAperture = 100;  // from here on apertures are a hundred times as large, focal lengths ten times

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.';
}

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
}

bool skip(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

// Takes a finite decimal number, and blanks before it, off the text.
std::optional<double> taken_number(std::string_view& text) {
  skip_blanks(text);
  const bool has_plus = skip(text, '+');
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc{} || !std::isfinite(number) || (has_plus && number < 0)) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

// Takes an integer of `least` to `most` digits off the text.
std::optional<int> taken_digits(std::string_view& text, std::size_t least, std::size_t most) {
  std::size_t digits = 0;
  int number = 0;
  while (digits < most && digits < text.size() && is_digit(text[digits])) number = 10 * number + (text[digits++] - '0');
  if (digits < least) return {};
  text.remove_prefix(digits);
  return number;
}

// The text behind a whole word, wherever it stands: "GPS" but not "GPSx". Empty: it does not.
std::string_view behind(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !is_word(text[at - 1]);
    const std::string_view rest = text.substr(at + word.size());
    if (begins && (rest.empty() || !is_word(rest.front()))) return rest;
  }
  return {};
}

// The text of the value in "word: value" and "word : value"; empty: there is none.
std::string_view value_of(std::string_view text, std::string_view word) {
  std::string_view rest = behind(text, word);
  skip_blanks(rest);
  if (!skip(rest, ':')) return {};
  skip_blanks(rest);
  return rest;
}

std::optional<double> number_of(std::string_view text, std::string_view word) {
  std::string_view value = value_of(text, word);
  return taken_number(value);
}

// The numbers in "WORD(1, 2, 3)", up to three of them.
struct Bracket {
  std::array<double, 3> numbers{};
  int count = 0;
  bool is_there = false;
  bool third_has_unit = false;
  std::string_view second;  // its text, to count the decimals
};

Bracket bracket_of(std::string_view text, std::string_view word) {
  Bracket bracket;
  std::string_view rest = behind(text, word);
  skip_blanks(rest);
  if (!skip(rest, '(')) return bracket;
  bracket.is_there = true;
  while (bracket.count < 3) {
    skip_blanks(rest);
    const std::string_view start = rest;
    const std::optional<double> number = taken_number(rest);
    if (!number) break;
    if (bracket.count == 1) bracket.second = start.substr(0, start.size() - rest.size());
    bracket.numbers[static_cast<std::size_t>(bracket.count++)] = *number;
    if (bracket.count == 3) bracket.third_has_unit = !rest.empty() && (rest.front() == 'M' || rest.front() == 'm');
    if (rest.starts_with("\xC2\xB0")) rest.remove_prefix(2);  // degree sign
    if (!skip(rest, ',')) break;
  }
  return bracket;
}

int decimals_of(std::string_view number) {
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  int decimals = 0;
  for (std::size_t i = point + 1; i < number.size() && is_digit(number[i]); ++i) ++decimals;
  return decimals;
}

void read_place(std::string_view text, DjiValues& values) {
  std::string_view longitude_text = value_of(text, "longitude");
  if (longitude_text.empty()) longitude_text = value_of(text, "longtitude");
  std::string_view latitude_text = value_of(text, "latitude");
  if (!latitude_text.empty() || !longitude_text.empty()) {
    values.place_form = DjiPlaceForm::named;
    values.place_decimals = decimals_of(latitude_text);
    const std::optional<double> latitude_deg = taken_number(latitude_text);
    const std::optional<double> longitude_deg = taken_number(longitude_text);
    values.has_place = latitude_deg && longitude_deg;
    if (values.has_place) values.place = {.latitude_deg = *latitude_deg, .longitude_deg = *longitude_deg};
    return;
  }
  const Bracket gps = bracket_of(text, "GPS");
  if (!gps.is_there) return;
  values.place_form = gps.third_has_unit ? DjiPlaceForm::latitude_first : DjiPlaceForm::longitude_first;
  values.has_place = gps.count >= 2;
  values.place_decimals = decimals_of(gps.second);
  const bool is_latitude_first = gps.third_has_unit;
  values.place.latitude_deg = gps.numbers[is_latitude_first ? 0 : 1];
  values.place.longitude_deg = gps.numbers[is_latitude_first ? 1 : 0];
}

void read_heights(std::string_view text, DjiValues& values) {
  values.absolute_height_m = number_of(text, "abs_alt");
  values.altitude_m = number_of(text, "altitude");
  for (const std::string_view word : {"rel_alt", "BAROMETER", "Hb"})
    if (!values.relative_height_m) values.relative_height_m = number_of(text, word);
  // "H 85.80m": no colon.
  std::string_view h = behind(text, "H");
  if (!values.relative_height_m && h.starts_with(' ')) values.relative_height_m = taken_number(h);
}

// "shutter : 1/80.0" is a fraction, "shutter : 2.0" seconds; "Shutter:60", "TV:60" and "SS 400" are its reciprocal.
void read_exposure(std::string_view text, DjiValues& values) {
  if (std::string_view shutter = value_of(text, "shutter"); !shutter.empty()) {
    const std::optional<double> number = taken_number(shutter);
    if (!number) return;
    const std::optional<double> divisor = skip(shutter, '/') ? taken_number(shutter) : 1.0;
    if (divisor && *divisor > 0 && *number > 0) values.exposure_s = *number / *divisor;
    return;
  }
  std::optional<double> reciprocal = number_of(text, "Shutter");
  if (!reciprocal) reciprocal = number_of(text, "TV");
  std::string_view ss = behind(text, "SS");
  if (!reciprocal && ss.starts_with(' ')) reciprocal = taken_number(ss);
  if (reciprocal && *reciprocal > 0) values.exposure_s = 1 / *reciprocal;
}

void read_attitudes(std::string_view text, DjiValues& values) {
  const std::optional<double> yaw = number_of(text, "gb_yaw");
  const std::optional<double> pitch = number_of(text, "gb_pitch");
  const std::optional<double> roll = number_of(text, "gb_roll");
  if (yaw && pitch && roll) values.gimbal_roll_pitch_yaw_deg = {*roll, *pitch, *yaw};
  // PRY: pitch, roll, yaw.
  const auto pry = [&](std::string_view word) -> std::optional<std::array<double, 3>> {
    const Bracket bracket = bracket_of(text, word);
    if (bracket.count < 3) return {};
    return std::array<double, 3>{bracket.numbers[1], bracket.numbers[0], bracket.numbers[2]};
  };
  if (const auto gimbal = pry("G.PRY")) values.gimbal_roll_pitch_yaw_deg = gimbal;
  values.airframe_roll_pitch_yaw_deg = pry("F.PRY");
}

// "fnum : 280", "Fnum:F2.8", "IR:F2.8" and "F/2.8" are 2.8, "Fnum:2.2" as it stands; "iso : 100" and "ISO 260". After
// the exposure time. White is by the sensitivity that ISO 12232 defines by saturation: 78 / (0.65 S t) N^2.
void read_white(std::string_view text, DjiValues& values) {
  std::string_view aperture;
  for (const std::string_view word : {"fnum", "Fnum", "IR"})
    if (aperture.empty()) aperture = value_of(text, word);
  if (aperture.empty()) aperture = behind(text, "F");
  for (const char c : {'F', '/'}) skip(aperture, c);
  std::string_view sensitivity = value_of(text, "iso");
  if (sensitivity.empty()) sensitivity = behind(text, "ISO");
  skip(sensitivity, ':');
  std::optional<double> f_number = taken_number(aperture);
  const std::optional<double> iso = taken_number(sensitivity);
  if (f_number && *f_number >= kScaledAperture) *f_number /= 100;
  if (!values.exposure_s || !f_number || !iso || *f_number <= 0 || *iso <= 0) return;
  values.white_cdpm2 = 120 * *f_number * *f_number / (*iso * *values.exposure_s);
}

// "fnum : 280, focal_len : 240" is 2.8 and 24 mm, "fnum: 1.7, focal_len: 24.00" as it stands; "dzoom_ratio: 10000"
// is 1.
void read_focal_length(std::string_view text, DjiValues& values) {
  const std::optional<double> focal_length = number_of(text, "focal_len");
  if (!focal_length || *focal_length <= 0) return;
  const bool is_scaled = number_of(text, "fnum").value_or(0) >= kScaledAperture;
  double zoom = number_of(text, "dzoom_ratio").value_or(1);
  if (zoom >= 1000) zoom /= 10000;
  values.focal_length_35mm_mm = *focal_length / (is_scaled ? 10 : 1) * (zoom >= 1 ? zoom : 1);
}

// "2017.8.5 14:11:51", "2022-08-07 13:40:40,774,808" (milliseconds, microseconds), "2026-05-27 13:10:00.015".
std::optional<double> taken_date(std::string_view text) {
  const auto number = [&](std::size_t least, std::size_t most) { return taken_digits(text, least, most); };
  const std::optional<int> year = number(4, 4);
  if (!year || text.empty() || (text.front() != '.' && text.front() != '-')) return {};
  const char separator = text.front();
  std::array<int, 5> parts{};  // month, day, hour, minute, second
  const std::array<char, 5> before = {separator, separator, ' ', ':', ':'};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::optional<int> part = skip(text, before[i]) ? number(1, 2) : std::nullopt;
    if (!part) return {};
    parts[i] = *part;
  }
  const std::optional<double> day_s = utc_of_day(*year, parts[0], parts[1]);
  if (!day_s || parts[2] > 23 || parts[3] > 59 || parts[4] > 60) return {};
  double seconds = *day_s + parts[2] * 3600 + parts[3] * 60 + parts[4];
  double unit_s = 1e-3;
  while (unit_s > 1e-7 && (skip(text, ',') || skip(text, '.'))) {
    const std::optional<int> thousandths = number(3, 3);
    if (!thousandths) break;
    seconds += *thousandths * unit_s;
    unit_s *= 1e-3;
  }
  return seconds;
}

std::optional<double> date_in(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at)
    if (is_digit(text[at]) && (at == 0 || !is_digit(text[at - 1])))
      if (const std::optional<double> date = taken_date(text.substr(at))) return date;
  return {};
}

// "00:00:01,000 --> 00:00:02,000": the first time.
std::optional<double> time_line(std::string_view line) {
  if (line.find("-->") == std::string_view::npos) return {};
  const std::optional<int> hours = taken_digits(line, 1, 4);
  const std::optional<int> minutes = hours && skip(line, ':') ? taken_digits(line, 1, 2) : std::nullopt;
  const std::optional<int> seconds = minutes && skip(line, ':') ? taken_digits(line, 1, 2) : std::nullopt;
  if (!seconds) return {};
  const bool has_fraction = skip(line, ',') || skip(line, '.');
  const std::optional<int> thousandths = has_fraction ? taken_digits(line, 3, 3) : std::optional(0);
  if (!thousandths) return {};
  return *hours * 3600.0 + *minutes * 60.0 + *seconds + *thousandths * 1e-3;
}

bool is_number(std::string_view line) {
  line = trimmed(line);
  return !line.empty() && line.size() <= 9 && line.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::vector<DjiCue> dji_cues(std::string_view text) {
  text = without_bom(text);
  std::vector<DjiCue> cues;
  const char* cue_begins = nullptr;  // the text of the last cue
  std::size_t line_number = 0;
  while (!text.empty()) {
    const std::string_view before = text;
    const std::string_view line = next_line(text);
    ++line_number;
    std::string_view ahead = text;
    const std::string_view following = trimmed(next_line(ahead));
    const std::optional<double> start_s = is_number(line) ? time_line(following) : std::nullopt;
    if (is_number(line) && (start_s || taken_date(following))) {
      if (cue_begins) cues.back().text = {cue_begins, static_cast<std::size_t>(before.data() - cue_begins)};
      if (start_s) {
        text = ahead;
        ++line_number;
      }
      cue_begins = text.data();
      cues.push_back({.line = line_number + 1, .footage_s = start_s});
    }
    if (text.empty() && cue_begins)
      cues.back().text = {cue_begins, static_cast<std::size_t>(before.data() + before.size() - cue_begins)};
  }
  return cues;
}

DjiValues dji_values(std::string_view text) {
  DjiValues values;
  read_place(text, values);
  read_heights(text, values);
  read_exposure(text, values);
  read_white(text, values);
  read_focal_length(text, values);
  read_attitudes(text, values);
  values.local_time_s = date_in(text);
  return values;
}

}  // namespace sigs
