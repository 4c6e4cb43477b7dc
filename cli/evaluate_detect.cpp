// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <tuple>

#include "base/text.h"
#include "base/threads.h"
#include "cli/detect_inputs.h"
#include "cli/evaluation_folder.h"
#include "cli/options.h"
#include "cli/process.h"
#include "evaluation/metrics/detection_score.h"
#include "evaluation/reports/report.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEvaluateDetectFooter =
    "Examples:\n"
    "  sigs evaluate detect out/crossing.xml --results found.csv --out report\n"
    "  sigs evaluate detect a.xml b.xml --results a.csv b.csv --min-score 0.3\n"
    "  sigs evaluate detect datasets/mine --split test --results runs/one runs/two --out report\n"
    "  sigs evaluate detect datasets/mine --split test --results coco_results.json\n"
    "  sigs evaluate detect MOT17/train/MOT17-02 --results found.txt --classes 1\n"
    "  sigs evaluate detect groundtruth.json --rules aot --results result.json --target-hfar 0.5 --out report";

struct DetectOptions {
  DetectSources sources;
  DetectionPolicy policy;
  std::string rules = "sigs";
  AotPolicy aot;
  fs::path folder;
  bool force = false;
};

Result<DetectionReport> report_of(const DetectOptions& options, const DetectInputs& inputs) {
  const Result<std::vector<std::vector<DetectedClip>>> clips = clips_by_detector(inputs, options.sources.format);
  if (!clips) return fail(clips.error());
  DetectionReport report{.policy = options.policy};
  for (const ClipFiles& files : inputs.clips) report.clips.push_back(files.name);
  report.remarks = left_out_of(clips->front());
  for (std::size_t i = 0; i < clips->size(); ++i) {
    report.scores.push_back(score_detections(inputs.detectors[i], (*clips)[i], options.policy));
    report.slices.push_back(frame_slices((*clips)[i], options.policy));
  }
  return report;
}

// Below the table, where few encounters need an explanation.
void print(const DetectionReport& report) {
  std::printf("%s", table_text(report).c_str());
  for (const std::string& text : {intervals_text(report), slices_text(report)})
    if (!text.empty()) std::printf("\n%s", text.c_str());
  std::fflush(stdout);
  for (const std::string& remark : report.remarks) print_warning({"", remark});
  for (const std::string& reason : uncounted_in(report)) print_warning({"", reason});
}

// `sigs evaluate detect --rules aot`: a groundtruth.json and a result.json of the Airborne Object Tracking challenge,
// by that challenge's own rules.
Result<void> run_by_aot_rules(const DetectOptions& options) {
  AotPolicy policy = options.aot;
  policy.min_score = options.policy.min_score;
  const DetectSources& sources = options.sources;
  if (sources.inputs.size() != 1 || sources.results.size() != 1)
    return fail("--rules aot", "takes one groundtruth.json and one result.json", ErrorKind::usage);
  if (policy.target_fppi && policy.target_hfar)
    return fail("--target-fppi", "and --target-hfar exclude each other", ErrorKind::usage);
  const fs::path& result_file = sources.results.front();
  defer_interrupts();
  Result<std::optional<EvaluationFolder>> folder =
      EvaluationFolder::reserved(options.folder, options.force, {sources.inputs.front(), result_file});
  if (!folder) return fail(folder.error());
  const Result<AotTruth> truth = read_aot_truth(sources.inputs.front());
  if (!truth) return fail(truth.error());
  const Result<std::vector<AotReport>> reports = read_aot_reports(result_file);
  if (!reports) return fail(reports.error());
  const Result<AotScore> score = aot_score(*truth, *reports, policy);
  if (!score) return fail(result_file.string(), score.error().what);
  if (score->unknown_images > 0)
    print_warning({result_file.string(),
                   count_text(score->unknown_images, "report") + " of images that the truth does not have: ignored"});
  std::printf("%s", aot_table(*score).c_str());
  if (!*folder) return {};
  return (*folder)->commit(write_report((*folder)->staging_path(), *truth, *score));
}

