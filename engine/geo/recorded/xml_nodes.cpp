// SPDX-License-Identifier: MIT
#include "geo/recorded/xml_nodes.h"

#include <fmt/format.h>

#include "base/nesting.h"
#include "base/text.h"
#include "geo/recorded/formats.h"
#include "geo/utc_time.h"

namespace sigs {

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_named(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node& child : node.children())
    if (local_name(child) == name) return child;
  return {};
}

std::string_view text_in(const pugi::xml_node& node, std::string_view name) {
  return child_named(node, name).child_value();
}

std::optional<double> time_in(std::string_view text, bool& has_local) {
  const std::optional<UtcInstant> instant = utc_instant_of(text);
  if (!instant) return std::nullopt;
  has_local |= !instant->has_zone;
  return instant->time_s;
}

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
  if (local_name(root) == "gpx") return drafts_of_gpx(root);
  if (local_name(root) == "kml") return drafts_of_kml(root);
  return fail(where, fmt::format("is XML, but neither GPX nor KML: its root is <{}>", file_name_text(root.name())));
}

}  // namespace sigs
