// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/text.h"
#include "evaluation/report.h"
#include "evaluation/report_files.h"
#include "labels/label_text.h"

// The report of trackers on many clips.

namespace sigs {

namespace {

using SetJson = nlohmann::ordered_json;
using Figure = std::function<double(const TrackSetFigures&)>;

enum class Better { none, less, more };

TableColumn set_column(const TrackSetReport& report, const char* title, const char* unit, int decimals, Better better,
                       const Figure& figure) {
  TableColumn column{.title = title, .unit = unit};
  std::vector<double> values;
  for (const TrackSetFigures& figures : report.figures) values.push_back(figure(figures));
  for (const double value : values) column.cells.push_back(fixed_text(value, decimals));
  column.is_best = better == Better::none ? std::vector<bool>(values.size(), false)
                                          : best_of(values, better == Better::more, decimals);
  return column;
}

// Fewer than half of the frames scored have a report: no error over them is shown, as in the table of one clip.
double shown_error(const TrackSetFigures& figures, double error) {
  const TrackScore& score = figures.over_frames;
  return score.reported > 0 && 2 * score.reported < score.scored ? std::nan("") : error;
}

std::string set_name(const std::string& name) {
  return csv_field(line_text(name));
}

std::string interval_cells(const Interval& interval) {
  return exact_text(interval.low) + "," + exact_text(interval.high);
}

SetJson interval_json(const Interval& interval) {
  return {interval.low, interval.high};  // NaN becomes null
}

SetJson slices_json(const std::vector<TrackSlice>& slices) {
  SetJson json = SetJson::object();
  for (const TrackSlice& slice : slices)
    if (slice.frames > 0)
      json[slice.by].push_back({{"slice", slice.name},
                                {"frames", slice.frames},
                                {"mean_overlap", slice.mean_overlap},
                                {"mean_overlap_95", interval_json(slice.interval)}});
  return json;
}

SetJson clips_json(const TrackSetReport& report) {
  SetJson clips = SetJson::array();
  for (const TrackSetClip& clip : report.clips)
    clips.push_back({{"name", line_text(clip.name)},
                     {"target", line_text(clip.target)},
                     {"from_frame", clip.from_frame},
                     {"frames", clip.truth.size()}});
  return clips;
}

SetJson figures_json(const TrackSetFigures& figures) {
  return {{"mean_center_error_px", figures.clips_center_error_px},
          {"precision_at_20_px", figures.clips_precision_at_20},
          {"success_auc", figures.clips_success_auc},
          {"success_auc_95", interval_json(figures.clips_success)},
          {"normalized_precision_auc", figures.clips_normalized_precision_auc},
          {"mean_overlap", figures.clips_mean_overlap},
          {"lost_share", figures.clips_lost_share}};
}

// All frames of all clips as the report of one clip, for the curves.
TrackReport as_one_clip(const TrackSetReport& report) {
  TrackReport one{.clip = count_text(std::ssize(report.clips), "clip"), .policy = report.policy};
  for (const TrackSetFigures& figures : report.figures) one.scores.push_back(figures.over_frames);
  for (TrackScore& score : one.scores) score.frames.clear();
  return one;
}

}  // namespace

std::vector<TableColumn> table_of(const TrackSetReport& report) {
  TableColumn names{.title = "tracker", .is_best = std::vector<bool>(report.trackers.size(), false)};
  for (const std::string& name : report.trackers) names.cells.push_back(line_text(name));
  using F = TrackSetFigures;
  const auto column = [&](const char* title, const char* unit, int decimals, Better better, const Figure& figure) {
    return set_column(report, title, unit, decimals, better, figure);
  };
  return {
      names,
      column("CLE px", "frames", 2, Better::none,
             [](const F& f) { return shown_error(f, f.over_frames.mean_center_error_px); }),
      column("CLE px", "clips", 2, Better::none, [](const F& f) { return shown_error(f, f.clips_center_error_px); }),
      column("prec.@20", "frames", 3, Better::more, [](const F& f) { return f.over_frames.precision_at_20; }),
      column("prec.@20", "clips", 3, Better::more, [](const F& f) { return f.clips_precision_at_20; }),
      column("success", "frames", 3, Better::more, [](const F& f) { return f.over_frames.success_auc; }),
      column("success", "clips", 3, Better::more, [](const F& f) { return f.clips_success_auc; }),
      column("norm.pr.", "frames", 3, Better::more, [](const F& f) { return f.over_frames.normalized_precision_auc; }),
      column("norm.pr.", "clips", 3, Better::more, [](const F& f) { return f.clips_normalized_precision_auc; }),
      column("lost", "share", 3, Better::less,
             [](const F& f) { return static_cast<double>(f.over_frames.lost) / f.over_frames.scored; }),
      column("lost", "clips", 3, Better::less, [](const F& f) { return f.clips_lost_share; }),
      column("scored", "frames", 0, Better::none, [](const F& f) { return double(f.over_frames.scored); }),
      column("speed", "frames/s", 1, Better::none,
             [](const F& f) { return f.over_frames.frames_per_s.value_or(std::nan("")); })};
}

std::vector<TableColumn> slices_of(const TrackSetReport& report) {
  std::vector<TableColumn> columns{{.title = "mean overlap", .unit = "by"}, {}, {.title = "frames"}};
  for (const std::string& name : report.trackers) columns.push_back({.title = line_text(name), .unit = "IoU"});
  for (std::size_t s = 0; !report.slices.empty() && s < report.slices.front().size(); ++s) {
    // A tracker that was given the truth on its way is not scored there, so trackers may differ in frames.
    int most = 0;
    for (const std::vector<TrackSlice>& slices : report.slices) most = std::max(most, slices[s].frames);
    if (most == 0) continue;
    const TrackSlice& first = report.slices.front()[s];
    std::vector<std::string> cells{first.by, first.name, std::to_string(most)};
    for (const std::vector<TrackSlice>& slices : report.slices)
      cells.push_back(fmt::format("{} ({} to {})", fixed_text(slices[s].mean_overlap, 3),
                                  fixed_text(slices[s].interval.low, 3), fixed_text(slices[s].interval.high, 3)));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      columns[i].cells.push_back(cells[i]);
      columns[i].is_best.push_back(false);
    }
  }
  return columns;
}

