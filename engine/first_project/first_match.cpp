// SPDX-License-Identifier: MIT
#include "first_project/planning_steps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/appearance.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "base/transfer.h"
#include "ego_motion/ego_motion.h"
#include "horizon/horizon.h"
#include "video/color_space.h"

namespace sigs {

namespace {

// Settings that one note is about.
struct NoteGroup {
  const char* field;
  std::initializer_list<std::string_view> settings;  // keys, or beginnings of keys that end in a point
};

const NoteGroup kGroups[] = {
    {"appearance.psf_sigma_px", {"appearance.psf_sigma_px", "appearance.sharpening", "appearance.sharpening_px"}},
    {"appearance.chroma_blur_px", {"appearance.chroma_blur_px"}},
    {"appearance.grain", {"appearance.grain."}},
    {"appearance.black", {"appearance.black"}},
    {"appearance.saturation", {"appearance.saturation"}},
    {"appearance.haze.visibility_m", {"appearance.haze.visibility_m"}},
    {"appearance.glare", {"appearance.glare", "appearance.glare_px"}},
};

bool is_in(const NoteGroup& group, std::string_view setting) {
  return std::any_of(group.settings.begin(), group.settings.end(), [&](std::string_view key) {
    return key.ends_with('.') ? setting.starts_with(key) : setting == key;
  });
}

// "point spread 0.51 +- 0.02 px, sharpening 0.3 +- 0.1", and what of it is not known.
FirstProjectNote note_of(const NoteGroup& group, const std::vector<AppearanceQuantity>& quantities) {
  FirstProjectNote note{.field = group.field, .is_guess = true};
  std::vector<std::string> found, missing;
  for (const AppearanceQuantity& quantity : quantities) {
    if (!is_in(group, quantity.setting)) continue;
    (quantity.estimate.is_known ? found : missing).push_back(quantity.name + " " + text_of(quantity));
    if (quantity.estimate.is_known) note.is_guess = false;
  }
  note.is_not_shown = note.is_guess;
  // The reason is the same for all of a group.
  if (missing.size() > 1) missing.resize(1);
  found.insert(found.end(), missing.begin(), missing.end());
  note.text = fmt::format("{}", fmt::join(found, ", "));
  return note;
}

FirstProjectNote codec_note(const Appearance& seen, const Project& project) {
  FirstProjectNote note{.field = "appearance.codec.match"};
  if (project.appearance.codec.match == CodecMatchChoice::none) {
    note.text = fmt::format("none: {} keeps every sample", seen.footage.codec);
    return note;
  }
  const CodecEstimate& codec = seen.codec;
  note.text = fmt::format("what is inserted goes through the footage's own compression, {}{}", seen.footage.codec,
                          codec.quantiser.is_known ? ": each image by the quantisers that the stream states" : "");
  if (codec.quantiser.is_known) return note;
  note.text += "; how strong it is, is not known: " + codec.quantiser.why;
  note.is_guess = true;
  return note;
}

std::vector<FirstProjectNote> light_notes(const SurroundingsEstimate& seen) {
  FirstProjectNote light{.field = "light.kind"};
  if (!seen.light.sky_color[0].is_known) {
    light.is_guess = true;
    light.text = "the default light: " + seen.light.sky_color[0].why + "; set light.* as the footage is lit";
    return {light};
  }
  light.text = fmt::format("sun, sky and ground as the footage shows them; exposure {}, sun's share {}",
                           estimate_text(seen.light.exposure, ""), estimate_text(seen.light.sun_share, ""));
  light.is_guess = !seen.light.exposure.is_known;
  FirstProjectNote sun{.field = "light.sun.azimuth_deg"};
  sun.is_guess = !seen.sun.azimuth_rad.is_known;
  sun.text = sun.is_guess
                 ? "behind the camera, as what people point one at is mostly lit: " + seen.sun.azimuth_rad.why +
                       "; set light.sun.* as the footage's own things are lit"
                 : "the sun's direction " + how_found(seen.sun.evidence);
  return {light, sun};
}

}  // namespace

Result<std::vector<FirstProjectNote>> match_appearance(FrameSource& footage, const Scene& scene, Project& project,
                                                       const MatchControl& control) {
  const AppearanceFrames frames{.first = scene.first_frame, .last = scene.last_frame};
  const AppearanceControl following{.progress =
                                        [&](int done, int total) {
                                          if (control.progress) control.progress(double(done) / std::max(1, total));
                                        },
                                    .cancel = control.cancel};
  const Result<Appearance> seen = estimate_appearance(footage, frames, hints_of(scene), following);
  if (!seen) return fail(seen.error());
  apply(*seen, project);
  std::vector<FirstProjectNote> notes;
  const std::vector<AppearanceQuantity> quantities = quantities_of(*seen);
  for (const NoteGroup& group : kGroups)
    if (FirstProjectNote note = note_of(group, quantities); !note.text.empty()) notes.push_back(std::move(note));
  notes.push_back(codec_note(*seen, project));
  const std::vector<FirstProjectNote> light = light_notes(seen->surroundings);
  notes.insert(notes.begin(), light.begin(), light.end());
  return notes;
}

namespace {

constexpr int kSpectrumFrames = 5;
constexpr double kWarmGround_codes = 5;  // by so much
constexpr double kNight_code = 25;       // of 8 bits: half of the footage is darker by night
constexpr double kNightExposure_s = 1.0 / 30;
constexpr double kNightWhite_cdpm2 = 5;  // f/2, 1/30 s, ISO 3200: 120 N^2 / (S t)
constexpr double kWhiteOverNight = 3;    // light of a white surface over that of what is there
// Of 12 clips of thermal cameras (docs/thermal.md): a sharp core, and a glow of two fifths of the light.
constexpr double kThermalSpread_px = 0.35, kThermalGlow = 0.4, kThermalGlow_px = 1.8;
constexpr double kHaloOfWidth = 0.1;  // sigma of the halo over the image's width: 32 px in 320

// Frames that stand for all: in the middles of equal parts of the scene's range. Damaged ones are left out.
//   look  gives back whether the next one is wanted
Result<void> look_through(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel,
                          const std::function<bool(const Frame&)>& look) {
  const int length = scene.last_frame - scene.first_frame + 1;
  const int count = std::min(kSpectrumFrames, length);
  for (int i = 0; i < count; ++i) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    const Result<Frame> frame =
        footage.read(scene.first_frame + static_cast<int>((2LL * i + 1) * length / (2LL * count)));
    if (!frame) return fail(frame.error());
    if (!frame->damaged && !look(*frame)) break;
  }
  return {};
}

// Medians over some frames; skies and differences of those in which both sky and ground are told.
struct Brightness {
  std::vector<double> all, skies, differences;
  ThermalLevels levels;  // where they may be those of a thermal camera

