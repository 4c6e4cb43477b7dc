// SPDX-License-Identifier: MIT
#include "realism/look_settings.h"

#include <string_view>

#include "accuracy/csv.h"
#include "base/input_file.h"
#include "base/json.h"
#include "project/fields.h"

namespace sigs::bench {

namespace {

constexpr std::string_view kTaken[] = {"light.", "compositing.", "appearance.", "camera.exposure_s",
                                       "footage.spectrum"};

bool is_taken(const std::string& key) {
  for (const std::string_view begin : kTaken)
    if (key.starts_with(begin)) return true;
  return false;
}

void apply_members(const Json& json, const std::string& key, Project& project) {
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) apply_members(value, key.empty() ? name : key + "." + name, project);
  } else if (is_taken(key)) {
    if (const Result<void> set = set_field(project, key + "=" + json.dump()); !set) accuracy::stop(set.error().text());
  }
}

Json json_of(const std::filesystem::path& from, const std::string& clip) {
  const std::filesystem::path file = std::filesystem::is_directory(from) ? from / (clip + ".json") : from;
  const Result<std::string> text = read_text(file, kProjectLimit_bytes);
  if (!text) accuracy::stop(text.error().text());
  Result<Json> json = parsed_json(*text, file.string(), ErrorKind::bad_project);
  if (!json) accuracy::stop(json.error().text());
  return *std::move(json);
}

}  // namespace

void apply(const LookSettings& settings, const std::string& clip, Project& project) {
  for (const std::filesystem::path& from : settings.from) apply_members(json_of(from, clip), "", project);
}

bool shakes_in(const LookSettings& settings, const std::string& clip) {
  for (const std::filesystem::path& from : settings.from) {
    const Json json = json_of(from, clip);
    if (!json.contains("intruders")) continue;
    const Json::json_pointer track("/camera/track/file");
    return json.contains(track) && json.at(track).is_string() && !json.at(track).get<std::string>().empty();
  }
  return settings.shakes;
}

}  // namespace sigs::bench