Result<void> run(const DetectOptions& options) {
  if (options.rules == "aot") return run_by_aot_rules(options);
  if (options.aot.target_fppi || options.aot.target_hfar || options.aot.min_track_length > 0)
    return fail("--target-fppi, --target-hfar and --min-track-length", "need --rules aot", ErrorKind::usage);
  if (options.policy.false_overlap > options.policy.match_overlap)
    return fail("--false-overlap", "is more than --match-overlap", ErrorKind::usage);
  const Result<DetectInputs> inputs = detect_inputs(options.sources);
  if (!inputs) return fail(inputs.error());
  defer_interrupts();
  const std::vector<fs::path> read = files_read(options.sources, *inputs);
  Result<std::optional<EvaluationFolder>> folder = EvaluationFolder::reserved(options.folder, options.force, read);
  if (!folder) return fail(folder.error());
  const Result<DetectionReport> report = report_of(options, *inputs);
  if (!report) return fail(report.error());
  print(*report);
  if (!*folder) return {};
  return (*folder)->commit(write_report((*folder)->staging_path(), *report));
}

void add_policy_options(CLI::App& command, DetectionPolicy& policy) {
  struct Number {
    const char* name;
    double* value;
    double largest;
    const char* unit;
    const char* help;
  };
  constexpr double kLarge = 1e9;
  for (const Number& number :
       {Number{"--min-score", &policy.min_score, kLarge, "SCORE", "reports below it are left out"},
        Number{"--min-area", &policy.min_area_px2, kLarge, "PX2", "smaller true boxes are grown to it"},
        Number{"--match-overlap", &policy.match_overlap, 1, "SHARE", "extended overlap of a match"},
        Number{"--false-overlap", &policy.false_overlap, 1, "SHARE", "less with every true box: a false alarm"},
        Number{"--max-range", &policy.max_range_m, kLarge, "M", "an encounter is within it"},
        Number{"--max-closest-range", &policy.max_closest_range_m, kLarge, "M",
               "an encounter that counts comes so near"},
        Number{"--min-encounter", &policy.min_encounter_s, kLarge, "S", "shorter encounters do not count"},
        Number{"--max-gap", &policy.max_gap_s, kLarge, "S", "longer gaps end an encounter"},
        Number{"--detect-range", &policy.detect_range_m, kLarge, "M", "detected in time: before it comes nearer"},
        Number{"--window", &policy.window_s, kLarge, "S", "detected: within a window of this length"},
        Number{"--window-share", &policy.min_window_share, 1, "SHARE", "... in this share of its frames"}}) {
    add_figure(command, number.name, *number.value, number.unit, number.value == &policy.min_score ? -kLarge : 0.0,
               number.largest, number.help);
  }
}

void add_aot_options(CLI::App& command, DetectOptions& options) {
  command
      .add_option("--rules", options.rules,
                  "aot: those of the Airborne Object Tracking challenge's own program, LABELS is its groundtruth.json; "
                  "of the options above --min-score alone counts")
      ->check(CLI::IsMember({"sigs", "aot"}))
      ->option_text("sigs|aot");
  command
      .add_option("--min-track-length", options.aot.min_track_length,
                  "aot: a track counts from its N-th frame on, gaps included")
      ->type_name("N")
      ->check(from_to(0, 1e6));
  for (const auto& [name, value, help] :
       {std::tuple("--target-fppi", &options.aot.target_fppi, "aot: raise the score until so many are false an image"),
        std::tuple("--target-hfar", &options.aot.target_hfar, "aot: ... so many tracks are false an hour")})
    command.add_option(name, *value, help)->type_name("RATE")->check(from_to(0, 1e9));
}

}  // namespace

Command add_evaluate_detect(CLI::App& evaluate) {
  CLI::App* const command =
      evaluate.add_subcommand("detect", "measure detectors on clips: encounters detected, false alarms");
  const auto options = std::make_shared<DetectOptions>();
  add_source_options(
      *command, options->sources,
      {.labels = "exported clips' NAME.xml, the folder of a dataset, or another program's truth: a coco or aot "
                 "file, a mot or yolo folder",
       .results = "what a detector reports: a file for each clip in order, a folder for each detector, or one file in "
                  "COCO's layout for all clips of a split",
       .results_value = "FILES|DIRS ..."});
  add_policy_options(*command, options->policy);
  add_aot_options(*command, *options);
  add_report_options(*command, options->folder, options->force);
  command->footer(kEvaluateDetectFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
