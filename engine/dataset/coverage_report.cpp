// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <span>

#include "base/json.h"
#include "base/text.h"
#include "dataset/coverage.h"
#include "telemetry/plot_axes.h"

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

constexpr int kCoverageWidth_px = 1200;
constexpr int kCoveragePanel_px = 230;
constexpr int kCoverageLeft_px = 90;
constexpr int kCoverageTop_px = 50;
constexpr int kCoverageBottom_px = 40;
const cv::Scalar kCoverageInk(40, 40, 40);
const cv::Scalar kIntruderBars(200, 120, 40);
const cv::Scalar kDistractorBars(40, 120, 230);

// One histogram, its frame's upper edge at top_px.
void draw_section(cv::Mat& image, const CoverageSection& section, bool has_distractors, int top_px) {
  const cv::Point low(kCoverageLeft_px, top_px);
  const cv::Point high(kCoverageWidth_px - 30, top_px + kCoveragePanel_px - kCoverageBottom_px - 30);
  long long most = 1;
  for (const auto* const counts : {&section.intruders, &section.distractors})
    for (const long long count : *counts) most = std::max(most, count);
  const double step = std::max(1.0, tick_step(double(most)));
  const auto row = [&](double count) {
    return high.y - static_cast<int>(std::lround(count / (1.05 * double(most)) * (high.y - low.y)));
  };
  const double width = double(high.x - low.x) / double(section.bins.size());
  std::vector<PlacedTick> columns;
  std::vector<PlacedTick> rows;
  for (const Tick& tick : ticks_between(0, 1.05 * double(most), step)) rows.push_back({tick, row(tick.value)});
  for (std::size_t i = 0; i < section.bins.size(); ++i)
    columns.push_back({{double(i), section.bins[i]}, low.x + static_cast<int>(std::lround(width * (double(i) + 0.5)))});
  draw_axes(image, low, high, columns, rows, {.ink = kCoverageInk});
  for (std::size_t i = 0; i < section.bins.size(); ++i) {
    const int middle = columns[i].at_px;
    const int bar = static_cast<int>(width * 0.35);
    // The only bar of a column is in line with its label; two stand on both sides of it.
    const int intruders_end = has_distractors ? middle - 1 : middle + bar;
    if (section.intruders[i] > 0)
      cv::rectangle(image, {middle - bar, row(double(section.intruders[i]))}, {intruders_end, high.y}, kIntruderBars,
                    cv::FILLED);
    if (section.distractors[i] > 0)
      cv::rectangle(image, {middle + 1, row(double(section.distractors[i]))}, {middle + bar, high.y}, kDistractorBars,
                    cv::FILLED);
  }
  draw_text(image, section.title, {low.x, low.y - 8}, kCoverageInk);
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
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

cv::Mat coverage_plot(const Coverage& coverage, const std::string& title) {
  const std::vector<CoverageSection> sections = sections_of(coverage);
  const int height = kCoverageTop_px + static_cast<int>(sections.size()) * kCoveragePanel_px;
  cv::Mat image(height, kCoverageWidth_px, CV_8UC3, cv::Scalar::all(255));
  draw_text(image,
            fmt::format("bodies in view, {}: intruders {} (blue), distractors {} (orange)", title,
                        coverage.intruders.sights, coverage.distractors.sights),
            {kCoverageLeft_px, 20}, kCoverageInk);
  for (std::size_t i = 0; i < sections.size(); ++i)
    draw_section(image, sections[i], coverage.distractors.sights > 0,
                 kCoverageTop_px + 10 + static_cast<int>(i) * kCoveragePanel_px);
  return image;
}

}  // namespace sigs
