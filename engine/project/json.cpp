// SPDX-License-Identifier: MIT
#include "project/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "base/staged_outputs.h"
#include "project/fields.h"
#include "project/places.h"

namespace sigs {

namespace {

// The list under a key, empty where the key is absent. Any other value is an error.
Result<std::size_t> list_size(const Json& json, const char* pointer, const std::string& where) {
  const Json::json_pointer place(pointer);
  if (!json.contains(place)) return std::size_t{0};
  if (!json.at(place).is_array()) return fail(where, "expected a list [ ... ]", ErrorKind::bad_project);
  return json.at(place).size();
}

constexpr std::array<const char*, 3> kPlaceKeys{"latitude_deg", "longitude_deg", "height_m"};

// A waypoint on the Earth has all three numbers; a missing one is not meant as 0.
Result<bool> has_place(const Json& waypoint, const std::string& where) {
  const auto has = [&](const char* key) { return waypoint.contains(key) && !waypoint.at(key).is_null(); };
  const auto there = std::count_if(kPlaceKeys.begin(), kPlaceKeys.end(), has);
  if (there == 0) return false;
  for (const char* const key : kPlaceKeys)
    if (!has(key))
      return fail(fmt::format("{}.{}", where, key),
                  "is missing: a place on the Earth needs latitude_deg, longitude_deg and height_m",
                  ErrorKind::bad_project);
  return true;
}

// A missing position is not meant as the world's origin.
Result<std::vector<WaypointSettings>> empty_waypoints(const Json& intruder, std::size_t count,
                                                      const std::string& where) {
  std::vector<WaypointSettings> waypoints(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Json& waypoint = intruder.at("trajectory").at("waypoints").at(i);
    if (!waypoint.is_object()) continue;
    const std::string key = fmt::format("{}.trajectory.waypoints[{}]", where, i);
    const Result<bool> on_earth = has_place(waypoint, key);
    if (!on_earth) return fail(on_earth.error());
    if (*on_earth) waypoints[i].place.emplace();
    if (!*on_earth && !waypoint.contains("position_m"))
      return fail(key + ".position_m",
                  "is missing: where the waypoint is, in the world as [x, y, z], or on the Earth by latitude_deg, "
                  "longitude_deg and height_m",
                  ErrorKind::bad_project);
  }
  return waypoints;
}

tl::unexpected<Error> too_many(std::string where, std::size_t count, std::size_t most) {
  return fail(std::move(where), fmt::format("has {} entries; at most {} are read", count, most),
              ErrorKind::bad_project);
}

// Which cameras a rig has, and which of them look in a way of their own.
Result<void> make_room_for_cameras(const Json& json, const std::string& file, Project& project) {
  const Result<std::size_t> cameras = list_size(json, "/cameras", file + ": cameras");
  if (!cameras) return fail(cameras.error());
  if (*cameras > kMaxCameras) return too_many(file + ": cameras", *cameras, kMaxCameras);
  project.cameras.resize(*cameras);
  for (std::size_t i = 0; i < *cameras; ++i) {
    const Json& camera = json.at("cameras").at(i);
    if (!camera.is_object())
      return fail(fmt::format("{}: cameras[{}]", file, i), "expected { ... }", ErrorKind::bad_project);
    if (camera.contains("appearance") && !camera.at("appearance").is_null()) project.cameras[i].appearance.emplace();
  }
  if (*cameras > 0 && json.contains("footage"))
    return fail(file + ": footage", "stands beside cameras, each of which has its own: move it to cameras[0].footage",
                ErrorKind::bad_project);
  return {};
}

Result<void> make_room_for_lists(const Json& json, const std::string& file, Project& project) {
  if (const Result<void> cameras = make_room_for_cameras(json, file, project); !cameras) return cameras;
  const Result<std::size_t> intruders = list_size(json, "/intruders", file + ": intruders");
  if (!intruders) return fail(intruders.error());
  if (*intruders > kMaxIntruders) return too_many(file + ": intruders", *intruders, kMaxIntruders);
  project.intruders.resize(*intruders);
  std::size_t waypoints_so_far = 0;
  for (std::size_t i = 0; i < *intruders; ++i) {
    const std::string key = fmt::format("intruders[{}]", i);
    const Json& intruder = json.at("intruders").at(i);
    if (!intruder.is_object()) return fail(file + ": " + key, "expected { ... }", ErrorKind::bad_project);
    const Result<std::size_t> waypoints =
        list_size(intruder, "/trajectory/waypoints", fmt::format("{}: {}.trajectory.waypoints", file, key));
    if (!waypoints) return fail(waypoints.error());
    waypoints_so_far += *waypoints;
    if (waypoints_so_far > kMaxWaypoints)
      return too_many(fmt::format("{}: {}.trajectory.waypoints, with those of the intruders before", file, key),
                      waypoints_so_far, kMaxWaypoints);
    Result<std::vector<WaypointSettings>> empty = empty_waypoints(intruder, *waypoints, file + ": " + key);
    if (!empty) return fail(empty.error());
    project.intruders[i].trajectory.waypoints = *std::move(empty);
    const Result<std::size_t> rotors =
        list_size(intruder, "/model/rotors", fmt::format("{}: {}.model.rotors", file, key));
    if (!rotors) return fail(rotors.error());
    if (*rotors > kMaxRotors) return too_many(fmt::format("{}: {}.model.rotors", file, key), *rotors, kMaxRotors);
    project.intruders[i].model.rotors.resize(*rotors);
  }
  return {};
}

// Objects without any key left are removed too, so that only unknown keys remain.
void remove_empty_objects(Json& json) {
  if (!json.is_object()) return;
  Json remaining = Json::object();
  for (auto& [key, value] : json.get_ref<Json::object_t&>()) {
    remove_empty_objects(value);
    if (!value.is_object() || !value.empty())
      static_cast<Json::object_t::Container&>(remaining.get_ref<Json::object_t&>()).emplace_back(key, std::move(value));
  }
  json = std::move(remaining);
}

// Keys of a project with one camera, one intruder and one waypoint that begin with `prefix`, without it; of the whole
// project (no prefix) those outside of lists.
std::vector<std::string> known_keys(std::string_view prefix) {
  Project sample;
  if (!prefix.empty()) sample.cameras.resize(1);
  for (RigCamera& camera : sample.cameras) camera.appearance.emplace();
  sample.intruders.resize(1);
  sample.intruders[0].trajectory.waypoints.resize(1);
  sample.intruders[0].trajectory.waypoints[0].place.emplace();
  sample.intruders[0].model.rotors.resize(1);
  std::vector<std::string> keys;
  for (const Field& field : fields_of(sample)) {
    if (!field.key.starts_with(prefix)) continue;
    std::string key = field.key.substr(prefix.size());
    if (key.find('[') == std::string::npos) keys.push_back(std::move(key));
  }
  return keys;
}

// A part of a project file in which keys are searched: its key, and the keys that it may have.
struct KeyPlace {
  std::string where;  // "p.json: intruders[0]."
  const std::vector<std::string>& known;
};

// A similar key is suggested for the first unknown keys only: the search compares with each known key.
std::string meant(const KeyPlace& place, const std::string& key, std::size_t warnings_so_far) {
  constexpr std::size_t kMaxKey = 100;
  constexpr std::size_t kMaxSuggestions = 20;
  return warnings_so_far < kMaxSuggestions && key.size() <= kMaxKey ? suggestion(place.known, key) : "";
}

// The maximum number of warnings.
constexpr std::size_t kMaxWarnings = 100;

void warn_of(const Json& unknown, const KeyPlace& place, const std::string& path, std::vector<Warning>& warnings) {
  for (const auto& [name, value] : unknown.items()) {
    const std::string key = path + name;
    if (warnings.size() > kMaxWarnings) return;
    if (value.is_object())
      warn_of(value, place, key + ".", warnings);
    else if (warnings.size() < kMaxWarnings)
      warnings.push_back({place.where + key, "unknown key, kept but not used" + meant(place, key, warnings.size())});
    else
      warnings.push_back({place.where + key, "unknown key, and there are more; all are kept but not used"});
  }
}

std::string kept(Json unknown, const KeyPlace& place, std::vector<Warning>& warnings) {
  remove_empty_objects(unknown);
  warn_of(unknown, place, "", warnings);
  return unknown.empty() ? std::string() : unknown.dump();
}

// Removes the lists from rest, and keeps the unknown keys of each item with the item.
void keep_unknown(Json rest, const std::string& file, Project& project, std::vector<Warning>& warnings) {
  Json intruders = rest.value("intruders", Json::array());
  Json cameras = rest.value("cameras", Json::array());
  rest.erase("sigs");
  rest.erase("intruders");
  rest.erase("cameras");
  std::vector<std::string> of_project = known_keys("");
  of_project.emplace_back("intruders");
  of_project.emplace_back("cameras");
  for (std::size_t i = 0; i < project.cameras.size(); ++i)
    project.cameras[i].unknown_json =
        kept(std::move(cameras.at(i)), {fmt::format("{}: cameras[{}].", file, i), known_keys("cameras[0].")}, warnings);
  std::vector<std::string> of_intruder = known_keys("intruders[0].");
  of_intruder.emplace_back("trajectory.waypoints");
  of_intruder.emplace_back("model.rotors");
  const std::vector<std::string> of_rotor = known_keys("intruders[0].model.rotors[0].");
  const std::vector<std::string> of_waypoint = known_keys("intruders[0].trajectory.waypoints[0].");
  project.unknown_json = kept(std::move(rest), {file + ": ", of_project}, warnings);
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const std::string where = fmt::format("{}: intruders[{}].", file, i);
    IntruderSettings& intruder = project.intruders[i];
    Json& json = intruders.at(i);
    for (std::size_t j = 0; j < intruder.trajectory.waypoints.size(); ++j)
      intruder.trajectory.waypoints[j].unknown_json =
          kept(json.at("trajectory").at("waypoints").at(j),
               {fmt::format("{}trajectory.waypoints[{}].", where, j), of_waypoint}, warnings);
    if (json.contains("trajectory")) json.at("trajectory").erase("waypoints");
    for (std::size_t j = 0; j < intruder.model.rotors.size(); ++j)
      intruder.model.rotors[j].unknown_json =
          kept(json.at("model").at("rotors").at(j), {fmt::format("{}model.rotors[{}].", where, j), of_rotor}, warnings);
    if (json.contains("model")) json.at("model").erase("rotors");
    intruder.unknown_json = kept(std::move(json), {where, of_intruder}, warnings);
  }
}

Json parsed_or_empty(const std::string& text) {
  return text.empty() ? Json::object() : parsed_json(text, "", ErrorKind::bad_project).value_or(Json::object());
}

Result<void> check_version(const Json& json, const std::string& file) {
  if (!json.is_object()) return fail(file, "is not a SIGS project: expected { ... }", ErrorKind::bad_project);
  const auto version = json.find("sigs");
  if (version == json.end() && json.contains("sigs_dataset"))
    return fail(file, "is a recipe of a dataset, not a project; sigs dataset makes its videos, each with a project",
                ErrorKind::bad_project);
  if (version == json.end())
    return fail(file + ": sigs", "missing; a project begins with \"sigs\": 1", ErrorKind::bad_project);
  if (!version->is_number_integer() || *version != kProjectVersion)
    return fail(file + ": sigs", fmt::format("version {} is not known; this program reads version 1", version->dump()),
                ErrorKind::bad_project);
  return {};
}

// Sets every field that the file has, and removes it from rest.
Result<void> put_fields(const Json& json, const std::string& file, Project& project, Json& rest) {
  for (const Field& field : fields_of(project)) {
    const Json::json_pointer place = pointer_of(field.key);
    if (!json.contains(place)) continue;
    const std::string wrong = put_json(json.at(place), field);
    if (!wrong.empty()) return fail(file + ": " + field.key, wrong, ErrorKind::bad_project);
    rest.at(place.parent_pointer()).erase(place.back());
  }
  return {};
}

// A section written as a number or text ("camera": 5) would hide all its fields.
Result<void> check_sections(const Json& json, const std::string& file, Project& project) {
  std::unordered_set<std::string> checked;
  for (const Field& field : fields_of(project)) {
    for (std::size_t dot = field.key.rfind('.'); dot != std::string::npos; dot = field.key.rfind('.', dot - 1)) {
      const std::string section = field.key.substr(0, dot);
      if (!checked.insert(section).second) break;  // and what holds it
      const Json::json_pointer place = pointer_of(section);
      if (!json.contains(place) || json.at(place).is_object()) continue;
      return fail(file + ": " + section, "expected { ... }", ErrorKind::bad_project);
    }
  }
  return {};
}

}  // namespace

