// SPDX-License-Identifier: MIT
#include "geo/recorded/path_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "geo/utc_time.h"

namespace sigs {
namespace {

// Longer times without a point are worth a warning: what happened in them is not known.
constexpr double kLongGap_s = 30;

using OptionalNumbers = std::vector<std::optional<double>>;

// A draft on its way to a path.
struct Repair {
  PathDraft draft;
  std::vector<std::string> notes;

  [[nodiscard]] std::vector<DraftPoint>& points() { return draft.points; }

  void note(std::string_view text) { notes.emplace_back(text); }
};

bool is_usable_place(const DraftPoint& point) {
  const bool is_nowhere = point.latitude_deg == 0 && point.longitude_deg == 0;
  return !is_nowhere && check_place({point.latitude_deg, point.longitude_deg, 0}).has_value();
}

void drop_unusable_places(Repair& repair) {
  std::vector<DraftPoint>& points = repair.points();
  // Some programs count longitudes from 0 to 360 degrees, or beyond 180 where a line crosses the antimeridian.
  for (DraftPoint& point : points)
    if (const double size_deg = std::abs(point.longitude_deg); size_deg > 180 && size_deg <= 360)
      point.longitude_deg = std::remainder(point.longitude_deg, 360.0);
  const auto first = std::find_if_not(points.begin(), points.end(), is_usable_place);
  if (first == points.end()) return;
  const auto number = first - points.begin() + 1;
  const double latitude_deg = first->latitude_deg;
  const double longitude_deg = first->longitude_deg;
  const std::size_t dropped = std::erase_if(points, [](const DraftPoint& point) { return !is_usable_place(point); });
  repair.note(fmt::format(
      "{} left out for a place that cannot be: unreadable, out of range or exactly 0/0; the first is "
      "number {} (latitude {}, longitude {})",
      count_text(dropped, "point"), number, short_number_text(latitude_deg), short_number_text(longitude_deg)));
}

bool has_usable_time(const DraftPoint& point) {
  return point.time_s && *point.time_s >= kFirstUtc_s && *point.time_s <= kLastUtc_s;
}

// Whether the path has times. Afterwards all points have one.
bool settle_times(Repair& repair) {
  std::vector<DraftPoint>& points = repair.points();
  const auto timed = std::count_if(points.begin(), points.end(), has_usable_time);
  if (timed == 0) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i].time_s = static_cast<double>(i);
    repair.note("has no times");
    return false;
  }
  const std::size_t dropped = std::erase_if(points, [](const DraftPoint& point) { return !has_usable_time(point); });
  if (dropped > 0) repair.note(fmt::format("{} left out for want of a time", count_text(dropped, "point")));
  return true;
}

void bring_into_order(Repair& repair) {
  std::vector<DraftPoint>& points = repair.points();
  std::int64_t back = 0;
  double latest_s = kFirstUtc_s;
  for (const DraftPoint& point : points) {
    if (*point.time_s < latest_s) ++back;
    latest_s = std::max(latest_s, *point.time_s);
  }
  if (back > 0) {
    repair.note(fmt::format("times go back at {}; put in order of time", count_text(back, "point")));
    std::ranges::stable_sort(points, {}, &DraftPoint::time_s);
  }
  const auto end = std::unique(points.begin(), points.end(),
                               [](const DraftPoint& a, const DraftPoint& b) { return a.time_s == b.time_s; });
  if (end == points.end()) return;
  repair.note(fmt::format("{} left out for the time of an earlier one", count_text(points.end() - end, "point")));
  points.erase(end, points.end());
}

// Every value: those that lack follow from their neighbours, in proportion to time; before the first and after the last
// they are the same. There must be one.
std::vector<double> filled(const std::vector<DraftPoint>& points, const OptionalNumbers& values) {
  std::vector<double> all(values.size());
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    const std::size_t begin = before ? *before + 1 : 0;
    const double before_value = before ? *values[*before] : *values[i];
    const double start_s = before ? *points[*before].time_s : *points[0].time_s - 1;
    for (std::size_t k = begin; k < i; ++k)
      all[k] = std::lerp(before_value, *values[i], (*points[k].time_s - start_s) / (*points[i].time_s - start_s));
    all[i] = *values[i];
    before = i;
  }
  for (std::size_t k = before.value_or(0) + 1; k < values.size(); ++k) all[k] = *values[*before];
  return all;
}

