// SPDX-License-Identifier: MIT
#include "export/export_files.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "encounter/encounter.h"
#include "labels/label_files.h"
#include "scene/flight.h"

namespace sigs {

namespace {

Result<std::vector<WellClearVolume>> volumes_of(const Project& project) {
  std::vector<WellClearVolume> volumes;
  for (const std::string& name : project.output.encounter) {
    Result<WellClearVolume> volume = well_clear_volume(name);
    if (!volume) return fail(project.file.string() + ": export.encounter", volume.error().what, ErrorKind::bad_project);
    volumes.push_back(*std::move(volume));
  }
  return volumes;
}

EncounterTruth truth_of(const EncounterRow& row, const std::vector<VolumeOutcome>& volumes) {
  const RelativeQuantities& q = row.quantities;
  EncounterTruth truth{.range_rate_mps = q.range_rate_mps,
                       .closing_speed_mps = q.closing_speed_mps,
                       .bearing_rad = q.bearing_rad,
                       .elevation_rad = q.elevation_rad,
                       .hmd_m = q.hmd_m,
                       .vmd_m = q.vmd_m,
                       .time_to_closest_approach_s = q.time_to_closest_s,
                       .time_to_coaltitude_s = q.time_to_coaltitude_s};
  truth.of_volumes.reserve(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const RowOfVolume& one = row.of_volumes[i];
    truth.of_volumes.push_back({volumes[i].volume.name, one.is_lost, one.tau_mod_s, one.severity});
  }
  return truth;
}

// The row of that time; nullptr where the encounter has none, or where a path is not finite at this time.
const EncounterRow* row_at(const EncounterSummary& encounter, double time_s) {
  const auto row =
      std::lower_bound(encounter.rows.begin(), encounter.rows.end(), time_s,
                       [](const EncounterRow& candidate, double wanted_s) { return candidate.time_s < wanted_s; });
  const bool is_there =
      row != encounter.rows.end() && row->time_s == time_s && is_finite(relative_state(row->own, row->intruder));
  return is_there ? &*row : nullptr;
}

}  // namespace

Result<ExportedEncounters> ExportedEncounters::of(const Project& project, const Scene& scene,
                                                  const FrameRange& frames) {
  const Result<std::vector<WellClearVolume>> volumes = volumes_of(project);
  if (!volumes) return fail(volumes.error());
  ExportedEncounters exported;
  exported.source_ = project.name;
  exported.first_frame_ = frames.first;
  for (int frame = frames.first; frame <= frames.last; ++frame)
    exported.times_s_.push_back(time_of_frame_s(scene.footage, frame));
  const EncounterSettings settings{.volumes = *volumes, .row_times_s = times_of_frames_s(scene, frames)};
  const std::vector<EncounterTrack> tracks = encounter_tracks_of(scene, frames);
  for (std::size_t i = 1; i < tracks.size(); ++i) {
    Result<EncounterSummary> encounter = encounter_of(tracks[0], tracks[i], settings);
    if (!encounter)
      return fail(project.file.string() + ": " + line_text(encounter.error().where), encounter.error().what);
    exported.encounters_.push_back(*std::move(encounter));
  }
  return exported;
}

void ExportedEncounters::add_to(FrameTruth& truth) const {
  const double time_s = times_s_.at(static_cast<std::size_t>(truth.index - first_frame_));
  for (IntruderTruth& intruder : truth.intruders) {
    const EncounterSummary& encounter = encounters_.at(static_cast<std::size_t>(intruder.id));
    if (const EncounterRow* const row = row_at(encounter, time_s))
      intruder.encounter = truth_of(*row, encounter.volumes);
  }
}

Result<void> ExportedEncounters::write_json(const std::filesystem::path& path) const {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  const Result<void> written =
      put_encounter_json(encounters_, source_, [&file](std::string_view text) { return file->put(text); });
  return written ? file->close() : written;
}

}  // namespace sigs