Result<ReadProject> parse_project(const std::string& text, const std::filesystem::path& path) {
  const std::string file = path.string();
  std::vector<std::string> doubled;
  Result<Json> json = parsed_json(text, file, ErrorKind::bad_project, &doubled);
  if (!json && text.find_first_not_of(" \t\r\n") != text.find('{') && !file.ends_with(".json"))
    return fail(file, "is not JSON; `sigs init` makes a project of a video", ErrorKind::bad_project);
  if (!json) return fail(json.error());
  ReadProject read;
  read.project.file = path;
  Result<void> step = check_version(*json, file);
  if (step) read.warnings = rename_old_keys(*json, "", file + ": ");
  for (const std::string& key : doubled) read.warnings.push_back({file + ": " + key, kIsDoubled});
  Json rest = *json;
  if (step) step = make_room_for_lists(*json, file, read.project);
  if (step) step = check_sections(*json, file, read.project);
  if (step) step = put_fields(*json, file, read.project, rest);
  if (!step) return fail(step.error());
  place_waypoints(read.project);
  keep_unknown(std::move(rest), file, read.project, read.warnings);
  return read;
}

Result<ReadProject> read_project(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path, kProjectLimit_bytes);
  if (!text) return fail(text.error());
  return parse_project(*text, path);
}

