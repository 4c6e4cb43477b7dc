// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "base/ensure.h"
#include "base/text.h"
#include "evaluation/reports/report_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

enum class Best { none, least, most };

template <class Score>
TableColumn column(const std::vector<Score>& scores, std::string title, std::string unit, int decimals, Best best,
                   const std::function<double(const Score&)>& value) {
  TableColumn out{.title = std::move(title), .unit = std::move(unit)};
  std::vector<double> values;
  for (const Score& score : scores) values.push_back(value(score));
  for (const double one : values) out.cells.push_back(fixed_text(one, decimals));
  out.is_best =
      best == Best::none ? std::vector<bool>(values.size(), false) : best_of(values, best == Best::most, decimals);
  return out;
}

template <class Score>
TableColumn names_of(const std::vector<Score>& scores, std::string title) {
  TableColumn names{.title = std::move(title), .is_best = std::vector<bool>(scores.size(), false)};
  for (const Score& score : scores) names.cells.push_back(line_text(score.name));
  return names;
}

TableColumn rates(const std::vector<DetectionScore>& scores, std::string title, DetectionRate DetectionScore::*rate) {
  TableColumn out = column<DetectionScore>(scores, std::move(title), "EDR", 3, Best::most, [rate](const auto& score) {
    const DetectionRate& of = score.*rate;
    return of.encounters > 0 ? of.rate() : std::numeric_limits<double>::quiet_NaN();
  });
  for (std::size_t i = 0; i < scores.size(); ++i)
    out.cells[i] += fmt::format(" ({}/{})", (scores[i].*rate).detected, (scores[i].*rate).encounters);
  return out;
}

bool any_of(const std::vector<bool>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

// The lines of a column, its title and unit first. Marks have a character of their own, so that decimal points are
// aligned.
std::vector<std::string> column_lines(const TableColumn& column) {
  const std::string none = any_of(column.is_best) || any_of(column.is_partial) ? " " : "";
  std::vector<std::string> lines{column.title + none, column.unit + none};
  for (std::size_t i = 0; i < column.cells.size(); ++i) {
    const std::string mark = mark_of(column, i);
    lines.push_back(column.cells[i] + (mark.empty() ? none : mark));
  }
  return lines;
}

std::string with_notes(const std::vector<TableColumn>& columns) {
  std::string text = aligned(columns);
  for (const std::string& note : notes_on(columns)) text += note + "\n";
  return text;
}

// Fewer than half of the frames scored have a report.
bool has_few_reports(const TrackScore& score) {
  return score.reported > 0 && 2 * score.reported < score.scored;
}

// An error is the mean over the frames that have a report. It is not shown for few such frames: a tracker that follows
// for one frame and gives up would look best.
TableColumn error_column(const std::vector<TrackScore>& scores, std::string title, std::string unit,
                         double TrackScore::*error) {
  TableColumn out =
      column<TrackScore>(scores, std::move(title), std::move(unit), 2, Best::none, [error](const TrackScore& score) {
        return has_few_reports(score) ? std::numeric_limits<double>::quiet_NaN() : score.*error;
      });
  for (const TrackScore& score : scores) out.is_partial.push_back(has_few_reports(score));
  return out;
}

// Of a table of slices: what they are by, their names and numbers of frames, and a column for each tracker or detector.
template <class Slice, class Text>
std::vector<TableColumn> slice_columns(const std::string& title, const std::string& unit,
                                       const std::vector<std::string>& names,
                                       const std::vector<std::vector<Slice>>& slices, const Text& text_of) {
  std::vector<TableColumn> columns{{title, "by"}, {}, {"frames", ""}};
  for (const std::string& name : names) columns.push_back({line_text(name), unit});
  for (std::size_t s = 0; !slices.empty() && s < slices.front().size(); ++s) {
    // A tracker that was given the truth on its way is not scored there, so trackers may differ in frames.
    int most = 0;
    for (const std::vector<Slice>& of_one : slices) most = std::max(most, of_one[s].frames);
    if (most == 0) continue;
    std::vector<std::string> cells{slices.front()[s].by, slices.front()[s].name, std::to_string(most)};
    for (const std::vector<Slice>& of_one : slices) cells.push_back(text_of(of_one[s]));
    add_row(columns, cells);
  }
  return columns;
}

std::string interval_text(const Interval& interval) {
  if (!std::isfinite(interval.low)) return "no interval";
  return fixed_text(interval.low, 3) + " to " + fixed_text(interval.high, 3);
}

std::string interval_lines(const std::string& title, const std::vector<std::string>& names,
                           const std::vector<std::vector<GroupShare>>& shares) {
  std::string text = title + "\n";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("  {}: {}\n", line_text(names[i]), interval_text(share_interval(shares[i])));
  for (std::size_t i = 1; i < names.size(); ++i) {
    const Interval interval = difference_interval(shares[i], shares.front());
    const bool is_apart = interval.low > 0 || interval.high < 0;
    text += fmt::format("  {} less {}: {}, they can{} be distinguished\n", line_text(names[i]),
                        line_text(names.front()), interval_text(interval), is_apart ? "" : "not");
  }
  return text;
}

}  // namespace