  [[nodiscard]] bool has_both() const { return 2 * skies.size() >= all.size(); }
  [[nodiscard]] bool is_ground_warm() const { return has_both() && median(differences) >= kWarmGround_codes; }
  [[nodiscard]] bool is_ground_dark() const { return has_both() && median(differences) <= -kWarmGround_codes; }
};

Result<Brightness> brightness_of(FrameSource& footage, const Scene& scene, bool may_be_thermal,
                                 const std::atomic<bool>* cancel) {
  Brightness seen;
  const std::optional<HeatColors> colors = heat_colors(scene.palette);
  const Result<void> looked = look_through(footage, scene, cancel, [&](const Frame& frame) {
    const Frame shown = colors ? colors->heat_of(frame).frame : frame;
    const SkyAndGround found = sky_and_ground_of(shown);
    if (may_be_thermal) seen.levels.add(shown);
    seen.all.push_back(found.all);
    if (!found.sky || !found.ground) return true;
    seen.skies.push_back(*found.sky);
    seen.differences.push_back(*found.ground - *found.sky);
    return true;
  });
  if (!looked) return fail(looked.error());
  return seen;
}

FirstProjectNote set_thermal(const Brightness& seen, int width_px, Project& project) {
  project.footage.spectrum = Spectrum::thermal;
  project.light = {};
  project.appearance.black = 0;
  project.appearance.haze = {};
  if (project.appearance.psf_sigma_px == AppearanceSettings{}.psf_sigma_px) {  // not seen: as in other thermal clips
    project.appearance.psf_sigma_px = kThermalSpread_px;
    project.appearance.sharpening = -kThermalGlow;
    project.appearance.sharpening_px = kThermalGlow_px;
  }
  project.appearance.thermal.sky = std::round(median(seen.has_both() ? seen.skies : seen.all));
  const bool has_palette = project.footage.palette != HeatPalette::gray;
  // No ground is colder than the sky: the palette runs the other way.
  if (has_palette && seen.is_ground_dark()) project.appearance.thermal.hot = HotChoice::black;
  const LevelsEstimate levels = seen.levels.finish();
  const auto rounded = [](double value, double parts) { return std::round(value * parts) / parts; };
  project.appearance.thermal.halo_px =
      rounded(levels.halo_px.is_known ? levels.halo_px.value : kHaloOfWidth * width_px, 10);
  even_out_noise(project.appearance, levels.noise);
  if (levels.halo.is_known) project.appearance.thermal.halo = rounded(levels.halo.value, 100);
  FirstProjectNote note{.field = "footage.spectrum", .is_guess = true};
  note.text = fmt::format(
      "thermal: the footage {}; its sky has code {:.0f}{}; {}; how warm the intruder is (intruders[].heat) is a guess",
      has_palette       ? "has the colours of a palette"
      : seen.has_both() ? "is gray and its ground is brighter than its sky"
                        : "is gray and as small as that of thermal cameras",
      project.appearance.thermal.sky,
      project.appearance.thermal.hot == HotChoice::black
          ? " and its ground less, so that low codes are warm (appearance.thermal.hot)"
          : "",
      levels.halo_px.is_known
          ? fmt::format(
                "by the dark sky above its ground the camera's halo is {:.0f} px wide (appearance.thermal.halo)",
                project.appearance.thermal.halo_px)
          : "the camera's halo (appearance.thermal.halo) is that of other clips");
  note.remedy = "set footage.spectrum to visible if it is footage by light";
  return note;
}

FirstProjectNote set_night(double code, const Scene& scene, Project& project) {
  const double light = kWhiteOverNight * linear_of_display(static_cast<float>(code / 255));
  const std::optional<double>& logged = scene.motion.logged_white_cdpm2;
  const double white_cdpm2 = logged ? std::clamp(std::round(1000 * *logged) / 1000, 1e-3, 1e9) : kNightWhite_cdpm2;
  project.light = {.color = glm::dvec3(light), .ambient = 1, .white_cdpm2 = white_cdpm2};
  FirstProjectNote note{.field = "light.white_cdpm2", .is_guess = true};
  note.text = fmt::format(
      "{} cd/m2 are white{}: by night, as the footage is as dark as code {:.0f}; the intruder is as "
      "dark and shows its lights (intruders[].lights)",
      short_number_text(white_cdpm2), logged ? ", by the log's aperture, exposure and sensitivity" : "", code);
  if (scene.motion.exposures.empty()) {
    project.camera.exposure_s = std::round(1000 * std::min(kNightExposure_s, scene.footage.frame_interval_s)) / 1000;
    note.text += fmt::format("; the shutter is taken to be open for {} s", *project.camera.exposure_s);
  }
  note.remedy = "set it by aperture, exposure and sensitivity (docs/aircraft-lights.md)";
  return note;
}

}  // namespace

