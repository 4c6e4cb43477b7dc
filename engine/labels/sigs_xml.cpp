// SPDX-License-Identifier: MIT

#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "base/pose.h"
#include "base/text.h"
#include "labels/formats.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

void set(pugi::xml_node node, const char* name, double number, int decimals = kLabelDecimals) {
  node.append_attribute(name) = number_text(number, decimals).c_str();
}

void set_position(pugi::xml_node node, const glm::dvec3& position_m) {
  set(node, "x_m", position_m.x);
  set(node, "y_m", position_m.y);
  set(node, "z_m", position_m.z);
}

void set_attitude(pugi::xml_node node, const Attitude& attitude) {
  set(node, "roll_deg", deg_of_rad(attitude.roll_rad));
  set(node, "pitch_deg", deg_of_rad(attitude.pitch_rad));
  set(node, "yaw_deg", deg_of_rad(attitude.yaw_rad));
}

void add_place(pugi::xml_node node, const std::optional<GeodeticPosition>& place) {
  if (!place) return;
  pugi::xml_node child = node.append_child("place");
  set(child, "latitude_deg", place->latitude_deg, kLabelPlaceDecimals);
  set(child, "longitude_deg", place->longitude_deg, kLabelPlaceDecimals);
  set(child, "height_m", place->height_m);
}

void add_source(pugi::xml_node node, const CameraTruth& camera) {
  if (!camera.position_source.empty())
    node.append_attribute("position_source") = xml_text(camera.position_source).c_str();
  if (!camera.attitude_source.empty())
    node.append_attribute("attitude_source") = xml_text(camera.attitude_source).c_str();
  if (const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(camera)) {
    set(node, "sd_x_deg", sd_deg->x);
    set(node, "sd_y_deg", sd_deg->y);
    set(node, "sd_z_deg", sd_deg->z);
  }
  add_place(node, camera.place);
}

void add_box_elements(pugi::xml_node node, const IntruderTruth& truth) {
  if (truth.visible_box) {
    pugi::xml_node box = node.append_child("box");
    box.append_attribute("x") = truth.visible_box->x;
    box.append_attribute("y") = truth.visible_box->y;
    box.append_attribute("width") = truth.visible_box->width;
    box.append_attribute("height") = truth.visible_box->height;
    box.append_attribute("pixels") = truth.visible_pixels;
  }
  if (truth.amodal_box) {
    pugi::xml_node silhouette = node.append_child("silhouette");
    set(silhouette, "x", truth.amodal_box->x, kLabelPixelDecimals);
    set(silhouette, "y", truth.amodal_box->y, kLabelPixelDecimals);
    set(silhouette, "width", truth.amodal_box->width, kLabelPixelDecimals);
    set(silhouette, "height", truth.amodal_box->height, kLabelPixelDecimals);
  }
}

void add_appearance(pugi::xml_node node, const IntruderTruth& truth) {
  if (!truth.detectability) return;
  pugi::xml_node appearance = node.append_child("appearance");
  set(appearance, "weber_contrast", truth.detectability->weber_contrast);
  set(appearance, "rms_contrast", truth.detectability->rms_contrast);
  set(appearance, "signal_to_noise", truth.detectability->signal_to_noise);
  set(appearance, "blur_px", truth.image_formation.blur_px);
  set(appearance, "motion_blur_px", truth.image_formation.motion_blur_px);
  if (truth.image_formation.visibility_m) set(appearance, "visibility_m", *truth.image_formation.visibility_m);
}

// A number that is infinite does not come: it is left out.
void set_if_finite(pugi::xml_node node, const char* name, double number) {
  if (std::isfinite(number)) set(node, name, number);
}

