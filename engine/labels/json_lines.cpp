// SPDX-License-Identifier: MIT

#include <cmath>
#include <string_view>
#include <utility>

#include "base/pose.h"
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
  [[nodiscard]] std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

JsonObject position_json(const glm::dvec3& position_m) {
  JsonObject object;
  object.add("x_m", position_m.x);
  object.add("y_m", position_m.y);
  object.add("z_m", position_m.z);
  return object;
}

JsonObject attitude_json(const Attitude& attitude) {
  JsonObject object;
  object.add("roll_deg", deg_of_rad(attitude.roll_rad));
  object.add("pitch_deg", deg_of_rad(attitude.pitch_rad));
  object.add("yaw_deg", deg_of_rad(attitude.yaw_rad));
  return object;
}

void add_place_json(JsonObject& object, const std::optional<GeodeticPosition>& place) {
  if (!place) return;
  JsonObject child;
  child.add("latitude_deg", place->latitude_deg, kLabelPlaceDecimals);
  child.add("longitude_deg", place->longitude_deg, kLabelPlaceDecimals);
  child.add("height_m", place->height_m);
  object.add("place", child);
}

JsonObject camera_object(const FrameTruth& truth) {
  JsonObject object;
  object.add("position", position_json(truth.camera_position_m));
  object.add("attitude", attitude_json(attitude_of(truth.world_from_camera)));
  const CameraTruth& camera = truth.camera;
  if (!camera.position_source.empty()) object.add_text("position_source", camera.position_source);
  if (!camera.attitude_source.empty()) object.add_text("attitude_source", camera.attitude_source);
  if (const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(camera)) {
    object.add("sd_x_deg", sd_deg->x);
    object.add("sd_y_deg", sd_deg->y);
    object.add("sd_z_deg", sd_deg->z);
  }
  add_place_json(object, camera.place);
  return object;
}

void add_boxes_json(JsonObject& object, const IntruderTruth& truth) {
  if (truth.visible_box) {
    JsonObject box;
    box.add("x", truth.visible_box->x);
    box.add("y", truth.visible_box->y);
    box.add("width", truth.visible_box->width);
    box.add("height", truth.visible_box->height);
    box.add("pixels", truth.visible_pixels);
    object.add("box", box);
  }
  if (truth.amodal_box) {
    JsonObject silhouette;
    silhouette.add("x", truth.amodal_box->x, kLabelPixelDecimals);
    silhouette.add("y", truth.amodal_box->y, kLabelPixelDecimals);
    silhouette.add("width", truth.amodal_box->width, kLabelPixelDecimals);
    silhouette.add("height", truth.amodal_box->height, kLabelPixelDecimals);
    object.add("silhouette", silhouette);
  }
}

void add_appearance_json(JsonObject& object, const IntruderTruth& truth) {
  if (!truth.detectability) return;
  JsonObject appearance;
  appearance.add("weber_contrast", truth.detectability->weber_contrast);
  appearance.add("rms_contrast", truth.detectability->rms_contrast);
  appearance.add("signal_to_noise", truth.detectability->signal_to_noise);
  appearance.add("blur_px", truth.image_formation.blur_px);
  appearance.add("motion_blur_px", truth.image_formation.motion_blur_px);
  if (truth.image_formation.visibility_m) appearance.add("visibility_m", *truth.image_formation.visibility_m);
  object.add("appearance", appearance);
}

void add_encounter_json(JsonObject& object, const IntruderTruth& truth) {
  if (!truth.encounter) return;
  const EncounterTruth& now = *truth.encounter;
  JsonObject encounter;
  encounter.add("range_rate_mps", now.range_rate_mps);
  encounter.add("closing_speed_mps", now.closing_speed_mps);
  encounter.add("bearing_deg", deg_of_rad(now.bearing_rad));
  encounter.add("elevation_deg", deg_of_rad(now.elevation_rad));
  encounter.add("hmd_m", now.hmd_m);
  encounter.add("vmd_m", now.vmd_m);
  encounter.add("time_to_closest_approach_s", now.time_to_closest_approach_s);
  encounter.add_if_finite("time_to_coaltitude_s", now.time_to_coaltitude_s);
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

std::string intruder_json(const IntruderTruth& truth, const LabelSequence& sequence) {
  JsonObject object;
  object.add("id", truth.id);
  object.add_text("name", truth.name);
  object.add_text("category", labelled_intruder(sequence, truth.id).category);
  if (truth.is_distractor) object.add_text("role", "distractor");
  object.add("in_picture", truth.in_image);
  object.add("visible_fraction", truth.visible_fraction);
  object.add_text("horizon", name_of(truth.horizon));
  object.add("position", position_json(truth.position_m));
  object.add("distance_m", glm::length(truth.position_m));
  object.add("attitude", attitude_json(attitude_of(truth.world_from_body)));
  add_place_json(object, truth.place);
  add_boxes_json(object, truth);
  add_appearance_json(object, truth);
  add_encounter_json(object, truth);
  return object.text();
}

class JsonLinesLabels : public LabelWriter {
 public:
  JsonLinesLabels(TextFile file, LabelSequence sequence) : file_(std::move(file)), sequence_(std::move(sequence)) {}
  Result<void> write(const FrameTruth& truth) override { return file_.put(json_line_of(truth, sequence_)); }
  Result<void> finish(const std::filesystem::path& /*images*/) override { return file_.close(); }

 private:
  TextFile file_;
  LabelSequence sequence_;
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
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  return std::make_unique<JsonLinesLabels>(std::move(*file), sequence);
}

}  // namespace sigs
