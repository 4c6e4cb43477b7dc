// SPDX-License-Identifier: MIT
#include "dataset/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <span>
#include <string_view>

#include "base/json.h"
#include "base/pose.h"
#include "base/text.h"
#include "base/threads.h"
#include "dataset/footage_cache.h"
#include "dataset/index.h"
#include "plot/plot.h"
#include "scene/scene_at.h"
#include "scene/visibility.h"
#include "truth/measure.h"

namespace sigs {

namespace {

// From the numbers sampled for an image: those of its further bodies are called other1.sky_percent, ...
BeforeWhat before_what(const std::map<std::string, double>& sampled, std::size_t body) {
  constexpr double kNearlyAll_percent = 100 * kNearlyAll;
  const std::string prefix = body == 0 ? "" : fmt::format("other{}.", body);
  const auto percent_of = [&](const char* what) {
    const auto there = sampled.find(prefix + what);
    return there == sampled.end() ? -1 : there->second;
  };
  if (percent_of("sky_percent") < 0) return BeforeWhat::unknown;
  if (percent_of("sky_percent") >= kNearlyAll_percent) return BeforeWhat::sky;
  return percent_of("land_percent") >= kNearlyAll_percent ? BeforeWhat::land : BeforeWhat::both;
}

template <class Limits>
void count_in(std::vector<long long>& bins, const Limits& limits, double value) {
  ++bins.at(static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), value) - limits.begin()));
}

double bearing_deg_of(const glm::dvec3& in_camera_m) {
  return deg_of_rad(std::atan2(in_camera_m.y, in_camera_m.x));
}

// A body without a box of its silhouette counts in the centre.
int cell_of_box(const std::optional<Box>& box, cv::Size image_px) {
  return box ? cell_of(box->x + box->width / 2, box->y + box->height / 2, image_px) : 4;
}

// What of one scene can be seen in a frame.
void add_sights(const PlannedVideo& video, const Scene& scene, const VisibilityEstimator& estimator, int frame,
                Coverage& coverage) {
  const Project& project = video.project;
  const std::vector<VisibilityEstimate> estimates = estimator.all_at(frame);
  const SceneMoment moment = scene_at(scene, frame);
  for (const PlacedIntruder& placed : moment.intruders) {
    const auto i = static_cast<std::size_t>(placed.id);
    const VisibilityState state = estimates[i].visibility_state;
    if (state != VisibilityState::in_view && state != VisibilityState::partly_occluded) continue;
    const SceneIntruder& intruder = scene.intruders[i];
    coverage.add({.category = project.intruders[i].category,
                  .is_distractor = intruder.is_distractor,
                  .range_m = estimates[i].distance_m,
                  .size_px = estimates[i].size_px,
                  .bearing_deg = bearing_deg_of(placed.camera_from_body.translation_m),
                  .horizon = scene.horizon_is_known ? horizon_side_of(intruder.model->outermost_m,
                                                                      placed.camera_from_body, moment.up_in_camera)
                                                    : HorizonSide::unknown,
                  .before = before_what(video.sampled, i),
                  .cell = cell_of_box(estimates[i].silhouette, scene.camera.size_px)});
  }
}

// The sight that an element `intruder` tells of. Error without a place: a number is missing.
Result<Sight> sight_of(pugi::xml_node intruder, cv::Size image_px,
                       const std::map<std::string, std::string>& categories) {
  const pugi::xml_node position = intruder.child("position");
  const pugi::xml_node silhouette = intruder.child("silhouette");
  Sight sight{.is_distractor = std::string_view(intruder.attribute("role").value()) == "distractor",
              .range_m = attribute_of(intruder.child("distance"), "m"),
              .size_px = std::max(attribute_of(silhouette, "width"), attribute_of(silhouette, "height")),
              .bearing_deg = bearing_deg_of({attribute_of(position, "x_m"), attribute_of(position, "y_m"), 0}),
              .horizon = horizon_side_named(intruder.attribute("horizon").value()).value_or(HorizonSide::unknown),
              .cell = cell_of(attribute_of(silhouette, "x") + attribute_of(silhouette, "width") / 2,
                              attribute_of(silhouette, "y") + attribute_of(silhouette, "height") / 2, image_px)};
  const auto category = categories.find(intruder.attribute("id").value());
  sight.category = category == categories.end() ? "?" : category->second;
  if (std::isfinite(sight.range_m) && std::isfinite(sight.size_px) && std::isfinite(sight.bearing_deg)) return sight;
  return fail("", fmt::format("intruder {}: distance, position or silhouette is missing or no number",
                              line_text(intruder.attribute("id").value())));
}

