// SPDX-License-Identifier: MIT
#pragma once

#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "geo/recorded/path_draft.h"

namespace sigs {

// What the readers of GPX and KML share. Names of elements are compared without their prefixes: gx:Track and Track are
// the same, whatever prefix the file gives a namespace.

// "Track" for "gx:Track".
[[nodiscard]] std::string_view local_name(const pugi::xml_node& node);

// The first child of a local name; an empty node where there is none.
[[nodiscard]] pugi::xml_node child_named(const pugi::xml_node& node, std::string_view name);

// The text of the first child of that name; empty where there is none.
[[nodiscard]] std::string_view text_in(const pugi::xml_node& node, std::string_view name);

// The time that a text says, in UTC; sets has_local where it states no zone. nullopt: it is no time.
[[nodiscard]] std::optional<double> time_in(std::string_view text, bool& has_local);

// For drafts with times that state no zone.
inline constexpr const char* kNoZoneNote = "times state no zone; they are taken for UTC";

// The paths in a document whose root is <gpx>, or <kml>. The root must not be nested deeper than kMaxNesting.
[[nodiscard]] std::vector<PathDraft> drafts_of_gpx(const pugi::xml_node& root);
[[nodiscard]] std::vector<PathDraft> drafts_of_kml(const pugi::xml_node& root);

}  // namespace sigs
