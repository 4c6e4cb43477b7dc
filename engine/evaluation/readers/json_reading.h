// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "evaluation/readers/results_formats.h"

namespace sigs {

// Reads fields of one JSON file of another program. The first that is wrong is the file's error, so that callers need
// not check each of them.
class JsonFields {
 public:
  explicit JsonFields(std::filesystem::path path) : path_(std::move(path)) {}

  // The whole document. Errors: cannot_read; bad_data (no JSON, nested too deeply).
  [[nodiscard]] Result<Json> document() const;

  // The place that is read from here on, for messages: "annotations[3]".
  void enter(std::string place) { place_ = std::move(place); }

  // The object's value of this key; null where there is none, or it is null, or `object` is no object.
  [[nodiscard]] static const Json* field(const Json& object, const char* key);

  // Values that must be there: text; a number of a magnitude up to 1e9; a whole one; a list of four such numbers. What
  // is returned where it is not so has no meaning.
  [[nodiscard]] std::string text(const Json& object, const char* key);
  [[nodiscard]] double number(const Json& object, const char* key);
  [[nodiscard]] int whole(const Json& object, const char* key);
  [[nodiscard]] std::array<double, 4> four_numbers(const Json& object, const char* key);

  // The same of values that need not be there.
  [[nodiscard]] std::optional<double> optional_number(const Json& object, const char* key);
  [[nodiscard]] std::optional<int> optional_whole(const Json& object, const char* key);

  // Keeps "PLACE.KEY WHAT" as the error where there is none yet.
  void wrong(const char* key, const std::string& what);

  [[nodiscard]] bool is_wrong() const { return !error_.empty(); }
  [[nodiscard]] tl::unexpected<Error> failure() const { return fail(path_.string(), error_); }
  [[nodiscard]] tl::unexpected<Error> failure(const std::string& what) const { return fail(path_.string(), what); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::string place_;
  std::string error_;
};

// Results in JSON (layouts aot and coco) are a list of entries, which can be too long for a document tree, so it is
// read entry by entry.

// What is wrong with a value that stands where the layouts have none, by its kind.
inline constexpr const char* kJsonLayouts =
    "is {}; results are [{{\"img_name\": ..., \"detections\": [{{...}}]}}, ...] (aot) or [{{\"image_id\": ..., "
    "\"bbox\": [x, y, w, h], \"score\": ...}}, ...] (coco)";

// A value of an entry. Of a list all objects are kept, of other items the first five: enough to see that they are
// wrong. Values of keys that no layout reads are left out.
struct JsonValue {
  static constexpr const char* kNumber = "a number";
  static constexpr const char* kText = "text";
  static constexpr const char* kList = "a list";
  static constexpr const char* kObject = "an object";

  const char* kind = "";  // as messages name it
  int line = 0;
  double number = 0;
  std::string text;
  std::vector<std::string> keys;  // of an object: one for each of its items
  std::vector<JsonValue> items;

  [[nodiscard]] bool is(std::string_view wanted) const { return kind == wanted; }
  // The value of an object's key, the last of several; null: there is none.
  [[nodiscard]] const JsonValue* field(std::string_view key) const {
    const auto found = std::find(keys.rbegin(), keys.rend(), key);
    return found == keys.rend() ? nullptr : &items[static_cast<std::size_t>(keys.rend() - found) - 1];
  }
};

// Reads a list of entries and gives each, once it is complete, to take(). An error ends the reading.
class EntryReader : private nlohmann::json_sax<nlohmann::json> {
 public:
  explicit EntryReader(const ResultsFile& file) : file_(file) {}
  [[nodiscard]] Result<void> read_entries();

 protected:
  [[nodiscard]] virtual Result<void> take(const JsonValue& entry) = 0;

  [[nodiscard]] const ResultsFile& file() const { return file_; }
  [[nodiscard]] tl::unexpected<Error> wrong(const JsonValue& at, const std::string& what) const {
    return file_.wrong(at.line, what);
  }
  void set_detection(std::size_t index) { detection_ = index; }  // that take() is looking at, for messages

 private:
  // The parser's events; false ends the parsing.
  bool null() override { return put({.kind = "null"}); }
  bool boolean(bool) override { return put({.kind = "true or false"}); }
  bool binary(binary_t&) override { return put({.kind = "binary"}); }
  bool number_integer(number_integer_t number) override { return put_number(static_cast<double>(number)); }
  bool number_unsigned(number_unsigned_t number) override { return put_number(static_cast<double>(number)); }
  bool number_float(number_float_t number, const string_t&) override { return put_number(number); }
  bool string(string_t& text) override { return put({.kind = JsonValue::kText, .text = text}); }
  bool key(string_t& name) override {
    if (skipped_levels_ == 0) key_ = name;
    return true;
  }
  bool start_object(std::size_t) override { return open(JsonValue::kObject); }
  bool start_array(std::size_t) override { return open(JsonValue::kList); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) override;

  bool put_number(double number) { return put({.kind = JsonValue::kNumber, .number = number}); }
  bool put(JsonValue value);
  bool open(const char* kind);
  bool close();
  JsonValue* added(JsonValue value);  // to the innermost list or object; null: it is not kept
  bool taken();
  bool fails(Error error);

  const ResultsFile& file_;
  bool is_one_line_ = file_.text.find('\n') >= file_.text.find_last_not_of(" \r\n");
  int line_ = 1;
  JsonValue root_;                // its items: the entry that is being read
  std::vector<JsonValue*> open_;  // lists and objects, each an item of the one before
  std::size_t skipped_levels_ = 0;
  std::string key_;
  int entries_ = 0;  // that are complete
  std::optional<std::size_t> detection_;
  Error error_;
};

}  // namespace sigs
