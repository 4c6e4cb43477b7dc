// SPDX-License-Identifier: MIT
// Results of the Airborne Object Tracking challenge: [{"img_name": ..., "detections": [{"x": ...}, ...]}, ...].
#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "evaluation/counting_iterator.h"
#include "evaluation/numbers.h"
#include "evaluation/results_layouts.h"

namespace sigs {

namespace {

enum Field { x_field, y_field, w_field, h_field, score_field, track_field, kFields };
constexpr const char* kFieldNames[kFields] = {"x", "y", "w", "h", "s", "track_id"};

struct Detection {
  std::optional<double> values[kFields];
  int line = 0;
};

// One element of the list: the detections may come before the picture's name.
struct Picture {
  std::optional<std::string> name;
  std::vector<Detection> detections;
  int line = 0;
};

// Told of one token after the other.
class AotHandler : public nlohmann::json_sax<nlohmann::json> {
 public:
  AotHandler(const ResultsFile& file, const int& line) : file_(file), line_(line), intake_(file) {}

  [[nodiscard]] Results taken() {
    Results results = intake_.taken();
    results.film = film_;
    return results;
  }
  [[nodiscard]] const Error& error() const { return error_; }

  bool null() override { return other_value("null"); }
  bool boolean(bool) override { return other_value("true or false"); }
  bool binary(binary_t&) override { return other_value("binary"); }
  bool number_integer(number_integer_t number) override { return take_number(static_cast<double>(number)); }
  bool number_unsigned(number_unsigned_t number) override { return take_number(static_cast<double>(number)); }
  bool number_float(number_float_t number, const string_t&) override { return take_number(number); }
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
  enum class Place { outside, list, picture, detections, detection };

  bool fails(int line, const std::string& what) {
    error_ = file_.wrong(line, what).value();
    if (is_one_line_) error_.where += entry_text(static_cast<int>(picture_.detections.size()) - 1);
    return false;
  }
  [[nodiscard]] std::optional<Field> field() const;
  bool take_number(double number);
  bool other_value(const char* what);
  bool take_picture();
  bool take_detection(int frame, const Detection& detection);

  // ", [17].detections[0]": where a line number tells nothing.
  [[nodiscard]] std::string entry_text(int detection) const {
    if (pictures_ == 0 || place_ == Place::list || place_ == Place::outside) return "";
    const std::string picture = ", [" + std::to_string(pictures_ - 1) + "]";
    return detection < 0 ? picture : picture + ".detections[" + std::to_string(detection) + "]";
  }

