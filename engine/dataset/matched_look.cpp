// SPDX-License-Identifier: MIT
#include "dataset/matched_look.h"

#include <filesystem>

#include "appearance/appearance.h"
#include "base/text.h"
#include "base/threads.h"
#include "dataset/entry.h"
#include "project/fields.h"
#include "project/json.h"

namespace sigs {

namespace {

// The paper's point light is stated, which the measured light of sun and sky would replace.
bool states_lamp(const std::set<std::string>& stated, const Project& project) {
  return stated.contains("light.position_m") || stated.contains("light.ambient") ||
         (stated.contains("light.kind") && project.light.kind == LightKind::point);
}

Result<MeasuredLook> measured_look(const ClipToMeasure& clip, const AppearanceControl& control) {
  const FootageSettings& footage = clip.project.footage;
  const Result<Appearance> found = appearance_of_footage(
      clip.project, {.first = footage.first_frame, .last = footage.last_frame}, clip.height_is_guess, control);
  if (!found && found.error().kind == ErrorKind::interrupted) return fail(found.error());
  if (!found) return fail(clip.where, "cannot be measured: " + found.error().text(), found.error().kind);
  Project project = clip.project;
  apply(*found, project);
  MeasuredLook look{.settings = settings_json(std::move(project), applied_settings(*found)),
                    .not_shown = names_of_unknown(*found)};
  if (control.warn && !look.not_shown.empty())
    control.warn({std::filesystem::path(footage.video).filename().string(),
                  "does not show: " + listed(look.not_shown) + "; their defaults are taken"});
  return look;
}

}  // namespace

void put_look(const MeasuredLook& look, const std::set<std::string>& stated, Project& project) {
  const bool keeps_light = states_lamp(stated, project);
  for (const Field& field : fields_of(project)) {
    if (!may_be_measured(field.key) || stated.contains(field.key)) continue;
    if (keeps_light && field.key.starts_with("light.")) continue;
    if (const Json::json_pointer place = pointer_of(field.key); look.settings.contains(place))
      static_cast<void>(put_json(look.settings.at(place), field));
  }
}

Json described(const MeasuredLook& look) {
  return {{"settings", look.settings}, {"not_shown", look.not_shown}};
}

MeasuredLook look_of(const Json& json) {
  return {.settings = json.at("settings"), .not_shown = json.at("not_shown").get<std::vector<std::string>>()};
}

void ClipLooks::find_keys(const std::set<std::size_t>& clips, InputChecksums& inputs) {
  for (const std::size_t index : clips) {
    const ClipToMeasure& clip = clips_[index];
    keys_.emplace(index,
                  fingerprint_of(clip.project, program_ + (clip.height_is_guess ? "\nheight guessed" : ""), inputs));
  }
}

bool ClipLooks::take(std::size_t clip, const MeasuredLook& look) {
  const Result<MeasuredLook>& known = looks_.emplace(*key_of(clip), look).first->second;
  return known && *known == look;
}

void ClipLooks::measure(const std::set<std::size_t>& clips, const MeasuringControl& control) {
  std::vector<std::size_t> unknown;  // clips may share a key
  std::set<std::string> keys;
  for (const std::size_t clip : clips)
    if (const std::string& key = *key_of(clip); !looks_.contains(key) && keys.insert(key).second)
      unknown.push_back(clip);
  constexpr int kParts = 1000;  // of each clip
  const int total = kParts * static_cast<int>(unknown.size());
  for (int i = 0; kParts * i < total && !is_cancelled(control.cancel); ++i) {
    const ClipToMeasure& clip = clips_[unknown[static_cast<std::size_t>(i)]];
    const std::string name = std::filesystem::path(clip.project.footage.video).filename().string();
    const AppearanceControl following{.progress =
                                          [&](int done, int frames) {
                                            if (control.measuring)
                                              control.measuring(kParts * i + kParts * done / frames, total, name);
                                          },
                                      .cancel = control.cancel,
                                      .warn =
                                          [&](const Warning& warning) {
                                            if (control.warn) control.warn({clip.where, warning.text()});
                                          }};
    looks_.emplace(*key_of(unknown[static_cast<std::size_t>(i)]),
                   guarded([&] { return measured_look(clip, following); }));
  }
}

const Result<MeasuredLook>* ClipLooks::of(std::size_t clip) const {
  const auto look = looks_.find(*key_of(clip));
  return look == looks_.end() ? nullptr : &look->second;
}

}  // namespace sigs
