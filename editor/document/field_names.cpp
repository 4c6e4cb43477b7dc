// SPDX-License-Identifier: MIT
// How settings are called in the window, and which of them most projects need.
#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "editor/document/field_edits.h"

namespace sigs::editor {

namespace {

constexpr std::array<std::string_view, 7> kUnitsInKeys{"_px_per_m", "_mps", "_deg", "_percent", "_px", "_m", "_s"};

// Where the key alone would not be understood.
constexpr std::array<std::pair<std::string_view, std::string_view>, 74> kNames{{
    {"camera.track.file", "Log file"},
    {"camera.track.offset_s", "Time offset"},
    {"camera.track.position", "Its position"},
    {"camera.track.attitude", "Its attitude"},
    {"camera.track.mount", "Its mount"},
    {"camera.track.incomplete", "If incomplete"},
    {"mount.position_m", "Position on the aircraft"},
    {"clock.offset_s", "Clock offset"},
    {"clock.drift_ppm", "Clock drift"},
    {"camera.readout_s", "Shutter readout"},
    {"camera.exposure_s", "Exposure time"},
    {"light.sun.azimuth_deg", "Sun azimuth"},
    {"light.sun.elevation_deg", "Sun elevation"},
    {"footage.crop.left_px", "Crop, left"},
    {"footage.crop.top_px", "Crop, top"},
    {"footage.crop.width_px", "Crop, width"},
    {"footage.crop.height_px", "Crop, height"},
    {"footage.occluder_mask", "Occluder"},
    {"footage.occluder_distance_m", "Its distance"},
    {"footage.cloud_distance_m", "Clouds from"},
    {"footage.cloud_depth_m", "Their depth"},
    {"appearance.psf_sigma_px", "Blur"},
    {"appearance.sharpening_px", "Sharpening radius"},
    {"appearance.chroma_blur_px", "Blur of colours"},
    {"appearance.black", "Flare"},
    {"appearance.grain.source", "Noise from"},
    {"appearance.grain.sd_dark", "Noise, dark"},
    {"appearance.grain.sd_bright", "Noise, bright"},
    {"appearance.grain.sd_chroma", "Noise, colours"},
    {"appearance.grain.correlation_length_px", "Grain size"},
    {"appearance.grain.temporal_correlation", "Grain temporal correlation"},
    {"appearance.grain.seed", "Grain seed"},
    {"appearance.haze.airlight_color", "Airlight colour"},
    {"appearance.thermal.sky", "Sky's code"},
    {"appearance.thermal.hot", "Warm is"},
    {"appearance.thermal.halo_px", "Halo radius"},
    {"heat.skin", "Heat of skin"},
    {"lights.position_cd", "Position lights"},
    {"lights.strobe_cd", "Strobes"},
    {"lights.beacon_cd", "Beacons"},
    {"lights.landing_cd", "Landing light"},
    {"lights.landing_beam_deg", "Its beam"},
    {"lights.flashes_per_minute", "Flashes a minute"},
    {"lights.flash_s", "Length of a flash"},
    {"lights.phase", "Phase of flashes"},
    {"light.white_cdpm2", "White is"},
    {"light.ground_shadow", "Shadow on ground"},
    {"appearance.glare", "Glare of lights"},
    {"appearance.glare_px", "Glare radius"},
    {"appearance.codec.match", "Codec"},
    {"geo.height_m", "Height of z = 0"},
    {"geo.heading_deg", "Heading of X"},
    {"compositing.blur_px_per_m", "Blur with distance"},
    {"contrail.strands", "Contrail strands"},
    {"contrail.length_m", "Contrail length"},
    {"contrail.width_m", "Contrail width"},
    {"contrail.spread_mps", "Contrail spread"},
    {"contrail.opacity", "Contrail opacity"},
    {"contrail.brightness", "Contrail brightness"},
    {"export.video.crf", "Quality (crf)"},
    {"light.color", "Colour"},
    {"own_body.every", "Every nth"},
    {"own_body.settled_percent", "Settled below"},
    {"footage.own_body_mask", "Own-body mask"},
    {"footage.max_substituted_percent", "Damaged frames up to"},
    {"name", "Project"},
    {"model.file", "Model"},
    {"model.forward", "Nose along"},
    {"model.up", "Top along"},
    {"model.anchor", "Reference point"},
    {"export.video.quality", "Quality (jpeg)"},
    {"export.video.max_bit_depth", "Bit depth up to"},
    {"export.label_min_pixels", "Min pixels"},
    {"export.label_min_visible_fraction", "Min visible part"},
}};

// "intruders[3].model.file" is named as "model.file" is.
std::string_view without_intruder(std::string_view key) {
  return key.starts_with("intruders[") && key.find("].") != std::string_view::npos ? key.substr(key.find("].") + 2)
                                                                                   : key;
}

}  // namespace

std::string label_of(std::string_view key) {
  // The project's name and an intruder's are two things.
  const std::string_view own = key.ends_with("].name") ? key : without_intruder(key);
  for (const auto& [named, name] : kNames)
    if (own == named) return std::string(name);
  std::string_view last = key.substr(key.rfind('.') + 1);
  for (const std::string_view unit : kUnitsInKeys)
    if (last.size() > unit.size() && last.ends_with(unit)) {
      last.remove_suffix(unit.size());
      break;
    }
  std::string label = with_spaces(last);
  if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return label;
}

std::string advice_on_guess(std::string_view key) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kAdvice{{
      {"footage.calibration", "A calibration of this camera is chosen here."},
      {"camera.attitude_deg", "Horizon, above the footage, shows where it is level, to be dragged into place."},
      {"camera.speed_mps", "A flight log is chosen in Camera log."},
      {"model.file", "Change model... shows the others."},
      {"model.forward", "The image of the model shows whether it is right."},
      {"light.kind", "Match the footage, in Appearance, looks at more of it."},
  }};
  for (const auto& [guessed, advice] : kAdvice)
    if (without_intruder(key) == guessed) return std::string(advice);
  return "";
}

