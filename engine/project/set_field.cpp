// SPDX-License-Identifier: MIT
#include "project/set_field.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "project/json_reading.h"

namespace sigs {

namespace {

// Levenshtein's distance: how many letters to change, add or leave out.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::string nearest_key(const std::vector<Field>& fields, const std::string& key) {
  const auto nearer = [&key](const Field& a, const Field& b) {
    return edit_distance(a.key, key) < edit_distance(b.key, key);
  };
  return std::min_element(fields.begin(), fields.end(), nearer)->key;
}

Json json_or_text(const std::string& text) {
  if (json_depth(text) > kDeepestJson) return text;
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
  if (field == fields.end())
    return fail(where, "no such setting; did you mean " + nearest_key(fields, key) + "?", ErrorKind::usage);
  const bool takes_text = std::holds_alternative<std::string*>(field->value) && !(field->is_path && text == "null");
  const std::string wrong = put_json(takes_text ? Json(text) : json_or_text(text), *field);
  if (!wrong.empty()) return fail(where, wrong, ErrorKind::usage);
  return {};
}

}  // namespace sigs
