// SPDX-License-Identifier: MIT
#include "cli/tracked_clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <climits>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>

#include "base/paths.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/detect_inputs.h"
#include "cli/evaluation_folder.h"
#include "cli/process.h"
#include "evaluation/readers/truth_files.h"
#include "evaluation/reports/report.h"

namespace sigs::cli {

namespace fs = std::filesystem;

namespace {

// One target of one clip.
struct TrackRun {
  std::string name;  // results' files are called so
  std::size_t input = 0;
  int target = 0;
  TrackPolicy policy;
  int frames = 0;                     // from the first one scored on
  std::vector<Results> from_files;    // of trackers that have run elsewhere
  std::vector<Results> from_opencv;   // of those that run here
  std::optional<TrackSetClip> score;  // once it is done
  std::vector<std::string> remarks;
  Result<void> outcome;
};

struct TrackRuns {
  std::vector<TrackInput> inputs;
  std::vector<TrackRun> runs;
  std::vector<std::string> trackers;  // OpenCV's, then those of the files
  std::vector<std::string> remarks;
};

Result<std::vector<fs::path>> labels_of(const fs::path& folder, const std::string& split) {
  std::error_code code;
  std::vector<fs::path> labels;
  if (fs::exists(folder / "index.json", code)) {
    const Result<std::vector<ClipFiles>> clips = clips_of_dataset(folder, split);
    if (!clips) return fail(clips.error());
    for (const ClipFiles& clip : *clips) labels.push_back(clip.labels);
    return labels;
  }
  if (!split.empty()) return fail("--split", "goes with a dataset's folder", ErrorKind::usage);
  return sequences_in(folder);
}

// The targets of an input that can be followed.
Result<void> add_runs(const TrackRequest& request, TrackRuns& all, std::size_t index) {
  const TrackInput& input = all.inputs[index];
  const auto targets = static_cast<int>(input.truth.targets.size());
  if (request.intruder && (*request.intruder < 0 || *request.intruder >= targets))
    return fail(fmt::format("--intruder {}", *request.intruder),
                fmt::format("{} has {}", input.labels.string(), count_text(targets, "intruder")), ErrorKind::usage);
  const int first = request.intruder.value_or(0);
  const int last = request.intruder.value_or(targets - 1);
  if (targets == 0) all.remarks.push_back(input.name + " has no intruder; it is left out");
  for (int target = first; target <= last; ++target) {
    TrackRun run{.name = first == last && targets == 1 ? input.name : fmt::format("{}-{}", input.name, target),
                 .input = index,
                 .target = target};
    const std::optional<TrackPolicy> policy = started_policy(request, input.truth, target);
    if (!policy) {
      all.remarks.push_back(run.name + " has no frame in which the intruder can be followed; it is left out");
      continue;
    }
    run.policy = *policy;
    run.frames = input.truth.footage.last_frame - policy->from_frame + 1;
    all.runs.push_back(std::move(run));
  }
  return {};
}

// What trackers elsewhere have reported: a folder for each, a file for each run.
Result<void> read_set_results(const TrackRequest& request, TrackRuns& all) {
  for (const fs::path& folder : request.results) {
    if (!is_folder(folder))
      return fail(folder.string(), "is no folder; of many clips, name a folder of results for each tracker",
                  ErrorKind::usage);
    all.trackers.push_back(free_name(name_of_folder(folder), all.trackers));
    for (TrackRun& run : all.runs) {
      if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return fail(on.error());
      const Result<fs::path> file = results_in(folder, run.name);
      if (!file) return fail(file.error());
      Result<Results> results = read_results(*file, all.inputs[run.input].truth.footage,
                                             {.format = request.format, .start_frame = run.policy.from_frame});
      if (!results) return fail(results.error());
      results->name = all.trackers.back();
      run.from_files.push_back(std::move(*results));
    }
  }
  return {};
}

Result<TrackRuns> all_runs(const TrackRequest& request, const std::string& split) {
  if (!request.video.empty())
    return fail("--video", "goes with one clip; those of a folder have their images beside them", ErrorKind::usage);
  const Result<std::vector<fs::path>> labels = labels_of(request.input.file, split);
  if (!labels) return fail(labels.error());
  TrackRuns all{.trackers = request.trackers};
  for (const fs::path& path : *labels) {
    if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return fail(on.error());
    Result<TrackInput> input = read_track_input(request, path);
    if (!input) return fail(input.error());
    all.inputs.push_back(std::move(*input));
    if (const Result<void> added = add_runs(request, all, all.inputs.size() - 1); !added) return fail(added.error());
  }
  if (all.runs.empty()) return fail(request.input.file.string(), "has no clip with an intruder that can be followed");
  if (const Result<void> read = read_set_results(request, all); !read) return fail(read.error());
  return all;
}

// Trackers that did not start report nothing.
std::vector<Results> in_order(const std::vector<std::string>& trackers, const std::vector<Results>& started) {
  std::vector<Results> all;
  for (const std::string& name : trackers) {
    const auto found = std::ranges::find(started, name, &Results::name);
    all.push_back(found == started.end() ? Results{.name = name} : *found);
  }
  return all;
}

Result<void> make_run(const TrackRequest& request, const TrackInput& input, TrackRun& run,
                      const FrameCounter& on_frame) {
  Result<TrackerGroup> group = TrackerGroup::make(request.trackers);
  if (!group) return fail("--tracker " + group.error().where, group.error().what, group.error().kind);
  const Result<TrackedClip> clip = tracked_input(request, input, run.target, std::move(*group), on_frame);
  if (!clip) return fail(clip.error());
  for (const std::string& remark : clip->remarks) run.remarks.push_back(run.name + ": " + remark);
  run.from_opencv = in_order(request.trackers, clip->results);
  const TargetTruth& target = input.truth.targets[static_cast<std::size_t>(run.target)];
  run.score = TrackSetClip{.name = run.name,
                           .target = fmt::format("intruder {} ({})", target.id, target.name),
                           .from_frame = run.policy.from_frame,
                           .truth = target.frames};
  for (const std::vector<Results>* const results : {&run.from_opencv, &run.from_files})
    for (const Results& one : *results) run.score->scores.push_back(score_track(input.truth, target, one, run.policy));
  return {};
}

// All runs, `jobs` at a time. Of several errors that of the first run in their order is returned: runs before one that
// failed go on to their end, those behind it stop.
Result<void> make_runs(const TrackRequest& request, TrackRuns& all) {
  const int total = std::accumulate(all.runs.begin(), all.runs.end(), 0,
                                    [](int sum, const TrackRun& run) { return sum + run.frames; });
  Progress progress(request.progress);
  std::mutex mutex;
  int done = 0;
  std::atomic<int> first_failed{INT_MAX};
  parallel_for(static_cast<int>(all.runs.size()), request.jobs, [&](int i) {
    if (first_failed < i || interrupt_flag().load()) return;
    TrackRun& run = all.runs[static_cast<std::size_t>(i)];
    run.outcome = guarded([&] {
      return make_run(request, all.inputs[run.input], run, [&](int, int) {
        const std::lock_guard lock(mutex);
        progress.update(++done, total);
        return first_failed >= i;
      });
    });
    for (int failed = first_failed; !run.outcome && i < failed && !first_failed.compare_exchange_weak(failed, i);) {
    }
  });
  progress.end();
  if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return fail(on.error());
  for (const TrackRun& run : all.runs)
    if (!run.outcome) return run.outcome;
  return {};
}

TrackSetReport set_report(const TrackRequest& request, TrackRuns& all) {
  TrackSetReport report{
      .trackers = all.trackers, .policy = request.policy, .min_side_px = request.min_side_px, .remarks = all.remarks};
  for (TrackRun& run : all.runs) {
    report.clips.push_back(std::move(*run.score));
    report.remarks.insert(report.remarks.end(), run.remarks.begin(), run.remarks.end());
  }
  complete(report);
  return report;
}

Result<void> write_set(EvaluationFolder& folder, const TrackSetReport& report, const TrackRuns& all) {
  Result<WrittenReport> written = write_report(folder.staging_path(), report);
  if (!written) return fail(written.error());
  bool has_results = false;
  for (const TrackRun& run : all.runs)
    for (const Results& results : run.from_opencv) {
      if (const Result<void> kept = folder.write_results(fs::path(results.name) / run.name, results); !kept)
        return kept;
      has_results = true;
    }
  // The results are many; their folder stands for them.
  if (has_results) written->files.push_back(folder.staging_path() / "results" / "");
  return folder.commit(written);
}

}  // namespace

bool is_track_set(const fs::path& path) {
  if (!is_folder(path) || is_sequence_folder(path)) return false;
  std::error_code code;
  return fs::exists(path / "index.json", code) || !sequences_in(path).empty();
}

Result<void> evaluate_track_set(const TrackRequest& request, const std::string& split, const fs::path& folder,
                                bool force) {
  defer_interrupts();
  std::vector<fs::path> inputs = request.results;
  inputs.push_back(request.input.file);
  Result<std::optional<EvaluationFolder>> out = EvaluationFolder::reserved(folder, force, inputs);
  if (!out) return fail(out.error());
  Result<TrackRuns> all = all_runs(request, split);
  if (!all) return fail(all.error());
  if (const Result<void> made = make_runs(request, *all); !made) return made;
  const TrackSetReport report = set_report(request, *all);
  for (const std::string& remark : report.remarks) print_warning({"", remark});
  std::printf("%s: over all frames, and the mean over clips\n%s\n%s\n%s",
              count_text(std::ssize(report.clips), "clip").c_str(), table_text(report).c_str(),
              intervals_text(report).c_str(), slices_text(report).c_str());
  return *out ? write_set(**out, report, *all) : Result<void>();
}

}  // namespace sigs::cli
