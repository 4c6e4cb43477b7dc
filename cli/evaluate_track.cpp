// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "base/text.h"
#include "cli/detect_inputs.h"
#include "cli/evaluation_folder.h"
#include "cli/process.h"
#include "cli/tracked_clip.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/readers/results.h"
#include "evaluation/reports/report.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "scene/scene_files.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEvaluateTrackFooter =
    "Examples:\n"
    "  sigs evaluate track projects/crossing/crossing.json --tracker csrt,kcf,mosse --out report\n"
    "  sigs evaluate track out/crossing.xml --tracker all --min-side 8\n"
    "  sigs evaluate track out/crossing.xml --results mine.txt --format otb --out report\n"
    "  sigs evaluate track OTB100/Biker --tracker csrt\n"
    "  sigs evaluate track datasets/mine --split test --tracker csrt,kcf --jobs 8 --out report";

struct TrackOptions {
  TrackRequest request;
  std::string truth = "visible";
  std::string frames;
  int jobs = 0;
  std::string split;
  fs::path folder;
  bool force = false;
};

Result<TrackRequest> request_of(const TrackOptions& options) {
  TrackRequest request = options.request;
  if (std::find(request.trackers.begin(), request.trackers.end(), "all") != request.trackers.end())
    request.trackers.assign(tracker_names().begin(), tracker_names().end());
  if (request.trackers.empty() && request.results.empty())
    return fail("evaluate track", "name what is to be measured: --tracker or --results", ErrorKind::usage);
  request.policy.truth = options.truth == "visible" ? TruthBox::visible : TruthBox::amodal;
  const Result<std::optional<FrameRange>> range = frame_range_of(options.frames);
  if (!range) return fail(range.error());
  request.frames = *range;
  request.jobs = jobs_of_option(options.jobs);
  for (const fs::path& file : request.results)
    if (std::error_code code; !fs::exists(file, code))
      return fail(file.string(), "no such file", ErrorKind::cannot_read);
  return request;
}

Result<std::vector<Results>> all_results(const TrackRequest& request, const TrackedClip& clip) {
  std::vector<Results> all = clip.results;
  std::vector<std::string> names;
  for (const Results& results : all) names.push_back(results.name);
  for (const fs::path& file : request.results) {
    Result<Results> read =
        read_results(file, clip.truth.footage, {.format = request.format, .start_frame = clip.policy.from_frame});
    if (!read) return fail(read.error());
    warn_of_other_clip(*read, file, clip.name);
    read->name = free_name(read->name, names);
    names.push_back(read->name);
    all.push_back(std::move(*read));
  }
  return all;
}

TrackReport report_of(const TrackedClip& clip, const std::vector<Results>& all) {
  const TargetTruth& target = clip.truth.targets[static_cast<std::size_t>(clip.target)];
  TrackReport report{.clip = clip.name,
                     .footage = clip.truth.footage,
                     .target = fmt::format("intruder {} ({})", target.id, target.name),
                     .policy = clip.policy,
                     .remarks = clip.remarks};
  for (const Results& results : all) report.scores.push_back(score_track(clip.truth, target, results, report.policy));
  return report;
}

// Where scoring begins, in a line above the table.
std::string heading_of(const TrackReport& report) {
  return fmt::format("{}: {}, box of {}, frames {} to {}\n", report.clip, report.target,
                     report.policy.truth == TruthBox::visible ? "what can be seen" : "the whole",
                     report.policy.from_frame, report.footage.last_frame);
}

Result<void> write(EvaluationFolder& folder, const TrackReport& report, const TrackedClip& clip) {
  Result<WrittenReport> written = write_report(folder.staging_path(), report);
  if (!written) return fail(written.error());
  for (const Results& one : clip.results) {
    if (const Result<void> kept = folder.write_results(one.name, one); !kept) return kept;
    written->files.push_back(folder.staging_path() / "results" / (one.name + ".csv"));
  }
  return folder.commit(written);
}

