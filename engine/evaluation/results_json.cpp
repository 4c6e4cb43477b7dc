// SPDX-License-Identifier: MIT
#include "evaluation/results_json.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>

#include "evaluation/text_parsing.h"

namespace sigs {

namespace {

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

// Reads the keys of the list's first entry and stops.
class FirstKeys : public nlohmann::json_sax<nlohmann::json> {
 public:
  [[nodiscard]] std::optional<ResultsFormat> format() const { return format_; }
  [[nodiscard]] bool has_other_keys() const { return has_other_keys_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ > 1; }  // an object outside a list is not a list of results
  bool end_object() override { return --depth_ > 1; }               // the first entry alone
  bool start_array(std::size_t) override {
    ++depth_;
    return true;
  }
  bool end_array() override { return --depth_ > 0; }
  bool key(string_t& name) override {
    if (depth_ != 2) return true;
    if (name == "img_name" || name == "detections") format_ = ResultsFormat::aot;
    if (name == "image_id" || name == "bbox") format_ = ResultsFormat::coco;
    has_other_keys_ = true;
    return !format_;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    has_other_keys_ = false;  // the reader of the layout reports what is wrong, and where
    return false;
  }

 private:
  int depth_ = 0;
  std::optional<ResultsFormat> format_;
  bool has_other_keys_ = false;
};

// The folder in which an image lies: "one" of "flights/one/frame_000123.png"; empty where its name has none.
std::string folder_of_image(const std::string& image) {
  std::string folder = image.substr(0, image.find_last_of("/\\") + 1);  // npos + 1 is 0
  if (!folder.empty()) folder.pop_back();
  return folder.substr(folder.find_last_of("/\\") + 1);
}

}  // namespace

Result<Results> JsonListReader::read() {
  const char* begin = file_.text.data();
  const char* end = begin + file_.text.size();
  nlohmann::json_sax<nlohmann::json>* const events = this;
  if (!nlohmann::json::sax_parse(CountingIterator(begin, &line_), CountingIterator(end, &line_), events))
    return fail(error_);
  Results results = builder_.results();
  results.clip = clip_;
  results.boxes_elsewhere = boxes_elsewhere_;
  return results;
}

bool JsonListReader::fails(int line, const std::string& what) {
  return fails(file_.wrong(line, what).value());
}

bool JsonListReader::fails(const Error& error) {
  error_ = error;
  if (is_one_line_) error_.where += place_in_list();
  return false;
}

bool JsonListReader::add_box(int frame, const Box& box, double score, double track, int line) {
  const std::optional<int> whole_track = integer_of(track);
  if (!whole_track) return fails(line, "track_id is no whole number");
  const int number = *whole_track < 0 ? kNoTrack : *whole_track;
  const Result<void> added = builder_.add(frame, {.box = box, .score = score, .track = number, .line = line});
  return added || fails(added.error());
}

std::optional<int> JsonListReader::frame_named(std::string_view image) const {
  const FramesOfImages* const images = file_.options.images;
  if (images == nullptr || images->by_name.empty()) return frame_of_image(image);
  if (const auto found = images->by_name.find(image); found != images->by_name.end()) return found->second;
  const auto by_stem = images->by_name.find(stem_of_image(image));
  return by_stem == images->by_name.end() ? std::nullopt : std::optional(by_stem->second);
}

void JsonListReader::set_clip_of_image(const std::string& image) {
  if (clip_.empty()) clip_ = folder_of_image(image);
}

bool JsonListReader::key(string_t& name) {
  if (skipped_depth_ == 0) key_ = name;
  return true;
}

bool JsonListReader::start_object(std::size_t) {
  if (skipped_depth_ > 0 || skips_object()) {
    ++skipped_depth_;
    return true;
  }
  if (!starts_object()) return unexpected_value("an object");
  key_.clear();
  return true;
}

bool JsonListReader::end_object() {
  if (skipped_depth_ == 0) return on_object_end();
  --skipped_depth_;
  return true;
}

bool JsonListReader::start_array(std::size_t) {
  if (skipped_depth_ == 0 && starts_list()) return true;
  if (!on_other_value("a list")) return false;
  ++skipped_depth_;
  return true;
}

bool JsonListReader::end_array() {
  if (skipped_depth_ > 0)
    --skipped_depth_;
  else
    on_list_end();
  return true;
}

bool JsonListReader::parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) {
  const std::size_t at = std::min(position > 0 ? position - 1 : 0, file_.text.size());
  return fails(line_at(file_.text, at), "is not JSON from here on" + (token.empty() ? "" : ", at " + in_quotes(token)));
}

Result<ResultsFormat> json_format(const ResultsFile& file) {
  FirstKeys keys;
  static_cast<void>(nlohmann::json::sax_parse(file.text, &keys));
  if (keys.format()) return *keys.format();
  if (!keys.has_other_keys()) return ResultsFormat::aot;
  return file.wrong(1,
                    "is of no known layout: its first entry has neither img_name and detections (aot) nor image_id and "
                    "bbox (coco)");
}

std::string_view stem_of_image(std::string_view image) {
  const std::string_view name = image.substr(image.find_last_of("/\\") + 1);  // npos + 1 is 0
  return name.substr(0, name.find_last_of('.'));
}

std::optional<int> frame_of_image(std::string_view image) {
  const std::string_view name = stem_of_image(image);
  const auto is_digit = [](char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; };
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), is_digit).base();
  const std::string_view digits = name.substr(static_cast<std::size_t>(begin - name.begin()));
  return digits.empty() ? std::nullopt : integer_of(digits);
}

}  // namespace sigs