void add_row(std::vector<TableColumn>& columns, const std::vector<std::string>& cells) {
  ENSURE(cells.size() == columns.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    columns[i].cells.push_back(cells[i]);
    columns[i].is_best.push_back(false);
  }
}

std::vector<TableColumn> table_of(const TrackReport& report) {
  using Score = TrackScore;
  const std::vector<Score>& scores = report.scores;
  // A tracker that gives up early has small errors, those of the frames that it reports, so no error is marked as best.
  return {names_of(scores, "tracker"),
          error_column(scores, "CLE", "mean px", &Score::mean_center_error_px),
          error_column(scores, "CLE", "median", &Score::median_center_error_px),
          error_column(scores, "CLE", "95 %", &Score::p95_center_error_px),
          error_column(scores, "X", "mean px", &Score::mean_dx_px),
          error_column(scores, "Y", "mean px", &Score::mean_dy_px),
          column<Score>(scores, "reported", "frames", 0, Best::none, [](const Score& s) { return double(s.reported); }),
          column<Score>(scores, "prec.", "@20 px", 3, Best::most, [](const Score& s) { return s.precision_at_20; }),
          column<Score>(scores, "success", "AUC", 3, Best::most, [](const Score& s) { return s.success_auc; }),
          column<Score>(scores, "norm.pr.", "AUC", 3, Best::most,
                        [](const Score& s) { return s.normalized_precision_auc; }),
          column<Score>(scores, "lost", "frames", 0, Best::least, [](const Score& s) { return double(s.lost); }),
          column<Score>(scores, "scored", "frames", 0, Best::none, [](const Score& s) { return double(s.scored); }),
          column<Score>(scores, "absent", "reports", 0, Best::none,
                        [](const Score& s) { return double(s.reported_absent); }),
          column<Score>(scores, "speed", "frames/s", 1, Best::none, [](const Score& s) {
            return s.frames_per_s.value_or(std::numeric_limits<double>::quiet_NaN());
          })};
}