// The files that a project names; labels name none. Errors in it are reported when it is opened.
std::vector<fs::path> files_named_by(const ProjectOptions& options) {
  Result<ReadProject> read = read_project(options.file);
  if (!read || !set_all(read->project, options.settings)) return {};
  return files_read_by(read->project);
}

Result<void> run(const TrackOptions& options) {
  const Result<TrackRequest> request = request_of(options);
  if (!request) return fail(request.error());
  if (is_track_set(request->input.file))
    return evaluate_track_set(*request, options.split, options.folder, options.force);
  if (!options.split.empty()) return fail("--split", "goes with a dataset's folder", ErrorKind::usage);
  defer_interrupts();
  std::vector<fs::path> inputs = request->results;
  inputs.push_back(request->input.file);
  if (!request->video.empty()) inputs.push_back(request->video);
  const std::vector<fs::path> named = options.folder.empty() ? std::vector<fs::path>() : files_named_by(request->input);
  inputs.insert(inputs.end(), named.begin(), named.end());
  Result<std::optional<EvaluationFolder>> folder = EvaluationFolder::reserved(options.folder, options.force, inputs);
  if (!folder) return fail(folder.error());
  const Result<TrackedClip> clip = tracked_clip(*request);
  if (!clip) return fail(clip.error());
  for (const std::string& remark : clip->remarks) print_warning({"", remark});
  const Result<std::vector<Results>> all = all_results(*request, *clip);
  if (!all) return fail(all.error());
  const TrackReport report = report_of(*clip, *all);
  std::printf("%s%s", heading_of(report).c_str(), table_text(report).c_str());
  return *folder ? write(**folder, report, *clip) : Result<void>();
}

void add_scoring_options(CLI::App& command, TrackOptions& options) {
  TrackRequest& request = options.request;
  add_value(command, "--intruder", request.intruder, "N", "which intruder is followed, where there are several");
  add_value(command, "--truth", options.truth, "NAME=visible",
            "true box: visible, what can be seen; silhouette, the whole")
      ->check(CLI::IsMember({"visible", "silhouette"}));
  add_range(command, "--min-visible", request.policy.min_visible_fraction, "SHARE=0", 0, 1,
            "frames in which a smaller share of the intruder can be seen are not scored, 0 to 1");
  add_range(command, "--min-side", request.min_side_px, "PX=1", 0, 1e6,
            "trackers start, and scoring begins, where both sides of the true box are at least this long");
}

}  // namespace

Command add_evaluate_track(CLI::App& evaluate) {
  CLI::App* const command =
      evaluate.add_subcommand("track", "measure trackers on one clip or many: centre error, overlap");
  const auto options = std::make_shared<TrackOptions>();
  TrackRequest& request = options->request;
  add_subject(*command, "PROJECT_OR_LABELS", request.input.file,
              "a project, an exported clip's NAME.xml, an otb or vot sequence, or a folder of "
              "many clips: a dataset, or such sequences");
  add_value(*command, "--tracker", request.trackers, "NAMES ...",
            fmt::format("OpenCV's tracker to run: all, {}; several by commas", listed(tracker_names())))
      ->delimiter(',')
      ->allow_extra_args(false);
  add_input(*command, "--results", request.results,
            "what trackers have reported, a file for each, of many clips a folder for each; may be repeated",
            "FILES|DIRS ...");
  add_format_option(*command, request.format);
  add_value(*command, "--split", options->split, "NAME", "only the clips of this split of a dataset");
  add_scoring_options(*command, *options);
  add_input(*command, "--video", request.video, "images of the labels; else those beside them");
  add_report_options(*command, options->folder, options->force);
  add_value(*command, "--frames", options->frames, "A-B", "only these frames of a project's footage");
  add_set_option(*command, request.input);
  command
      ->add_option("--jobs", options->jobs,
                   "frames composed, or clips followed, side by side; 0: one less than processor cores")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  add_progress_option(*command, request.progress);
  command->footer(kEvaluateTrackFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
