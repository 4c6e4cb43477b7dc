// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "appearance/appearance.h"
#include "base/pose.h"
#include "project/fields.h"
#include "project/validate.h"
#include "scene/camera_track.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_light.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

// Chosen with the clips that are kept for tuning (docs/research/realism.md): more change little.
constexpr int kPredictedFrames = 12;

// To three digits; more would not be honest, and settings are read by people.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double scale = std::pow(10, 2 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

const char* unit_of(QuantiserKind kind) {
  // In the order of QuantiserKind.
  static constexpr std::array kUnits{"QP", "codes a step", "", "% quality"};
  return kUnits.at(static_cast<std::size_t>(kind));
}

void add_color(std::vector<AppearanceQuantity>& list, const std::string& name, const std::array<Estimate, 3>& color,
               const std::string& setting) {
  const char* const kParts[] = {", red", ", green", ", blue"};
  for (std::size_t k = 0; k < 3; ++k) list.push_back({name + kParts[k], "", color[k], setting});
}

void apply_haze(const HazeEstimate& haze, HazeSettings& settings) {
  settings = {};
  if (!haze.visibility_m.is_known) return;
  settings.visibility_m = haze.visibility_m.value;
  if (!haze.airlight[0].is_known) return;
  settings.airlight = AirlightChoice::color;
  settings.airlight_color = {haze.airlight[0].value, haze.airlight[1].value, haze.airlight[2].value};
}

void apply_sun(const SunEstimate& sun, SunSettings& settings) {
  if (sun.azimuth_rad.is_known || !settings.azimuth_deg) settings.azimuth_deg = deg_of_rad(sun.azimuth_rad.value);
  if (sun.elevation_rad.is_known || !settings.elevation_deg)
    settings.elevation_deg = deg_of_rad(sun.elevation_rad.value);
}

// To three digits, and within what a user may set.
void hold_in_ranges(Project& project) {
  for (const Field& field : fields_of(project)) {
    if (!field.key.starts_with("appearance.") && !field.key.starts_with("light.")) continue;
    const auto held = [&](double value) { return std::clamp(rounded(value), field.minimum, field.maximum); };
    if (double* const* const number = std::get_if<double*>(&field.value)) **number = held(**number);
    if (std::optional<double>* const* const maybe = std::get_if<std::optional<double>*>(&field.value))
      if (*maybe != nullptr && (*maybe)->has_value()) **maybe = held(***maybe);
    if (glm::dvec3* const* const color = std::get_if<glm::dvec3*>(&field.value))
      for (int k = 0; k < 3; ++k) (**color)[k] = held((**color)[k]);
  }
}

bool light_is_known(const Appearance& appearance) {
  return appearance.surroundings.light.sky_color[0].is_known;
}

Panel tone_panel(const Appearance& appearance) {
  const ToneEstimate& tone = appearance.surroundings.tone;
  PanelSeries share{.label = "share of the footage"};
  for (std::size_t level = 0; level < appearance.tone_histogram.size(); ++level) {
    share.x.push_back(static_cast<double>(level) / 255);
    share.y.push_back(appearance.tone_histogram[level]);
  }
  return {.title = "tones",
          .x_title = "luma, 0 black, 1 white",
          .series = {std::move(share)},
          .remark = "black " + estimate_text(tone.black, "") + "; white " + estimate_text(tone.white, "")};
}

Panel haze_panel(const Appearance& appearance) {
  const HazeCurve& curve = appearance.haze_curve;
  return {.title = "luminance of the ground, linear",
          .x_title = "distance, m",
          .series = {{"ground", curve.distance_m, curve.ground_luminance, true},
                     {"fit", curve.distance_m, curve.fitted_luminance}},
          .remark = "visibility " + estimate_text(appearance.surroundings.haze.visibility_m, "m")};
}