std::vector<TableColumn> table_of(const DetectionReport& report) {
  using Score = DetectionScore;
  const std::vector<Score>& scores = report.scores;
  std::vector<TableColumn> columns{
      names_of(scores, "detector"),
      rates(scores, "all", &Score::all),
      rates(scores, "above", &Score::above_horizon),
      rates(scores, "on", &Score::on_horizon),
      rates(scores, "below", &Score::below_horizon),
      column<Score>(scores, "HFAR", "tracks/h", 2, Best::least, [](const Score& s) { return s.false_alarms_per_hour; }),
      column<Score>(scores, "FPPI", "boxes", 4, Best::least, [](const Score& s) { return s.false_boxes_per_frame; }),
      column<Score>(scores, "AFDR", "", 3, Best::most, [](const Score& s) { return s.frame_detection_rate; }),
      column<Score>(scores, "first seen", "mean m", 0, Best::none, [](const Score& s) { return s.mean_first_range_m; }),
      column<Score>(scores, "frames", "", 0, Best::none, [](const Score& s) { return double(s.frames); }),
      column<Score>(scores, "time", "h", 4, Best::none, [](const Score& s) { return s.hours; })};
  // Of most clips it is known where the horizon lies.
  const bool has_unknown = std::any_of(scores.begin(), scores.end(),
                                       [](const Score& score) { return score.unknown_horizon.encounters > 0; });
  if (has_unknown) columns.insert(columns.begin() + 5, rates(scores, "unknown", &Score::unknown_horizon));
  return columns;
}

std::vector<TableColumn> table_of(const TrackSetReport& report) {
  using F = TrackSetFigures;
  const auto figure = [&](const char* title, const char* unit, int decimals, Best best,
                          const std::function<double(const F&)>& value) {
    return column<F>(report.figures, title, unit, decimals, best, value);
  };
  // As in the table of one clip, no error is shown where few frames have a report.
  const auto error = [&](const char* unit, const std::function<double(const F&)>& value) {
    return figure("CLE px", unit, 2, Best::none,
                  [&](const F& f) { return has_few_reports(f.over_frames) ? std::nan("") : value(f); });
  };
  TableColumn names{.title = "tracker", .is_best = std::vector<bool>(report.trackers.size(), false)};
  for (const std::string& name : report.trackers) names.cells.push_back(line_text(name));
  return {
      names,
      error("frames", [](const F& f) { return f.over_frames.mean_center_error_px; }),
      error("clips", [](const F& f) { return f.clips_center_error_px; }),
      figure("prec.@20", "frames", 3, Best::most, [](const F& f) { return f.over_frames.precision_at_20; }),
      figure("prec.@20", "clips", 3, Best::most, [](const F& f) { return f.clips_precision_at_20; }),
      figure("success", "frames", 3, Best::most, [](const F& f) { return f.over_frames.success_auc; }),
      figure("success", "clips", 3, Best::most, [](const F& f) { return f.clips_success_auc; }),
      figure("norm.pr.", "frames", 3, Best::most, [](const F& f) { return f.over_frames.normalized_precision_auc; }),
      figure("norm.pr.", "clips", 3, Best::most, [](const F& f) { return f.clips_normalized_precision_auc; }),
      figure("lost", "share", 3, Best::least,
             [](const F& f) { return static_cast<double>(f.over_frames.lost) / f.over_frames.scored; }),
      figure("lost", "clips", 3, Best::least, [](const F& f) { return f.clips_lost_share; }),
      figure("scored", "frames", 0, Best::none, [](const F& f) { return double(f.over_frames.scored); }),
      figure("speed", "frames/s", 1, Best::none,
             [](const F& f) { return f.over_frames.frames_per_s.value_or(std::nan("")); })};
}

std::vector<TableColumn> slices_of(const TrackSetReport& report) {
  return slice_columns("mean overlap", "IoU", report.trackers, report.slices, [](const TrackSlice& slice) {
    return fmt::format("{} ({})", fixed_text(slice.mean_overlap, 3), interval_text(slice.interval));
  });
}

std::vector<TableColumn> encounters_of(const DetectionReport& report) {
  std::vector<TableColumn> columns{{"detector", ""},        {"video", ""},         {"intruder", ""},
                                   {"frames", ""},          {"horizon", ""},       {"nearest", "m"},
                                   {"detected", "in time"}, {"first seen", "m"},   {"first seen", "after s"},
                                   {"matched", "frames"},   {"in range", "frames"}};
  for (const DetectionScore& score : report.scores)
    for (const EncounterScore& encounter : score.encounters) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      add_row(columns,
              {line_text(score.name), line_text(encounter.clip), std::to_string(encounter.target),
               fmt::format("{} to {}", encounter.first_frame, encounter.last_frame),
               std::string(name_of(encounter.horizon)), fixed_text(encounter.min_range_m, 0),
               encounter.is_detected ? "yes" : "no", fixed_text(encounter.first_detection_range_m.value_or(none), 0),
               fixed_text(encounter.first_detection_time_s.value_or(none), 2), std::to_string(encounter.frames_matched),
               std::to_string(encounter.frames_visible)});
    }
  return columns;
}

