// SPDX-License-Identifier: MIT
#include "editor/document/settings.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "base/staged_outputs.h"
#include "project/fields.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxRecent = 12;

// Calls with each setting's key, place and range.
template <class SettingsOrConst, class Call>
void for_each_setting(SettingsOrConst& settings, const Call& call) {
  call("font_px", settings.font_px, kMinFont_px, kMaxFont_px);
  call("window_width_px", settings.window_width_px, 640, 16384);
  call("window_height_px", settings.window_height_px, 480, 16384);
  call("maximised", settings.maximised, false, true);
  call("inspector_width", settings.inspector_width, 200.0, 2000.0);
  call("timeline_height", settings.timeline_height, 90.0, 2000.0);
  call("world_share", settings.world_share, 0.05, 0.95);
  call("show_world", settings.show_world, false, true);
  call("show_inspector", settings.show_inspector, false, true);
  call("all_settings", settings.all_settings, false, true);
  call("loop", settings.loop, false, true);
  call("autosave_s", settings.autosave_s, 1.0, 3600.0);
}

// What is absent or of another type leaves the default.
Settings settings_of(const Json& json) {
  Settings settings;
  for_each_setting(settings, [&]<class Value>(const char* key, Value& value, Value minimum, Value maximum) {
    const auto found = json.find(key);
    const bool fits = found != json.end() && (std::is_same_v<Value, bool> ? found->is_boolean() : found->is_number());
    if (fits) value = std::clamp(found->get<Value>(), minimum, maximum);
  });
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
  for_each_setting(settings, [&](const char* key, const auto& value, auto, auto) { json[key] = value; });
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
