// SPDX-License-Identifier: MIT
#include "geo/recorded_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/ensure.h"
#include "base/pose.h"
#include "base/text.h"
#include "geo/recorded/path_draft.h"

namespace sigs {

namespace {

// What a file is that only looks like one of ours, and what to do about it; empty: none of these.
std::string_view wrong_with_content(std::string_view text) {
  if (text.starts_with("PK\x03\x04")) return "is a ZIP archive; if it is a KMZ, unpack it and take the KML file in it";
  if (text.starts_with("\x1F\x8B")) return "is compressed by gzip; unpack it first";
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || text.find('\0') != std::string_view::npos)
    return "is not text in UTF-8 (UTF-16, or no text at all); save it as UTF-8";
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return "is empty";
  return "";
}

Result<std::vector<PathDraft>> drafts_of(std::string_view text, const std::string& where) {
  const char first = text[text.find_first_not_of(" \t\r\n")];
  if (first == '<') return drafts_of_xml(text, where);
  if (first == '{' || first == '[') return drafts_of_adsb_json(text, where);
  if (is_opensky_csv(text)) return drafts_of_opensky_csv(text, where);
  return fail(
      where,
      "is no file with recorded paths: neither GPX, KML, JSON of readsb or the OpenSky Network, nor its CSV with "
      "the columns time, icao24, lat and lon");
}

// The shortest range of longitudes that has all of them: what the largest gap between neighbours leaves.
void set_longitudes(std::vector<double> longitudes, PathExtent& extent) {
  std::sort(longitudes.begin(), longitudes.end());
  double largest_deg = longitudes.front() + 360 - longitudes.back();
  extent.west_deg = longitudes.front();
  extent.east_deg = longitudes.back();
  for (std::size_t i = 1; i < longitudes.size(); ++i) {
    const double gap_deg = longitudes[i] - longitudes[i - 1];
    if (gap_deg <= largest_deg) continue;
    largest_deg = gap_deg;
    extent.west_deg = longitudes[i];
    extent.east_deg = longitudes[i - 1];
  }
}

}  // namespace

std::string_view name_of(HeightReference reference) {
  static constexpr std::array<std::string_view, 5> kNames{"above the ellipsoid", "above the sea", "by pressure",
                                                          "above the ground", "not known"};
  return kNames.at(static_cast<std::size_t>(reference));
}

Result<std::vector<RecordedPath>> recorded_paths_of(std::string_view text, const std::string& where) {
  if (const std::string_view wrong = wrong_with_content(text); !wrong.empty()) return fail(where, std::string(wrong));
  text = without_bom(text);
  if (const std::string_view wrong = wrong_with_content(text); !wrong.empty()) return fail(where, std::string(wrong));
  Result<std::vector<PathDraft>> drafts = drafts_of(text, where);
  if (!drafts) return fail(drafts.error());
  return repair_paths(std::move(*drafts), where);
}

Result<std::vector<RecordedPath>> read_recorded_paths(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path, kRecordedPathLimit_bytes);
  if (!text) return fail(text.error());
  return recorded_paths_of(*text, path.string());
}

PathExtent extent_of(const std::vector<TimedPlace>& points) {
  ENSURE(!points.empty());
  const GeodeticPosition& first = points.front().place;
  PathExtent extent{.south_deg = first.latitude_deg,
                    .north_deg = first.latitude_deg,
                    .low_m = first.height_m,
                    .high_m = first.height_m};
  std::vector<double> longitudes;
  for (const TimedPlace& point : points) {
    extent.south_deg = std::min(extent.south_deg, point.place.latitude_deg);
    extent.north_deg = std::max(extent.north_deg, point.place.latitude_deg);
    extent.low_m = std::min(extent.low_m, point.place.height_m);
    extent.high_m = std::max(extent.high_m, point.place.height_m);
    longitudes.push_back(point.place.longitude_deg);
  }
  set_longitudes(std::move(longitudes), extent);
  return extent;
}

namespace {

// The method takes time with the square of the number of points where each split takes off one point alone. Every point
// of this number stays, so that such a file takes as long as its length; in others it is one point of thousands.
constexpr std::size_t kMaxAtOnce = 4096;

class Simplification {
 public:
  Simplification(const std::vector<WorldWaypoint>& all, bool in_time, double tolerance_m)
      : all_(all), in_time_(in_time), tolerance_m_(tolerance_m), kept_(all.size(), false) {}

  [[nodiscard]] std::vector<WorldWaypoint> waypoints() {
    for (std::size_t first = 0; first < all_.size(); first += kMaxAtOnce)
      keep_needed(first, std::min(first + kMaxAtOnce, all_.size() - 1));
    std::vector<WorldWaypoint> chosen;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (kept_[i]) chosen.push_back(all_[i]);
    return chosen;
  }

 private:
  [[nodiscard]] double error_m(std::size_t i, std::size_t first, std::size_t last) const {
    const WorldWaypoint& a = all_[first];
    const WorldWaypoint& b = all_[last];
    if (!in_time_) return distance_to_segment(all_[i].position_m, a.position_m, b.position_m);
    const double part = (all_[i].time_s - a.time_s) / (b.time_s - a.time_s);
    return glm::length(all_[i].position_m - glm::mix(a.position_m, b.position_m, part));
  }

  // Splits at the point that is furthest off, until none is off by more than the tolerance.
  void keep_needed(std::size_t begin, std::size_t end) {
    kept_[begin] = kept_[end] = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{begin, end}};
    while (!open.empty()) {
      const auto [first, last] = open.back();
      open.pop_back();
      std::size_t furthest = first;
      double largest_m = tolerance_m_;
      for (std::size_t i = first + 1; i < last; ++i)
        if (const double off_m = error_m(i, first, last); off_m > largest_m) {
          largest_m = off_m;
          furthest = i;
        }
      if (furthest == first) continue;
      kept_[furthest] = true;
      open.emplace_back(first, furthest);
      open.emplace_back(furthest, last);
    }
  }

  const std::vector<WorldWaypoint>& all_;
  bool in_time_;
  double tolerance_m_;
  std::vector<bool> kept_;
};

}  // namespace

std::vector<WorldWaypoint> waypoints_of(const RecordedPath& path, const LocalFrame& frame, double tolerance_m) {
  ENSURE(tolerance_m >= 0 && std::isfinite(tolerance_m));
  std::vector<WorldWaypoint> all;
  for (const TimedPlace& point : path.points) all.push_back({point.time_s, frame.world_of(point.place)});
  if (tolerance_m == 0) return all;
  return Simplification(all, path.has_times, tolerance_m).waypoints();
}

}  // namespace sigs
