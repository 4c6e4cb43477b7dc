// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "base/threads.h"
#include "cli/detect_inputs.h"
#include "cli/evaluation_folder.h"
#include "cli/options.h"
#include "cli/process.h"
#include "evaluation/metrics/rig_score.h"
#include "evaluation/reports/report.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEvaluateRigFooter =
    "Examples:\n"
    "  sigs evaluate rig out/ring.rig.json --results front.csv left.csv --out report\n"
    "  sigs evaluate rig out/ring.rig.json --results runs/one runs/two\n"
    "\n"
    "In a folder the results of a camera are called as its labels: NAME.CAMERA.csv, .json or .txt.";

struct RigOptions {
  fs::path rig;
  std::vector<fs::path> results;
  ResultsFormat format = ResultsFormat::automatic;
  DetectionPolicy policy;
  fs::path folder;
  bool force = false;
};

Result<RigDetectionReport> rig_report_of(const RigOptions& options, const RigClip& rig, const DetectInputs& inputs) {
  const Result<std::vector<std::vector<DetectedClip>>> clips = clips_by_detector(inputs, options.format);
  if (!clips) return fail(clips.error());
  RigDetectionReport report{.rig = rig.name, .cameras = rig.cameras, .policy = options.policy};
  for (std::size_t i = 0; i < clips->size(); ++i)
    report.scores.push_back(score_rig(inputs.detectors[i], rig, (*clips)[i], options.policy));
  return report;
}

Result<void> run_rig_evaluation(const RigOptions& options) {
  if (options.policy.false_overlap > options.policy.match_overlap)
    return fail("--match-overlap",
                fmt::format("is less than {}, below which a report is a false alarm", options.policy.false_overlap),
                ErrorKind::usage);
  const Result<RigClip> rig = read_rig(options.rig);
  if (!rig) return fail(rig.error());
  const Result<DetectInputs> inputs = detect_inputs({.inputs = rig->labels, .results = options.results});
  if (!inputs) return fail(inputs.error());
  defer_interrupts();
  const std::vector<fs::path> read = files_read({.inputs = {options.rig}, .results = options.results}, *inputs);
  Result<std::optional<EvaluationFolder>> folder = EvaluationFolder::reserved(options.folder, options.force, read);
  if (!folder) return fail(folder.error());
  const Result<RigDetectionReport> report = rig_report_of(options, *rig, *inputs);
  if (!report) return fail(report.error());
  std::printf("%s", table_text(*report).c_str());
  if (!*folder) return {};
  return (*folder)->commit(write_report((*folder)->staging_path(), *report));
}

}  // namespace

Command add_evaluate_rig(CLI::App& evaluate) {
  CLI::App* const command = evaluate.add_subcommand(
      "rig", "measure detectors on several cameras of one aircraft: who has it first, handovers");
  const auto options = std::make_shared<RigOptions>();
  add_subject(*command, "RIG", options->rig, "NAME.rig.json, as an export of several cameras writes it");
  add_input(*command, "--results", options->results,
            "what a detector reports: a file for each camera in order, or a folder for each detector", "FILES|DIRS ...")
      ->required();
  add_format_option(*command, options->format);
  constexpr double kLarge = 1e9;
  add_figure(*command, "--min-score", options->policy.min_score, "SCORE", -kLarge, kLarge,
             "reports below it are left out");
  add_figure(*command, "--min-area", options->policy.min_area_px2, "PX2", 0, kLarge,
             "smaller true boxes are grown to it");
  add_figure(*command, "--match-overlap", options->policy.match_overlap, "SHARE", 0, 1, "extended overlap of a match");
  add_report_options(*command, options->folder, options->force);
  command->footer(kEvaluateRigFooter);
  return [options] { return run_rig_evaluation(*options); };
}

}  // namespace sigs::cli
