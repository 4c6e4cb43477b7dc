// SPDX-License-Identifier: MIT
// Results of the Airborne Object Tracking challenge: [{"img_name": ..., "detections": [{"x": ...}, ...]}, ...].
#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "evaluation/counting_iterator.h"
#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"

namespace sigs {

namespace {

enum Field { x_field, y_field, w_field, h_field, score_field, track_field, kFields };
constexpr const char* kFieldNames[kFields] = {"x", "y", "w", "h", "s", "track_id"};

struct Detection {
  std::optional<double> values[kFields];
  int line = 0;
};

// One element of the list: the detections may come before the image's name.
struct AotImage {
  std::optional<std::string> name;
  std::vector<Detection> detections;
  int line = 0;
};

// Told of one token after the other.
class AotHandler : public nlohmann::json_sax<nlohmann::json> {
 public:
  AotHandler(const ResultsFile& file, const int& line) : file_(file), line_(line), builder_(file) {}

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
    key_ = name;
    return true;
  }
  bool string(string_t& text) override;
  bool start_object(std::size_t) override;
  bool end_object() override;
  bool start_array(std::size_t) override;
  bool end_array() override;
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) override;

 private:
  enum class State { outside, list, image, detections, detection };

  bool fails(int line, const std::string& what) {
    error_ = file_.wrong(line, what).value();
    if (is_one_line_) error_.where += entry_text(static_cast<int>(image_.detections.size()) - 1);
    return false;
  }
  [[nodiscard]] std::optional<Field> field() const;
  bool on_number(double number);
  bool unexpected_value(const char* what);
  bool add_image();
  bool add_detection(int frame, const Detection& detection);

  // ", [17].detections[0]": where a line number tells nothing.
  [[nodiscard]] std::string entry_text(int detection) const {
    if (images_ == 0 || state_ == State::list || state_ == State::outside) return "";
    const std::string image = ", [" + std::to_string(images_ - 1) + "]";
    return detection < 0 ? image : image + ".detections[" + std::to_string(detection) + "]";
  }

  const ResultsFile& file_;
  const int& line_;
  bool is_one_line_ = file_.text.find('\n') >= file_.text.find_last_not_of(" \r\n");
  int images_ = 0;
  std::string clip_;
  ResultsBuilder builder_;
  Error error_;
  State state_ = State::outside;
  int skipped_depth_ = 0;  // in how many objects and arrays of keys that are not read
  std::string key_;
  AotImage image_;
  std::map<int, int> line_of_frame_;
};

std::optional<Field> AotHandler::field() const {
  if (state_ != State::detection || skipped_depth_ > 0) return std::nullopt;
  if (key_ == "object_id") return track_field;
  const auto found = std::ranges::find(kFieldNames, key_);
  if (found == std::end(kFieldNames)) return std::nullopt;
  return static_cast<Field>(found - std::begin(kFieldNames));
}

bool AotHandler::on_number(double number) {
  if (const std::optional<Field> at = field()) {
    image_.detections.back().values[*at] = number;
    return true;
  }
  return unexpected_value("a number");
}

bool AotHandler::unexpected_value(const char* what) {
  if (skipped_depth_ > 0) return true;
  if (field()) return fails(line_, key_ + " is " + what + ", not a number");
  if (state_ == State::image && key_ == "img_name") return fails(line_, std::string("img_name is ") + what);
  if (state_ == State::image && key_ == "detections")
    return fails(line_, std::string("detections is ") + what + ", not a list");
  if (state_ == State::image || state_ == State::detection) return true;
  return fails(line_,
               std::string("is ") + what +
                   "; results are [{\"img_name\": ..., \"detections\": [{...}]}, ...] (aot) or [{\"image_id\": ..., "
                   "\"bbox\": [x, y, w, h], \"score\": ...}, ...] (coco)");
}

