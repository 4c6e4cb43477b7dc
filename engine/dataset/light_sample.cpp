// SPDX-License-Identifier: MIT
#include "dataset/light_sample.h"

#include <algorithm>
#include <array>

#include "dataset/quantity_json.h"
#include "dataset/short_text.h"
#include "project/fields.h"

namespace sigs {

namespace {

// A field of a project's light and what its numbers are called among those sampled.
struct LightField {
  const char* key;
  std::vector<const char*> names;
};

const std::array<LightField, 3>& light_fields() {
  static const std::array<LightField, 3> fields{{{"position_m", {"light_x_m", "light_y_m", "light_z_m"}},
                                                 {"color", {"light_red", "light_green", "light_blue"}},
                                                 {"ambient", {"light_ambient"}}}};
  return fields;
}

// What a project may have in that field.
Span limits_of(const char* key) {
  Project project;
  for (const Field& field : fields_of(project))
    if (field.key == std::string("light.") + key) return {field.minimum, field.maximum};
  return {};
}

void read_number(const Json& json, const std::string& where, const LightField& field, std::size_t part,
                 LightPlan& light, RecipeLog& log) {
  const tl::expected<Quantity, std::string> quantity = quantity_of(json);
  if (!quantity) return log.wrong(where, quantity.error());
  const Span span = span_of(*quantity);
  const Span limits = limits_of(field.key);
  if (span.low < limits.low || span.high > limits.high)
    return log.wrong(where, "must lie between " + short_text(limits.low) + " and " + short_text(limits.high) +
                                "; a normal quantity needs \"low\" and \"high\" for that");
  light.quantities[field.names[part]] = *quantity;
}

void read_field(RecipeNode& node, const LightField& field, LightPlan& light) {
  const Json* const json = node.value(field.key);
  if (json == nullptr) return;
  const std::string where = node.key_of(field.key);
  if (field.names.size() == 1) return read_number(*json, where, field, 0, light, node.log());
  if (!json->is_array() || json->size() != field.names.size())
    return node.log().wrong(where, "expected a list of three quantities");
  for (std::size_t i = 0; i < json->size(); ++i)
    read_number(json->at(i), where + "[" + std::to_string(i) + "]", field, i, light, node.log());
}

bool is_set(const std::vector<std::string>& settings, const char* key) {
  const std::string begin = std::string("light.") + key + "=";
  return std::any_of(settings.begin(), settings.end(), [&](const std::string& one) { return one.starts_with(begin); });
}

LightPlan read_light(RecipeNode node, const std::vector<std::string>& settings) {
  LightPlan light;
  for (const LightField& field : light_fields()) {
    read_field(node, field, light);
    if (is_set(settings, field.key))
      for (const char* const name : field.names) light.quantities.erase(name);
  }
  node.done();
  return light;
}

}  // namespace

std::vector<LightPlan> read_lights(RecipeNode& group, const std::vector<std::string>& settings) {
  const Json* const json = group.value("light");
  if (json == nullptr) return {};
  std::vector<LightPlan> lights;
  if (json->is_array())
    for (RecipeNode& node : group.nodes("light")) lights.push_back(read_light(std::move(node), settings));
  else
    lights.push_back(read_light(RecipeNode(*json, group.key_of("light"), group.log()), settings));
  return lights;
}

LightSettings with_sampled_light(LightSettings light, const std::map<std::string, double>& sampled) {
  const std::array<double*, 7> values{&light.position_m.x, &light.position_m.y, &light.position_m.z, &light.color.x,
                                      &light.color.y,      &light.color.z,      &light.ambient};
  std::size_t i = 0;
  for (const LightField& field : light_fields())
    for (const char* const name : field.names) {
      if (const auto found = sampled.find(name); found != sampled.end()) *values[i] = found->second;
      ++i;
    }
  return light;
}

}  // namespace sigs
