// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "encounter/daa_file.h"
#include "encounter/encounter.h"
#include "encounter/well_clear.h"
#include "scene/flight.h"
#include "scene/opened_project.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPlotted = 8;  // encounters in one plot

constexpr const char* kEncounterFooter =
    "Examples:\n"
    "  sigs encounter projects/head-on/head-on.json\n"
    "  sigs encounter pair.daa --volume dwc-en-route --json pair.json --plot pair.png\n"
    "  sigs encounter pair.csv --volume small-uas --zthr-ft 300\n"
    "  sigs encounter encounter.json --daa encounter.daa";

struct EncounterOptions {
  fs::path file;
  std::vector<std::string> volumes;  // by name; empty: all of the table
  // Limits of a volume of the user's own, in the units of its options; none: those of the first volume.
  std::optional<double> dmod_ft;
  std::optional<double> hmd_ft;
  std::optional<double> tau_s;
  std::optional<double> zthr_ft;
  std::optional<double> tcoa_s;
  std::string intruder;  // empty: all
  fs::path json;         // empty: not written; likewise the others
  fs::path plot;
  fs::path daa;
  bool force = false;

  [[nodiscard]] bool has_own_volume() const { return dmod_ft || hmd_ft || tau_s || zthr_ft || tcoa_s; }
  [[nodiscard]] std::vector<CommandOutput> outputs() const {
    return {{"--json", json}, {"--plot", plot}, {"--daa", daa}};
  }
};

// What a file or a project says: flights, and the times of its steps.
struct Flights {
  std::vector<EncounterTrack> tracks;  // the ownship first
  std::vector<SampledTrack> samples;   // the same, for --daa
  std::vector<double> steps_s;
};

// Those named, each once, and then the user's own. Error usage.
Result<std::vector<WellClearVolume>> volumes_of(const EncounterOptions& options) {
  std::vector<WellClearVolume> volumes;
  for (const std::string& name : options.volumes) {
    const Result<WellClearVolume> volume = well_clear_volume(name);
    if (!volume) return fail("--volume " + line_text(name), volume.error().what, ErrorKind::usage);
    if (std::ranges::find(volumes, volume->name, &WellClearVolume::name) == volumes.end()) volumes.push_back(*volume);
  }
  if (options.has_own_volume()) {
    WellClearVolume own = volumes.empty() ? well_clear_volumes().front() : volumes.front();
    own.name = "own";
    if (options.dmod_ft) own.dmod_m = *options.dmod_ft * kFoot_m;
    // The table's volumes have one distance for both.
    if (options.dmod_ft && !options.hmd_ft) own.hmd_m = own.dmod_m;
    if (options.hmd_ft) own.hmd_m = *options.hmd_ft * kFoot_m;
    if (options.tau_s) own.tau_mod_s = *options.tau_s;
    if (options.zthr_ft) own.zthr_m = *options.zthr_ft * kFoot_m;
    if (options.tcoa_s) own.tcoa_s = *options.tcoa_s;
    volumes.push_back(own);
  }
  if (volumes.empty()) volumes.assign(well_clear_volumes().begin(), well_clear_volumes().end());
  return volumes;
}

SampledTrack sampled(const EncounterTrack& track, const std::vector<double>& times_s) {
  SampledTrack samples{.name = track.name, .has_velocities = true};
  for (const double time_s : times_s) samples.samples.push_back({time_s, track.at(time_s)});
  return samples;
}

Result<Flights> flights_of_project(const Project& project) {
  const Result<OpenedProject> opened = open_project(project, &interrupt_flag());
  if (!opened) return fail(opened.error());
  for (const Warning& warning : opened->warnings) print_warning(warning);
  const Scene& scene = opened->scene;
  if (scene.intruders.empty())
    return fail(project.file.string() + ": intruders", "is empty; an encounter needs one", ErrorKind::bad_project);
  Flights flights{.tracks = encounter_tracks_of(scene, {scene.first_frame, scene.last_frame}),
                  .steps_s = times_of_frames_s(scene)};
  for (const EncounterTrack& track : flights.tracks) flights.samples.push_back(sampled(track, flights.steps_s));
  return flights;
}

Result<Flights> flights_of_file(const fs::path& path) {
  Result<EncounterFile> file = read_encounter_file(path.string());
  if (!file) return fail(file.error());
  for (const Warning& warning : file->warnings) print_warning(warning);
  Flights flights;
  for (const TrackSample& sample : file->tracks.front().samples) flights.steps_s.push_back(sample.time_s);
  for (const SampledTrack& track : file->tracks) flights.tracks.push_back(track_of(track));
  flights.samples = std::move(file->tracks);
  return flights;
}

Result<Flights> flights_of(const EncounterOptions& options) {
  const Result<std::optional<Project>> project = project_in(options.file);
  if (!project) return fail(project.error());
  if (!*project) return flights_of_file(options.file);
  const std::vector<fs::path> outputs{options.json, options.plot, options.daa};
  if (const Result<void> kept = check_inputs_not_overwritten(**project, outputs); !kept) return fail(kept.error());
  return flights_of_project(**project);
}

