// SPDX-License-Identifier: MIT
#include "project/set_field.h"

#include <algorithm>
#include <vector>

#include "project/json_reading.h"
#include "project/near_key.h"

namespace sigs {

namespace {

std::vector<std::string> keys_of(const std::vector<Field>& fields) {
  std::vector<std::string> keys;
  for (const Field& field : fields) keys.push_back(field.key);
  return keys;
}

Json json_or_text(const std::string& text) {
  if (json_depth(text) > kMaxJsonNesting) return text;
  Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json(text) : json;
}

}  // namespace

Result<void> set_field(Project& project, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string where = "--set " + assignment;
  if (equals == std::string::npos || equals == 0)
    return fail(where, "expected key=value, as in camera.speed_mps=30", ErrorKind::usage);
  const std::string key = assignment.substr(0, equals);
  const std::string text = assignment.substr(equals + 1);
  const std::vector<Field> fields = fields_of(project);
  const auto field = std::find_if(fields.begin(), fields.end(), [&key](const Field& f) { return f.key == key; });
  const bool is_group = std::any_of(fields.begin(), fields.end(), [&key](const Field& f) {
    return f.key.starts_with(key + ".") || f.key.starts_with(key + "[");
  });
  if (is_group) return fail(where, "is a group of settings; set one of its members by its key", ErrorKind::usage);
  if (field == fields.end()) return fail(where, "no such setting" + suggestion(keys_of(fields), key), ErrorKind::usage);
  const bool takes_text = std::holds_alternative<std::string*>(field->value) && !(field->is_path && text == "null");
  const std::string wrong = put_json(takes_text ? Json(text) : json_or_text(text), *field);
  if (!wrong.empty()) return fail(where, wrong, ErrorKind::usage);
  return {};
}

}  // namespace sigs