Panel light_panel(const Appearance& appearance) {
  const LightEstimate& light = appearance.surroundings.light;
  Panel panel{.title = "light of sun, sky and ground, linear, exposure included",
              .x_title = "0 red, 1 green, 2 blue",
              .remark = "exposure " + estimate_text(light.exposure, "")};
  const std::pair<const char*, const std::array<Estimate, 3>*> kColors[] = {
      {"sun", &light.sun_color}, {"sky", &light.sky_color}, {"ground", &light.ground_color}};
  for (const auto& [name, color] : kColors) {
    PanelSeries series{.label = name, .x = {0, 1, 2}};
    for (const Estimate& part : *color) series.y.push_back(part.value * light.exposure.value);
    panel.series.push_back(std::move(series));
  }
  return panel;
}

// To a thermal camera nothing is lit or hazy, and where its blur or sky is not seen, that of other ones stays.
void keep_thermal(const Project& before, const Appearance& appearance, Project& project) {
  project.light = before.light;
  project.appearance.black = before.appearance.black;
  project.appearance.haze = before.appearance.haze;
  const ThermalSettings& stated = before.appearance.thermal;
  ThermalSettings& thermal = project.appearance.thermal;
  if (!appearance.levels || !appearance.levels->sky.is_known) thermal.sky = stated.sky;
  if (!appearance.levels || !appearance.levels->halo.is_known) thermal.halo = stated.halo;
  if (!appearance.levels || !appearance.levels->halo_px.is_known) thermal.halo_px = stated.halo_px;
  even_out_noise(project.appearance, appearance.levels ? appearance.levels->noise : Estimate());
  if (appearance.point_spread.sigma_px.is_known) return;
  project.appearance.psf_sigma_px = before.appearance.psf_sigma_px;
  project.appearance.sharpening = before.appearance.sharpening;
  project.appearance.sharpening_px = before.appearance.sharpening_px;
}

struct KnownCamera {
  Scene scene;
  bool has_calibration = false;
  bool has_height = false;
  cv::Mat own_body;  // CV_8UC1
};

View view_at(const KnownCamera& known, int frame) {
  const double time_s = time_of_frame_s(known.scene.footage, frame);
  const Pose<frame::World, frame::Camera> pose = camera_at(known.scene.motion, time_s);
  View view{.camera = known.has_calibration ? &known.scene.camera : nullptr, .own_body = known.own_body};
  if (known.scene.horizon_is_known) view.world_from_camera = pose.rotation;
  if (known.has_height && pose.translation_m.z < 0)
    view.height_m = -pose.translation_m.z;  // the ground is the world's plane z = 0
  return view;
}

AppearanceHints hints_by(std::shared_ptr<KnownCamera> known) {
  AppearanceHints hints{.view = [known](int frame) { return view_at(*known, frame); }};
  hints.palette = known->scene.palette;
  known->scene.light = {};  // the direction that the project states must not stand for the computed one
  if (known->scene.earth && known->scene.utc_at_frame_0_s)
    hints.to_sun_in_world = [known](int frame) {
      return sunlight_at(known->scene, time_of_frame_s(known->scene.footage, frame)).to_sun;
    };
  return hints;
}

}  // namespace

