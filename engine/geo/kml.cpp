// SPDX-License-Identifier: MIT
#include "geo/kml.h"

#include <fmt/format.h>

#include <cmath>
#include <pugixml.hpp>

#include "base/ensure.h"
#include "base/text.h"
#include "base/xml_text.h"
#include "geo/utc_time.h"

namespace sigs {

namespace {

constexpr int kDegreeDecimals = 9;  // 0.1 mm on the ground
constexpr int kMetreDecimals = 4;
constexpr int kAngleDecimals = 4;

struct StringWriter : pugi::xml_writer {
  std::string text;
  void write(const void* data, std::size_t size) override { text.append(static_cast<const char*>(data), size); }
};

void add_text(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_child(name).text().set(text.c_str());
}

std::string place_text(const GeodeticPosition& place, char separator) {
  return fmt::format("{}{}{}{}{}", number_text(place.longitude_deg, kDegreeDecimals), separator,
                     number_text(place.latitude_deg, kDegreeDecimals), separator,
                     number_text(place.height_m, kMetreDecimals));
}

// Empty where the attitude is not known, as the reference says for missing data.
std::string angles_text(const std::optional<Attitude>& attitude) {
  if (!attitude) return "";
  const double heading_deg = std::fmod(deg_of_rad(attitude->yaw_rad) + 360, 360);
  return fmt::format("{} {} {}", number_text(heading_deg, kAngleDecimals),
                     number_text(-deg_of_rad(attitude->pitch_rad), kAngleDecimals),
                     number_text(-deg_of_rad(attitude->roll_rad), kAngleDecimals));
}

// KML has colours as aabbggrr.
void add_style(pugi::xml_node document, const GeoPath& path, std::size_t index) {
  const auto [red, green, blue] = path.color_rgb;
  const std::string color = fmt::format("ff{:02x}{:02x}{:02x}", blue, green, red);
  pugi::xml_node style = document.append_child("Style");
  style.append_attribute("id") = fmt::format("path{}", index + 1).c_str();
  add_text(style.append_child("IconStyle"), "color", color);
  pugi::xml_node line = style.append_child("LineStyle");
  add_text(line, "color", color);
  add_text(line, "width", "2");
}

pugi::xml_node add_placemark(pugi::xml_node document, const GeoPath& path, std::size_t index, bool is_visible) {
  pugi::xml_node placemark = document.append_child("Placemark");
  add_text(placemark, "name", xml_text(path.name));
  if (!is_visible) add_text(placemark, "visibility", "0");
  if (const std::string text = description_of(path); !text.empty()) add_text(placemark, "description", xml_text(text));
  add_text(placemark, "styleUrl", fmt::format("#path{}", index + 1));
  return placemark;
}

void add_track(pugi::xml_node placemark, const GeoPath& path) {
  pugi::xml_node track = placemark.append_child("gx:Track");
  add_text(track, "altitudeMode", "absolute");
  for (const TimedPlace& point : path.points) add_text(track, "when", utc_text(utc_of(path, point.time_s)));
  for (const TimedPlace& point : path.points) add_text(track, "gx:coord", place_text(point.place, ' '));
  for (const std::optional<Attitude>& attitude : path.attitudes) add_text(track, "gx:angles", angles_text(attitude));
}

void add_line(pugi::xml_node placemark, const GeoPath& path) {
  pugi::xml_node line = placemark.append_child("LineString");
  add_text(line, "altitudeMode", "absolute");
  std::string text;
  for (const TimedPlace& point : path.points) {
    if (!text.empty()) text += '\n';
    text += place_text(point.place, ',');
  }
  add_text(line, "coordinates", text);
}

}  // namespace

std::string kml_text(const std::vector<GeoPath>& paths, const std::string& title) {
  pugi::xml_document xml;
  pugi::xml_node declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = xml.append_child("kml");
  root.append_attribute("xmlns") = "http://www.opengis.net/kml/2.2";
  root.append_attribute("xmlns:gx") = "http://www.google.com/kml/ext/2.2";
  pugi::xml_node document = root.append_child("Document");
  add_text(document, "name", xml_text(title));
  for (std::size_t i = 0; i < paths.size(); ++i) add_style(document, paths[i], i);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const GeoPath& path = paths[i];
    ENSURE(path.attitudes.empty() || path.attitudes.size() == path.points.size());
    if (path.points.empty()) continue;
    if (path.has_times) add_track(add_placemark(document, path, i, true), path);
    if (!path.has_times || path.points.size() > 1) add_line(add_placemark(document, path, i, !path.has_times), path);
  }
  StringWriter writer;
  xml.save(writer, " ");
  return std::move(writer.text);
}

}  // namespace sigs
