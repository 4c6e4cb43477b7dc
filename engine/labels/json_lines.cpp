// SPDX-License-Identifier: MIT

#include <cmath>
#include <string_view>
#include <utility>

#include "base/text.h"
#include "labels/formats.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

// An object of JSON, member by member. Numbers have the digits of the XML file's.
class JsonObject {
 public:
  void add(std::string_view key, const std::string& json) {
    text_ += (text_.empty() ? "\"" : ",\"");
    text_.append(key).append("\":").append(json);
  }
  void add(std::string_view key, const JsonObject& object) { add(key, object.text()); }
  void add(std::string_view key, double number, int decimals = kLabelDecimals) {
    add(key, number_text(number, decimals));
  }
  void add(std::string_view key, int number) { add(key, std::to_string(number)); }
  void add(std::string_view key, bool is_true) { add(key, std::string(is_true ? "true" : "false")); }
  void add_text(std::string_view key, std::string_view text) { add(key, json_string(xml_text(text))); }
  void add_if_finite(std::string_view key, double number) {
    if (std::isfinite(number)) add(key, number);
  }
  void add(const LabelNumbers& numbers) {
    for (const LabelNumber& number : numbers) add(number.name, number.value, number.decimals);
  }
  [[nodiscard]] std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

JsonObject numbers_json(const LabelNumbers& numbers) {
  JsonObject object;
  object.add(numbers);
  return object;
}

void add_numbers_json(JsonObject& object, std::string_view key, const LabelNumbers& numbers) {
  if (!numbers.empty()) object.add(key, numbers_json(numbers));
}

void add_place_json(JsonObject& object, const std::optional<GeodeticPosition>& place) {
  if (place) object.add("place", numbers_json(place_numbers(*place)));
}

JsonObject camera_object(const FrameTruth& truth) {
  JsonObject object;
  object.add("position", numbers_json(position_numbers(truth.camera_position_m)));
  object.add("attitude", numbers_json(attitude_numbers(truth.world_from_camera)));
  const CameraTruth& camera = truth.camera;
  if (!camera.position_source.empty()) object.add_text("position_source", camera.position_source);
  if (!camera.attitude_source.empty()) object.add_text("attitude_source", camera.attitude_source);
  object.add(deviation_numbers(camera));
  add_place_json(object, camera.place);
  return object;
}

void add_encounter_json(JsonObject& object, const IntruderTruth& truth) {
  if (!truth.encounter) return;
  const EncounterTruth& now = *truth.encounter;
  JsonObject encounter;
  for (const LabelNumber& number : encounter_numbers(now)) encounter.add_if_finite(number.name, number.value);
  std::vector<std::string> volumes;
  for (const WellClearTruth& volume : now.of_volumes) {
    JsonObject well_clear;
    well_clear.add_text("volume", volume.volume);
    well_clear.add("lost", volume.is_lost);
    well_clear.add_if_finite("tau_mod_s", volume.tau_mod_s);
    well_clear.add("severity", volume.severity);
    volumes.push_back(well_clear.text());
  }
  encounter.add("well_clear", "[" + listed(volumes, ",") + "]");
  object.add("encounter", encounter);
}

void add_lights_json(JsonObject& object, const IntruderTruth& truth) {
  std::vector<std::string> lights;
  for (const LampTruth& lamp : truth.lights) {
    JsonObject light;
    light.add_text("name", lamp.name);
    light.add(light_numbers(lamp));
    lights.push_back(light.text());
  }
  if (!lights.empty()) object.add("lights", "[" + listed(lights, ",") + "]");
}

std::string intruder_json(const IntruderTruth& truth, const LabelSequence& sequence) {
  JsonObject object;
  object.add("id", truth.id);
  object.add_text("name", truth.name);
  object.add_text("category", labelled_intruder(sequence, truth.id).category);
  if (truth.is_distractor) object.add_text("role", "distractor");
  if (truth.lights_alone) object.add("lights_alone", true);
  if (truth.has_contrail) object.add("contrail", true);
  if (truth.has_shadow) object.add("shadow", true);
  object.add("in_picture", truth.in_image);
  object.add("visible_fraction", truth.visible_fraction);
  object.add_text("horizon", name_of(truth.horizon));
  object.add("position", numbers_json(position_numbers(truth.position_m)));
  object.add("distance_m", glm::length(truth.position_m));
  object.add("attitude", numbers_json(attitude_numbers(truth.world_from_body)));
  add_place_json(object, truth.place);
  add_numbers_json(object, "box", box_numbers(truth));
  add_numbers_json(object, "other_box", other_box_numbers(truth));
  add_numbers_json(object, "silhouette", silhouette_numbers(truth));
  add_numbers_json(object, "appearance", appearance_numbers(truth));
  add_lights_json(object, truth);
  add_numbers_json(object, "clouds", cloud_numbers(truth));
  add_encounter_json(object, truth);
  return object.text();
}

class JsonLinesLabels : public OneFileLabels {
 public:
  using OneFileLabels::OneFileLabels;

  Result<void> write(const FrameTruth& truth) override { return file_.put(json_line_of(truth, sequence_)); }
};

}  // namespace

std::string json_line_of(const FrameTruth& truth, const LabelSequence& sequence) {
  JsonObject object;
  object.add("index", truth.index);
  object.add("time_s", truth.time_s);
  object.add("width", sequence.footage.size_px.width);
  object.add("height", sequence.footage.size_px.height);
  if (truth.substituted) object.add("substituted", true);
  object.add("camera", camera_object(truth));
  std::vector<std::string> intruders;
  for (const IntruderTruth& intruder : truth.intruders) intruders.push_back(intruder_json(intruder, sequence));
  object.add("intruders", "[" + listed(intruders, ",") + "]");
  return object.text() + "\n";
}

Result<std::unique_ptr<LabelWriter>> open_jsonl(const std::filesystem::path& path, const LabelSequence& sequence) {
  return begun_file<JsonLinesLabels>(path, sequence);
}

}  // namespace sigs