Result<std::optional<FirstProjectNote>> set_palette(FrameSource& footage, const Scene& scene, Project& project,
                                                    const std::atomic<bool>* cancel) {
  // Most footage has none, which shows in two frames; those between cost a search in the file each.
  constexpr int kTold = 2;
  PaletteSearch search;
  std::optional<PaletteSearch::Found> found;
  int count = 0;
  const Result<void> looked = look_through(footage, scene, cancel, [&](const Frame& frame) {
    search.add(frame);
    if (++count >= kTold) found = search.found();
    return count < kTold || found.has_value();
  });
  if (!looked) return fail(looked.error());
  if (count < kTold) found = search.found();
  if (!found) return std::nullopt;
  project.footage.spectrum = Spectrum::thermal;
  project.footage.palette = found->palette;
  return FirstProjectNote{
      .field = "footage.palette",
      .text = fmt::format("{}: the footage's colours are off by {:.0f} codes in the mean from those of this palette of "
                          "thermal cameras",
                          kHeatPaletteNames[static_cast<std::size_t>(found->palette)], found->off_codes),
      .is_guess = true,
      .remedy = "set footage.palette, or footage.spectrum to visible if it is footage by light"};
}

Result<DarkOrThermal> set_dark_or_thermal(FrameSource& footage, const Scene& scene, Project& project,
                                          const std::atomic<bool>* cancel) {
  const bool has_palette = scene.palette != HeatPalette::gray;
  const bool may_be_thermal = has_palette || project.appearance.saturation == 0;
  const Result<Brightness> seen = brightness_of(footage, scene, may_be_thermal, cancel);
  if (!seen) return fail(seen.error());
  if (seen->all.empty()) return DarkOrThermal{};
  const cv::Size& size_px = scene.footage.size_px;
  const bool is_small = is_as_small_as_thermal(size_px);
  const bool is_warm = seen->has_both() ? seen->is_ground_warm() : is_small;
  if (has_palette || (may_be_thermal && is_warm))
    return DarkOrThermal{.note = set_thermal(*seen, size_px.width, project), .is_lit = false};
  if (const double code = median(seen->all); code < kNight_code)
    return DarkOrThermal{.note = set_night(code, scene, project), .is_lit = false};
  if (!may_be_thermal || !is_small || !seen->is_ground_dark()) return DarkOrThermal{};
  return DarkOrThermal{.note = FirstProjectNote{
                           .field = "footage.spectrum",
                           .text = "visible: the footage is gray and its ground darker than its sky, as by day; one of "
                                   "a thermal camera that shows dark what is warm looks alike",
                           .is_guess = true,
                           .remedy = "if it is such a one, set footage.spectrum to thermal and appearance.thermal.hot "
                                     "to black, then run sigs appearance with --into"}};
}

