// SPDX-License-Identifier: MIT
#include "evaluation/readers/json_entries.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "evaluation/readers/text_parsing.h"

namespace sigs {

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
