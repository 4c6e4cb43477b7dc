// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "evaluation/results_json.h"
#include "evaluation/text_parsing.h"

namespace sigs {

namespace {

enum AotField { x_field, y_field, w_field, h_field, score_field, track_field, kAotFields };
constexpr const char* kAotFieldNames[kAotFields] = {"x", "y", "w", "h", "s", "track_id"};

struct AotDetection {
  std::optional<double> values[kAotFields];
  int line = 0;
};

// One entry of the list. Its boxes are added at its end, since the detections may come before the image's name.
struct AotImage {
  std::optional<std::string> name;
  std::vector<AotDetection> detections;
  std::optional<int> checked;  // position of the detection that is being added
  int line = 0;
};

// Results of the Airborne Object Tracking challenge:
// [{"img_name": ..., "detections": [{"x": ..., "y": ..., "w": ..., "h": ..., "s": ...}, ...]}, ...].
class AotReader : public JsonListReader {
 public:
  explicit AotReader(const ResultsFile& results) : JsonListReader(results, results.clip.first_frame) {}

 private:
  enum class State { outside, list, image, detections, detection };

  bool on_number(double number) override;
  bool on_text(const std::string& text) override;
  bool starts_object() override;
  bool starts_list() override;
  bool on_object_end() override;
  void on_list_end() override { state_ = state_ == State::detections ? State::image : State::outside; }
  [[nodiscard]] bool skips_object() const override {
    return (state_ == State::image && key() != "detections") || (state_ == State::detection && !field());
  }
  bool unexpected_value(const char* what) override;
  [[nodiscard]] std::string place_in_list() const override;

  [[nodiscard]] std::optional<AotField> field() const;
  bool add_image();
  bool add_detection(int frame, const AotDetection& detection);

  State state_ = State::outside;
  int images_ = 0;  // begun so far
  AotImage image_;
  std::map<int, int> line_of_frame_;
};

// ", [17].detections[0]"
std::string AotReader::place_in_list() const {
  if (images_ == 0 || state_ == State::list || state_ == State::outside) return "";
  const std::string image = fmt::format(", [{}]", images_ - 1);
  const int detection = image_.checked.value_or(static_cast<int>(image_.detections.size()) - 1);
  return detection < 0 ? image : fmt::format("{}.detections[{}]", image, detection);
}

std::optional<AotField> AotReader::field() const {
  if (state_ != State::detection) return std::nullopt;
  if (key() == "object_id") return track_field;
  const auto found = std::ranges::find(kAotFieldNames, key());
  if (found == std::end(kAotFieldNames)) return std::nullopt;
  return static_cast<AotField>(found - std::begin(kAotFieldNames));
}

bool AotReader::on_number(double number) {
  const std::optional<AotField> at = field();
  if (!at) return unexpected_value("a number");
  image_.detections.back().values[*at] = number;
  return true;
}

bool AotReader::on_text(const std::string& text) {
  if (state_ != State::image || key() != "img_name") return unexpected_value("text");
  image_.name = text;
  return true;
}

bool AotReader::unexpected_value(const char* what) {
  if (field()) return fails(line(), fmt::format("{} is {}, not a number", key(), what));
  if (state_ == State::image && key() == "img_name") return fails(line(), std::string("img_name is ") + what);
  if (state_ == State::image && key() == "detections")
    return fails(line(), fmt::format("detections is {}, not a list", what));
  if (state_ == State::image || state_ == State::detection) return true;
  return fails(line(),
               std::string("is ") + what +
                   "; results are [{\"img_name\": ..., \"detections\": [{...}]}, ...] (aot) or [{\"image_id\": ..., "
                   "\"bbox\": [x, y, w, h], \"score\": ...}, ...] (coco)");
}

bool AotReader::starts_object() {
  if (state_ == State::list) {
    image_ = {.line = line()};
    ++images_;
    state_ = State::image;
    return true;
  }
  if (state_ != State::detections) return false;
  image_.detections.push_back({.line = line()});
  state_ = State::detection;
  return true;
}

bool AotReader::starts_list() {
  if (state_ == State::outside) {
    state_ = State::list;
    return true;
  }
  if (state_ != State::image || key() != "detections") return false;
  state_ = State::detections;
  return true;
}

bool AotReader::on_object_end() {
  if (state_ == State::detection) {
    state_ = State::detections;
    return true;
  }
  const bool is_added = add_image();
  state_ = State::list;
  return is_added;
}

bool AotReader::add_image() {
  if (!image_.name) return fails(image_.line, "has no img_name");
  const std::optional<int> frame = frame_named(*image_.name);
  if (!frame && file().options.images != nullptr) {
    leave_out(static_cast<int>(image_.detections.size()));
    return true;
  }
  if (!frame)
    return fails(image_.line, fmt::format("img_name {} does not end with a frame number, as frame_000123.png does",
                                          in_quotes(*image_.name)));
  const auto [there, is_first] = line_of_frame_.emplace(*frame, image_.line);
  if (!is_first)
    return fails(image_.line, fmt::format("frame {} a second time, first in line {}", *frame, there->second));
  set_clip_of_image(*image_.name);
  for (std::size_t i = 0; i < image_.detections.size(); ++i) {
    image_.checked = static_cast<int>(i);
    if (!add_detection(*frame, image_.detections[i])) return false;
  }
  return true;
}

bool AotReader::add_detection(int frame, const AotDetection& detection) {
  for (const AotField needed : {x_field, y_field, w_field, h_field})
    if (!detection.values[needed]) return fails(detection.line, std::string("has no ") + kAotFieldNames[needed]);
  const auto& values = detection.values;
  const double width = *values[w_field];
  const double height = *values[h_field];
  // x and y are the centre of the box; the origin is the upper left corner of the first pixel.
  const Box box{*values[x_field] - width / 2 - kEdgeFrom0, *values[y_field] - height / 2 - kEdgeFrom0, width, height};
  return add_box(frame, box, values[score_field].value_or(1), values[track_field].value_or(kNoTrack), detection.line);
}

}  // namespace

Result<Results> read_aot(const ResultsFile& file) {
  return AotReader(file).read();
}

}  // namespace sigs