bool is_usable_height(double height_m) {
  return height_m >= kLowestHeight_m && height_m <= kHighestHeight_m;
}

void drop_unusable_heights(Repair& repair) {
  std::int64_t dropped = 0;
  for (DraftPoint& point : repair.points())
    for (std::optional<double>* const height : {&point.height_m, &point.pressure_height_m})
      if (*height && !is_usable_height(**height)) {
        height->reset();
        ++dropped;
      }
  if (dropped > 0) repair.note(fmt::format("{} ignored: not a height that can be", count_text(dropped, "height")));
}

std::int64_t missing_in(const OptionalNumbers& values) {
  return std::count(values.begin(), values.end(), std::nullopt);
}

// Where pressure alone is known, the geometric height is the pressure's plus the difference of both at the times
// beside, which changes as slowly as the weather and the height do.
void take_from_pressure(Repair& repair, OptionalNumbers& heights) {
  const std::vector<DraftPoint>& points = repair.points();
  OptionalNumbers differences(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].height_m && points[i].pressure_height_m)
      differences[i] = *points[i].height_m - *points[i].pressure_height_m;
  if (missing_in(differences) == std::ssize(differences)) return;
  const std::vector<double> all = filled(points, differences);
  std::int64_t taken = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (heights[i] || !points[i].pressure_height_m) continue;
    const double height_m = *points[i].pressure_height_m + all[i];
    if (!is_usable_height(height_m)) continue;
    heights[i] = height_m;
    ++taken;
  }
  if (taken > 0)
    repair.note(
        fmt::format("{} of the pressure alone; the difference to the geometric height is taken from the points "
                    "beside",
                    count_text(taken, "height")));
}

// In the order of HeightReference.
constexpr std::array<std::string_view, 5> kHeightWarnings{
    "",
    "heights count from the sea (the geoid, or what the recorder took for it), which lies up to 107 m from the "
    "ellipsoid; they are not converted",
    "heights are those of the pressure in the standard atmosphere; without the QNH they cannot be compared with "
    "heights of GPS",
    "heights count from the ground, whose own height is not in the file", "has no heights; all are 0"};

// The height of each point, and what they count from.
std::pair<std::vector<double>, HeightReference> settle_heights(Repair& repair) {
  drop_unusable_heights(repair);
  const std::vector<DraftPoint>& points = repair.points();
  OptionalNumbers heights(points.size());
  HeightReference reference = repair.draft.height;
  for (std::size_t i = 0; i < points.size(); ++i) heights[i] = points[i].height_m;
  if (missing_in(heights) == std::ssize(heights)) {
    reference = HeightReference::pressure;
    for (std::size_t i = 0; i < points.size(); ++i) heights[i] = points[i].pressure_height_m;
  } else {
    take_from_pressure(repair, heights);
  }
  const std::int64_t missing = missing_in(heights);
  if (missing == std::ssize(heights)) return {std::vector<double>(points.size(), 0), HeightReference::unknown};
  if (missing > 0)
    repair.note(
        fmt::format("{} without a height; theirs follows from the points beside", count_text(missing, "point")));
  return {filled(points, heights), reference};
}

void note_gaps(Repair& repair) {
  const std::vector<DraftPoint>& points = repair.points();
  std::int64_t gaps = 0;
  std::size_t longest = 0;
  double longest_s = kLongGap_s;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double gap_s = *points[i].time_s - *points[i - 1].time_s;
    gaps += gap_s > kLongGap_s ? 1 : 0;
    if (gap_s > longest_s) {
      longest = i;
      longest_s = gap_s;
    }
  }
  if (gaps > 0)
    repair.note(fmt::format("{} longer than {:.0f} s between points, the longest of {} after point {}",
                            count_text(gaps, "gap"), kLongGap_s, clock_text(longest_s), longest));
}