void add_encounter(pugi::xml_node node, const IntruderTruth& truth) {
  if (!truth.encounter) return;
  const EncounterTruth& now = *truth.encounter;
  pugi::xml_node encounter = node.append_child("encounter");
  set(encounter, "range_rate_mps", now.range_rate_mps);
  set(encounter, "closing_speed_mps", now.closing_speed_mps);
  set(encounter, "bearing_deg", deg_of_rad(now.bearing_rad));
  set(encounter, "elevation_deg", deg_of_rad(now.elevation_rad));
  set(encounter, "hmd_m", now.hmd_m);
  set(encounter, "vmd_m", now.vmd_m);
  set(encounter, "time_to_closest_approach_s", now.time_to_closest_approach_s);
  set_if_finite(encounter, "time_to_coaltitude_s", now.time_to_coaltitude_s);
  for (const WellClearTruth& volume : now.of_volumes) {
    pugi::xml_node well_clear = encounter.append_child("well_clear");
    well_clear.append_attribute("volume") = xml_text(volume.volume).c_str();
    well_clear.append_attribute("lost") = volume.is_lost;
    set_if_finite(well_clear, "tau_mod_s", volume.tau_mod_s);
    set(well_clear, "severity", volume.severity);
  }
}

void add_intruder(pugi::xml_node frame, const IntruderTruth& truth) {
  pugi::xml_node node = frame.append_child("intruder");
  node.append_attribute("id") = truth.id;
  node.append_attribute("name") = xml_text(truth.name).c_str();
  if (truth.is_distractor) node.append_attribute("role") = "distractor";
  node.append_attribute("in_picture") = truth.in_image;
  set(node, "visible_fraction", truth.visible_fraction);
  node.append_attribute("horizon") = name_of(truth.horizon).data();
  set_position(node.append_child("position"), truth.position_m);
  set(node.append_child("distance"), "m", glm::length(truth.position_m));
  set_attitude(node.append_child("attitude"), attitude_of(truth.world_from_body));
  add_place(node, truth.place);
  add_box_elements(node, truth);
  add_appearance(node, truth);
  add_encounter(node, truth);
}

// The declaration, the opening tag of the document and its element "footage".
std::string sigs_head(const FootageTruth& footage) {
  pugi::xml_document document;
  pugi::xml_node node = document.append_child("footage");
  node.append_attribute("video") = xml_text(footage.video).c_str();
  node.append_attribute("width") = footage.size_px.width;
  node.append_attribute("height") = footage.size_px.height;
  node.append_attribute("first_frame") = footage.first_frame;
  node.append_attribute("last_frame") = footage.last_frame;
  node.append_attribute("frame_rate") = rate_text(footage).c_str();
  std::ostringstream text;
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<sigs version=\"1\">\n";
  node.print(text, "  ", pugi::format_default, pugi::encoding_utf8, 1);
  return text.str();
}

}  // namespace

std::string xml_of(const FrameTruth& truth) {
  pugi::xml_document document;
  pugi::xml_node frame = document.append_child("frame");
  frame.append_attribute("index") = truth.index;
  set(frame, "time_s", truth.time_s);
  if (truth.substituted) frame.append_attribute("substituted") = true;
  pugi::xml_node camera = frame.append_child("camera");
  set_position(camera, truth.camera_position_m);
  set_attitude(camera, attitude_of(truth.world_from_camera));
  add_source(camera, truth.camera);
  for (const IntruderTruth& intruder : truth.intruders) add_intruder(frame, intruder);
  std::ostringstream text;
  frame.print(text, "  ", pugi::format_default, pugi::encoding_utf8, 1);
  return text.str();
}

Result<SigsXmlWriter> SigsXmlWriter::open(const std::filesystem::path& path, const FootageTruth& footage) {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  if (const Result<void> head = file->put(sigs_head(footage)); !head) return fail(head.error());
  return SigsXmlWriter(std::move(*file));
}

Result<void> SigsXmlWriter::write(const FrameTruth& truth) {
  return file_.put(xml_of(truth));
}

Result<void> SigsXmlWriter::finish() {
  if (const Result<void> end = file_.put("</sigs>\n"); !end) return end;
  return file_.close();
}

namespace {

class SigsXmlLabels : public LabelWriter {
 public:
  explicit SigsXmlLabels(SigsXmlWriter writer) : writer_(std::move(writer)) {}
  Result<void> write(const FrameTruth& truth) override { return writer_.write(truth); }
  Result<void> finish(const std::filesystem::path&) override { return writer_.finish(); }

 private:
  SigsXmlWriter writer_;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_sigs_xml(const std::filesystem::path& path, const LabelSequence& sequence) {
  Result<SigsXmlWriter> writer = SigsXmlWriter::open(path, sequence.footage);
  if (!writer) return fail(writer.error());
  return std::make_unique<SigsXmlLabels>(std::move(*writer));
}

}  // namespace sigs