std::string table_text(const TrackSetReport& report) {
  const std::vector<TableColumn> columns = table_of(report);
  std::string text = aligned(columns);
  for (const std::string& note : notes_on(columns)) text += note + "\n";
  return text;
}

std::string slices_text(const TrackSetReport& report) {
  const std::vector<TableColumn> columns = slices_of(report);
  return columns.front().cells.empty() ? "" : aligned(columns);
}

std::string intervals_text(const TrackSetReport& report) {
  std::vector<std::vector<GroupShare>> by_frames;
  std::vector<std::vector<GroupShare>> by_clips;
  for (std::size_t i = 0; i < report.trackers.size(); ++i) {
    by_frames.push_back(success_by_frames(report, i));
    by_clips.push_back(success_by_clips(report, i));
  }
  return interval_lines("success AUC over all frames, 95 % when clips are drawn anew", report.trackers, by_frames) +
         interval_lines("success AUC, mean over clips, 95 % when clips are drawn anew", report.trackers, by_clips);
}

std::vector<std::string> policies_of(const TrackSetReport& report) {
  const bool is_visible = report.policy.truth == TruthBox::visible;
  return {
      std::string("Truth: the box around ") +
          (is_visible ? "the intruder's visible pixels." : "the whole intruder, hidden or not."),
      "Clip: one intruder of one video, from the first frame on in which both sides of the true box have at least " +
          exact_text(report.min_side_px) + " px and at least " + exact_text(100 * report.policy.min_visible_fraction) +
          " % of it can be seen. OpenCV's trackers are given the true box there.",
      "Over frames: all frames scored of all clips, each counting alike. Over clips: the mean of the clips' own "
      "figures, each clip counting alike, however long it is.",
      "A tracker that cannot be started in a clip reports nothing there: its frames are lost.",
      "Intervals: the middle 95 % of 2000 draws of as many clips as there are.",
      "Nothing reported in a scored frame: lost, and past every threshold. CLE is over the frames with a report "
      "alone.",
      "Speed: frames a second of the trackers alone, beside whatever ran at the same time. It differs from run to "
      "run; all other figures do not, whatever the number of jobs."};
}

