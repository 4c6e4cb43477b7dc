// SPDX-License-Identifier: MIT
#include <utility>

#include "geo/recorded/xml_nodes.h"

namespace sigs {

// GPX 1.1, https://www.topografix.com/GPX/1/1/. GPX 1.0 has the same elements as far as they are read here.

namespace {

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

}  // namespace

std::vector<PathDraft> drafts_of_gpx(const pugi::xml_node& root) {
  std::vector<PathDraft> drafts;
  for (const pugi::xml_node& node : root.children())
    if (local_name(node) == "trk" || local_name(node) == "rte") drafts.push_back(draft_of_gpx(node));
  return drafts;
}

}  // namespace sigs
