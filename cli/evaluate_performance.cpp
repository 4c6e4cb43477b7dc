// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/json.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/evaluation_folder.h"
#include "cli/options.h"
#include "cli/performance_inputs.h"
#include "cli/process.h"
#include "performance/performance_report.h"
#include "performance/risk.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEvaluatePerformanceFooter =
    "Examples:\n"
    "  sigs evaluate performance datasets/mine --results found --out report\n"
    "  sigs evaluate performance datasets/mine --split test --results coco_results.json --declare 4/8 --latency 0.2\n"
    "  sigs evaluate performance a.xml b.xml --results a.csv b.csv --calibration camera.xml --own-speed 30\n"
    "  sigs evaluate performance datasets/mine --results found --risk risk.json --out report --force";

struct PerformanceOptions {
  PerformanceInputs read;
  int min_encounters = 10;
  AirSpeeds speeds;
  NeededTimes times;
  fs::path risk;
  fs::path coverage;
  fs::path folder;
  bool force = false;
};

Result<PerformanceReport> report_of(const PerformanceOptions& options) {
  Result<ReadPerformance> read = read_performance(options.read);
  if (!read) return fail(read.error());
  const std::vector<PerformanceClip>& clips = read->clips;
  PerformanceReport report{
      .performance = performance_of(std::move(read->observations), read->policy, options.min_encounters),
      .speeds = options.speeds,
      .times = options.times};
  for (const PerformanceClip& clip : clips) report.clips.push_back(clip.detected.name);
  report.needed = needed_ranges(report.performance, report.speeds, report.times);
  std::optional<FieldOfView> field;
  for (const PerformanceClip& clip : clips)
    if (!field && clip.ray_of_pixel) field = field_of_view_of(clip.ray_of_pixel, clip.detected.truth.footage.size_px);
  if (report.performance.encounters.size() >= 2) {
    Result<SensorFit> fit = fitted_sensor_model(report.performance, field);
    if (!fit) return fail(fit.error());
    report.sensor = *std::move(fit);
    report.check = checked_sensor_model(report.performance);
    if (!field)
      report.remarks.emplace_back(
          "the lens is not known: the sensor model sees all around (--calibration states the lens)");
  } else {
    report.remarks.emplace_back("no sensor model: it needs at least two encounters in view");
  }
  if (static_cast<int>(report.performance.encounters.size()) < options.min_encounters)
    report.remarks.push_back("all figures are of " +
                             count_text(std::ssize(report.performance.encounters), "encounter") +
                             ": too few to conclude from");
  for (const auto& [file, json, check] : {std::tuple(&options.risk, &report.risk, &check_risk_json),
                                          std::tuple(&options.coverage, &report.coverage, &check_coverage_json)}) {
    if (file->empty()) continue;
    Result<Json> text = json_of_file(*file);
    if (!text) return fail(text.error());
    *json = *std::move(text);
    if (const Result<void> good = check(*json, file->string()); !good) return fail(good.error());
  }
  if (report.risk.is_object() && report.sensor &&
      report.risk["settings"].value("sensor_model", Json()) != Json::parse(sensor_model_json(report.sensor->model)))
    report.remarks.push_back(options.risk.string() + " was flown with another sensor model than this report's");
  std::set<std::string> footage;
  for (const PerformanceClip& clip : clips) footage.insert(clip.detected.truth.footage.video);
  if (clips.size() >= 10 && footage.size() * 5 <= clips.size())
    report.remarks.push_back(count_text(std::ssize(clips), "clip") + " show " +
                             count_text(std::ssize(footage), "video") +
                             ": encounters before the same footage are less independent than the intervals suppose");
  if (2 * report.performance.declared_at_once > report.performance.encounters_declared)
    report.remarks.emplace_back(
        "most declarations came with the first frames in view: the sensor may reach farther than these clips show");
  return report;
}

