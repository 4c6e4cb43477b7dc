// SPDX-License-Identifier: MIT
#include "camera/gyroflow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "camera/plain_yaml.h"

namespace sigs::calibration {
namespace {

using Json = nlohmann::json;

void append(const Json& node, Field& field) {
  if (node.is_number()) {
    field.numbers.push_back(node.get<double>());
  } else if (node.is_array()) {
    for (const Json& element : node) append(element, field);
  } else if (!field.not_a_number) {
    field.not_a_number = node.dump();
  }
}

// Nothing set (null, "") or said to be the given word.
bool is_unset_or(const Json& profile, const char* key, std::string_view word) {
  const auto it = profile.find(key);
  if (it == profile.end() || it->is_null()) return true;
  return it->is_string() && (it->get<std::string>().empty() || it->get<std::string>() == word);
}

Result<void> check_model(const Json& profile, const std::string& file) {
  if (!is_unset_or(profile, "distortion_model", "opencv_fisheye"))
    return fail(file + ": distortion_model",
                "Gyroflow's model " + profile["distortion_model"].dump() + " is not supported; opencv_fisheye is");
  if (!is_unset_or(profile, "digital_lens", ""))
    return fail(file + ": digital_lens", "the digital lens " + profile["digital_lens"].dump() + " is not supported");
  for (const char* key : {"input_horizontal_stretch", "input_vertical_stretch"}) {
    const auto it = profile.find(key);
    if (it == profile.end() || !it->is_number()) continue;
    const double stretch = it->get<double>();
    if (std::abs(stretch) > 0.01 && stretch != 1)  // Gyroflow takes up to 0.01 as not set
      return fail(file + ": " + key, "stretched footage (" + text_of(stretch) + ") is not supported");
  }
  return {};
}

Result<Fields> profile_fields(const Json& profile, const std::string& file) {
  if (const auto good = check_model(profile, file); !good) return fail(good.error());
  constexpr std::array<std::array<const char*, 3>, 2> kParts{{
      {"fisheye_params", "camera_matrix", "camera_matrix"},
      {"fisheye_params", "distortion_coeffs", "distortion_coefficients"},
  }};
  Fields fields{{"fisheye_model", Field{.name = "fisheye_params", .numbers = {1}}}};
  for (const auto& [group, key, known_as] : kParts) {
    Field field{.name = std::string(group) + "." + key};
    const Json& parts = profile[group];
    if (!parts.is_object() || !parts.contains(key)) return fail(file + ": " + field.name, "missing");
    append(parts[key], field);
    fields.emplace(known_as, std::move(field));
  }
  const Json size = profile.value("calib_dimension", Json());
  if (!size.is_object()) return fields;
  Field field{.name = "calib_dimension"};
  for (const char* side : {"w", "h"})
    if (size.contains(side)) append(size[side], field);
  fields.emplace("image_size", std::move(field));
  return fields;
}

}  // namespace

Result<Fields> json_fields(const std::string& text, const std::string& file_name) {
  try {
    const Json json = Json::parse(text);
    if (json.is_object() && json.contains("fisheye_params")) return profile_fields(json, file_name);
    return plain_yaml_fields(json.dump(), file_name);
  } catch (const Json::parse_error& error) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::min(error.byte, text.size()), '\n');
    return fail(file_name, "line " + std::to_string(line) + ": not readable as JSON");
  } catch (const std::exception& error) {
    return fail(file_name, std::string("not readable as JSON: ") + error.what());
  }
}

}  // namespace sigs::calibration