Result<void> count_video(const std::filesystem::path& folder, const IndexedVideo& video, pugi::xml_node root,
                         Coverage& coverage) {
  const std::filesystem::path file = folder / video.name / (video.name + ".xml");
  const pugi::xml_node footage = root.child("footage");
  const cv::Size image_px(footage.attribute("width").as_int(1), footage.attribute("height").as_int(1));
  ++coverage.videos;
  for (const pugi::xml_node frame : root.children("frame")) {
    ++coverage.frames;
    for (const pugi::xml_node intruder : frame.children("intruder")) {
      if (!intruder.child("box")) continue;
      Result<Sight> sight = sight_of(intruder, image_px, video.categories);
      if (!sight)
        return fail(file.string(),
                    fmt::format("frame {}: {}", line_text(frame.attribute("index").value()), sight.error().what));
      sight->before = before_what(video.sampled, intruder.attribute("id").as_uint());
      coverage.add(*sight);
    }
  }
  return {};
}

}  // namespace

int cell_of(double x_px, double y_px, cv::Size image_px) {
  const auto third = [](double at_px, int length_px) {
    const double thirds = 3 * (at_px + 0.5) / std::max(1, length_px);
    return std::isfinite(thirds) ? static_cast<int>(std::clamp(std::floor(thirds), 0.0, 2.0)) : 1;
  };
  return 3 * third(y_px, image_px.height) + third(x_px, image_px.width);
}

void CoverageCounts::add(const Sight& sight) {
  ++sights;
  count_in(range, kRangeLimits_m, sight.range_m);
  count_in(size, kSizeLimits_px, sight.size_px);
  count_in(bearing, kBearingLimits_deg, sight.bearing_deg);
  ++cell.at(static_cast<std::size_t>(sight.cell));
  ++horizon.at(static_cast<std::size_t>(sight.horizon));
  ++before.at(static_cast<std::size_t>(sight.before));
}

void Coverage::add(const Sight& sight) {
  (sight.is_distractor ? distractors : intruders).add(sight);
  ++categories[sight.category];
}

Result<Coverage> predicted_coverage(const std::vector<const PlannedVideo*>& videos, const std::atomic<bool>* cancel) {
  VideoVisibility opener;
  Coverage coverage;
  for (const PlannedVideo* const video : videos) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    const std::optional<Scene> scene = opener.scene_of(video->project);
    if (!scene) {
      ++coverage.unopened;
      continue;
    }
    const VisibilityEstimator estimator(*scene);
    ++coverage.videos;
    coverage.frames += scene->last_frame - scene->first_frame + 1;
    for (int frame = scene->first_frame; frame <= scene->last_frame; ++frame)
      add_sights(*video, *scene, estimator, frame, coverage);
  }
  return coverage;
}

Result<Coverage> counted_coverage(const std::filesystem::path& folder, const std::atomic<bool>* cancel) {
  Coverage coverage;
  const Result<Json> index =
      for_each_indexed_video(folder, cancel, [&](const IndexedVideo& video, pugi::xml_node annotations) {
        return count_video(folder, video, annotations, coverage);
      });
  if (!index) return fail(index.error());
  return coverage;
}

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
  std::vector<CoverageSection> sections{
      binned("range_m", kRangeLimits_m, intruders.range, distractors.range),
      binned("size_px", kSizeLimits_px, intruders.size, distractors.size),
      binned("bearing_deg", kBearingLimits_deg, intruders.bearing, distractors.bearing), cells, horizon};
  const long long known = intruders.sights + distractors.sights - intruders.before.back() - distractors.before.back();
  if (known > 0)
    sections.push_back({.title = "before",
                        .bins = {kBeforeNames.begin(), kBeforeNames.end()},
                        .limits = {},
                        .intruders = intruders.before,
                        .distractors = distractors.before});
  return sections;
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
      bin[section.title == "horizon" ? "side" : section.title == "before" ? "what" : "cell"] = section.bins[i];
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
