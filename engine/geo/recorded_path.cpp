// SPDX-License-Identifier: MIT
#include "geo/recorded_path.h"

#include <algorithm>

#include "base/ensure.h"
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
  switch (reference) {
    case HeightReference::ellipsoid:
      return "above the ellipsoid";
    case HeightReference::sea_level:
      return "above the sea";
    case HeightReference::pressure:
      return "by pressure";
    case HeightReference::ground:
      return "above the ground";
    case HeightReference::unknown:
      return "not known";
  }
  return "";
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

}  // namespace sigs