namespace {

constexpr double kLongestMotion_s = 90;
constexpr double kMaxLostShare = 0.05;
constexpr double kMaxStep_px = 1;
constexpr double kStill_px = 0.5, kStillBesideCut_px = 3;

// Why the turns are of no use; "": they are.
std::string why_no_motion(const EgoMotion& motion, const Scene& scene) {
  std::size_t lost = 0, used = 0;
  double largest_rad = 0, step_rad = 0;
  bool is_known = true;
  const auto begin = static_cast<std::size_t>(scene.first_frame);
  std::size_t stretch = begin, cut = 0;  // frames
  for (std::size_t n = begin; n <= static_cast<std::size_t>(scene.last_frame) && n < motion.frames.size(); ++n) {
    const EgoFrame& frame = motion.frames[n];
    ++used;
    lost += frame.is_lost && n > begin ? 1 : 0;
    if (frame.is_cut && n > begin) cut = n;
    if (frame.is_lost) stretch = n;  // what it turned by meanwhile is not known
    const glm::dquat turn = glm::conjugate(motion.frames[stretch].world_from_camera) * frame.world_from_camera;
    largest_rad = std::max(largest_rad, 2 * std::acos(std::min(1.0, std::abs(turn.w))));
    if (!frame.is_lost && frame.sd_rad.x >= kUnknownRotation_rad) is_known = false;
    if (!frame.is_lost) step_rad = std::max({step_rad, frame.step_sd_rad.y, frame.step_sd_rad.z});
  }
  if (static_cast<double>(lost) > kMaxLostShare * static_cast<double>(used))
    return fmt::format("the images do not show how the camera turns in {} of {} frames", lost, used);
  if (lost == 0 && !is_known) return "the images do not show how the camera turns before the frames used";
  const double px_per_rad = motion.focal_factor * scene.camera.lens.pixels_per_radian({1, 0, 0});
  // What adds up over seconds, as where clouds drift, moves footage and intruder alike.
  if (step_rad * px_per_rad > kMaxStep_px)
    return fmt::format("the images show the camera's turns to {:.1f} px only", step_rad * px_per_rad);
  const double still_px = largest_rad * px_per_rad;
  if (still_px < kStill_px) return fmt::format("the camera stands still: it turns by {:.1f} px at most", still_px);
  if (cut > 0 && still_px < kStillBesideCut_px)
    return fmt::format("the camera stands still, but for a jerk or a cut at frame {}: it turns by {:.1f} px at most",
                       cut, still_px);
  return "";
}

}  // namespace

Result<FirstMotion> first_motion(FrameSource& footage, const Scene& scene, const FirstMotionOptions& options,
                                 const MatchControl& control) {
  FirstMotion found{
      .focal = {}, .track = {}, .attitudes = {}, .note = {.field = "camera.track.file", .is_guess = true}};
  if (options.log != nullptr) found.note.field = "camera.track.attitude";  // its path stays
  const auto none = [&](const std::string& why) {
    found.note.text = "none: " + why + "; the camera keeps one attitude";
    return found;
  };
  if (footage.info().frame_count() < 2) return none("a single image shows no motion");
  if (footage.info().times_s.back() > kLongestMotion_s) {
    found.note.remedy = "`sigs ego-motion --into PROJECT` finds them";
    return none(fmt::format("turns are not sought in footage longer than {:.0f} s", kLongestMotion_s));
  }
  const EgoMotionControl following{.progress =
                                       [&](int done, int total) {
                                         if (control.progress) control.progress(double(done) / std::max(1, total));
                                       },
                                   .cancel = control.cancel};
  const Result<EgoMotion> motion = estimate_ego_motion(
      footage, scene.camera, {}, options.log,
      {.use_horizon = options.horizon_is_seen, .fits_focal_length = options.lens_is_guessed}, following);
  if (!motion && motion.error().kind == ErrorKind::interrupted) return fail(motion.error());
  if (!motion) return none(motion.error().text());
  if (const std::string why = why_no_motion(*motion, scene); !why.empty()) return none(why);
  if (motion->focal_factor != 1) found.focal = motion->focal_scale;
  found.track = track_of(*motion, footage.info().path);
  if (options.log != nullptr) add_log(*found.track, *options.log, *motion);
  found.attitudes = found_attitudes(*motion, {});
  found.note.is_guess = false;
  const char* const by =
      motion->gyro && motion->gyro->is_fused ? "by the images and the log's gyroscope" : "by the images";
  found.note.text = motion->level_sd_rad
                        ? fmt::format(
                              "the camera's attitude at each frame, {}, and the horizon in them, level to {:.1f} "
                              "degrees",
                              by, deg_of_rad(*motion->level_sd_rad))
                        : fmt::format(
                              "the camera's turns at each frame, {}; camera.attitude_deg is its attitude at the "
                              "start",
                              by);
  return found;
}

}  // namespace sigs
