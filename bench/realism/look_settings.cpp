// SPDX-License-Identifier: MIT
#include "realism/look_settings.h"

#include <string_view>

#include "accuracy/csv.h"
#include "base/input_file.h"
#include "project/fields.h"
#include "project/json_reading.h"

namespace sigs::bench {

namespace {

constexpr std::string_view kTaken[] = {"light.", "compositing.", "appearance.", "camera.exposure_s"};

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

void apply_file(const std::filesystem::path& file, Project& project) {
  const Result<std::string> text = read_text(file, kProjectLimit_bytes);
  if (!text) accuracy::stop(text.error().text());
  const Result<Json> json = parsed_json(*text, file.string(), ErrorKind::bad_project);
  if (!json) accuracy::stop(json.error().text());
  apply_members(*json, "", project);
}

}  // namespace

void apply(const LookSettings& settings, const std::string& clip, Project& project) {
  for (const std::filesystem::path& from : settings.from)
    apply_file(std::filesystem::is_directory(from) ? from / (clip + ".json") : from, project);
}

}  // namespace sigs::bench
