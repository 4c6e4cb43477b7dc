// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>

#include "base/json.h"
#include "base/pose.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/logic_process.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/performance_inputs.h"
#include "cli/process.h"
#include "encounter/daa_file.h"
#include "encounter_model/model_flight.h"
#include "performance/risk.h"
#include "plot/plot.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRiskFooter =
    "Examples:\n"
    "  sigs risk report/sensor.json\n"
    "  sigs risk report/sensor.json --intruder uncor_1200only_fwse_v1p2.txt --manoeuvre descend --json risk.json\n"
    "  sigs risk report/sensor.json --labels datasets/mine --results found    # images and sensor model side by side\n"
    "  sigs risk report/sensor.json --shard 1/4 --json part1.json             # then, of all four:\n"
    "  sigs risk --merge part1.json part2.json part3.json part4.json --json risk.json";

struct RiskOptions {
  fs::path sensor;
  std::vector<fs::path> merge;
  std::vector<fs::path> intruders;
  fs::path own;
  std::vector<fs::path> pairs;
  PerformanceInputs images;
  RiskSettings settings;
  std::vector<double> own_speed, intruder_speed;
  std::string manoeuvre = "vertical-away";
  double alert_rate_deg_s = std::numeric_limits<double>::infinity();
  std::string volume = "small-uas";
  double turn_rate_deg_s = 11.5;
  double heading_change_deg = 90;
  fs::path logic;
  std::string logic_command;
  std::string shard;
  bool plain_sampling = false;
  int jobs = 0;
  fs::path json;
  fs::path plot;
  std::string progress = "auto";
  bool force = false;

  [[nodiscard]] std::vector<CommandOutput> outputs() const { return {{"--json", json}, {"--plot", plot}}; }
};

Result<EncounterModel> model_of_file(const fs::path& file) {
  Result<EncounterModel> model = read_encounter_model(file);
  if (!model) return model;
  for (const Warning& warning : model->warnings) print_warning(warning);
  if (const Result<void> flies = check_can_fly(*model); !flies) return fail(file.string(), flies.error().what);
  return model;
}

Result<std::array<double, 2>> speeds_of(const char* option, const std::vector<double>& given,
                                        const std::array<double, 2>& otherwise) {
  if (given.empty()) return otherwise;
  const std::array<double, 2> speeds{given.front(), given.back()};
  if (given.size() > 2 || speeds[0] > speeds[1])
    return fail(option, "must be one speed, or the lowest and the highest: 30,80", ErrorKind::usage);
  return speeds;
}

Result<void> read_pairs(const std::vector<fs::path>& files, std::vector<RiskPair>& pairs) {
  for (const fs::path& path : files) {
    const Result<EncounterFile> file = read_encounter_file(path.string());
    if (!file) return fail(file.error());
    for (const Warning& warning : file->warnings) print_warning(warning);
    for (std::size_t i = 1; i < file->tracks.size(); ++i) {
      RiskPair pair{.name = path.stem().string() + ": " + file->tracks[i].name,
                    .own = track_of(file->tracks[0]),
                    .intruder = track_of(file->tracks[i])};
      if (pair.own.first_s >= pair.intruder.last_s || pair.intruder.first_s >= pair.own.last_s)
        return fail(path.string(), "ownship and " + file->tracks[i].name + " share no time");
      pairs.push_back(std::move(pair));
    }
  }
  return {};
}

