// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_file.h"
#include "base/text.h"
#include "geo/recorded/path_draft.h"
#include "geo/utc_time.h"

namespace sigs {
namespace {

// What the readers of GPX and KML share. Names of elements are compared without their prefixes: gx:Track and Track are
// the same, whatever prefix the file gives a namespace.

// For drafts with times that state no zone.
constexpr const char* kNoZoneNote = "times state no zone; they are taken for UTC";

// "Track" for "gx:Track".
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// The first child of a local name; an empty node where there is none.
pugi::xml_node child_named(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node& child : node.children())
    if (local_name(child) == name) return child;
  return {};
}

// The text of the first child of that name; empty where there is none.
std::string_view text_in(const pugi::xml_node& node, std::string_view name) {
  return child_named(node, name).child_value();
}

// The time that a text says, in UTC; sets has_local where it states no zone. nullopt: it is no time.
std::optional<double> time_in(std::string_view text, bool& has_local) {
  const std::optional<UtcInstant> instant = utc_instant_of(text);
  if (!instant) return std::nullopt;
  has_local |= !instant->has_zone;
  return instant->time_s;
}

// GPX 1.1, https://www.topografix.com/GPX/1/1/. GPX 1.0 has the same elements as far as they are read here.

void add_gpx_point(const pugi::xml_node& node, PathDraft& draft, bool& has_local) {
  DraftPoint point;
  point.latitude_deg = file_number_or_nan(node.attribute("lat").value());
  point.longitude_deg = file_number_or_nan(node.attribute("lon").value());
  point.height_m = file_number_of(text_in(node, "ele"));
  point.time_s = time_in(text_in(node, "time"), has_local);
  draft.points.push_back(point);
}

void add_gpx_points(const pugi::xml_node& node, std::string_view name, PathDraft& draft, bool& has_local) {
  for (const pugi::xml_node& child : node.children())
    if (local_name(child) == name) add_gpx_point(child, draft, has_local);
}

PathDraft draft_of_gpx(const pugi::xml_node& node) {
  PathDraft draft;
  draft.name = file_name_text(text_in(node, "name"));
  draft.height = HeightReference::sea_level;
  bool has_local = false;
  add_gpx_points(node, "rtept", draft, has_local);
  for (const pugi::xml_node& segment : node.children())
    if (local_name(segment) == "trkseg") add_gpx_points(segment, "trkpt", draft, has_local);
  add_gpx_points(node, "trkpt", draft, has_local);
  if (has_local) draft.notes.emplace_back(kNoZoneNote);
  return draft;
}

// KML 2.2 (OGC 07-147r2) with Google's extension gx:Track, which KML 2.3 (OGC 12-007r2) has as Track.

constexpr std::string_view kKmlSpace = " \t\r\n";

// Takes the first word off the text, at any white space.
std::string_view next_kml_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kKmlSpace), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kKmlSpace));
  text.remove_prefix(word.size());
  return word;
}

