// SPDX-License-Identifier: MIT
#include "first_project/first_match.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "appearance/appearance.h"
#include "appearance/project_hints.h"

namespace sigs {

namespace {

// Settings that one note is about.
struct NoteGroup {
  const char* field;
  std::initializer_list<std::string_view> settings;  // keys, or beginnings of keys that end in a point
};

const NoteGroup kGroups[] = {
    {"appearance.point_spread_px",
     {"appearance.point_spread_px", "appearance.sharpening", "appearance.sharpening_px"}},
    {"appearance.chroma_spread_px", {"appearance.chroma_spread_px"}},
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
  sun.text = sun.is_guess ? "behind the camera, as what people point one at is mostly lit: " + seen.sun.azimuth_rad.why +
                                "; set light.sun.* as the footage's own things are lit"
                          : "the sun's direction " + how_found(seen.sun.witness);
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

}  // namespace sigs
