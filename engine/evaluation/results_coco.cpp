// SPDX-License-Identifier: MIT
// Results as COCO's evaluation takes them: [{"image_id": 1, "category_id": 1, "bbox": [x, y, w, h], "score": 0.9},
// ...].
#include <algorithm>
#include <climits>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "evaluation/counting_iterator.h"
#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"

namespace sigs {

namespace {

constexpr std::size_t kMaxNumbers = 5;  // of a bbox: one more than it may have is enough to say so

// One box of the list. image_id: a number of COCO's images, or the name of the image (as Ultralytics writes it).
struct Entry {
  std::optional<double> image_id;
  std::optional<std::string> image_name;
  std::optional<std::vector<double>> box;
  double score = 1;
  double track = kNoTrack;
  int line = 0;
};

// Told of one token after the other.
class CocoHandler : public nlohmann::json_sax<nlohmann::json> {
 public:
  CocoHandler(const ResultsFile& file, const int& line)
      : file_(file), line_(line), builder_(file, file.options.first_image_id) {}

  [[nodiscard]] Results results() {
    Results results = builder_.results();
    results.clip = clip_;
    return results;
  }
  [[nodiscard]] const Error& error() const { return error_; }

  bool null() override { return unexpected_value("null"); }
  bool boolean(bool) override { return unexpected_value("true or false"); }
  bool binary(binary_t&) override { return unexpected_value("binary"); }
  bool number_integer(number_integer_t number) override { return on_number(static_cast<double>(number)); }
  bool number_unsigned(number_unsigned_t number) override { return on_number(static_cast<double>(number)); }
  bool number_float(number_float_t number, const string_t&) override { return on_number(number); }
  bool key(string_t& name) override {
    if (skipped_depth_ == 0) key_ = name;
    return true;
  }
  bool string(string_t& text) override {
    if (state_ != State::entry || skipped_depth_ > 0 || key_ != "image_id") return unexpected_value("text");
    entry_.image_name = text;
    return true;
  }
  bool start_object(std::size_t) override;
  bool end_object() override;
  bool start_array(std::size_t) override;
  bool end_array() override;
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) override;

 private:
  enum class State { outside, list, entry, box };

  bool fails(int line, const std::string& what) {
    error_ = file_.wrong(line, what).value();
    name_entry();
    return false;
  }
  // The entry's place in the list, where all are in one line.
  void name_entry() {
    if (is_one_line_ && entries_ > 0) error_.where += ", [" + std::to_string(entries_ - 1) + "]";
  }
  [[nodiscard]] bool is_read(const std::string& key) const {
    return key == "image_id" || key == "bbox" || key == "score" || key == "track_id";
  }
  bool on_number(double number);
  bool unexpected_value(const char* what);
  bool add_entry();
  [[nodiscard]] std::optional<int> frame_of_entry();

  const ResultsFile& file_;
  const int& line_;
  bool is_one_line_ = file_.text.find('\n') >= file_.text.find_last_not_of(" \r\n");
  int entries_ = 0;
  std::string clip_;
  ResultsBuilder builder_;
  Error error_;
  State state_ = State::outside;
  int skipped_depth_ = 0;  // in how many objects and arrays of keys that are not read
  std::string key_;
  Entry entry_;
};

bool CocoHandler::on_number(double number) {
  if (skipped_depth_ > 0) return true;
  if (state_ == State::box) {
    if (entry_.box->size() < kMaxNumbers) entry_.box->push_back(number);
    return true;
  }
  if (state_ != State::entry) return unexpected_value("a number");
  if (key_ == "image_id") entry_.image_id = number;
  if (key_ == "score") entry_.score = number;
  if (key_ == "track_id") entry_.track = number;
  return key_ != "bbox" || unexpected_value("a number");
}

bool CocoHandler::unexpected_value(const char* what) {
  if (skipped_depth_ > 0) return true;
  if (state_ == State::box) return fails(line_, std::string("bbox holds ") + what + ", not a number");
  if (state_ == State::entry) {
    if (!is_read(key_)) return true;
    return fails(line_, key_ + " is " + what + (key_ == "bbox" ? ", not a list of 4 numbers" : ", not a number"));
  }
  return fails(line_, std::string("is ") + what +
                          "; coco results are [{\"image_id\": ..., \"bbox\": [x, y, w, h], \"score\": ...}, ...]");
}

bool CocoHandler::start_object(std::size_t) {
  if (skipped_depth_ > 0 || (state_ == State::entry && !is_read(key_))) {
    ++skipped_depth_;
    return true;
  }
  if (state_ != State::list) return unexpected_value("an object");
  entry_ = {.line = line_};
  ++entries_;
  state_ = State::entry;
  key_.clear();
  return true;
}

bool CocoHandler::end_object() {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
    return true;
  }
  state_ = State::list;
  return add_entry();
}

