// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encounter/encounter.h"
#include "project/project.h"
#include "scene/scene.h"

namespace sigs::editor {

// What the timeline and the inspector show of an intruder's encounter with the camera, known without rendering.

// The volumes that the editor shows: those of export.encounter that there are, in its order; `small-uas` where it names
// none.
[[nodiscard]] std::vector<WellClearVolume> shown_volumes(const Project& project);

// From one moment to another, in frames of the footage with fractions, and in seconds.
struct LossStretch {
  double first_frame = 0;
  double last_frame = 0;
  TimeInterval time_s;
  // False: it is lost in the first frame, or in the last one, already; what comes before or after is not known.
  bool has_entry = true;
  bool has_exit = true;

  // The first and the last whole frame within; the nearest one where there is none.
  [[nodiscard]] int entry_frame() const;
  [[nodiscard]] int exit_frame() const;
};

struct VolumeLosses {
  WellClearVolume volume;
  std::vector<LossStretch> losses;  // by time
};

struct EncounterSurvey {
  NearestMoment nearest;  // by horizontal distance
  double nearest_frame = 0;
  std::vector<VolumeLosses> volumes;  // those of shown_volumes()
  // One a frame each, from first_frame on. tau_mod is that of the first volume; infinite where the distance does not
  // fall.
  int first_frame = 0;
  std::vector<double> horizontal_range_m;
  std::vector<double> tau_mod_s;

  // Whether the frame lies within a loss of the volume with this index.
  [[nodiscard]] bool is_lost(std::size_t volume, double frame) const;
};

// Over the scene's frames.
//   intruder  index in Scene::intruders
//   volumes   one at least
// Places that are not finite: no losses, and no values.
[[nodiscard]] EncounterSurvey encounter_survey(const Scene& scene, int intruder,
                                               const std::vector<WellClearVolume>& volumes);

}  // namespace sigs::editor
