// SPDX-License-Identifier: MIT
#include "first_project/planning_steps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "appearance/appearance.h"
#include "base/pose.h"
#include "base/text.h"
#include "ego_motion/ego_motion.h"

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
  for (const NoteGroup& group : kGroups) notes.push_back(note_of(group, quantities));
  notes.push_back(codec_note(*seen, project));
  const std::vector<FirstProjectNote> light = light_notes(seen->surroundings);
  notes.insert(notes.begin(), light.begin(), light.end());
  return notes;
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