bool CocoHandler::start_array(std::size_t) {
  if (state_ == State::outside) {
    state_ = State::list;
    return true;
  }
  if (state_ == State::entry && skipped_depth_ == 0 && key_ == "bbox") {
    entry_.box.emplace();
    state_ = State::box;
    return true;
  }
  if (!unexpected_value("a list")) return false;
  ++skipped_depth_;
  return true;
}

bool CocoHandler::end_array() {
  if (skipped_depth_ > 0)
    --skipped_depth_;
  else
    state_ = state_ == State::box ? State::entry : State::outside;
  return true;
}

bool CocoHandler::parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) {
  const std::size_t at = std::min(position > 0 ? position - 1 : 0, file_.text.size());
  return fails(line_at(file_.text, at), "is not JSON from here on" + (token.empty() ? "" : ", at " + in_quotes(token)));
}

// The footage's number; nothing where error_ says why.
std::optional<int> CocoHandler::frame_of_entry() {
  if (entry_.image_name) {
    const std::optional<int> frame = frame_of_image(*entry_.image_name);
    if (!frame)
      fails(entry_.line, "image_id " + in_quotes(*entry_.image_name) +
                             " is neither a number nor an image's name that ends with one, as frame_000123");
    if (clip_.empty()) clip_ = folder_of_image(*entry_.image_name);
    return frame;
  }
  const std::optional<int> id = integer_of(*entry_.image_id);
  if (!id || *id < 1) {
    fails(entry_.line, "image_id is not a whole number from 1; 1 is the clip's first frame");
    return std::nullopt;
  }
  if (const std::optional<int> last = file_.options.last_image_id; last && *id > *last) {
    fails(entry_.line, "image_id " + std::to_string(*id) + " is past the last one, " + std::to_string(*last));
    return std::nullopt;
  }
  const std::int64_t frame = std::int64_t{file_.clip.first_frame} + *id - file_.options.first_image_id;
  return static_cast<int>(std::clamp<std::int64_t>(frame, INT_MIN, INT_MAX));
}

bool CocoHandler::add_entry() {
  if (!entry_.image_id && !entry_.image_name) return fails(entry_.line, "has no image_id");
  if (!entry_.box) return fails(entry_.line, "has no bbox");
  if (entry_.box->size() != 4) return fails(entry_.line, "bbox is not a list of 4 numbers: left, top, width, height");
  const std::optional<int> frame = frame_of_entry();
  if (!frame) return false;
  const FootageTruth& clip = file_.clip;
  if (file_.options.last_image_id && (*frame < clip.first_frame || *frame > clip.last_frame)) return true;
  const std::optional<int> track = integer_of(entry_.track);
  if (!track) return fails(entry_.line, "track_id is no whole number");
  const std::vector<double>& box = *entry_.box;  // COCO counts from the first pixel's corner
  const Result<void> added = builder_.add(*frame, {.box = {box[0] - kEdgeFrom0, box[1] - kEdgeFrom0, box[2], box[3]},
                                                   .score = entry_.score,
                                                   .track = *track < 0 ? kNoTrack : *track,
                                                   .line = entry_.line});
  if (added) return true;
  error_ = added.error();
  name_entry();
  return false;
}

}  // namespace

Result<Results> read_coco(const ResultsFile& file) {
  int line = 1;
  CocoHandler handler(file, line);
  const char* begin = file.text.data();
  const char* end = begin + file.text.size();
  if (!nlohmann::json::sax_parse(CountingIterator(begin, &line), CountingIterator(end, &line), &handler))
    return fail(handler.error());
  return handler.results();
}

}  // namespace sigs
