// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "base/csv.h"
#include "base/text.h"
#include "evaluation/reports/report.h"
#include "evaluation/reports/report_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

std::vector<GroupShare> encounter_shares(const DetectionScore& score) {
  std::vector<GroupShare> shares;
  for (const EncounterScore& encounter : score.encounters) shares.push_back({encounter.is_detected ? 1.0 : 0.0, 1});
  return shares;
}

std::string interval_text(const Interval& interval) {
  return fixed_text(interval.low, 3) + " to " + fixed_text(interval.high, 3);
}

double slice_rate(const FrameSlice& slice) {
  return slice.frames > 0 ? static_cast<double>(slice.matched) / slice.frames : std::nan("");
}

}  // namespace

std::string slices_text(const DetectionReport& report) {
  if (report.slices.empty()) return "";
  std::vector<TableColumn> columns{
      {.title = "frames matched", .unit = "by"}, {.title = "", .unit = ""}, {.title = "frames", .unit = ""}};
  for (const DetectionScore& score : report.scores)
    columns.push_back({.title = line_text(score.name), .unit = "share"});
  for (std::size_t s = 0; s < report.slices.front().size(); ++s) {
    const FrameSlice& first = report.slices.front()[s];
    if (first.frames == 0) continue;
    std::vector<std::string> cells{first.by, first.name, std::to_string(first.frames)};
    for (const std::vector<FrameSlice>& slices : report.slices)
      cells.push_back(fmt::format("{} ({})", fixed_text(slice_rate(slices[s]), 3), interval_text(slices[s].rate)));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      columns[i].cells.push_back(cells[i]);
      columns[i].is_best.push_back(false);
    }
  }
  return columns.front().cells.empty() ? "" : aligned(columns);
}

std::string slices_csv(const DetectionReport& report) {
  std::string text = "detector,by,slice,frames,matched,rate,rate_low_95,rate_high_95\n";
  for (std::size_t i = 0; i < report.slices.size(); ++i)
    for (const FrameSlice& slice : report.slices[i])
      text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(line_text(report.scores[i].name)), slice.by,
                          slice.name, slice.frames, slice.matched, exact_text(slice_rate(slice)),
                          exact_text(slice.rate.low), exact_text(slice.rate.high));
  return text;
}

std::string interval_lines(const std::string& title, const std::vector<std::string>& names,
                           const std::vector<std::vector<GroupShare>>& shares) {
  std::string text = title + "\n";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("  {}: {}\n", line_text(names[i]), interval_text(share_interval(shares[i])));
  for (std::size_t i = 1; i < names.size(); ++i) {
    const Interval interval = difference_interval(shares[i], shares.front());
    const bool is_apart = interval.low > 0 || interval.high < 0;
    text +=
        fmt::format("  {} less {}: {}, {}\n", line_text(names[i]), line_text(names.front()), interval_text(interval),
                    is_apart ? "they can be distinguished" : "they cannot be distinguished");
  }
  return text;
}

std::string intervals_text(const DetectionReport& report) {
  if (report.scores.empty() || report.scores.front().encounters.empty()) return "";
  std::vector<std::vector<GroupShare>> shares;
  std::vector<std::string> names;
  for (const DetectionScore& score : report.scores) {
    names.push_back(score.name);
    shares.push_back(encounter_shares(score));
  }
  return interval_lines("EDR, 95 % when encounters are drawn anew", names, shares);
}

}  // namespace sigs