std::vector<AppearanceQuantity> quantities_of(const Appearance& appearance) {
  const PointSpreadFound& sharp = appearance.point_spread;
  const NoiseFound& noise = appearance.noise;
  std::vector<AppearanceQuantity> list{
      {"point spread", "px", sharp.sigma_px, "appearance.psf_sigma_px"},
      {"sharpening", "", sharp.sharpening, "appearance.sharpening"},
      {"sharpening's width", "px", sharp.sharpening_px, "appearance.sharpening_px"},
      {"chroma blur", "px of chroma", sharp.chroma_blur_px, "appearance.chroma_blur_px"},
      {"noise at black", "codes", noise.sd_dark, "appearance.grain.sd_dark"},
      {"noise at white", "codes", noise.sd_bright, "appearance.grain.sd_bright"},
      {"noise of chroma", "codes", noise.sd_chroma, "appearance.grain.sd_chroma"},
      {"noise's spread", "px", noise.correlation_length_px, "appearance.grain.correlation_length_px"},
      {"noise's temporal correlation", "", noise.temporal_correlation, "appearance.grain.temporal_correlation"}};
  const CodecEstimate& codec = appearance.codec;
  list.push_back(
      {"codec's quantiser", unit_of(codec.kind), codec.quantiser, ""});  // the settings' null: frame by frame
  list.push_back({"codec's block grid", "codes", codec.block_grid, ""});
  list.push_back({"codec's ringing", "codes", codec.ringing, ""});
  const auto& [haze, tone, light, sun] = appearance.surroundings;
  list.push_back({"black", "", tone.black, "appearance.black"});
  list.push_back({"white", "", tone.white, ""});
  list.push_back({"saturation", "", tone.saturation, "appearance.saturation"});
  list.push_back({"visibility", "m", haze.visibility_m, "appearance.haze.visibility_m"});
  add_color(list, "airlight", haze.airlight, "appearance.haze.airlight_color");
  list.push_back({"exposure", "", light.exposure, "light.exposure"});
  list.push_back({"sun's share", "", light.sun_share, ""});
  add_color(list, "sun", light.sun_color, "light.color");
  add_color(list, "sky", light.sky_color, "light.sky_color");
  add_color(list, "ground", light.ground_color, "light.ground_color");
  list.push_back(
      {"sun's azimuth", "deg", in_degrees(sun.azimuth_rad), "light.sun.azimuth_deg", how_found(sun.evidence)});
  // Shadows tell the azimuth alone.
  const SunEvidence of_elevation = sun.evidence == SunEvidence::shadows ? SunEvidence::sky : sun.evidence;
  list.push_back({"sun's elevation", "deg", in_degrees(sun.elevation_rad), "light.sun.elevation_deg",
                  sun.elevation_rad.is_known ? how_found(of_elevation) : ""});
  if (appearance.glare) {
    list.push_back({"glare", "of the light", appearance.glare->share, "appearance.glare"});
    list.push_back({"glare's radius", "px", appearance.glare->sigma_px, "appearance.glare_px"});
  }
  if (appearance.levels) {
    list.push_back({"sky's code", "codes", appearance.levels->sky, "appearance.thermal.sky"});
    if (appearance.levels->ground.is_known) list.push_back({"ground's code", "codes", appearance.levels->ground, ""});
    list.push_back({"noise of the sky", "codes", appearance.levels->noise, ""});  // sd_dark and sd_bright
    list.push_back({"halo", "", appearance.levels->halo, "appearance.thermal.halo"});
    list.push_back({"halo's radius", "px", appearance.levels->halo_px, "appearance.thermal.halo_px"});
  }
  return list;
}

std::string text_of(const AppearanceQuantity& quantity) {
  const Estimate& estimate = quantity.estimate;
  if (quantity.setting == "appearance.haze.visibility_m") {
    if (!estimate.is_known) return "not known: " + estimate.why + "; clear air is taken";
    return fmt::format("{:.0f} +- {:.0f} m", estimate.value, estimate.sd);
  }
  if (quantity.setting.starts_with("appearance.thermal.") && !estimate.is_known)
    return "not known: " + estimate.why + "; the project's stays";
  const std::string text = estimate_text(estimate, quantity.unit);
  return quantity.how.empty() ? text : text + ", " + quantity.how;
}

std::vector<Panel> panels_of(const Appearance& appearance) {
  std::vector<Panel> panels = appearance.point_spread.panels;
  panels.insert(panels.end(), appearance.noise.panels.begin(), appearance.noise.panels.end());
  panels.push_back(tone_panel(appearance));
  panels.push_back(haze_panel(appearance));
  panels.push_back(light_panel(appearance));
  return panels;
}

std::vector<std::string> applied_settings(const Appearance& appearance) {
  std::vector<std::string> keys;
  if (light_is_known(appearance)) keys.emplace_back("light.kind");
  const auto add = [&](const std::string& part) {
    for (const AppearanceQuantity& quantity : quantities_of(appearance))
      if (quantity.setting.starts_with(part) && (keys.empty() || keys.back() != quantity.setting))
        keys.push_back(quantity.setting);
  };
  if (light_is_known(appearance)) add("light.");
  keys.emplace_back("compositing.blur_px_per_m");
  add("appearance.");
  keys.emplace_back("appearance.grain.source");
  keys.emplace_back("appearance.haze.airlight");
  keys.emplace_back("appearance.codec.match");
  keys.emplace_back("appearance.codec.predicted_frames");
  return keys;
}