Result<void> run(const PerformanceOptions& options) {
  const Result<DetectInputs> inputs = detect_inputs(options.read.sources);
  if (!inputs) return fail(inputs.error());
  defer_interrupts();
  std::vector<fs::path> read = files_read(options.read.sources, *inputs);
  read.insert(read.end(), options.read.empty.begin(), options.read.empty.end());
  for (const fs::path& file : {options.read.calibration, options.risk, options.coverage})
    if (!file.empty()) read.push_back(file);
  Result<std::optional<EvaluationFolder>> folder = EvaluationFolder::reserved(options.folder, options.force, read);
  if (!folder) return fail(folder.error());
  const Result<PerformanceReport> report = report_of(options);
  if (!report) return fail(report.error());
  std::printf("%s", performance_text(*report).c_str());
  std::fflush(stdout);
  for (const std::string& remark : report->remarks) print_warning({"", remark});
  if (!*folder) return {};
  return (*folder)->commit(write_report((*folder)->staging_path(), *report));
}

void add_performance_options(CLI::App& command, PerformanceOptions& options) {
  command.add_option("--declare", options.read.declare, "a track is declared where M of the last N frames match")
      ->type_name("M/N")
      ->capture_default_str();
  constexpr double kMost = 1e6;
  for (const auto& [name, value, unit, high, help] :
       {std::tuple("--latency", &options.read.policy.latency_s, "S", kMost,
                   "reports are known so much after their frame"),
        std::tuple("--match-overlap", &options.read.policy.matching.match_overlap, "SHARE", 1.0,
                   "extended overlap of a match"),
        std::tuple("--min-area", &options.read.policy.matching.min_area_px2, "PX2", kMost,
                   "smaller true boxes are grown to it"),
        std::tuple("--own-speed", &options.speeds.own_mps, "MPS", kMost, "of the own aircraft, for the range needed"),
        std::tuple("--intruder-speed", &options.speeds.intruder_mps, "MPS", kMost, "of the intruder"),
        std::tuple("--system-latency", &options.times.latency_s, "S", kMost,
                   "from a declaration to the decision's begin, for the range needed"),
        std::tuple("--decide", &options.times.decide_s, "S", kMost, "time to decide"),
        std::tuple("--manoeuvre", &options.times.manoeuvre_s, "S", kMost,
                   "time until the manoeuvre has the aircraft out of the way")})
    add_figure(command, name, *value, unit, 0, high, help);
  add_figure(command, "--min-score", options.read.policy.matching.min_score, "SCORE", -1e9, 1e9,
             "reports below it are left out");
  add_number(command, "--min-encounters", options.min_encounters, "N", 1, 1'000'000, "fewer are called too few");
  add_input(command, "--empty", options.read.empty, "videos without any aircraft, for false tracks an hour",
            "VIDEO ...");
  add_input(command, "--calibration", options.read.calibration,
            "the lens, for errors of angles and the field of view; of a dataset its projects' own");
  add_input(command, "--risk", options.risk, "put this risk ratio, a JSON file of sigs risk, into the report");
  add_input(command, "--coverage", options.coverage, "put this coverage, a JSON file of sigs dataset, into the report");
}

}  // namespace

Command add_evaluate_performance(CLI::App& evaluate) {
  CLI::App* const command = evaluate.add_subcommand(
      "performance", "a sensor's performance by range: detection, declared tracks, range needed, a sensor model");
  const auto options = std::make_shared<PerformanceOptions>();
  add_source_options(
      *command, options->read.sources,
      {.labels = "exported clips' NAME.xml, the folder of a dataset, or another program's truth with ranges",
       .results = "what one detector or tracker reports: a file for each clip in order, a folder, or one file in "
                  "COCO's layout for all clips of a split",
       .results_value = "FILES|DIR"});
  add_performance_options(*command, *options);
  add_report_options(*command, options->folder, options->force);
  command->footer(kEvaluatePerformanceFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
