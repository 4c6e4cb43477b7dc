// SPDX-License-Identifier: MIT
#include "labels/aot.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/text.h"
#include "labels/label_text.h"
#include "labels/text_file.h"

namespace sigs {

namespace {

constexpr int kDecimals = 6;

// A text as JSON has it, quotes and all; what is no UTF-8 becomes U+FFFD.
std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// "Airplane1": the category, its first letter large as in the data set, and the intruder's number from 1. A category
// that ends in a digit keeps apart from the number.
std::string object_id(const LabelledIntruder& intruder) {
  std::string name = line_name(intruder.category);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.front() >= 'a' && name.front() <= 'z') name.front() = static_cast<char>(name.front() - 'a' + 'A');
  return name + (is_digit(name.back()) ? "_" : "") + std::to_string(intruder.id + 1);
}

// The data set marks 0 where it is unclear.
int horizon_code(HorizonSide side) {
  if (side == HorizonSide::on || side == HorizonSide::unknown) return 0;
  return side == HorizonSide::above ? 1 : -1;
}

std::string metadata_text(const LabelSequence& sequence) {
  const FootageTruth& footage = sequence.footage;
  const double rate_hz = static_cast<double>(footage.frame_rate_num) / footage.frame_rate_den;
  const int frames = footage.last_frame - footage.first_frame + 1;
  return "{\"data_path\": " + json_text(sequence.images + "/") + ", \"fps\": " + number_text(rate_hz, kDecimals) +
         ", \"number_of_frames\": " + std::to_string(frames) +
         ", \"duration\": " + number_text(1000.0 * frames / rate_hz, kDecimals) +
         ", \"resolution\": {\"height\": " + std::to_string(footage.size_px.height) +
         ", \"width\": " + std::to_string(footage.size_px.width) + "}}";
}

class AotLabels : public LabelWriter {
 public:
  AotLabels(TextFile file, LabelSequence sequence) : file_(std::move(file)), sequence_(std::move(sequence)) {}

  Result<void> write(const FrameTruth& truth) override {
    std::string text;
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds)) text += entity(truth, &intruder);
    // A frame without objects stands there all the same: the metrics count the frames that were looked at.
    return file_.put(text.empty() ? entity(truth, nullptr) : text);
  }

  Result<void> finish(const std::filesystem::path&) override {
    if (const Result<void> end = file_.put("\n]}}}\n"); !end) return end;
    return file_.close();
  }

 private:
  [[nodiscard]] std::string entity(const FrameTruth& truth, const IntruderTruth* labelled) {
    const auto time_ns = static_cast<std::int64_t>(std::llround(truth.time_s * 1e9));
    std::string text = is_first_ ? "\n" : ",\n";
    is_first_ = false;
    text += "{\"time\": " + std::to_string(time_ns) + ", \"blob\": {\"frame\": " + std::to_string(truth.index);
    if (labelled != nullptr)
      text += ", \"range_distance_m\": " + number_text(glm::length(labelled->position_m), kDecimals) +
              "}, \"id\": " + json_text(object_id(labelled_intruder(sequence_, labelled->id))) + ", \"bb\": [" +
              joined({labelled->visible_box->x, labelled->visible_box->y, labelled->visible_box->width,
                      labelled->visible_box->height},
                     ", ") +
              "], \"labels\": {\"is_above_horizon\": " + std::to_string(horizon_code(labelled->horizon)) + "}";
    else
      text += "}, \"labels\": {}";
    return text + ", \"flight_id\": " + json_text(sequence_.name) +
           ", \"img_name\": " + json_text(sequence_.images + "/" + image_name(truth.index)) + "}";
  }

  TextFile file_;
  LabelSequence sequence_;
  bool is_first_ = true;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_aot(const std::filesystem::path& path, const LabelSequence& sequence) {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  const std::string head = "{\"metadata\": {\"description\": \"made with SIGS\"},\n\"samples\": {" +
                           json_text(sequence.name) + ": {\"metadata\": " + metadata_text(sequence) +
                           ",\n\"entities\": [";
  if (const Result<void> put = file->put(head); !put) return fail(put.error());
  return std::make_unique<AotLabels>(std::move(*file), sequence);
}

}  // namespace sigs