// Longitude, latitude and, maybe, height, separated by one character.
DraftPoint kml_point_of(std::string_view text, char separator) {
  const auto next_number = [&]() -> std::optional<double> {
    const std::size_t end = text.find(separator);
    const std::optional<double> number = file_number_of(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return number;
  };
  DraftPoint point;
  const double nan = point.latitude_deg;
  point.longitude_deg = next_number().value_or(nan);
  point.latitude_deg = next_number().value_or(nan);
  point.height_m = next_number();
  return point;
}

// "lon lat height" of gx:coord, with any white space between.
DraftPoint track_point_of(std::string_view text) {
  std::string words;
  for (std::string_view word = next_kml_word(text); !word.empty(); word = next_kml_word(text)) {
    if (!words.empty()) words += ' ';
    words += word;
  }
  return kml_point_of(words, ' ');
}

void set_height_reference(const pugi::xml_node& geometry, PathDraft& draft) {
  const std::string_view mode = text_in(geometry, "altitudeMode");
  draft.height = mode == "absolute" ? HeightReference::sea_level : HeightReference::ground;
  if (draft.height == HeightReference::sea_level || mode == "relativeToGround") return;
  // On the ground by its mode: heights of 0 say nothing.
  const auto is_flat = [](const DraftPoint& point) { return point.height_m.value_or(0) == 0; };
  if (std::all_of(draft.points.begin(), draft.points.end(), is_flat)) {
    for (DraftPoint& point : draft.points) point.height_m.reset();
  } else {
    draft.notes.push_back(
        fmt::format("altitudeMode is {}, so programs show it on the ground; its heights are read all "
                    "the same",
                    mode.empty() ? "not stated" : file_name_text(mode)));
  }
}

void add_track_points(const pugi::xml_node& track, PathDraft& draft) {
  std::vector<std::optional<double>> times;
  std::vector<DraftPoint> points;
  bool has_local = false;
  for (const pugi::xml_node& child : track.children()) {
    if (local_name(child) == "when") times.push_back(time_in(child.child_value(), has_local));
    if (local_name(child) == "coord") points.push_back(track_point_of(child.child_value()));
  }
  if (times.size() != points.size())
    draft.notes.push_back(
        fmt::format("has {} times and {} places; those without a partner are left out", times.size(), points.size()));
  const std::size_t count = std::min(times.size(), points.size());
  for (std::size_t i = 0; i < count; ++i) {
    points[i].time_s = times[i];
    draft.points.push_back(points[i]);
  }
  if (has_local) draft.notes.emplace_back(kNoZoneNote);
}

PathDraft draft_of_line(const pugi::xml_node& line, const std::string& name) {
  PathDraft draft;
  draft.name = name;
  std::string_view text = text_in(line, "coordinates");
  for (std::string_view word = next_kml_word(text); !word.empty(); word = next_kml_word(text))
    draft.points.push_back(kml_point_of(word, ','));
  set_height_reference(line, draft);
  return draft;
}

PathDraft draft_of_track(const pugi::xml_node& track, const std::string& name) {
  PathDraft draft;
  draft.name = name;
  add_track_points(track, draft);
  set_height_reference(track, draft);
  return draft;
}

PathDraft draft_of_multi_track(const pugi::xml_node& multi, const std::string& name) {
  PathDraft draft;
  draft.name = name;
  pugi::xml_node first;
  for (const pugi::xml_node& child : multi.children()) {
    if (local_name(child) != "Track") continue;
    if (!first) first = child;
    add_track_points(child, draft);
  }
  const bool has_own_mode = !text_in(multi, "altitudeMode").empty();
  set_height_reference(has_own_mode ? multi : first, draft);
  return draft;
}

// Places with a time of their own, as many Placemarks have them.
struct TimedPlacemarks {
  PathDraft draft;
  pugi::xml_node last;  // its altitudeMode stands for all
  bool has_local_time = false;
};

// Collects the paths of a document. The recursion is as deep as the elements are nested.
class KmlPaths {
 public:
  // A folder or document. Points with a time of their own that lie in the same folder are one path, named after it.
  void add_folder(const pugi::xml_node& folder) {
    TimedPlacemarks places;
    places.draft.name = file_name_text(text_in(folder, "name"));
    for (const pugi::xml_node& child : folder.children()) {
      const std::string_view name = local_name(child);
      if (name == "Document" || name == "Folder") add_folder(child);
      if (name == "Placemark") add_placemark(child, places);
    }
    if (places.draft.points.empty()) return;
    if (places.has_local_time) places.draft.notes.emplace_back(kNoZoneNote);
    set_height_reference(places.last, places.draft);
    drafts_.push_back(std::move(places.draft));
  }

  [[nodiscard]] std::vector<PathDraft> take() { return std::move(drafts_); }

 private:
  void add_placemark(const pugi::xml_node& placemark, TimedPlacemarks& places) {
    add_geometries(placemark, file_name_text(text_in(placemark, "name")));
    const pugi::xml_node point = child_named(placemark, "Point");
    std::string_view when = text_in(child_named(placemark, "TimeStamp"), "when");
    if (when.empty()) when = text_in(child_named(placemark, "TimeSpan"), "begin");
    if (!point || when.empty()) return;
    std::string_view text = text_in(point, "coordinates");
    DraftPoint at = kml_point_of(next_kml_word(text), ',');
    at.time_s = time_in(when, places.has_local_time);
    places.draft.points.push_back(at);
    places.last = point;
  }

  void add_geometries(const pugi::xml_node& parent, const std::string& name) {
    for (const pugi::xml_node& child : parent.children()) {
      const std::string_view kind = local_name(child);
      if (kind == "LineString") drafts_.push_back(draft_of_line(child, name));
      if (kind == "Track") drafts_.push_back(draft_of_track(child, name));
      if (kind == "MultiTrack") drafts_.push_back(draft_of_multi_track(child, name));
      if (kind == "MultiGeometry") add_geometries(child, name);
    }
  }

  std::vector<PathDraft> drafts_;
};

}  // namespace

Result<std::vector<PathDraft>> drafts_of_xml(std::string_view text, const std::string& where) {
  if (xml_depth(text) > kMaxNesting)
    return fail(where, fmt::format("has elements more than {} deep within one another", kMaxNesting));
  pugi::xml_document document;
  // The parser works on a copy, so that the text keeps its lines.
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed)
    return fail(fmt::format("{}: {}", where, text_position(text, static_cast<std::size_t>(parsed.offset) + 1)),
                std::string("is not XML from here on: ") + parsed.description());
  const pugi::xml_node root = document.document_element();
  if (local_name(root) == "gpx") {
    std::vector<PathDraft> drafts;
    for (const pugi::xml_node& node : root.children())
      if (local_name(node) == "trk" || local_name(node) == "rte") drafts.push_back(draft_of_gpx(node));
    return drafts;
  }
  if (local_name(root) == "kml") {
    KmlPaths paths;
    paths.add_folder(root);
    return paths.take();
  }
  return fail(where, fmt::format("is XML, but neither GPX nor KML: its root is <{}>", file_name_text(root.name())));
}

}  // namespace sigs
