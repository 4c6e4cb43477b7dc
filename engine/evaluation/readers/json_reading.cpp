// SPDX-License-Identifier: MIT
#include "evaluation/readers/json_reading.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

Result<Json> JsonFields::document() const {
  const Result<std::string> text = read_text(path_);
  if (!text) return fail(text.error());
  return parsed_json(std::string(without_bom(*text)), path_.string(), ErrorKind::bad_data);
}

const Json* JsonFields::field(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::string JsonFields::text(const Json& object, const char* key) {
  const Json* const found = field(object, key);
  if (found != nullptr && found->is_string()) return found->get<std::string>();
  wrong(key, "is not a text");
  return {};
}

double JsonFields::number(const Json& object, const char* key) {
  const Json* const found = field(object, key);
  const double value = found != nullptr && found->is_number() ? found->get<double>() : std::nan("");
  if (!(std::abs(value) <= 1e9)) wrong(key, "is not a number of a magnitude up to 1e9");
  return value;
}

int JsonFields::whole(const Json& object, const char* key) {
  const double value = number(object, key);
  if (!is_wrong() && value != std::floor(value)) wrong(key, "is not a whole number");
  return is_wrong() ? 0 : static_cast<int>(value);
}

std::optional<double> JsonFields::optional_number(const Json& object, const char* key) {
  return field(object, key) != nullptr ? std::optional(number(object, key)) : std::nullopt;
}

std::optional<int> JsonFields::optional_whole(const Json& object, const char* key) {
  return field(object, key) != nullptr ? std::optional(whole(object, key)) : std::nullopt;
}

std::array<double, 4> JsonFields::four_numbers(const Json& object, const char* key) {
  const Json* const list = field(object, key);
  std::array<double, 4> numbers{};
  bool is_good = list != nullptr && list->is_array() && list->size() == numbers.size();
  for (std::size_t i = 0; is_good && i < numbers.size(); ++i) {
    is_good = (*list)[i].is_number();
    if (is_good) numbers[i] = (*list)[i].get<double>();
    is_good = is_good && std::abs(numbers[i]) <= 1e9;
  }
  if (!is_good) wrong(key, "is not a list of 4 numbers of a magnitude up to 1e9");
  return numbers;
}

void JsonFields::wrong(const char* key, const std::string& what) {
  if (error_.empty()) error_ = fmt::format("{}.{} {}", place_, key, what);
}

namespace {

// Keys that one of the layouts reads; values of others are skipped, however deep they nest.
constexpr std::array<std::string_view, 12> kReadKeys{"img_name", "detections", "x",        "y",    "w",    "h", "s",
                                                     "track_id", "object_id",  "image_id", "bbox", "score"};
constexpr std::size_t kMaxLevels = 4;  // the list, an entry, its detections, one of them; what is in values is skipped
constexpr std::size_t kMaxItems = 5;   // kept of a list but for its objects: one more than a bbox may have

// Iterates over a text and counts its lines into a number that outlives it: the parser's events have no line numbers.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, int* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    if (*at_++ == '\n') ++*line_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  int* line_;
};

}  // namespace

Result<void> EntryReader::read_entries() {
  const char* const begin = file_.text.data();
  const char* const end = begin + file_.text.size();
  nlohmann::json_sax<nlohmann::json>* const events = this;
  if (nlohmann::json::sax_parse(CountingIterator(begin, &line_), CountingIterator(end, &line_), events)) return {};
  return fail(error_);
}

JsonValue* EntryReader::added(JsonValue value) {
  JsonValue& parent = *open_.back();
  value.line = line_;
  if (parent.is(JsonValue::kObject)) {
    if (std::ranges::find(kReadKeys, key_) == kReadKeys.end()) return nullptr;
    parent.keys.push_back(key_);
  } else if (parent.items.size() >= kMaxItems && !value.is(JsonValue::kObject)) {
    return nullptr;
  }
  parent.items.push_back(std::move(value));
  return &parent.items.back();
}

bool EntryReader::put(JsonValue value) {
  if (skipped_levels_ > 0) return true;
  if (open_.empty()) return fails(file_.wrong(line_, fmt::format(kJsonLayouts, value.kind)).value());
  added(std::move(value));
  return open_.size() > 1 || taken();
}

bool EntryReader::open(const char* kind) {
  if (skipped_levels_ == 0 && open_.empty()) {
    if (kind != JsonValue::kList) return fails(file_.wrong(line_, fmt::format(kJsonLayouts, kind)).value());
    root_ = {.kind = JsonValue::kList};
    open_.push_back(&root_);
    return true;
  }
  JsonValue* const value = skipped_levels_ > 0 ? nullptr : added({.kind = kind});
  if (value == nullptr || open_.size() == kMaxLevels)
    ++skipped_levels_;
  else
    open_.push_back(value);
  return true;
}

bool EntryReader::close() {
  if (skipped_levels_ > 0)
    --skipped_levels_;
  else
    open_.pop_back();
  return skipped_levels_ > 0 || open_.size() != 1 || taken();
}

bool EntryReader::taken() {
  detection_.reset();
  const Result<void> good = take(root_.items.back());
  if (!good) return fails(good.error());
  root_.items.clear();
  ++entries_;
  return true;
}

// The entry is named in a file of a single line: "line 1, [17].detections[0]".
bool EntryReader::fails(Error error) {
  error_ = std::move(error);
  if (!is_one_line_ || root_.items.empty() || !root_.items.back().is(JsonValue::kObject)) return false;
  error_.where += fmt::format(", [{}]", entries_);
  if (detection_) error_.where += fmt::format(".detections[{}]", *detection_);
  return false;
}

bool EntryReader::parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) {
  const std::size_t at = std::min(position > 0 ? position - 1 : 0, file_.text.size());
  const JsonValue* const list = open_.size() > 2 ? open_[2] : nullptr;
  detection_ = list != nullptr && !list->items.empty() && list->items.back().is(JsonValue::kObject)
                   ? std::optional(list->items.size() - 1)
                   : std::nullopt;
  return fails(file_
                   .wrong(line_at(file_.text, at),
                          "is not JSON from here on" + (token.empty() ? "" : ", at " + in_quotes(token)))
                   .value());
}

}  // namespace sigs