  const ResultsFile& file_;
  const int& line_;
  bool is_one_line_ = file_.text.find('\n') >= file_.text.find_last_not_of(" \r\n");
  int pictures_ = 0;
  std::string film_;
  ResultsIntake intake_;
  Error error_;
  Place place_ = Place::outside;
  int skipped_depth_ = 0;  // in how many objects and arrays of keys that are not read
  std::string key_;
  Picture picture_;
  std::map<int, int> line_of_frame_;
};

std::optional<Field> AotHandler::field() const {
  if (place_ != Place::detection || skipped_depth_ > 0) return std::nullopt;
  if (key_ == "object_id") return track_field;
  const auto found = std::ranges::find(kFieldNames, key_);
  if (found == std::end(kFieldNames)) return std::nullopt;
  return static_cast<Field>(found - std::begin(kFieldNames));
}

bool AotHandler::take_number(double number) {
  if (const std::optional<Field> at = field()) {
    picture_.detections.back().values[*at] = number;
    return true;
  }
  return other_value("a number");
}

bool AotHandler::other_value(const char* what) {
  if (skipped_depth_ > 0) return true;
  if (field()) return fails(line_, key_ + " is " + what + ", not a number");
  if (place_ == Place::picture && key_ == "img_name") return fails(line_, std::string("img_name is ") + what);
  if (place_ == Place::picture && key_ == "detections")
    return fails(line_, std::string("detections is ") + what + ", not a list");
  if (place_ == Place::picture || place_ == Place::detection) return true;
  return fails(line_,
               std::string("is ") + what +
                   "; results are [{\"img_name\": ..., \"detections\": [{...}]}, ...] (aot) or [{\"image_id\": ..., "
                   "\"bbox\": [x, y, w, h], \"score\": ...}, ...] (coco)");
}

bool AotHandler::string(string_t& text) {
  if (place_ == Place::picture && skipped_depth_ == 0 && key_ == "img_name") {
    picture_.name = text;
    return true;
  }
  return other_value("text");
}

bool AotHandler::start_object(std::size_t) {
  if (skipped_depth_ > 0 || (place_ == Place::picture && key_ != "detections") ||
      (place_ == Place::detection && !field())) {
    ++skipped_depth_;
    return true;
  }
  if (place_ == Place::list) {
    picture_ = {.line = line_};
    ++pictures_;
    place_ = Place::picture;
    key_.clear();
    return true;
  }
  if (place_ == Place::detections) {
    picture_.detections.push_back({.line = line_});
    place_ = Place::detection;
    key_.clear();
    return true;
  }
  return other_value("an object");
}

bool AotHandler::end_object() {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
    return true;
  }
  if (place_ == Place::detection) {
    place_ = Place::detections;
    return true;
  }
  const bool taken = take_picture();
  place_ = Place::list;
  return taken;
}

bool AotHandler::start_array(std::size_t) {
  if (place_ == Place::outside) {
    place_ = Place::list;
    return true;
  }
  if (place_ == Place::picture && skipped_depth_ == 0 && key_ == "detections") {
    place_ = Place::detections;
    return true;
  }
  if (!other_value("a list")) return false;
  ++skipped_depth_;
  return true;
}

bool AotHandler::end_array() {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
  } else {
    place_ = place_ == Place::detections ? Place::picture : Place::outside;
  }
  return true;
}

bool AotHandler::parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) {
  const std::size_t at = std::min(position > 0 ? position - 1 : 0, file_.text.size());
  return fails(line_at(file_.text, at), "is not JSON from here on" + (token.empty() ? "" : ", at " + in_quotes(token)));
}

bool AotHandler::take_picture() {
  if (!picture_.name) return fails(picture_.line, "has no img_name");
  const std::optional<int> frame = frame_of_picture(*picture_.name);
  if (!frame)
    return fails(picture_.line, "img_name " + in_quotes(*picture_.name) +
                                    " does not end with a frame number, as frame_000123.png does");
  const auto [there, is_first] = line_of_frame_.emplace(*frame, picture_.line);
  if (!is_first)
    return fails(picture_.line,
                 "frame " + std::to_string(*frame) + " a second time, first in line " + std::to_string(there->second));
  if (film_.empty()) film_ = folder_of_picture(*picture_.name);
  for (std::size_t i = 0; i < picture_.detections.size(); ++i) {
    if (take_detection(*frame, picture_.detections[i])) continue;
    if (is_one_line_) error_.where = file_.wrong(picture_.line, "").value().where + entry_text(static_cast<int>(i));
    return false;
  }
  return true;
}

bool AotHandler::take_detection(int frame, const Detection& detection) {
  for (const Field needed : {x_field, y_field, w_field, h_field})
    if (!detection.values[needed]) return fails(detection.line, std::string("has no ") + kFieldNames[needed]);
  const auto& values = detection.values;
  const std::optional<int> track = integer_of(values[track_field].value_or(kNoTrack));
  if (!track) return fails(detection.line, "track_id is no whole number");
  const double width = *values[w_field];
  const double height = *values[h_field];
  const Result<void> added = intake_.add(frame, {.box = {*values[x_field] - width / 2 - kEdgeFrom0,
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
  return handler.taken();
}

}  // namespace sigs