std::string mark_of(const TableColumn& column, std::size_t row) {
  if (column.is_best[row]) return "*";
  return !column.is_partial.empty() && column.is_partial[row] ? "?" : "";
}

std::vector<std::string> notes_on(const std::vector<TableColumn>& columns) {
  std::vector<std::string> notes;
  if (std::any_of(columns.begin(), columns.end(), [](const TableColumn& c) { return any_of(c.is_best); }))
    notes.emplace_back("* best of its column");
  if (std::any_of(columns.begin(), columns.end(), [](const TableColumn& c) { return any_of(c.is_partial); }))
    notes.emplace_back("? no figure: fewer than half of the frames scored have a report, see lost");
  return notes;
}

std::string aligned(const std::vector<TableColumn>& columns) {
  ENSURE(!columns.empty());
  std::vector<std::string> rows(columns.front().cells.size() + 2);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::vector<std::string> lines = column_lines(columns[c]);
    ENSURE(lines.size() == rows.size());
    std::size_t width = 0;
    for (const std::string& line : lines) width = std::max(width, columns_of(line));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const std::string blank(width - columns_of(lines[row]), ' ');
      rows[row] += c == 0 ? lines[row] + blank : "  " + blank + lines[row];
    }
  }
  std::string text;
  for (const std::string& row : rows) text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  return text;
}

std::vector<bool> best_of(const std::vector<double>& values, bool larger_is_better, int decimals) {
  std::vector<bool> best(values.size(), false);
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  if (values.size() < 2 || finite.empty()) return best;
  const auto [least, most] = std::minmax_element(finite.begin(), finite.end());
  const std::string wanted = fixed_text(larger_is_better ? *most : *least, decimals);
  for (std::size_t i = 0; i < values.size(); ++i) best[i] = fixed_text(values[i], decimals) == wanted;
  if (std::all_of(best.begin(), best.end(), [](bool is_best) { return is_best; })) best.assign(values.size(), false);
  return best;
}

std::string table_text(const TrackReport& report) {
  return with_notes(table_of(report));
}

std::string table_text(const DetectionReport& report) {
  return with_notes(table_of(report));
}

std::string table_text(const TrackSetReport& report) {
  return with_notes(table_of(report));
}

std::string slices_text(const DetectionReport& report) {
  std::vector<std::string> names;
  for (const DetectionScore& score : report.scores) names.push_back(score.name);
  const auto columns = slice_columns("frames matched", "share", names, report.slices, [](const FrameSlice& slice) {
    return fmt::format("{} ({})", fixed_text(slice.share(), 3), interval_text(slice.rate));
  });
  return columns.front().cells.empty() ? "" : aligned(columns);
}

std::string slices_text(const TrackSetReport& report) {
  const std::vector<TableColumn> columns = slices_of(report);
  return columns.front().cells.empty() ? "" : aligned(columns);
}

std::string intervals_text(const DetectionReport& report) {
  if (report.scores.empty() || report.scores.front().encounters.empty()) return "";
  std::vector<std::vector<GroupShare>> shares;
  std::vector<std::string> names;
  for (const DetectionScore& score : report.scores) {
    names.push_back(score.name);
    shares.emplace_back();
    for (const EncounterScore& encounter : score.encounters)
      shares.back().push_back({encounter.is_detected ? 1.0 : 0.0, 1});
  }
  return interval_lines("EDR, 95 % when encounters are drawn anew", names, shares);
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

}  // namespace sigs