std::string summary_csv(const TrackSetReport& report) {
  std::string text = "tracker,clips," + track_figure_names() +
                     ",success_auc_low_95,success_auc_high_95,clips_mean_center_error_px,clips_precision_at_20_px,"
                     "clips_success_auc,clips_success_auc_low_95,clips_success_auc_high_95,"
                     "clips_normalized_precision_auc,clips_mean_overlap,clips_lost_share\n";
  for (const TrackSetFigures& figures : report.figures)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", set_name(figures.over_frames.name), report.clips.size(),
                        track_figures_csv(figures.over_frames), interval_cells(figures.frames_success),
                        exact_text(figures.clips_center_error_px), exact_text(figures.clips_precision_at_20),
                        exact_text(figures.clips_success_auc), interval_cells(figures.clips_success),
                        exact_text(figures.clips_normalized_precision_auc), exact_text(figures.clips_mean_overlap),
                        exact_text(figures.clips_lost_share));
  return text;
}

std::string clips_csv(const TrackSetReport& report) {
  std::string text = "clip,target,from_frame,tracker," + track_figure_names() + "\n";
  for (const TrackSetClip& clip : report.clips)
    for (const TrackScore& score : clip.scores)
      text += fmt::format("{},{},{},{},{}\n", set_name(clip.name), set_name(clip.target), clip.from_frame,
                          set_name(score.name), track_figures_csv(score));
  return text;
}

std::string slices_csv(const TrackSetReport& report) {
  std::string text = "tracker,by,slice,frames,mean_overlap,mean_overlap_low_95,mean_overlap_high_95\n";
  for (std::size_t i = 0; i < report.slices.size(); ++i)
    for (const TrackSlice& slice : report.slices[i])
      text += fmt::format("{},{},{},{},{},{}\n", set_name(report.trackers[i]), slice.by, slice.name, slice.frames,
                          exact_text(slice.mean_overlap), interval_cells(slice.interval));
  return text;
}

std::string evaluation_json(const TrackSetReport& report) {
  SetJson trackers = SetJson::array();
  for (std::size_t i = 0; i < report.figures.size(); ++i) {
    const TrackSetFigures& figures = report.figures[i];
    SetJson tracker = track_json(figures.over_frames);
    tracker["success_auc_95"] = interval_json(figures.frames_success);
    tracker["over_clips"] = figures_json(figures);
    tracker["frames_by"] = slices_json(report.slices[i]);
    trackers.push_back(std::move(tracker));
  }
  SetJson remarks = SetJson::array();
  for (const std::string& remark : report.remarks) remarks.push_back(line_text(remark));
  const SetJson json{{"sigs_evaluation", 1},
                     {"kind", "track_set"},
                     {"clips", clips_json(report)},
                     {"policy",
                      {{"truth", report.policy.truth == TruthBox::visible ? "visible" : "silhouette"},
                       {"min_visible_fraction", report.policy.min_visible_fraction},
                       {"min_side_px", report.min_side_px},
                       {"in_words", policies_of(report)}}},
                     {"trackers", trackers},
                     {"remarks", remarks}};
  return json.dump(1) + "\n";
}

std::vector<Plot> plots_of(const TrackSetReport& report) {
  std::vector<Plot> plots = plots_of(as_one_clip(report));
  std::erase_if(plots, [](const Plot& plot) { return plot.name.ends_with("_error"); });  // over frames of one clip
  return plots;
}

}  // namespace sigs
