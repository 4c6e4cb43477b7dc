// SPDX-License-Identifier: MIT
#include "editor/document/field_texts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <type_traits>
#include <utility>

namespace sigs::editor {

namespace {

constexpr std::array<std::string_view, 6> kUnitsInKeys{"_px_per_m", "_mps", "_deg", "_percent", "_px", "_m"};

// Where the key alone would not be understood.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kNames{{
    {"compositing.blur_px_per_m", "Blur with distance"},
    {"export.video.crf", "Quality (crf)"},
    {"export.video.codec", "Codec"},
    {"export.video.container", "Container"},
    {"light.color", "Colour"},
    {"own_body.every", "Every nth"},
    {"own_body.settled_percent", "Settled below"},
    {"own_body.stable.vibration_px", "Vibration"},
    {"own_body.stable.least_moving_percent", "Least that moves"},
    {"footage.calibration", "Calibration"},
}};

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

std::string with_spaces(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

// Beside a number. Frames are named by the label.
std::string unit_text(std::string_view unit) {
  if (unit.empty() || unit == "frame") return "";
  return unit == "deg" ? "°" : std::string(" ").append(unit);
}

std::string word_for_none(std::string_view key) {
  return key.starts_with("camera.attitude_deg.") ? "not set" : "none";
}

struct Words {
  const Field& field;

  std::string operator()(double value) const { return number_text(value, field.unit); }
  std::string operator()(int value) const { return number_text(value, field.unit); }
  template <class Number>
  std::string operator()(const std::optional<Number>& value) const {
    return value ? (*this)(*value) : word_for_none(field.key);
  }
  std::string operator()(const std::string& value) const { return value.empty() ? "none" : value; }
  std::string operator()(const glm::dvec3& v) const {
    return number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z, field.unit);
  }
  std::string operator()(const std::vector<std::string>& values) const {
    std::string text;
    for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
    return text.empty() ? "none" : text;
  }
  std::string operator()(ChosenName value) const {
    const auto* const choice = std::get_if<Choice>(&field.value);
    const auto index = static_cast<std::size_t>(value.index);
    return choice != nullptr && index < choice->names.size() ? with_spaces(choice->names[index]) : "";
  }
};

// Of a limit: short even where it is only there to keep numbers finite.
std::string limit_text(double limit) {
  if (std::abs(limit) < 1e6) return number_text(limit);
  char text[64];
  std::snprintf(text, sizeof text, "%g", limit);
  return text;
}

}  // namespace

std::string label_of(std::string_view key) {
  for (const auto& [named, name] : kNames)
    if (key == named) return std::string(name);
  std::string_view last = key.substr(key.rfind('.') + 1);
  for (const std::string_view unit : kUnitsInKeys)
    if (last.size() > unit.size() && last.ends_with(unit)) {
      last.remove_suffix(unit.size());
      break;
    }
  std::string label = with_spaces(last);
  if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return label;
}

bool matches(const Field& field, std::string_view words) {
  const std::string where = lower(field.key + " " + label_of(field.key) + " " + std::string(field.help));
  const std::string wanted = lower(words);
  for (std::size_t begin = 0; begin < wanted.size();) {
    const std::size_t end = std::min(wanted.find(' ', begin), wanted.size());
    if (where.find(wanted.substr(begin, end - begin)) == std::string::npos) return false;
    begin = end + 1;
  }
  return true;
}

std::string range_text(const Field& field) {
  const bool low = std::isfinite(field.minimum);
  const bool high = std::isfinite(field.maximum);
  if (low && high) return limit_text(field.minimum) + " to " + limit_text(field.maximum) + unit_text(field.unit);
  if (low) return "at least " + limit_text(field.minimum) + unit_text(field.unit);
  return high ? "at most " + limit_text(field.maximum) + unit_text(field.unit) : "";
}

std::string word_for_zero(std::string_view key) {
  constexpr std::array<std::string_view, 4> kAsTheClipAsks{"own_body.paper.canny_low", "own_body.paper.canny_high",
                                                           "own_body.paper.dilation_px", "own_body.paper.closing_px"};
  if (std::find(kAsTheClipAsks.begin(), kAsTheClipAsks.end(), key) != kAsTheClipAsks.end()) return "auto";
  return key == "own_body.settled_percent" ? "never" : "";
}

std::string value_text(const Field& field, const PlainValue& value) {
  if (value == PlainValue(0.0) || value == PlainValue(0))
    if (const std::string word = word_for_zero(field.key); !word.empty()) return word;
  return std::visit(Words{field}, value);
}

std::string advice(const Problem& problem, const Field* field) {
  if (field == nullptr) return "";
  if (field->is_path && std::get<std::string*>(field->value)->empty())
    return "Choose the file, or drop it onto the window.";
  if (field->is_path && problem.kind == ErrorKind::cannot_read)
    return field->required ? "Choose where the file lies." : "Choose where the file lies, or leave the field empty.";
  if (field->is_path) return "Choose another file.";
  return "";
}

std::string number_format(double value, std::string_view unit) {
  const double magnitude = std::abs(value);
  const int before_point = magnitude >= 1 ? static_cast<int>(std::floor(std::log10(magnitude))) + 1 : 1;
  const int digits = std::clamp(before_point + 2, 6, 15);
  const std::string beside = unit == "%" ? " %%" : unit_text(unit);
  return "%." + std::to_string(digits) + "g" + beside;
}

std::string number_text(double value, std::string_view unit) {
  char text[64];
  const std::string format = number_format(value, "");
  std::snprintf(text, sizeof text, format.c_str(), value + 0.0);  // no minus before a zero
  return text + unit_text(unit);
}

std::vector<std::string> extensions_for(std::string_view key) {
  if (key.ends_with(".video")) return {".mp4", ".mov", ".mkv", ".avi", ".webm", ".m4v", ".mts", ".png"};
  if (key.ends_with(".calibration")) return {".xml", ".yml", ".yaml", ".json"};
  if (key.ends_with("mask")) return {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  if (key.ends_with(".attitude_file")) return {".csv"};
  if (key.ends_with(".model.file")) return {".obj"};
  return {};
}

}  // namespace sigs::editor