// The ownship and the intruders asked for. Error usage where there is none of that name.
Result<Flights> chosen(Flights flights, const EncounterOptions& options) {
  if (options.intruder.empty()) return flights;
  Flights some{.tracks = {flights.tracks[0]}, .samples = {flights.samples[0]}, .steps_s = flights.steps_s};
  std::vector<std::string> others;
  for (std::size_t i = 1; i < flights.tracks.size(); ++i) {
    others.push_back(line_text(flights.tracks[i].name));
    if (lower_case(flights.tracks[i].name) != lower_case(options.intruder)) continue;
    some.tracks.push_back(flights.tracks[i]);
    some.samples.push_back(flights.samples[i]);
  }
  if (some.tracks.size() > 1) return some;
  if (others.size() > 10) others.resize(10);
  return fail("--intruder " + line_text(options.intruder), "no such aircraft; there are " + listed(others),
              ErrorKind::usage);
}

Result<std::string> plot_of(const std::vector<EncounterSummary>& encounters, const EncounterOptions& options) {
  if (encounters.size() > kMaxPlotted)
    return fail("--plot " + options.plot.string(),
                fmt::format("draws at most {} encounters, there are {}; choose one with --intruder", kMaxPlotted,
                            encounters.size()),
                ErrorKind::usage);
  const cv::Mat image = encounter_plot(encounters);
  if (image.empty()) return fail(options.file.string(), "has no step in the time that both fly, to be drawn");
  return png_bytes(image);
}

Result<void> encounter(const EncounterOptions& options) {
  if (const Result<void> named = check_outputs(options.outputs(), {options.file}); !named) return named;
  const Result<std::vector<WellClearVolume>> volumes = volumes_of(options);
  if (!volumes) return fail(volumes.error());
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> free = files.reserve(options.outputs()); !free) return free;
  Result<Flights> all = flights_of(options);
  if (!all) return fail(all.error());
  const Result<Flights> flights = chosen(*std::move(all), options);
  if (!flights) return fail(flights.error());
  std::vector<EncounterSummary> encounters;
  for (std::size_t i = 1; i < flights->tracks.size(); ++i) {
    Result<EncounterSummary> summary =
        encounter_of(flights->tracks[0], flights->tracks[i], {.volumes = *volumes, .row_times_s = flights->steps_s});
    if (interrupt_flag()) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
    if (!summary) return fail(options.file.string() + ": " + line_text(summary.error().where), summary.error().what);
    encounters.push_back(*std::move(summary));
  }
  const Result<void> written = files.write_and_commit(
      {{options.json, [&] { return encounter_json_text(encounters, options.file.filename().string()); }},
       {options.daa, [&] { return daa_text(flights->samples); }},
       {options.plot, [&] { return plot_of(encounters, options); }}});
  if (!written) return written;
  for (const EncounterSummary& summary : encounters)
    std::printf("%s%s", &summary == encounters.data() ? "" : "\n", encounter_report_text(summary).c_str());
  return {};
}

}  // namespace

Command add_encounter_command(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("encounter", "how near two aircraft come, and when they lose well clear");
  const auto options = std::make_shared<EncounterOptions>();
  add_subject(*command, "FILE", options->file,
              "a project, or flights: DAIDALUS .daa or .txt, or a CSV with columns own_east_ft, int_east_ft, ...");
  add_value(*command, "--volume", options->volumes, "NAME",
            "a volume by name, may be repeated: dwc-en-route, dwc-non-cooperative, dwc-terminal, small-uas, nmac")
      ->allow_extra_args(false);
  add_range(*command, "--dmod-ft", options->dmod_ft, "FT", 0, 1e9,
            "a volume \"own\": like the first one but for its DMOD");
  add_range(*command, "--hmd-ft", options->hmd_ft, "FT", 0, 1e9, "its HMD (that of --dmod-ft)");
  add_range(*command, "--tau-s", options->tau_s, "S", 0, 1e9, "its modified tau");
  add_range(*command, "--zthr-ft", options->zthr_ft, "FT", 0, 1e9, "its vertical limit");
  add_range(*command, "--tcoa-s", options->tcoa_s, "S", 0, 1e9, "its time to co-altitude");
  add_value(*command, "--intruder", options->intruder, "NAME", "only this aircraft against the ownship");
  add_output(*command, "--json", options->json, "write all quantities at each step, and the intervals");
  add_output(*command, "--plot", options->plot, "draw range, times and vertical offset; a PNG");
  add_output(*command, "--daa", options->daa, "write the flights as a file for DAIDALUS");
  command->add_flag("--force", options->force, "overwrite what is there");
  command->footer(kEncounterFooter);
  return [options] { return encounter(*options); };
}

}  // namespace sigs::cli
