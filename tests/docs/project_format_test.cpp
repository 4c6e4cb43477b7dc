// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "docs/markdown.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/validate.h"

namespace sigs::test {
namespace {

using Row = std::vector<std::string>;

const char* const kHeader = "| key | type | unit | range | default | meaning |";

// "intruders[0].name" -> "intruders[].name"
std::string general(const std::string& key) {
  static const std::regex number("\\[[0-9]+\\]");
  return std::regex_replace(key, number, "[]");
}

// Shortest text, with short exponents: 1e8.
std::string shown(double number) {
  char buffer[64];
  const std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr);
  static const std::regex exponent("e([+-]?)0*");
  return std::regex_replace(text, exponent, text.find("e-") == std::string::npos ? "e" : "e-");
}

std::string in_quotes(std::string_view text) {
  return std::string("\"").append(text).append("\"");
}

std::string joined(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

struct TypeText {
  const Field& field;
  std::string operator()(const double*) const { return "number"; }
  std::string operator()(const int*) const { return "whole number"; }
  std::string operator()(const std::optional<double>*) const { return "number or null"; }
  std::string operator()(const std::optional<int>*) const { return "whole number or null"; }
  std::string operator()(const std::string*) const { return field.is_path ? "path" : "text"; }
  std::string operator()(const glm::dvec3*) const { return "[x, y, z]"; }
  std::string operator()(const std::vector<std::string>*) const { return "list of texts"; }
  std::string operator()(const Choice&) const { return "name"; }
};

struct DefaultText {
  std::string operator()(const double* value) const { return shown(*value); }
  std::string operator()(const int* value) const { return shown(*value); }
  std::string operator()(const std::optional<double>* value) const { return *value ? shown(**value) : "null"; }
  std::string operator()(const std::optional<int>* value) const { return *value ? shown(**value) : "null"; }
  std::string operator()(const std::string* value) const { return in_quotes(*value); }
  std::string operator()(const glm::dvec3* v) const {
    return std::string("[").append(shown(v->x)).append(", ").append(shown(v->y)).append(", ").append(shown(v->z)) + "]";
  }
  std::string operator()(const std::vector<std::string>* values) const {
    std::string text;
    for (const std::string& value : *values) text.append(text.empty() ? "" : ", ").append(in_quotes(value));
    return std::string("[").append(text).append("]");
  }
  std::string operator()(const Choice& choice) const {
    return in_quotes(choice.names.at(static_cast<std::size_t>(choice.get())));
  }
};

std::string range_text(const Field& field) {
  if (const auto* const choice = std::get_if<Choice>(&field.value)) return joined(choice->names);
  if (field.required) return "not empty";
  return std::isfinite(field.minimum) ? shown(field.minimum) + " to " + shown(field.maximum) : "";
}

Row row_of(const Field& field) {
  return {general(field.key), std::visit(TypeText{field}, field.value), std::string(field.unit),
          range_text(field),  std::visit(DefaultText{}, field.value),   std::string(field.help)};
}

// The settings in the code: one row for each, with one intruder and one waypoint.
std::map<std::string, Row> rows_in_code() {
  Project project;
  project.intruders.resize(1);
  project.intruders[0].trajectory.waypoints.resize(1);
  project.intruders[0].model.rotors.resize(1);
  std::map<std::string, Row> rows;
  for (const Field& field : fields_of(project)) rows[general(field.key)] = row_of(field);
  // Footage and look of a camera of a rig are the settings of a project with one.
  project.cameras.resize(1);
  for (const Field& field : fields_of(project))
    if (field.key.starts_with("cameras[0].") && !field.key.starts_with("cameras[0].footage."))
      rows[general(field.key)] = row_of(field);
  return rows;
}

std::map<std::string, Row> rows_on_page() {
  std::map<std::string, Row> rows;
  for (const Row& row : table_rows(page("project-format.md"), kHeader)) {
    CHECK_MESSAGE(rows.emplace(row.front(), row).second, row.front() << " stands there twice");
  }
  return rows;
}

std::string text_of(const Row& row) {
  std::string text = "|";
  for (const std::string& cell : row) text += " " + cell + " |";
  return text;
}

// Remarks are for the reader; a project file has none.
std::string without_remarks(const std::string& jsonc) {
  return nlohmann::ordered_json::parse(jsonc, nullptr, true, true).dump(2);
}

std::set<std::string> keys_in(const nlohmann::ordered_json& json, const std::string& prefix) {
  std::set<std::string> keys;
  for (const auto& [key, value] : json.items()) {
    const bool list_of_objects = value.is_array() && !value.empty() && value[0].is_object();
    if (value.is_object()) keys.merge(keys_in(value, prefix + key + "."));
    if (list_of_objects)
      for (const auto& item : value) keys.merge(keys_in(item, prefix + key + "[]."));
    if (!value.is_object() && !list_of_objects) keys.insert(prefix + key);
  }
  return keys;
}

void check_project(const std::string& text) {
  const Result<ReadProject> read = parse_project(text, "example.json");
  if (!read) FAIL(read.error().text());
  for (const Warning& warning : read->warnings) FAIL_CHECK(warning.text());
  for (const Problem& problem : validate(read->project))  // its files do not exist
    CHECK_MESSAGE(problem.kind == ErrorKind::cannot_read, problem.field << " " << problem.what);
}

}  // namespace

TEST_CASE("the project format's page describes every setting as the code does") {
  const std::map<std::string, Row> on_page = rows_on_page();
  for (const auto& entry : rows_in_code()) {
    const auto& row = entry.second;
    const auto found = on_page.find(entry.first);
    if (found == on_page.end())
      FAIL_CHECK("missing: " << text_of(row));
    else
      CHECK_MESSAGE(found->second == row, "the page has\n" << text_of(found->second) << "\nthe code\n" << text_of(row));
  }
}

TEST_CASE("the project format's page describes no unknown setting") {
  const std::map<std::string, Row> in_code = rows_in_code();
  for (const auto& entry : rows_on_page()) CHECK_MESSAGE(in_code.contains(entry.first), entry.first);
}

TEST_CASE("the projects on the project format's page are read without a warning") {
  const std::string text = page("project-format.md");
  const std::vector<std::string> complete = blocks(text, "jsonc");
  const std::vector<std::string> others = blocks(text, "json");
  REQUIRE(complete.size() == 1);
  REQUIRE(!others.empty());
  check_project(without_remarks(complete[0]));
  for (const std::string& other : others) check_project(other);
}

TEST_CASE("the complete project on the project format's page has every setting") {
  const std::string text = blocks(page("project-format.md"), "jsonc").at(0);
  std::set<std::string> keys = keys_in(nlohmann::ordered_json::parse(without_remarks(text)), "");
  CHECK(keys.erase("sigs") == 1);
  std::set<std::string> expected;
  for (const auto& [key, row] : rows_in_code())
    if (!key.starts_with("cameras[]")) expected.insert(key);  // in place of footage: rigs.md has an example
  for (const std::string& key : expected) CHECK_MESSAGE(keys.contains(key), key);
  for (const std::string& key : keys) CHECK_MESSAGE(expected.contains(key), key);
}

}  // namespace sigs::test
