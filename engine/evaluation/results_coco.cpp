// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cstdint>
#include <vector>

#include "evaluation/results_json.h"
#include "evaluation/text_parsing.h"

namespace sigs {

namespace {

constexpr std::size_t kMaxNumbers = 5;  // kept of a bbox: one more than it may have is enough to report that

// One box of the list. image_id: a number of COCO's images, or the name of the image (as Ultralytics writes it).
struct CocoEntry {
  std::optional<double> image_id;
  std::optional<std::string> image_name;
  std::optional<std::vector<double>> box;
  double score = 1;
  double track = kNoTrack;
  int line = 0;
};

// Results as COCO's evaluation takes them:
// [{"image_id": 1, "category_id": 1, "bbox": [x, y, w, h], "score": 0.9}, ...].
class CocoReader : public JsonListReader {
 public:
  explicit CocoReader(const ResultsFile& results) : JsonListReader(results, results.options.first_image_id) {}

 private:
  enum class State { outside, list, entry, box };

  bool on_number(double number) override;
  bool on_text(const std::string& text) override;
  bool starts_object() override;
  bool starts_list() override;
  bool on_object_end() override;
  void on_list_end() override { state_ = state_ == State::box ? State::entry : State::outside; }
  [[nodiscard]] bool skips_object() const override { return state_ == State::entry && !is_read(); }
  bool unexpected_value(const char* what) override;
  [[nodiscard]] std::string place_in_list() const override {
    return entries_ > 0 ? fmt::format(", [{}]", entries_ - 1) : "";
  }

  [[nodiscard]] bool is_read() const {
    return key() == "image_id" || key() == "bbox" || key() == "score" || key() == "track_id";
  }
  bool add_entry();
  [[nodiscard]] std::optional<int> frame_of_entry();

  State state_ = State::outside;
  int entries_ = 0;  // begun so far
  CocoEntry entry_;
};

bool CocoReader::on_number(double number) {
  if (state_ == State::box) {
    if (entry_.box->size() < kMaxNumbers) entry_.box->push_back(number);
    return true;
  }
  if (state_ != State::entry) return unexpected_value("a number");
  if (key() == "image_id") entry_.image_id = number;
  if (key() == "score") entry_.score = number;
  if (key() == "track_id") entry_.track = number;
  return key() != "bbox" || unexpected_value("a number");
}

bool CocoReader::on_text(const std::string& text) {
  if (state_ != State::entry || key() != "image_id") return unexpected_value("text");
  entry_.image_name = text;
  return true;
}

bool CocoReader::unexpected_value(const char* what) {
  if (state_ == State::box) return fails(line(), fmt::format("bbox holds {}, not a number", what));
  if (state_ == State::entry) {
    if (!is_read()) return true;
    return fails(line(), fmt::format("{} is {}{}", key(), what,
                                     key() == "bbox" ? ", not a list of 4 numbers" : ", not a number"));
  }
  return fails(line(), std::string("is ") + what +
                           "; coco results are [{\"image_id\": ..., \"bbox\": [x, y, w, h], \"score\": ...}, ...]");
}

bool CocoReader::starts_object() {
  if (state_ != State::list) return false;
  entry_ = {.line = line()};
  ++entries_;
  state_ = State::entry;
  return true;
}

bool CocoReader::starts_list() {
  if (state_ == State::outside) {
    state_ = State::list;
    return true;
  }
  if (state_ != State::entry || key() != "bbox") return false;
  entry_.box.emplace();
  state_ = State::box;
  return true;
}

bool CocoReader::on_object_end() {
  state_ = State::list;
  return add_entry();
}

// The footage's number of the entry's frame; nullopt after fails(), and for an image that the truth does not have.
std::optional<int> CocoReader::frame_of_entry() {
  if (entry_.image_name) {
    const std::optional<int> frame = frame_named(*entry_.image_name);
    if (!frame && file().options.images != nullptr) return std::nullopt;
    if (!frame)
      fails(entry_.line,
            fmt::format("image_id {} is neither a number nor an image's name that ends with one, as frame_000123",
                        in_quotes(*entry_.image_name)));
    set_clip_of_image(*entry_.image_name);
    return frame;
  }
  const std::optional<int> id = integer_of(*entry_.image_id);
  const FramesOfImages* const images = file().options.images;
  if (id && images != nullptr && !images->by_id.empty()) {
    const auto found = images->by_id.find(*id);
    return found == images->by_id.end() ? std::nullopt : std::optional(found->second);
  }
  if (!id || *id < 1) {
    fails(entry_.line, "image_id is not a whole number from 1; 1 is the clip's first frame");
    return std::nullopt;
  }
  const ResultsOptions& options = file().options;
  if (options.last_image_id && *id > *options.last_image_id) {
    fails(entry_.line, fmt::format("image_id {} is past the last one, {}", *id, *options.last_image_id));
    return std::nullopt;
  }
  const std::int64_t frame = std::int64_t{file().clip.first_frame} + *id - options.first_image_id;
  return static_cast<int>(std::clamp<std::int64_t>(frame, INT_MIN, INT_MAX));
}

bool CocoReader::add_entry() {
  if (!entry_.image_id && !entry_.image_name) return fails(entry_.line, "has no image_id");
  if (!entry_.box) return fails(entry_.line, "has no bbox");
  if (entry_.box->size() != 4) return fails(entry_.line, "bbox is not a list of 4 numbers: left, top, width, height");
  const std::optional<int> frame = frame_of_entry();
  if (!frame && has_failed()) return false;
  if (!frame) {
    leave_out(1);
    return true;
  }
  const FootageTruth& clip = file().clip;
  if (file().options.last_image_id && (*frame < clip.first_frame || *frame > clip.last_frame)) return true;
  // COCO's origin is the upper left corner of the first pixel.
  const std::vector<double>& box = *entry_.box;
  return add_box(*frame, {box[0] - kEdgeFrom0, box[1] - kEdgeFrom0, box[2], box[3]}, entry_.score, entry_.track,
                 entry_.line);
}

}  // namespace

Result<Results> read_coco(const ResultsFile& file) {
  return CocoReader(file).read();
}

}  // namespace sigs
