// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/text.h"
#include "project/fields.h"

namespace sigs {

namespace {

std::string mismatch(std::string_view wanted, const Json& found) {
  return fmt::format("expected {}, found {}", wanted, shown(found));
}

std::string put(const Json& json, double* value) {
  if (!json.is_number()) return mismatch("a number", json);
  *value = json.get<double>();
  return {};
}

std::string put(const Json& json, int* value) {
  if (!json.is_number()) return mismatch("a whole number", json);
  const double number = json.get<double>();
  if (number != std::floor(number) || std::fabs(number) > 2e9) return mismatch("a whole number", json);
  *value = static_cast<int>(number);
  return {};
}

template <class T>
std::string put(const Json& json, std::optional<T>* value) {
  if (json.is_null()) {
    value->reset();
    return {};
  }
  T inner{};
  std::string wrong = put(json, &inner);
  if (wrong.empty()) *value = inner;
  return wrong;
}

std::string put(const Json& json, std::string* value) {
  if (json.is_null()) {
    value->clear();
    return {};
  }
  if (!json.is_string()) return mismatch("a text in quotes", json);
  *value = json.get<std::string>();
  return {};
}

std::string put(const Json& json, glm::dvec3* value) {
  if (!json.is_array() || json.size() != 3) return mismatch("three numbers [x, y, z]", json);
  glm::dvec3 read{0, 0, 0};
  for (int i = 0; i < 3; ++i)
    if (!put(json[static_cast<std::size_t>(i)], &read[i]).empty()) return mismatch("three numbers [x, y, z]", json);
  *value = read;
  return {};
}

std::string put(const Json& json, std::vector<std::string>* value) {
  if (!json.is_array()) return mismatch("a list of texts", json);
  std::vector<std::string> read;
  for (const Json& item : json) {
    if (!item.is_string()) return mismatch("a list of texts", json);
    read.push_back(item.get<std::string>());
  }
  *value = std::move(read);
  return {};
}

std::string put(const Json& json, const Choice& choice) {
  for (std::size_t i = 0; i < choice.names.size(); ++i) {
    if (!json.is_string() || json.get<std::string>() != choice.names[i]) continue;
    choice.set(static_cast<int>(i));
    return {};
  }
  return mismatch("one of " + listed(choice.names), json);
}

template <class T>
Json json_of_value(const T* value) {
  return *value;
}
Json json_of_value(const glm::dvec3* value) {
  return Json::array({value->x, value->y, value->z});
}
Json json_of_value(const Choice& choice) {
  return choice.names.at(static_cast<std::size_t>(choice.get()));
}
template <class T>
Json json_of_value(const std::optional<T>* value) {
  return *value ? Json(**value) : Json(nullptr);
}

}  // namespace

Json::json_pointer pointer_of(std::string_view key) {
  std::string pointer = "/";
  for (const char c : key) {
    if (c == '.' || c == '[')
      pointer += '/';
    else if (c == '~')
      pointer += "~0";
    else if (c != ']')
      pointer += c;
  }
  return Json::json_pointer(pointer);
}

std::string put_json(const Json& json, const Field& field) {
  return std::visit([&json](const auto& value) { return put(json, value); }, field.value);
}

Json json_of(const Field& field) {
  return std::visit([](const auto& value) { return json_of_value(value); }, field.value);
}

namespace {

constexpr std::array<RenamedKey, 10> kRenamed{{
    {"own_body.paper.least_area_percent", "own_body.paper.min_area_percent"},
    {"own_body.stable.least_area_percent", "own_body.stable.min_area_percent"},
    {"own_body.stable.least_moving_percent", "own_body.stable.min_moving_percent"},
    {"appearance.point_spread_px", "appearance.psf_sigma_px"},
    {"appearance.chroma_spread_px", "appearance.chroma_blur_px"},
    {"appearance.grain.spread_px", "appearance.grain.correlation_length_px"},
    {"appearance.grain.persistence", "appearance.grain.temporal_correlation"},
    {"appearance.codec.carried_frames", "appearance.codec.predicted_frames"},
    {"export.label_least_pixels", "export.label_min_pixels"},
    {"export.label_least_visible_fraction", "export.label_min_visible_fraction"},
}};

}  // namespace

std::span<const RenamedKey> renamed_keys() {
  return kRenamed;
}

std::string current_key(const std::string& key) {
  const auto* const renamed =
      std::find_if(kRenamed.begin(), kRenamed.end(), [&](const RenamedKey& one) { return one.old_key == key; });
  return renamed == kRenamed.end() ? key : std::string(renamed->key);
}

std::vector<Warning> rename_old_keys(Json& json, std::string_view section, const std::string& where) {
  std::vector<Warning> warnings;
  const std::string prefix = section.empty() ? "" : std::string(section) + ".";
  for (const RenamedKey& renamed : kRenamed) {
    if (!renamed.old_key.starts_with(prefix)) continue;
    const Json::json_pointer before = pointer_of(renamed.old_key.substr(prefix.size()));
    const Json::json_pointer now = pointer_of(renamed.key.substr(prefix.size()));
    if (!json.contains(before)) continue;
    if (json.contains(now)) continue;  // the old one is an unknown key
    // A renamed key stays in its object.
    Json value = std::move(json.at(before));
    Json& object = json.at(before.parent_pointer());
    object.erase(before.back());
    object[now.back()] = std::move(value);
    warnings.push_back({where + std::string(renamed.old_key.substr(prefix.size())),
                        "is called " + now.back() + " today; read as that, and saved so"});
  }
  return warnings;
}

}  // namespace sigs
