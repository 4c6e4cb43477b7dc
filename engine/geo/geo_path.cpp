// SPDX-License-Identifier: MIT
#include "geo/geo_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "base/ensure.h"
#include "base/text.h"
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

using CzmlPacket = nlohmann::ordered_json;

// The nearest number with so many decimals, which the shortest text has. No negative zero.
double rounded_to(double number, double one_over_unit) {
  return std::round(number * one_over_unit) / one_over_unit + 0.0;
}

double rounded_seconds(double time_s) {
  return rounded_to(time_s, 1e6);
}

void append_place(CzmlPacket& list, const GeodeticPosition& place) {
  list.push_back(rounded_to(place.longitude_deg, 1e9));
  list.push_back(rounded_to(place.latitude_deg, 1e9));
  list.push_back(rounded_to(place.height_m, 1e4));
}

// Takes north, east, down at a place to the axes fixed to the Earth.
glm::dquat earth_from_ned(const GeodeticPosition& place) {
  const double latitude_rad = rad_of_deg(place.latitude_deg);
  const double longitude_rad = rad_of_deg(place.longitude_deg);
  const double sin_lat = std::sin(latitude_rad);
  const double cos_lat = std::cos(latitude_rad);
  const double sin_lon = std::sin(longitude_rad);
  const double cos_lon = std::cos(longitude_rad);
  const glm::dvec3 north(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat);
  const glm::dvec3 east(-sin_lon, cos_lon, 0);
  const glm::dvec3 down(-cos_lat * cos_lon, -cos_lat * sin_lon, -sin_lat);
  return glm::normalize(glm::quat_cast(glm::dmat3(north, east, down)));
}

CzmlPacket color_of(const GeoPath& path) {
  const auto [red, green, blue] = path.color_rgb;
  return {{"rgba", {red, green, blue, 255}}};
}

CzmlPacket line_material(const GeoPath& path) {
  return {{"solidColor", {{"color", color_of(path)}}}};
}

CzmlPacket position_of(const GeoPath& path, double epoch_s) {
  CzmlPacket samples = CzmlPacket::array();
  for (const TimedPlace& point : path.points) {
    samples.push_back(rounded_seconds(utc_of(path, point.time_s) - epoch_s));
    append_place(samples, point.place);
  }
  return {{"epoch", utc_text(epoch_s)},
          {"interpolationAlgorithm", "LINEAR"},
          {"interpolationDegree", 1},
          {"cartographicDegrees", std::move(samples)}};
}

// Null where no attitude is known.
CzmlPacket orientation_of(const GeoPath& path, double epoch_s) {
  constexpr double kOneOverUnit = 1e9;
  const glm::dquat down_from_up(0, 1, 0, 0);  // half a turn about x: forward, left, up to forward, right, down
  CzmlPacket samples = CzmlPacket::array();
  glm::dquat before(1, 0, 0, 0);
  for (std::size_t i = 0; i < path.attitudes.size(); ++i) {
    if (!path.attitudes[i]) continue;
    glm::dquat turn = earth_from_ned(path.points[i].place) * rotation_of(*path.attitudes[i]) * down_from_up;
    if (glm::dot(turn, before) < 0) turn = -turn;  // the same turn; neighbours stay close
    before = turn;
    samples.push_back(rounded_seconds(utc_of(path, path.points[i].time_s) - epoch_s));
    for (const double part : {turn.x, turn.y, turn.z, turn.w}) samples.push_back(rounded_to(part, kOneOverUnit));
  }
  if (samples.empty()) return nullptr;
  return {{"epoch", utc_text(epoch_s)}, {"unitQuaternion", std::move(samples)}};
}

CzmlPacket label_of(const GeoPath& path) {
  return {{"text", line_text(path.name)},
          {"font", "12pt sans-serif"},
          {"fillColor", color_of(path)},
          {"horizontalOrigin", "LEFT"},
          {"pixelOffset", {{"cartesian2", {10, -10}}}}};
}

std::string interval_text(double first_s, double last_s) {
  return utc_text(first_s) + "/" + utc_text(last_s);
}

CzmlPacket packet_begin(const GeoPath& path, std::size_t index) {
  CzmlPacket packet{{"id", fmt::format("path{}", index + 1)}, {"name", line_text(path.name)}};
  if (const std::string text = description_of(path); !text.empty()) packet["description"] = xml_text(text);
  return packet;
}

CzmlPacket timed_packet(const GeoPath& path, std::size_t index) {
  CzmlPacket packet = packet_begin(path, index);
  const double first_s = utc_of(path, path.points.front().time_s);
  const double epoch_s = std::floor(first_s);
  packet["availability"] = interval_text(first_s, utc_of(path, path.points.back().time_s));
  packet["position"] = position_of(path, epoch_s);
  if (CzmlPacket orientation = orientation_of(path, epoch_s); !orientation.is_null())
    packet["orientation"] = std::move(orientation);
  packet["path"] = {{"width", 2}, {"resolution", 1}, {"material", line_material(path)}};
  packet["point"] = {{"pixelSize", 8}, {"color", color_of(path)}};
  packet["label"] = label_of(path);
  return packet;
}

CzmlPacket line_packet(const GeoPath& path, std::size_t index) {
  CzmlPacket packet = packet_begin(path, index);
  CzmlPacket places = CzmlPacket::array();
  for (const TimedPlace& point : path.points) append_place(places, point.place);
  packet["polyline"] = {{"positions", {{"cartographicDegrees", std::move(places)}}},
                        {"arcType", "NONE"},
                        {"width", 2},
                        {"material", line_material(path)}};
  return packet;
}

bool is_timed(const GeoPath& path) {
  return path.has_times && !path.points.empty();
}

CzmlPacket document_packet(const std::vector<GeoPath>& paths, const std::string& title) {
  CzmlPacket packet{{"id", "document"}, {"name", line_text(title)}, {"version", "1.0"}};
  double first_s = kLastUtc_s;
  double last_s = kFirstUtc_s;
  for (const GeoPath& path : paths) {
    if (!is_timed(path)) continue;
    first_s = std::min(first_s, utc_of(path, path.points.front().time_s));
    last_s = std::max(last_s, utc_of(path, path.points.back().time_s));
  }
  if (first_s <= last_s)
    packet["clock"] = {{"interval", interval_text(first_s, last_s)},
                       {"currentTime", utc_text(first_s)},
                       {"multiplier", 1},
                       {"range", "LOOP_STOP"},
                       {"step", "SYSTEM_CLOCK_MULTIPLIER"}};
  return packet;
}

}  // namespace

std::string description_of(const GeoPath& path) {
  std::string text = path.description;
  if (path.utc || !path.has_times) return text;
  if (!text.empty()) text += ' ';
  return text += kNoUtcText;
}

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

std::string czml_text(const std::vector<GeoPath>& paths, const std::string& title) {
  std::string text = "[\n" + document_packet(paths, title).dump();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    ENSURE(paths[i].attitudes.empty() || paths[i].attitudes.size() == paths[i].points.size());
    if (paths[i].points.empty()) continue;
    text += ",\n" + (is_timed(paths[i]) ? timed_packet(paths[i], i) : line_packet(paths[i], i)).dump();
  }
  return text + "\n]\n";
}

}  // namespace sigs
