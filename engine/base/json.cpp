// SPDX-License-Identifier: MIT
#include "base/json.h"

#include <fmt/format.h>

#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/input_file.h"
#include "base/text.h"

namespace sigs {
namespace {

using Members = Json::object_t::Container;

// Builds a value from the parser's events. The library's own builder compares each key with all keys of its object;
// this one keeps an index of them, so that its time grows with the length of the text only.
class JsonBuilder : public nlohmann::json_sax<Json> {
 public:
  explicit JsonBuilder(std::vector<std::string>* doubled) : doubled_(doubled) {}

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
    std::string path;  // what its keys begin with; empty unless doubled ones are asked for
    std::unordered_map<std::string, std::size_t> places{};  // of an object's keys
  };

  // The last of several values under one key counts.
  Json& member(Level& level) {
    Members& members = level.json->get_ref<Json::object_t&>();
    const auto [place, is_new] = level.places.emplace(key_, members.size());
    if (is_new) members.emplace_back(key_, nullptr);
    if (!is_new && doubled_ != nullptr) doubled_->push_back(level.path + key_);
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
    std::string path;
    if (doubled_ != nullptr && !levels_.empty())
      path = levels_.back().path + (levels_.back().json->is_array() ? "" : key_ + ".");
    levels_.push_back({&added(std::move(empty)), std::move(path)});
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
  std::vector<std::string>* doubled_;
};

}  // namespace

Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind,
                         std::vector<std::string>* doubled) {
  if (json_depth(text) > kMaxNesting)
    return fail(file, fmt::format("has more than {} brackets within one another", kMaxNesting), kind);
  JsonBuilder builder(doubled);
  if (Json::sax_parse(text, &builder)) return std::move(builder.built());
  if (builder.is_too_large()) return fail(file, "holds a number that is too large", kind);
  return fail(file, "is not JSON: unexpected text at " + text_position(text, builder.wrong_byte()), kind);
}

void append_members(Json& object, Json more) {
  Members& members = object.get_ref<Json::object_t&>();
  for (auto& [key, value] : more.get_ref<Json::object_t&>()) members.emplace_back(key, std::move(value));
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
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