std::vector<std::string> names_of_unknown(const Appearance& appearance) {
  std::vector<std::string> names;
  for (const AppearanceQuantity& quantity : quantities_of(appearance)) {
    if (quantity.setting.empty() || quantity.estimate.is_known) continue;
    const std::string name = quantity.name.substr(0, quantity.name.find(','));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

void apply(const Appearance& appearance, Project& project) {
  const Project before = project;
  project.compositing.blur_px_per_m = 0;
  for (const Field& field : fields_of(project))
    for (const AppearanceQuantity& quantity : quantities_of(appearance))
      if (quantity.setting == field.key && field.key.starts_with("appearance."))
        if (double* const* const number = std::get_if<double*>(&field.value)) **number = quantity.estimate.value;
  project.appearance.grain.source = GrainSource::footage;
  const SurroundingsEstimate& around = appearance.surroundings;
  apply_haze(around.haze, project.appearance.haze);
  if (light_is_known(appearance)) {
    apply_sun(around.sun, project.light.sun);
    apply(around.light, around.tone.white, project.light);                  // which asks for the sun's elevation
    if (around.sun.evidence == SunEvidence::given) project.light.sun = {};  // by time and place, at each frame
  }
  project.appearance.codec.match =
      is_lossless_codec(appearance.footage.codec) ? CodecMatchChoice::none : CodecMatchChoice::footage;
  project.appearance.codec.predicted_frames = appearance.codec.predicts ? kPredictedFrames : 0;
  if (before.footage.spectrum == Spectrum::thermal) keep_thermal(before, appearance, project);
  hold_in_ranges(project);
}

AppearanceHints hints_of(const Scene& scene) {
  return hints_by(std::make_shared<KnownCamera>(KnownCamera{.scene = scene, .has_calibration = true}));
}

Result<AppearanceHints> hints_of(const Project& project, const VideoInfo& footage, bool height_is_guess,
                                 const std::function<void(const Warning&)>& warn) {
  const auto failed = [&](const Problem& problem) { return fail(error_of(project, problem)); };
  const auto known = std::make_shared<KnownCamera>(
      KnownCamera{.scene = bare_scene(project, footage_shape(project, footage)), .has_height = !height_is_guess});
  Scene& scene = known->scene;
  const Result<FrameRange, Problem> range = scene_range(project.footage, scene.footage);
  if (!range) return failed(range.error());
  SceneFiles files;
  if (states_lens(project.footage)) {
    Result<Camera, Problem> camera = scene_camera(project, scene.footage, files);
    if (!camera) return failed(camera.error());
    scene.camera = *std::move(camera);
    known->has_calibration = true;
  }
  Result<CameraFlight, Problem> flight = camera_flight(project, scene.footage, *range, files);
  if (!flight) return failed(flight.error());
  set_camera_motion(scene, *std::move(flight));
  const Result<cv::Mat, Problem> own_body = scene_own_body(project, footage.size_px, files);
  if (!own_body) return failed(own_body.error());
  if (!own_body->empty()) own_body->convertTo(known->own_body, CV_8U, 255);
  for (const Warning& warning : scene.warnings) warn(warning);
  AppearanceHints hints = hints_by(known);
  hints.is_thermal = project.footage.spectrum == Spectrum::thermal;
  return hints;
}

Result<Appearance> appearance_of_footage(const Project& project, const AppearanceFrames& frames, bool height_is_guess,
                                         const AppearanceControl& control) {
  const auto warn = [&](const Warning& warning) {
    if (control.warn) control.warn(warning);
  };
  Result<FrameSource> footage = open_footage(project, control.cancel, Quantisers::read);
  if (!footage) return fail(footage.error());
  for (const Warning& warning : footage->info().warnings) warn(warning);
  const Result<AppearanceHints> hints = hints_of(project, footage->info(), height_is_guess, warn);
  if (!hints) return fail(hints.error());
  return estimate_appearance(*footage, frames, *hints, control);
}

}  // namespace sigs
