// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "project/project.h"

namespace sigs {

class InputChecksums;  // entry.h

// Backgrounds with "appearance": "matched": how their footage looks is measured once, before the first video of it is
// made, and stands in the project of each of its videos as `sigs appearance PROJECT --into PROJECT` would write it.

// A clip whose look is to be measured.
struct ClipToMeasure {
  Project project;  // with the background's footage, camera, light and appearance, and no intruder; paths are absolute
  bool height_is_guess = false;  // as hints_of() takes it
  std::string where;             // recipe and key, for errors and warnings
};

// What was measured in a clip.
struct MeasuredLook {
  Json settings;                       // nested as in a project file: those of applied_settings() (appearance.h)
  std::vector<std::string> not_shown;  // quantities that the clip does not show: their settings have defaults or stay

  [[nodiscard]] bool operator==(const MeasuredLook&) const = default;
};

// Whether a setting of a project is one that measures may set: its appearance, its light, compositing.blur_px_per_m.
[[nodiscard]] inline bool may_be_measured(const std::string& key) {
  return key.starts_with("appearance.") || key.starts_with("light.") || key == "compositing.blur_px_per_m";
}

// Puts a look into a project.
//   stated  keys of settings that stay; where they make the light a lamp (light.position_m or light.ambient, or
//           light.kind in a project in which that is "point"), all of the light stays
void put_look(const MeasuredLook& look, const std::set<std::string>& stated, Project& project);

// As entry.json and index.json have it, and back; throws what the JSON library does where it is something else.
[[nodiscard]] Json described(const MeasuredLook& look);
[[nodiscard]] MeasuredLook look_of(const Json& json);

struct MeasuringControl {
  std::function<void(int done, int total, const std::string& clip)> measuring;  // parts of the whole, and the file
  std::function<void(const Warning&)> warn;
  const std::atomic<bool>* cancel = nullptr;
};

// The looks of the clips of a plan. Clips are named by their places in the plan's list.
class ClipLooks {
 public:
  // program: name and version, on which measures depend. The clips must outlive the object.
  ClipLooks(const std::vector<ClipToMeasure>& clips, std::string program)
      : clips_(clips), program_(std::move(program)) {}

  // Computes the keys of these clips; the functions below are for clips that have one.
  void find_keys(const std::set<std::size_t>& clips, InputChecksums& inputs);

  // One checksum of all that the look of a clip depends on. Errors: those of fingerprint_of().
  [[nodiscard]] const Result<std::string>& key_of(std::size_t clip) const { return keys_.at(clip); }

  // Takes a look that was measured before. False: another one is known, which stays.
  [[nodiscard]] bool take(std::size_t clip, const MeasuredLook& look);

  // Measures those of the clips whose look is not known, one after the other, in the frames that their projects name.
  // What a clip does not show is said in one warning. After `cancel` was set some stay unknown.
  void measure(const std::set<std::size_t>& clips, const MeasuringControl& control);

  // Null: not known. An error, which names the recipe's key: it cannot be measured.
  [[nodiscard]] const Result<MeasuredLook>* of(std::size_t clip) const;

 private:
  const std::vector<ClipToMeasure>& clips_;
  std::string program_;
  std::map<std::size_t, Result<std::string>> keys_;
  std::map<std::string, Result<MeasuredLook>> looks_;  // by key
};

}  // namespace sigs