// "2/4"
Result<void> read_shard(const std::string& text, RiskSettings& settings) {
  if (text.empty()) return {};
  const std::optional<std::pair<int, int>> shard = fraction_of(text);
  if (!shard || shard->first < 1 || shard->first > shard->second || shard->second > 100'000)
    return fail("--shard " + text, "must be I/N, as in 2/4: the second of four", ErrorKind::usage);
  std::tie(settings.shard, settings.shards) = *shard;
  if (settings.until > 0)
    return fail("--shard", "and --until exclude each other: a shard does not know the others", ErrorKind::usage);
  return {};
}

Result<RiskSettings> settings_of(const RiskOptions& options) {
  RiskSettings settings = options.settings;
  Result<SensorModel> sensor = read_sensor_model(options.sensor);
  if (!sensor) return fail(sensor.error());
  settings.sensor = *std::move(sensor);
  RiskEncounters& encounters = settings.encounters;
  encounters.importance_sampling = !options.plain_sampling;
  const bool has_images = !options.images.sources.inputs.empty(), has_pairs = !options.pairs.empty();
  const bool is_drawn = !options.own.empty() || !options.intruders.empty() || !options.own_speed.empty() ||
                        !options.intruder_speed.empty();
  if ((has_images && has_pairs) || (is_drawn && (has_images || has_pairs)))
    return fail(has_images ? "--labels" : "--pairs", "has its flights: leave out all others", ErrorKind::usage);
  if (has_images && !options.shard.empty())
    return fail("--shard", "and --labels exclude each other: each of its encounters is flown once", ErrorKind::usage);
  if (!options.own.empty()) {
    Result<EncounterModel> model = model_of_file(options.own);
    if (!model) return fail(model.error());
    encounters.own_model = *std::move(model);
  }
  for (const fs::path& file : options.intruders) {
    Result<EncounterModel> model = model_of_file(file);
    if (!model) return fail(model.error());
    encounters.intruder_models.push_back(*std::move(model));
  }
  for (const auto& [option, given, speeds] :
       {std::tuple("--own-speed", &options.own_speed, &encounters.own_speed_mps),
        std::tuple("--intruder-speed", &options.intruder_speed, &encounters.intruder_speed_mps)}) {
    const Result<std::array<double, 2>> read = speeds_of(option, *given, *speeds);
    if (!read) return fail(read.error());
    *speeds = *read;
  }
  if (const Result<void> read = read_pairs(options.pairs, encounters.pairs); !read) return fail(read.error());
  const std::optional<ManoeuvreKind> kind = manoeuvre_named(options.manoeuvre);
  if (!kind) return fail("--manoeuvre " + options.manoeuvre, "there are " + listed(kManoeuvreNames), ErrorKind::usage);
  settings.manoeuvre.kind = *kind;
  settings.alert_rate_radps = rad_of_deg(options.alert_rate_deg_s);
  settings.manoeuvre.turn_rate_radps = rad_of_deg(options.turn_rate_deg_s);
  settings.manoeuvre.heading_change_rad = rad_of_deg(options.heading_change_deg);
  const Result<WellClearVolume> volume = well_clear_volume(options.volume);
  if (!volume) return fail(volume.error());
  settings.well_clear = *volume;
  if (const Result<void> shard = read_shard(options.shard, settings); !shard) return fail(shard.error());
  const unsigned cores = std::thread::hardware_concurrency();
  settings.threads = !options.logic_command.empty() ? 1
                     : options.jobs > 0             ? options.jobs
                                                    : static_cast<int>(std::max(1U, cores));
  if (!settings.sensor.is_field_known)
    print_warning({options.sensor.string(), "states no field of view: the sensor sees all around"});
  return settings;
}

Result<Logic> logic_of(const RiskOptions& options) {
  if (!options.logic.empty() && !options.logic_command.empty())
    return fail("--logic", "and --logic-command exclude each other", ErrorKind::usage);
  if (!options.logic_command.empty()) return logic_of_command(options.logic_command);
  if (options.logic.empty()) return Logic();
  const Result<std::string> text = read_text(options.logic);
  if (!text) return fail(text.error());
  return logic_table(*text, options.logic.string());
}

Result<RiskResult> flown(const RiskSettings& settings, const Logic& logic, const RiskOptions& options) {
  Progress progress(options.progress);
  std::mutex mutex;
  const auto total =
      static_cast<int>(std::min<std::int64_t>((settings.count + settings.shards - 1) / settings.shards, 2'000'000'000));
  Result<RiskResult> result = simulated_risk(settings, logic, &interrupt_flag(), [&](std::int64_t done) {
    const std::lock_guard lock(mutex);
    progress.update(static_cast<int>(std::min<std::int64_t>(done, total)), total, "encounters");
  });
  progress.end();
  // A signal from the keyboard ends the logic's program too, which then gives no answer.
  if (!result && is_cancelled(&interrupt_flag())) return fail(check_interrupt(&interrupt_flag()).error());
  return result;
}

Result<Json> merged(const RiskOptions& options) {
  std::vector<RiskShard> shards;
  std::vector<std::string> names;
  for (const fs::path& file : options.merge) {
    const Result<Json> json = json_of_file(file);
    if (!json) return fail(json.error());
    Result<RiskShard> shard = risk_shard_of(*json, file.string());
    if (!shard) return fail(shard.error());
    shards.push_back(*std::move(shard));
    names.push_back(file.string());
  }
  return merged_risk_json(shards, names);
}

// The encounters of a dataset, first as its images were detected, then as the sensor model draws.
Result<Json> compared(const RiskOptions& options, RiskSettings settings, const Logic& logic) {
  Result<ReadPerformance> read = read_performance(options.images);
  if (!read) return fail(read.error());
  const std::vector<ObservedEncounter>& observed = read->observations.encounters;
  for (const PerformanceClip& clip : read->clips)
    for (const TargetTruth& target : clip.detected.truth.targets) {
      std::optional<RiskPair> pair =
          risk_pair_of(clip.detected.truth, target, clip.detected.name, settings.encounters.after_s);
      if (!pair)
        return fail(clip.detected.name, "the truth has no places of the camera and the intruders; labels in xml have");
      for (const ObservedEncounter& one : observed)
        if (one.clip == clip.detected.name && one.target == target.id && one.declared)
          pair->declared_s = one.declared->time_s;
      pair->is_from_images = true;
      settings.encounters.pairs.push_back(std::move(*pair));
    }
  if (settings.encounters.pairs.empty()) return fail("--labels", "have no intruder");
  RiskSettings images = settings;
  images.count = std::ssize(images.encounters.pairs);
  const Result<RiskResult> by_images = flown(images, logic, options);
  if (!by_images) return fail(by_images.error());
  for (RiskPair& pair : settings.encounters.pairs) pair.is_from_images = false;
  const Result<RiskResult> by_model = flown(settings, logic, options);
  if (!by_model) return fail(by_model.error());
  Json json = risk_json(settings, *by_model);
  json["images"] = risk_json(images, *by_images);
  std::printf(
      "By the images (%lld encounters, each once):\n%s\nBy the sensor model (the same encounters, drawn again):\n",
      static_cast<long long>(images.count), risk_text(json["images"]).c_str());
  return json;
}

Result<void> run(const RiskOptions& options) {
  std::vector<fs::path> inputs{options.sensor, options.own, options.logic};  // empty ones are passed over
  for (const std::vector<fs::path>* files : {&options.merge, &options.intruders, &options.pairs})
    inputs.insert(inputs.end(), files->begin(), files->end());
  if (const Result<void> named = check_outputs(options.outputs(), inputs); !named) return named;
  if (options.sensor.empty() == options.merge.empty())
    return fail("SENSOR", "name a sensor model, which sigs evaluate performance --out writes, or --merge shards",
                ErrorKind::usage);
  if (options.images.sources.inputs.empty() != options.images.sources.results.empty())
    return fail("--labels", "and --results go together", ErrorKind::usage);
  OutputFiles files(options.force);
  defer_interrupts();
  if (const Result<void> free = files.reserve(options.outputs()); !free) return free;
  Result<Json> json = Json();
  if (!options.merge.empty()) {
    json = merged(options);
  } else {
    const Result<RiskSettings> settings = settings_of(options);
    if (!settings) return fail(settings.error());
    const Result<Logic> logic = logic_of(options);
    if (!logic) return fail(logic.error());
    if (!options.images.sources.inputs.empty()) {
      json = compared(options, *settings, *logic);
    } else {
      const Result<RiskResult> result = flown(*settings, *logic, options);
      if (!result) return fail(result.error());
      json = risk_json(*settings, *result);
    }
  }
  if (!json) return fail(json.error());
  const Result<void> written =
      files.write_and_commit({{options.json, [&] { return json_text(*json); }},
                              {options.plot, [&] { return png_bytes(image_of(risk_plot(*json))); }}});
  if (!written) return written;
  std::printf("%s", risk_text(*json).c_str());
  return {};
}

void add_encounter_options(CLI::App& command, RiskOptions& options) {
  RiskEncounters& encounters = options.settings.encounters;
  add_input(command, "--intruder", options.intruders,
            "encounter models that intruders fly by, each as often; else straight", "FILE ...");
  add_input(command, "--own", options.own,
            "an encounter model that the own aircraft flies by; else straight and level");
  add_input(command, "--pairs", options.pairs,
            "fly these pairs again and again: .daa, .txt or CSV, as sigs encounter reads", "FILE ...");
  for (const auto& [name, speeds, help] :
       {std::tuple("--own-speed", &options.own_speed,
                   "of straight flights, one or the lowest and the highest; else 25"),
        std::tuple("--intruder-speed", &options.intruder_speed, "the same; else 30,80")})
    add_value(command, name, *speeds, "MPS[,MPS]", help)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(from_to(0, 1e4));
  for (const auto& [name, value, most, help] :
       {std::tuple("--miss", &encounters.miss_m, 1e6, "horizontal offset at the closest approach, to both sides"),
        std::tuple("--vertical-miss", &encounters.vertical_miss_m, 1e5, "vertical offset, up and down")})
    add_figure(command, name, *value, "M", 0, most, help);
  add_number(command, "--lead", encounters.lead_s, "S", 1, 3600, "whole seconds before the closest approach");
  add_number(command, "--after", encounters.after_s, "S", 0, 3600, "whole seconds after it");
  command.add_flag("--plain-sampling", options.plain_sampling, "small misses are not drawn more often");
}

void add_manoeuvre_options(CLI::App& command, RiskOptions& options) {
  Manoeuvre& manoeuvre = options.settings.manoeuvre;
  command.add_option("--manoeuvre", options.manoeuvre, listed(kManoeuvreNames))
      ->type_name("NAME")
      ->capture_default_str();
  for (const auto& [name, value, unit, help] :
       {std::tuple("--delay", &manoeuvre.delay_s, "S", "from the declaration to the manoeuvre's begin"),
        std::tuple("--turn-rate", &options.turn_rate_deg_s, "DEG_S", "of turns"),
        std::tuple("--heading-change", &options.heading_change_deg, "DEG", "after which it flies straight"),
        std::tuple("--climb-rate", &manoeuvre.climb_mps, "MPS", "up or down"),
        std::tuple("--vertical-acceleration", &manoeuvre.vertical_acceleration_mps2, "MPS2", "until that rate"),
        std::tuple("--acceleration", &manoeuvre.acceleration_mps2, "MPS2", "of slow-down and speed-up"),
        std::tuple("--min-speed", &manoeuvre.min_speed_mps, "MPS", "of slow-down"),
        std::tuple("--max-speed", &manoeuvre.max_speed_mps, "MPS", "of speed-up")})
    add_figure(command, name, *value, unit, 0, 1e6, help);
  add_range(command, "--height-change", manoeuvre.height_change_m, "M", 0, 1e6,
            "after which it flies level; else never");
  add_range(command, "--alert-range", options.settings.alert_range_m, "M", 0, 1e9,
            "a track declared farther away waits; else none does");
  add_range(command, "--alert-rate", options.alert_rate_deg_s, "DEG_S", 0, 1e6,
            "a track whose line of sight turns faster waits; else none does: a collision course does not turn");
  add_input(command, "--logic", options.logic, "a table of rules that decides instead: bearing_min_deg, ..., manoeuvre",
            "CSV");
  add_value(command, "--logic-command", options.logic_command, "COMMAND",
            "a program that decides: it reads a JSON object a line and answers with a manoeuvre's name a line");
}

}  // namespace

Command add_risk_command(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("risk", "the risk ratio with a sensor and a manoeuvre, over many simulated encounters");
  const auto options = std::make_shared<RiskOptions>();
  command->add_option("SENSOR", options->sensor,
                      "a sensor model: sensor.json in the report of sigs evaluate performance");
  add_encounter_options(*command, *options);
  add_manoeuvre_options(*command, *options);
  command->add_option("--well-clear", options->volume, "a volume by name, as sigs encounter takes it")
      ->type_name("NAME")
      ->capture_default_str();
  add_number(*command, "--count", options->settings.count, "N", std::int64_t{1}, std::int64_t{1'000'000'000},
             "encounters at most");
  add_figure(*command, "--until", options->settings.until, "SHARE", 0, 1,
             "stop when half the 95 % interval of the NMAC ratio is within this share of it; 0: fly all");
  add_number(*command, "--seed", options->settings.seed, "S", std::uint64_t{0},
             std::numeric_limits<std::uint64_t>::max(), "the same seed gives the same encounters");
  add_input(*command, "--labels", options->images.sources.inputs,
            "compare with images: labels or a dataset, whose encounters are flown", "FILES|DIR");
  add_input(*command, "--results", options->images.sources.results, "of the detector on these images", "FILES|DIR");
  add_value(*command, "--split", options->images.sources.split, "NAME", "of the dataset");
  add_value(*command, "--shard", options->shard, "I/N", "only these of the encounters");
  add_input(*command, "--merge", options->merge, "results of all shards, instead of SENSOR", "FILES ...");
  add_number(*command, "--jobs", options->jobs, "N", 0, 1024, "threads; 0: as many as there are cores");
  add_output(*command, "--json", options->json, "write all figures and settings");
  add_output(*command, "--plot", options->plot, "draw the ratios by class; a PNG");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kRiskFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
