// SPDX-License-Identifier: MIT
#include "project/json_reading.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text.h"

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

Json json_of_value(const double* value) {
  return *value;
}
Json json_of_value(const int* value) {
  return *value;
}
Json json_of_value(const std::string* value) {
  return *value;
}
Json json_of_value(const std::vector<std::string>* value) {
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

using Members = Json::object_t::Container;

// Builds a value from the parser's events. The library's own builder compares each key with all keys of its object;
// this one keeps an index of them, so that its time grows with the length of the text only.
class JsonBuilder : public nlohmann::json_sax<Json> {
 public:
  [[nodiscard]] Json& built() { return root_; }
  [[nodiscard]] std::size_t wrong_byte() const { return wrong_byte_; }
  [[nodiscard]] bool is_too_large() const { return is_too_large_; }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t& value) override { return put(std::move(value)); }
  bool key(string_t& name) override {
    key_ = std::move(name);
    return true;
  }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
    const auto* const misplaced = dynamic_cast<const nlohmann::json::parse_error*>(&error);
    is_too_large_ = misplaced == nullptr;
    if (misplaced != nullptr) wrong_byte_ = misplaced->byte;
    return false;
  }

 private:
  struct Level {
    Json* json;
    std::unordered_map<std::string, std::size_t> places{};  // of an object's keys
  };

  // The last of several values under one key counts.
  Json& member(Level& level) {
    Members& members = level.json->get_ref<Json::object_t&>();
    const auto [place, is_new] = level.places.emplace(key_, members.size());
    if (is_new) members.emplace_back(key_, nullptr);
    return members[place->second].second;
  }

  Json& added(Json value) {
    Json* place = &root_;
    if (!levels_.empty() && levels_.back().json->is_array())
      place = &levels_.back().json->get_ref<Json::array_t&>().emplace_back();
    else if (!levels_.empty())
      place = &member(levels_.back());
    *place = std::move(value);
    return *place;
  }

  bool put(Json value) {
    added(std::move(value));
    return true;
  }
  bool open(Json empty) {
    levels_.push_back({&added(std::move(empty))});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  Json root_;
  std::vector<Level> levels_;
  std::string key_;
  std::size_t wrong_byte_ = 0;
  bool is_too_large_ = false;
};

}  // namespace

Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind) {
  if (json_depth(text) > kMaxJsonNesting)
    return fail(file, fmt::format("has more than {} brackets within one another", kMaxJsonNesting), kind);
  JsonBuilder builder;
  if (Json::sax_parse(text, &builder)) return std::move(builder.built());
  if (builder.is_too_large()) return fail(file, "holds a number that is too large", kind);
  if (text.find_first_not_of(" \t\r\n") != text.find('{') && !file.ends_with(".json"))
    return fail(file, "is not JSON; `sigs init` makes a project of a video", kind);
  return fail(file, "is not JSON: unexpected text at " + text_position(text, builder.wrong_byte()), kind);
}

void append_members(Json& object, Json more) {
  Members& members = object.get_ref<Json::object_t&>();
  for (auto& [key, value] : more.get_ref<Json::object_t&>()) members.emplace_back(key, std::move(value));
}

std::string shown(const Json& json) {
  constexpr std::size_t kMax = 40;
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= kMax) return text;
  std::size_t end = kMax - 3;
  while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not within a character
  return text.substr(0, end) + "...";
}

}  // namespace sigs
