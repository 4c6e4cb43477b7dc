// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/json.h"
#include "base/text.h"
#include "dataset/domain_coverage.h"
#include "plot/plot.h"

namespace sigs {

namespace {

constexpr std::size_t kListedTargets = 20;  // in texts for people; JSON has all

std::string count_row(const std::string& name, const DomainCount& count, const std::string& remark) {
  return fmt::format("  {:<24}{:>10}{:>12}{}{}\n", name, count.frames, count.encounters, remark.empty() ? "" : "  ",
                     remark);
}

std::string condition_table(const DomainCoverage& coverage, std::size_t i) {
  const DomainCondition& condition = coverage.domain.conditions[i];
  const ConditionCoverage& counts = coverage.conditions[i];
  std::string text = fmt::format("{:<26}{:>10}{:>12}\n", condition.name, "frames", "encounters");
  for (std::size_t bin = 0; bin < counts.bins.size(); ++bin) {
    text += count_row(condition.bin_name(bin), counts.bins[bin],
                      !coverage.domain.has(i, bin)          ? "not of the domain"
                      : coverage.is_empty(counts.bins[bin]) ? "empty"
                                                            : "");
  }
  if (counts.outside.frames > 0) text += count_row("outside", counts.outside, "");
  if (counts.untold.frames > 0) text += count_row("not told", counts.untold, "");
  return text;
}

std::string target_lines(const DomainCoverage& coverage, const std::vector<DomainTarget>& targets) {
  std::string text;
  for (std::size_t i = 0; i < std::min(targets.size(), kListedTargets); ++i)
    text += "  " + coverage.text_of(targets[i]) + "\n";
  if (targets.size() > kListedTargets) text += fmt::format("  and {} more\n", targets.size() - kListedTargets);
  return text;
}

// The empty bins, and the empty pairs of bins that are not empty themselves.
std::string empty_text(const DomainCoverage& coverage) {
  const std::vector<DomainTarget> bins = coverage.empty_bins();
  std::vector<DomainTarget> pairs = coverage.empty_pairs();
  const std::size_t all = pairs.size();
  const auto is_empty = [&](std::size_t condition, std::size_t bin) {
    return coverage.is_empty(coverage.conditions[condition].bins[bin]);
  };
  std::erase_if(pairs, [&](const DomainTarget& target) {
    return is_empty(target.condition, target.bin) || is_empty(target.other->first, target.other->second);
  });
  return fmt::format("empty bins: {}\n", bins.size()) + target_lines(coverage, bins) +
         fmt::format("empty pairs of bins: {}; {} of them of bins that are not empty\n", all, pairs.size()) +
         target_lines(coverage, pairs);
}

Json json_of(const DomainCount& count) {
  return {{"frames", count.frames}, {"encounters", count.encounters}};
}

Json bin_json(const DomainCondition& condition, std::size_t bin) {
  if (condition.edges.empty()) return {{"value", condition.values[bin]}};
  return {{"from", condition.edges[bin]}, {"to", condition.edges[bin + 1]}};
}

Json condition_json(const DomainCoverage& coverage, std::size_t i) {
  const ConditionCoverage& counts = coverage.conditions[i];
  Json json{{"name", coverage.domain.conditions[i].name}, {"bins", Json::array()}};
  for (std::size_t bin = 0; bin < counts.bins.size(); ++bin) {
    Json one = bin_json(coverage.domain.conditions[i], bin);
    append_members(one, json_of(counts.bins[bin]));
    one["in_domain"] = coverage.domain.has(i, bin);
    json["bins"].push_back(std::move(one));
  }
  json["outside"] = json_of(counts.outside);
  json["not_told"] = json_of(counts.untold);
  return json;
}

Json target_json(const DomainCoverage& coverage, const DomainTarget& target) {
  const auto of = [&](std::size_t condition, std::size_t bin) {
    Json json{{"condition", coverage.domain.conditions[condition].name}};
    append_members(json, bin_json(coverage.domain.conditions[condition], bin));
    return json;
  };
  if (!target.other) return of(target.condition, target.bin);
  return Json::array({of(target.condition, target.bin), of(target.other->first, target.other->second)});
}

Json targets_json(const DomainCoverage& coverage, const std::vector<DomainTarget>& targets) {
  Json list = Json::array();
  for (const DomainTarget& target : targets) list.push_back(target_json(coverage, target));
  return list;
}

constexpr PlotColor kDomainBars{40, 120, 200}, kCoveredCell{120, 180, 120}, kEmptyCell{220, 60, 60};

Plot condition_plot(const DomainCoverage& coverage, std::size_t i) {
  const DomainCondition& condition = coverage.domain.conditions[i];
  PlotSeries bars{.kind = SeriesKind::areas, .color = kDomainBars};
  std::vector<PlotTick> names;
  double most = 1;
  for (std::size_t bin = 0; bin < condition.bins(); ++bin) {
    const auto at = static_cast<double>(bin);
    const auto encounters = static_cast<double>(coverage.conditions[i].bins[bin].encounters);
    names.push_back({at, condition.bin_name(bin)});
    most = std::max(most, encounters);
    if (encounters > 0) bars.runs.push_back({{at - 0.35, 0}, {at + 0.35, encounters}});
  }
  return {.title = condition.name,
          .y_label = "encounters",
          .x_range = {-0.5, static_cast<double>(condition.bins()) - 0.5},
          .y_range = {0, 1.05 * most},
          .series = {std::move(bars)},
          .x_ticks = std::move(names),
          .height = 250};
}

// A cell for each pair of bins: filled where the domain has it.
Plot pairs_plot(const DomainCoverage& coverage) {
  PlotSeries covered{.title = "covered", .kind = SeriesKind::areas, .color = kCoveredCell};
  PlotSeries empty{.title = "empty", .kind = SeriesKind::areas, .color = kEmptyCell};
  std::vector<double> begin{0};  // of each condition along the axes
  std::vector<PlotTick> names;
  std::vector<PlotNote> notes;  // along the diagonal, which has no pairs
  for (const DomainCondition& condition : coverage.domain.conditions) {
    const auto bins = static_cast<double>(condition.bins());
    const double middle = begin.back() + bins / 2;
    names.push_back({middle, condition.name});
    notes.push_back({{middle, middle}, condition.name});
    begin.push_back(begin.back() + bins);
  }
  coverage.for_each_pair([&](const DomainTarget& target, const DomainCount& count) {
    if (!coverage.has(target)) return;
    const double x = begin[target.other->first] + static_cast<double>(target.other->second);
    const double y = begin[target.condition] + static_cast<double>(target.bin);
    (coverage.is_empty(count) ? empty : covered).runs.push_back({{x + 0.05, y + 0.05}, {x + 0.95, y + 0.95}});
  });
  return {.title = "pairs of bins",
          .x_range = {0, begin.back()},
          .y_range = {0, begin.back()},
          .series = {std::move(covered), std::move(empty)},
          .notes = std::move(notes),
          .x_ticks = std::move(names),
          .y_ticks = std::vector<PlotTick>{},
          .height = 600};
}

}  // namespace

std::string domain_text(const DomainCoverage& coverage, const std::string& title) {
  const DesignDomain& domain = coverage.domain;
  std::string text =
      fmt::format("design domain {}, {}: {}, {}; {} in view in {}", domain.name, title,
                  count_text(coverage.videos, "video"), count_text(coverage.frames, "frame"),
                  count_text(coverage.in_view.encounters, "encounter"), count_text(coverage.in_view.frames, "frame"));
  if (coverage.unopened > 0)
    text += fmt::format("; without {} whose files cannot be opened", count_text(coverage.unopened, "video"));
  text += fmt::format("\noutside of the domain: {} of {}\n", count_text(coverage.outside.frames, "frame"),
                      count_text(coverage.outside.encounters, "encounter"));
  if (domain.min_encounters > 1)
    text += fmt::format("a bin or pair of bins with fewer than {} encounters counts as empty\n", domain.min_encounters);
  for (std::size_t i = 0; i < domain.conditions.size(); ++i) text += condition_table(coverage, i);
  const auto [covered, all] = coverage.pairs_covered();
  text += fmt::format("pairs of bins: {} of {} covered{}\n", covered, all,
                      all > 0 ? fmt::format(", {:.1f} %", 100.0 * double(covered) / double(all)) : "");
  return text + empty_text(coverage);
}

std::string domain_json(const DomainCoverage& coverage, const std::string& title) {
  Json json{{"domain", coverage.domain.name},
            {"coverage", title},
            {"min_encounters", coverage.domain.min_encounters},
            {"videos", coverage.videos},
            {"unopened_videos", coverage.unopened},
            {"frames", coverage.frames},
            {"in_view", json_of(coverage.in_view)},
            {"outside", json_of(coverage.outside)},
            {"conditions", Json::array()}};
  for (std::size_t i = 0; i < coverage.domain.conditions.size(); ++i)
    json["conditions"].push_back(condition_json(coverage, i));
  const auto [covered, all] = coverage.pairs_covered();
  json["pairs"] = {{"covered", covered}, {"all", all}};
  json["pairs"]["share"] = all > 0 ? Json(double(covered) / double(all)) : Json(nullptr);
  json["empty_bins"] = targets_json(coverage, coverage.empty_bins());
  json["empty_pairs"] = targets_json(coverage, coverage.empty_pairs());
  return json_text(json);
}

cv::Mat domain_plot(const DomainCoverage& coverage, const std::string& title) {
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < coverage.domain.conditions.size(); ++i) plots.push_back(condition_plot(coverage, i));
  if (!coverage.pairs.empty()) plots.push_back(pairs_plot(coverage));
  plots.back().x_label = coverage.domain.name + ", " + title;
  return image_of(plots);
}

}  // namespace sigs