bool AotHandler::string(string_t& text) {
  if (state_ == State::image && skipped_depth_ == 0 && key_ == "img_name") {
    image_.name = text;
    return true;
  }
  return unexpected_value("text");
}

bool AotHandler::start_object(std::size_t) {
  if (skipped_depth_ > 0 || (state_ == State::image && key_ != "detections") ||
      (state_ == State::detection && !field())) {
    ++skipped_depth_;
    return true;
  }
  if (state_ == State::list) {
    image_ = {.line = line_};
    ++images_;
    state_ = State::image;
    key_.clear();
    return true;
  }
  if (state_ == State::detections) {
    image_.detections.push_back({.line = line_});
    state_ = State::detection;
    key_.clear();
    return true;
  }
  return unexpected_value("an object");
}

bool AotHandler::end_object() {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
    return true;
  }
  if (state_ == State::detection) {
    state_ = State::detections;
    return true;
  }
  const bool taken = add_image();
  state_ = State::list;
  return taken;
}

bool AotHandler::start_array(std::size_t) {
  if (state_ == State::outside) {
    state_ = State::list;
    return true;
  }
  if (state_ == State::image && skipped_depth_ == 0 && key_ == "detections") {
    state_ = State::detections;
    return true;
  }
  if (!unexpected_value("a list")) return false;
  ++skipped_depth_;
  return true;
}

bool AotHandler::end_array() {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
  } else {
    state_ = state_ == State::detections ? State::image : State::outside;
  }
  return true;
}

bool AotHandler::parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) {
  const std::size_t at = std::min(position > 0 ? position - 1 : 0, file_.text.size());
  return fails(line_at(file_.text, at), "is not JSON from here on" + (token.empty() ? "" : ", at " + in_quotes(token)));
}

bool AotHandler::add_image() {
  if (!image_.name) return fails(image_.line, "has no img_name");
  const std::optional<int> frame = frame_of_image(*image_.name);
  if (!frame)
    return fails(image_.line,
                 "img_name " + in_quotes(*image_.name) + " does not end with a frame number, as frame_000123.png does");
  const auto [there, is_first] = line_of_frame_.emplace(*frame, image_.line);
  if (!is_first)
    return fails(image_.line,
                 "frame " + std::to_string(*frame) + " a second time, first in line " + std::to_string(there->second));
  if (clip_.empty()) clip_ = folder_of_image(*image_.name);
  for (std::size_t i = 0; i < image_.detections.size(); ++i) {
    if (add_detection(*frame, image_.detections[i])) continue;
    if (is_one_line_) error_.where = file_.wrong(image_.line, "").value().where + entry_text(static_cast<int>(i));
    return false;
  }
  return true;
}

bool AotHandler::add_detection(int frame, const Detection& detection) {
  for (const Field needed : {x_field, y_field, w_field, h_field})
    if (!detection.values[needed]) return fails(detection.line, std::string("has no ") + kFieldNames[needed]);
  const auto& values = detection.values;
  const std::optional<int> track = integer_of(values[track_field].value_or(kNoTrack));
  if (!track) return fails(detection.line, "track_id is no whole number");
  const double width = *values[w_field];
  const double height = *values[h_field];
  const Result<void> added = builder_.add(frame, {.box = {*values[x_field] - width / 2 - kEdgeFrom0,
                                                          *values[y_field] - height / 2 - kEdgeFrom0, width, height},
                                                  .score = values[score_field].value_or(1),
                                                  .track = *track < 0 ? kNoTrack : *track,
                                                  .line = detection.line});
  if (!added) error_ = added.error();
  return added.has_value();
}

}  // namespace

Result<Results> read_aot(const ResultsFile& file) {
  int line = 1;
  AotHandler handler(file, line);
  const char* begin = file.text.data();
  const char* end = begin + file.text.size();
  if (!nlohmann::json::sax_parse(CountingIterator(begin, &line), CountingIterator(end, &line), &handler))
    return fail(handler.error());
  return handler.results();
}

}  // namespace sigs