std::string where_of(const std::string& where, const PathDraft& draft) {
  if (draft.name.empty()) return where;
  return fmt::format("{}: \"{}\"", where, draft.name);
}

// nullopt: no point is usable.
std::optional<RecordedPath> repaired(PathDraft draft, const std::string& where) {
  Repair repair{std::move(draft), {}};
  repair.notes = std::move(repair.draft.notes);
  drop_unusable_places(repair);
  if (repair.points().empty()) return std::nullopt;
  RecordedPath path;
  path.has_times = settle_times(repair);
  if (path.has_times) bring_into_order(repair);
  path.utc = path.has_times && repair.draft.utc;
  if (path.has_times && !path.utc) repair.note("times do not count from a known instant");
  const auto [heights, reference] = settle_heights(repair);
  path.height = reference;
  if (reference != HeightReference::ellipsoid) repair.note(kHeightWarnings.at(static_cast<std::size_t>(reference)));
  if (path.has_times) note_gaps(repair);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const DraftPoint& point = repair.points()[i];
    path.points.push_back({*point.time_s, {point.latitude_deg, point.longitude_deg, heights[i]}});
  }
  const std::string where_path = where_of(where, repair.draft);
  for (std::string& note : repair.notes) path.warnings.push_back({where_path, std::move(note)});
  path.name = std::move(repair.draft.name);
  path.icao24 = std::move(repair.draft.icao24);
  return path;
}

using PathShape = std::tuple<std::size_t, double, double, double, double>;

PathShape shape_of_path(const RecordedPath& path) {
  const GeodeticPosition& first = path.points.front().place;
  const GeodeticPosition& last = path.points.back().place;
  return {path.points.size(), first.latitude_deg, first.longitude_deg, last.latitude_deg, last.longitude_deg};
}

bool has_same_places(const RecordedPath& a, const RecordedPath& b) {
  return std::equal(
      a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), [](const TimedPlace& p, const TimedPlace& q) {
        return p.place.latitude_deg == q.place.latitude_deg && p.place.longitude_deg == q.place.longitude_deg;
      });
}

void drop_lines_of_timed_paths(std::vector<RecordedPath>& paths) {
  std::map<PathShape, const RecordedPath*> timed;
  for (const RecordedPath& path : paths)
    if (path.has_times) timed.emplace(shape_of_path(path), &path);
  std::set<const RecordedPath*> doubled;
  for (const RecordedPath& path : paths) {
    if (path.has_times) continue;
    const auto found = timed.find(shape_of_path(path));
    if (found != timed.end() && has_same_places(path, *found->second)) doubled.insert(&path);
  }
  // Each is looked at in its old place.
  std::erase_if(paths, [&](const RecordedPath& path) { return doubled.contains(&path); });
}

}  // namespace

std::optional<double> file_number_of(std::string_view text) {
  return parsed_number(trimmed(text, " \t\r\n"));
}

double file_number_or_nan(std::string_view text) {
  return file_number_of(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string file_name_text(std::string_view text) {
  constexpr std::size_t kMaxBytes = 200;
  return std::string(trimmed(line_text(text.substr(0, kMaxBytes)), " "));
}

Result<std::vector<RecordedPath>> repair_paths(std::vector<PathDraft> drafts, const std::string& where) {
  std::vector<RecordedPath> paths;
  std::vector<std::string> unusable;
  for (PathDraft& draft : drafts) {
    if (draft.points.empty()) continue;
    const std::string name = where_of(where, draft);
    if (std::optional<RecordedPath> path = repaired(std::move(draft), where))
      paths.push_back(std::move(*path));
    else
      unusable.push_back(name);
  }
  if (paths.empty())
    return fail(where, unusable.empty()
                           ? "has no path: no track, line or position of an aircraft is in it"
                           : "has no usable point: every place is unreadable, out of range or exactly 0/0");
  if (!unusable.empty())
    paths.front().warnings.push_back(
        {unusable.front(),
         fmt::format("{} left out: none of its points is at a place that can be",
                     unusable.size() == 1 ? "is" : fmt::format("and {} more are", unusable.size() - 1))});
  drop_lines_of_timed_paths(paths);
  return paths;
}

}  // namespace sigs
