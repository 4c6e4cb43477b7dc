// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/json.h"
#include "base/text.h"
#include "dataset/coverage.h"
#include "plot/plot.h"

namespace sigs {

namespace {

// One quantity of the table: its bins' names and counts.
struct CoverageSection {
  std::string title;
  std::vector<std::string> bins;
  std::vector<double> limits;  // between the bins; empty: the bins are names
  std::vector<long long> intruders;
  std::vector<long long> distractors;
};

std::vector<std::string> bin_names(std::span<const double> limits) {
  std::vector<std::string> names{"below " + short_number_text(limits.front())};
  for (std::size_t i = 1; i < limits.size(); ++i)
    names.push_back(short_number_text(limits[i - 1]) + " to " + short_number_text(limits[i]));
  names.push_back(short_number_text(limits.back()) + " and more");
  return names;
}

CoverageSection binned(const std::string& title, std::span<const double> limits,
                       const std::vector<long long>& intruders, const std::vector<long long>& distractors) {
  return {title, bin_names(limits), {limits.begin(), limits.end()}, intruders, distractors};
}

std::vector<CoverageSection> sections_of(const Coverage& coverage) {
  const CoverageCounts& intruders = coverage.intruders;
  const CoverageCounts& distractors = coverage.distractors;
  const CoverageSection cells{.title = "image_position",
                              .bins = {kCellNames.begin(), kCellNames.end()},
                              .limits = {},
                              .intruders = intruders.cell,
                              .distractors = distractors.cell};
  CoverageSection horizon{.title = "horizon", .bins = {}, .limits = {}, .intruders = {}, .distractors = {}};
  for (const HorizonSide side : {HorizonSide::above, HorizonSide::on, HorizonSide::below, HorizonSide::unknown}) {
    horizon.bins.emplace_back(name_of(side));
    horizon.intruders.push_back(intruders.horizon.at(static_cast<std::size_t>(side)));
    horizon.distractors.push_back(distractors.horizon.at(static_cast<std::size_t>(side)));
  }
  return {binned("range_m", kRangeLimits_m, intruders.range, distractors.range),
          binned("size_px", kSizeLimits_px, intruders.size, distractors.size),
          binned("bearing_deg", kBearingLimits_deg, intruders.bearing, distractors.bearing), cells, horizon};
}

std::string share_text(long long part, long long whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100.0 * double(part) / double(whole)) : "-";
}

constexpr PlotColor kIntruderBars{40, 120, 200}, kDistractorBars{230, 120, 40};

// One histogram. The only bar of a bin is in line with its label; two stand on both sides of it.
Plot section_plot(const CoverageSection& section, bool has_distractors) {
  PlotSeries intruders{.kind = SeriesKind::areas, .color = kIntruderBars};
  PlotSeries distractors{.kind = SeriesKind::areas, .color = kDistractorBars};
  std::vector<PlotTick> names;
  double most = 1;
  for (std::size_t i = 0; i < section.bins.size(); ++i) {
    const auto at = static_cast<double>(i);
    const auto seen = static_cast<double>(section.intruders[i]), beside = static_cast<double>(section.distractors[i]);
    names.push_back({at, section.bins[i]});
    most = std::max({most, seen, beside});
    if (seen > 0) intruders.runs.push_back({{at - 0.35, 0}, {has_distractors ? at : at + 0.35, seen}});
    if (beside > 0) distractors.runs.push_back({{at, 0}, {at + 0.35, beside}});
  }
  return {.title = section.title,
          .x_range = {-0.5, static_cast<double>(section.bins.size()) - 0.5},
          .y_range = {0, 1.05 * most},
          .series = {std::move(intruders), std::move(distractors)},
          .x_ticks = std::move(names),
          .height = 250};
}

Json counts_json(const CoverageSection& section, const std::vector<long long>& counts) {
  Json list = Json::array();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    Json bin = Json::object();
    if (section.limits.empty()) {
      bin[section.title == "horizon" ? "side" : "cell"] = section.bins[i];
    } else {
      bin["from"] = i == 0 ? Json(nullptr) : Json(section.limits[i - 1]);
      bin["to"] = i == section.limits.size() ? Json(nullptr) : Json(section.limits[i]);
    }
    bin["count"] = counts[i];
    list.push_back(std::move(bin));
  }
  return list;
}

}  // namespace

std::string coverage_text(const Coverage& coverage, const std::string& title) {
  const bool has_distractors = coverage.distractors.sights > 0;
  std::string text =
      fmt::format("coverage, {}: {}, {}; intruders in view {} times", title, count_text(coverage.videos, "video"),
                  count_text(coverage.frames, "frame"), coverage.intruders.sights);
  if (has_distractors) text += fmt::format(", distractors {} times", coverage.distractors.sights);
  if (coverage.unopened > 0)
    text += fmt::format("; without {} whose files cannot be opened", count_text(coverage.unopened, "video"));
  text += "\n";
  for (const CoverageSection& section : sections_of(coverage)) {
    text += fmt::format("{:<14}{:>12}{:>10}", section.title, "", "intruders");
    text += has_distractors ? fmt::format("{:>22}\n", "distractors") : "\n";
    for (std::size_t i = 0; i < section.bins.size(); ++i) {
      text += fmt::format("{:<12}{:>14}{:>10}{:>9}", "", section.bins[i], section.intruders[i],
                          share_text(section.intruders[i], coverage.intruders.sights));
      text += has_distractors ? fmt::format("{:>13}{:>9}\n", section.distractors[i],
                                            share_text(section.distractors[i], coverage.distractors.sights))
                              : "\n";
    }
  }
  text += "category\n";
  for (const auto& [category, count] : coverage.categories)
    text += fmt::format("{:<12}{:>14}{:>10}\n", "", category, count);
  return text;
}

std::string coverage_json(const Coverage& coverage, const std::string& title) {
  Json json{{"coverage", title},
            {"videos", coverage.videos},
            {"unopened_videos", coverage.unopened},
            {"frames", coverage.frames}};
  for (const bool of_distractors : {false, true}) {
    const CoverageCounts& counts = of_distractors ? coverage.distractors : coverage.intruders;
    Json& group = json[of_distractors ? "distractors" : "intruders"];
    group["in_view"] = counts.sights;
    for (const CoverageSection& section : sections_of(coverage))
      group[section.title] = counts_json(section, of_distractors ? section.distractors : section.intruders);
  }
  json["categories"] = Json::object();
  for (const auto& [category, count] : coverage.categories) json["categories"][category] = count;
  return json_text(json);
}

cv::Mat coverage_plot(const Coverage& coverage, const std::string& title) {
  std::vector<Plot> plots;
  for (const CoverageSection& section : sections_of(coverage))
    plots.push_back(section_plot(section, coverage.distractors.sights > 0));
  Plot& last = plots.back();
  last.x_label = "bodies in view, " + title;
  last.series[0].title = count_text(coverage.intruders.sights, "intruder");
  last.series[1].title = count_text(coverage.distractors.sights, "distractor");
  return image_of(plots);
}

}  // namespace sigs