std::string text_of(const Project& project) {
  Project copy = project;
  Json json = Json::object();
  json["sigs"] = kProjectVersion;
  append_members(json, parsed_or_empty(project.unknown_json));
  for (const RigCamera& camera : project.cameras) json["cameras"].push_back(parsed_or_empty(camera.unknown_json));
  json["intruders"] = Json::array();
  for (const IntruderSettings& intruder : project.intruders) {
    Json item = parsed_or_empty(intruder.unknown_json);
    item["trajectory"]["waypoints"] = Json::array();
    for (const WaypointSettings& waypoint : intruder.trajectory.waypoints)
      item["trajectory"]["waypoints"].push_back(parsed_or_empty(waypoint.unknown_json));
    for (const RotorSettings& rotor : intruder.model.rotors)
      item["model"]["rotors"].push_back(parsed_or_empty(rotor.unknown_json));
    json["intruders"].push_back(std::move(item));
  }
  for (const Field& field : fields_of(copy)) json[pointer_of(field.key)] = json_of(field);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // paths may be no UTF-8
}

std::string setting_text(const Project& project, const std::string& key) {
  return setting_texts(project, {key}).front();
}

std::vector<std::string> setting_texts(const Project& project, const std::vector<std::string>& keys) {
  const Json json = parsed_or_empty(text_of(project));
  std::vector<std::string> texts;
  for (const std::string& key : keys) {
    texts.emplace_back();
    if (key.empty()) continue;
    try {
      const Json::json_pointer pointer(pointer_of(key));
      if (json.contains(pointer)) texts.back() = json.at(pointer).dump(-1, ' ', false, Json::error_handler_t::replace);
    } catch (const Json::exception&) {  // no key
      continue;
    }
  }
  return texts;
}

Json settings_json(Project project, const std::vector<std::string>& keys) {
  Json settings = Json::object();
  const std::vector<Field> fields = fields_of(project);
  for (const std::string& key : keys)
    if (const auto field = std::ranges::find(fields, key, &Field::key); field != fields.end())
      settings[pointer_of(key)] = json_of(*field);
  return settings;
}

Result<void> write_project(const Project& project, const std::filesystem::path& path, bool overwrite) {
  return write_text(path, text_of(project), overwrite);
}

}  // namespace sigs
