// SPDX-License-Identifier: MIT

#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "base/text.h"
#include "labels/formats.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

void set(pugi::xml_node node, const char* name, double number, int decimals = kLabelDecimals) {
  node.append_attribute(name) = number_text(number, decimals).c_str();
}

void set_all(pugi::xml_node node, const LabelNumbers& numbers) {
  for (const LabelNumber& number : numbers) set(node, number.name, number.value, number.decimals);
}

// Without numbers there is no element.
void add_numbers(pugi::xml_node node, const char* name, const LabelNumbers& numbers) {
  if (!numbers.empty()) set_all(node.append_child(name), numbers);
}

void add_source(pugi::xml_node node, const CameraTruth& camera) {
  if (!camera.position_source.empty())
    node.append_attribute("position_source") = xml_text(camera.position_source).c_str();
  if (!camera.attitude_source.empty())
    node.append_attribute("attitude_source") = xml_text(camera.attitude_source).c_str();
  set_all(node, deviation_numbers(camera));
  if (camera.place) add_numbers(node, "place", place_numbers(*camera.place));
}

// A number that is infinite does not come: it is left out.
void set_if_finite(pugi::xml_node node, const char* name, double number) {
  if (std::isfinite(number)) set(node, name, number);
}

void add_encounter(pugi::xml_node node, const IntruderTruth& truth) {
  if (!truth.encounter) return;
  const EncounterTruth& now = *truth.encounter;
  pugi::xml_node encounter = node.append_child("encounter");
  for (const LabelNumber& number : encounter_numbers(now)) set_if_finite(encounter, number.name, number.value);
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
  if (truth.lights_alone) node.append_attribute("lights_alone") = true;
  if (truth.has_contrail) node.append_attribute("contrail") = true;
  if (truth.has_shadow) node.append_attribute("shadow") = true;
  node.append_attribute("in_picture") = truth.in_image;
  set(node, "visible_fraction", truth.visible_fraction);
  node.append_attribute("horizon") = name_of(truth.horizon).data();
  add_numbers(node, "position", position_numbers(truth.position_m));
  set(node.append_child("distance"), "m", glm::length(truth.position_m));
  add_numbers(node, "attitude", attitude_numbers(truth.world_from_body));
  if (truth.place) add_numbers(node, "place", place_numbers(*truth.place));
  add_numbers(node, "box", box_numbers(truth));
  add_numbers(node, "other_box", other_box_numbers(truth));
  add_numbers(node, "silhouette", silhouette_numbers(truth));
  add_numbers(node, "appearance", appearance_numbers(truth));
  for (const LampTruth& lamp : truth.lights) {
    pugi::xml_node light = node.append_child("light");
    light.append_attribute("name") = lamp.name.c_str();
    set_all(light, light_numbers(lamp));
  }
  add_numbers(node, "clouds", cloud_numbers(truth));
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

class SigsXmlLabels : public OneFileLabels {
 public:
  using OneFileLabels::OneFileLabels;

  Result<void> begin() override { return file_.put(sigs_head(sequence_.footage)); }
  Result<void> write(const FrameTruth& truth) override { return file_.put(xml_of(truth)); }
  Result<void> finish(const std::filesystem::path&) override {
    const Result<void> end = file_.put("</sigs>\n");
    return end ? file_.close() : end;
  }
};

}  // namespace

std::string xml_of(const FrameTruth& truth) {
  pugi::xml_document document;
  pugi::xml_node frame = document.append_child("frame");
  frame.append_attribute("index") = truth.index;
  set(frame, "time_s", truth.time_s);
  if (truth.substituted) frame.append_attribute("substituted") = true;
  pugi::xml_node camera = frame.append_child("camera");
  set_all(camera, position_numbers(truth.camera_position_m));
  set_all(camera, attitude_numbers(truth.world_from_camera));
  add_source(camera, truth.camera);
  for (const IntruderTruth& intruder : truth.intruders) add_intruder(frame, intruder);
  std::ostringstream text;
  frame.print(text, "  ", pugi::format_default, pugi::encoding_utf8, 1);
  return text.str();
}

Result<std::unique_ptr<LabelWriter>> open_sigs_xml(const std::filesystem::path& path, const LabelSequence& sequence) {
  return begun_file<SigsXmlLabels>(path, sequence);
}

}  // namespace sigs
