// SPDX-License-Identifier: MIT
#include "editor/preview/encounter_survey.h"

#include <algorithm>
#include <cmath>

#include "scene/encounter_tracks.h"

namespace sigs::editor {

namespace {

constexpr double kFrameRounding = 1e-6;  // a loss that begins this little after a frame begins in it

int whole_frame(double frame) {
  return static_cast<int>(std::clamp(frame, -1e9, 1e9));
}

VolumeLosses losses_of(const VolumeOutcome& outcome, const EncounterSummary& summary, const FootageShape& footage) {
  VolumeLosses result{.volume = outcome.volume};
  for (const TimeInterval& loss : outcome.losses)
    result.losses.push_back({.first_frame = frame_at_time(footage, loss.begin_s),
                             .last_frame = frame_at_time(footage, loss.end_s),
                             .time_s = loss,
                             .has_entry = loss.begin_s > summary.first_s,
                             .has_exit = loss.end_s < summary.last_s});
  return result;
}

}  // namespace

std::vector<WellClearVolume> shown_volumes(const Project& project) {
  std::vector<WellClearVolume> volumes;
  for (const std::string& name : project.output.encounter)
    if (const Result<WellClearVolume> volume = well_clear_volume(name); volume) volumes.push_back(*volume);
  if (volumes.empty()) volumes.push_back(well_clear_volume("small-uas").value());
  return volumes;
}

int LossStretch::entry_frame() const {
  const double first = std::ceil(first_frame - kFrameRounding);
  return whole_frame(first <= last_frame ? first : std::round(first_frame));
}

int LossStretch::exit_frame() const {
  const double last = std::floor(last_frame + kFrameRounding);
  return whole_frame(last >= first_frame ? last : std::round(last_frame));
}

bool EncounterSurvey::is_lost(std::size_t volume, double frame) const {
  const std::vector<LossStretch>& losses = volumes[volume].losses;
  return std::any_of(losses.begin(), losses.end(), [&](const LossStretch& loss) {
    return frame >= loss.first_frame - kFrameRounding && frame <= loss.last_frame + kFrameRounding;
  });
}

EncounterSurvey encounter_survey(const Scene& scene, int intruder, const std::vector<WellClearVolume>& volumes) {
  EncounterSurvey survey{.first_frame = scene.first_frame};
  const EncounterTrack own = encounter_track_of_camera(scene);
  const EncounterTrack flight = encounter_track_of_intruder(scene, static_cast<std::size_t>(intruder));
  const Result<EncounterSummary> summary = encounter_of(own, flight, {.volumes = volumes, .row_times_s = {}});
  if (!summary) return survey;
  survey.nearest = summary->nearest_horizontal;
  survey.nearest_frame = frame_at_time(scene.footage, survey.nearest.time_s);
  for (const VolumeOutcome& outcome : summary->volumes)
    survey.volumes.push_back(losses_of(outcome, *summary, scene.footage));
  for (int frame = scene.first_frame; frame <= scene.last_frame; ++frame) {
    const double time_s = time_of_frame_s(scene.footage, frame);
    const RelativeState state = relative_state(own.at(time_s), flight.at(time_s));
    survey.horizontal_range_m.push_back(std::hypot(state.horizontal_m.x, state.horizontal_m.y));
    survey.tau_mod_s.push_back(tau_mod_s(state, volumes.front().dmod_m));
  }
  return survey;
}

}  // namespace sigs::editor