bool is_common(std::string_view key) {
  constexpr std::array<std::string_view, 50> kCommon{
      "name",
      "footage.video",
      "footage.first_frame",
      "footage.last_frame",
      "footage.calibration",
      "footage.spectrum",
      "footage.palette",
      "footage.own_body_mask",
      "footage.occluder_mask",
      "footage.cloud_distance_m",
      "own_body.method",
      "own_body.soft_edge_px",
      "camera.position_m",
      "camera.attitude_deg.roll",
      "camera.attitude_deg.pitch",
      "camera.speed_mps",
      "camera.track.file",
      "camera.track.offset_s",
      "mount.position_m",
      "mount.attitude_deg.roll",
      "mount.attitude_deg.pitch",
      "mount.attitude_deg.yaw",
      "clock.offset_s",
      "clock.drift_ppm",
      "geo.latitude_deg",
      "geo.longitude_deg",
      "light.kind",
      "light.position_m",
      "light.ambient",
      "light.sun.azimuth_deg",
      "light.sun.elevation_deg",
      "light.exposure",
      "category",
      "model.file",
      "model.forward",
      "model.up",
      "model.length_m",
      "contrail.strands",
      "heat.skin",
      "lights.position_cd",
      "lights.strobe_cd",
      "lights.beacon_cd",
      "lights.landing_cd",
      "trajectory.timing",
      "trajectory.attitude",
      "compositing.method",
      "appearance.psf_sigma_px",
      "appearance.haze.visibility_m",
      "export.video.codec",
      "export.labels",
  };
  return key.ends_with("].name") || key.find(".rotors[") != std::string_view::npos ||
         std::ranges::find(kCommon, without_intruder(key)) != kCommon.end();
}

}  // namespace sigs::editor
