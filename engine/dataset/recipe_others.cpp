// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "base/text.h"
#include "dataset/recipe.h"
#include "dataset/recipe_reading.h"
#include "project/fields.h"
#include "project/renamed_keys.h"

namespace sigs {

namespace {

constexpr const char* kAppearancePrefix = "appearance.";

bool is_one_number(const Field& field) {
  return std::holds_alternative<double*>(field.value) || std::holds_alternative<int*>(field.value) ||
         std::holds_alternative<std::optional<double>*>(field.value);
}

bool is_given_beside(const std::vector<std::string>& settings, const std::string& key) {
  return std::any_of(settings.begin(), settings.end(),
                     [&](const std::string& setting) { return current_key(setting.substr(0, setting.find('='))) == key; });
}

// The numbers of "appearance" under the names that settings have today.
Json with_current_keys(const Json& json, RecipeNode& group) {
  if (!json.is_object()) return json;
  Json renamed = Json::object();
  for (const auto& [key, value] : json.items()) {
    const std::string today = current_key(kAppearancePrefix + key).substr(std::string_view(kAppearancePrefix).size());
    if (today != key)
      group.log().warn(group.key_of("appearance") + "." + key, "is called " + today + " today; read as that");
    renamed[today] = value;
  }
  return renamed;
}

void read_appearance_number(const Json& json, const std::string& where, const Field& field, RecipeLog& log,
                            std::map<std::string, Quantity>& numbers) {
  const tl::expected<Quantity, std::string> quantity = quantity_of(json);
  if (!quantity) return log.wrong(where, quantity.error());
  const Span span = span_of(*quantity);
  if (span.low < field.minimum || span.high > field.maximum)
    return log.wrong(where,
                     fmt::format("must lie between {} and {}; a normal quantity needs \"low\" and \"high\" for that",
                                 short_number_text(field.minimum), short_number_text(field.maximum)));
  numbers[field.key] = *quantity;
}

OthersPlan read_other(RecipeNode node, const Recipe& recipe) {
  OthersPlan others;
  std::vector<std::string> there;
  for (const Aircraft& aircraft : recipe.aircraft) there.push_back(aircraft.name);
  others.aircraft = selected_names(node, "aircraft", there, there);
  others.flights = read_flights(node.value("flights"), node.key_of("flights"), node.log());
  others.count = read_quantity(node, "count").value_or(others.count);
  const Span span = span_of(others.count);
  if (span.low < 0 || span.high > kMaxOthers)
    node.log().wrong(node.key_of("count"), fmt::format("must lie between 0 and {}", kMaxOthers));
  node.done();
  return others;
}

}  // namespace

std::map<std::string, Quantity> read_appearance(RecipeNode& group, const std::vector<std::string>& settings) {
  std::map<std::string, Quantity> numbers;
  const Json* const json = group.value("appearance");
  if (json == nullptr) return numbers;
  const Json renamed = with_current_keys(*json, group);
  RecipeNode node(renamed, group.key_of("appearance"), group.log());
  Project project;
  for (const Field& field : fields_of(project)) {
    if (!field.key.starts_with(kAppearancePrefix) || !is_one_number(field)) continue;
    const std::string name = field.key.substr(std::string_view(kAppearancePrefix).size());
    const Json* const value = node.value(name);
    if (value == nullptr || is_given_beside(settings, field.key)) continue;
    read_appearance_number(*value, node.key_of(name), field, group.log(), numbers);
  }
  node.done();
  return numbers;
}

std::vector<OthersPlan> read_others(RecipeNode& group, const Recipe& recipe) {
  std::vector<OthersPlan> others;
  if (group.value("others") == nullptr) return others;
  for (RecipeNode& node : group.nodes("others")) others.push_back(read_other(std::move(node), recipe));
  return others;
}

std::vector<std::string> selected_names(RecipeNode& group, const char* key, const std::vector<std::string>& there,
                                        const std::vector<std::string>& standard) {
  std::vector<std::string> names = group.texts(key);
  if (names.empty()) return standard;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string where = fmt::format("{}[{}]", group.key_of(key), i);
    if (std::find(there.begin(), there.end(), names[i]) == there.end())
      group.log().wrong(where, fmt::format("no such name: \"{}\"; there are {}", names[i], listed(there)));
    if (std::count(names.begin(), names.end(), names[i]) > 1)
      group.log().wrong(where, fmt::format("stands there twice: \"{}\"", names[i]));
  }
  return names;
}

}  // namespace sigs
