// SPDX-License-Identifier: MIT
#include "editor/document/settings.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/staged_outputs.h"
#include "project/fields.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxRecent = 12;

// A number of the file within its range; what is absent or no number leaves the default.
template <class Number>
void take(const Json& json, const char* key, Number& value, Number minimum, Number maximum) {
  if (const auto found = json.find(key); found != json.end() && found->is_number())
    value = std::clamp(found->get<Number>(), minimum, maximum);
}

void take(const Json& json, const char* key, bool& value) {
  if (const auto found = json.find(key); found != json.end() && found->is_boolean()) value = found->get<bool>();
}

Settings settings_of(const Json& json) {
  Settings settings;
  take(json, "font_px", settings.font_px, kMinFont_px, kMaxFont_px);
  take(json, "window_width_px", settings.window_width_px, 640, 16384);
  take(json, "window_height_px", settings.window_height_px, 480, 16384);
  take(json, "maximised", settings.maximised);
  take(json, "inspector_width", settings.inspector_width, 200.0, 2000.0);
  take(json, "timeline_height", settings.timeline_height, 90.0, 2000.0);
  take(json, "world_share", settings.world_share, 0.05, 0.95);
  take(json, "show_world", settings.show_world);
  take(json, "show_inspector", settings.show_inspector);
  take(json, "all_settings", settings.all_settings);
  take(json, "loop", settings.loop);
  take(json, "autosave_s", settings.autosave_s, 1.0, 3600.0);
  if (const auto folder = json.find("last_folder"); folder != json.end() && folder->is_string())
    settings.last_folder = folder->get<std::string>();
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (const Json& path : *recent)
      if (path.is_string() && settings.recent.size() < kMaxRecent)
        settings.recent.emplace_back(path.get<std::string>());
  return settings;
}

}  // namespace

fs::path settings_file() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0')
    return fs::path(folder) / "sigs/editor.json";
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : ".") / ".config/sigs/editor.json";
}

Settings read_settings(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  if (!text) return {};
  const Result<Json> json = parsed_json(*text, file.string(), ErrorKind::bad_data);
  return json && json->is_object() ? settings_of(*json) : Settings();
}

Result<void> write_settings(const Settings& settings, const fs::path& file) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  Json json;
  json["font_px"] = settings.font_px;
  json["window_width_px"] = settings.window_width_px;
  json["window_height_px"] = settings.window_height_px;
  json["maximised"] = settings.maximised;
  json["inspector_width"] = settings.inspector_width;
  json["timeline_height"] = settings.timeline_height;
  json["world_share"] = settings.world_share;
  json["show_world"] = settings.show_world;
  json["show_inspector"] = settings.show_inspector;
  json["all_settings"] = settings.all_settings;
  json["loop"] = settings.loop;
  json["autosave_s"] = settings.autosave_s;
  json["last_folder"] = settings.last_folder.string();
  json["recent"] = Json::array();
  for (const fs::path& path : settings.recent) json["recent"].push_back(path.string());
  return write_text(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", true);
}

void remember_project(Settings& settings, const fs::path& project) {
  const fs::path path = fs::absolute(project).lexically_normal();
  std::erase(settings.recent, path);
  settings.recent.insert(settings.recent.begin(), path);
  if (settings.recent.size() > kMaxRecent) settings.recent.resize(kMaxRecent);
}

}  // namespace sigs::editor
