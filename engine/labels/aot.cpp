// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "base/text.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

// "Airplane1": the category with a capital letter, as in the data set, and the intruder's number from 1, with an
// underscore between them where the category ends in a digit.
std::string object_id(const LabelledIntruder& intruder) {
  std::string name = line_name(intruder.category);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.front() >= 'a' && name.front() <= 'z') name.front() = static_cast<char>(name.front() - 'a' + 'A');
  return fmt::format("{}{}{}", name, is_digit(name.back()) ? "_" : "", intruder.id + 1);
}

// The data set has 0 where it is not clear.
int horizon_code(HorizonSide side) {
  if (side == HorizonSide::on || side == HorizonSide::unknown) return 0;
  return side == HorizonSide::above ? 1 : -1;
}

std::string metadata_text(const LabelSequence& sequence) {
  const FootageTruth& footage = sequence.footage;
  const int frames = frame_count(footage);
  return fmt::format(R"({{"data_path": {}, "fps": {}, "number_of_frames": {}, "duration": {}, )"
                     R"("resolution": {{"height": {}, "width": {}}}}})",
                     json_string(sequence.images + "/"), number_text(rate_hz(footage), kLabelDecimals), frames,
                     number_text(1000.0 * frames / rate_hz(footage), kLabelDecimals), footage.size_px.height,
                     footage.size_px.width);
}

class AotLabels : public OneFileLabels {
 public:
  using OneFileLabels::OneFileLabels;

  Result<void> begin() override {
    return file_.put("{\"metadata\": {\"description\": \"made with SIGS\"},\n\"samples\": {" +
                     json_string(sequence_.name) + ": {\"metadata\": " + metadata_text(sequence_) +
                     ",\n\"entities\": [");
  }

  Result<void> write(const FrameTruth& truth) override {
    std::string text;
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds)) text += entity(truth, &intruder);
    // A frame without objects has an entity too: the metrics count the frames that were examined.
    return file_.put(text.empty() ? entity(truth, nullptr) : text);
  }

  Result<void> finish(const std::filesystem::path&) override {
    if (const Result<void> end = file_.put("\n]}}}\n"); !end) return end;
    return file_.close();
  }

 private:
  // nullptr: the frame has no object.
  [[nodiscard]] std::string entity(const FrameTruth& truth, const IntruderTruth* labelled) {
    const auto time_ns = static_cast<std::int64_t>(std::llround(truth.time_s * 1e9));
    const char* const separator = is_first_ ? "\n" : ",\n";
    is_first_ = false;
    const std::string camera = has_source(truth.camera) ? ", \"camera\": " + camera_json(truth) : "";
    return fmt::format(R"({}{{"time": {}, "blob": {{"frame": {}{}{}, "flight_id": {}, "img_name": {}}})", separator,
                       time_ns, truth.index, camera, labelled == nullptr ? "}, \"labels\": {}" : object_text(*labelled),
                       json_string(sequence_.name),
                       json_string(sequence_.images + "/" + image_name(truth.index, sequence_.image_extension)));
  }

  // The rest of "blob", and what else an entity has that is an object.
  [[nodiscard]] std::string object_text(const IntruderTruth& labelled) const {
    const cv::Rect& box = *labelled.visible_box;
    // In the data set what is no aircraft of an encounter, such as a bird, has no range.
    const std::string range =
        labelled.is_distractor
            ? ""
            : fmt::format(R"(, "range_distance_m": {})", number_text(glm::length(labelled.position_m), kLabelDecimals));
    return fmt::format(R"({}}}, "id": {}, "bb": [{}, {}, {}, {}], "labels": {{"is_above_horizon": {}}})", range,
                       json_string(object_id(labelled_intruder(sequence_, labelled.id))), box.x, box.y, box.width,
                       box.height, horizon_code(labelled.horizon));
  }

  bool is_first_ = true;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_aot(const std::filesystem::path& path, const LabelSequence& sequence) {
  return begun_file<AotLabels>(path, sequence);
}

}  // namespace sigs
