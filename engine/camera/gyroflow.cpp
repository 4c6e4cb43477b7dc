// SPDX-License-Identifier: MIT
#include "camera/gyroflow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/nesting.h"
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
  return {};
}

// A number of the profile; where it is not there or null, 1.
Result<double> factor(const Json& profile, const char* key, const std::string& file) {
  const auto it = profile.find(key);
  if (it == profile.end() || it->is_null()) return 1;
  constexpr double kLeast = 0.1;
  constexpr double kMax = 10;
  const double number = it->is_number() ? it->get<double>() : 0;
  if (number >= kLeast && number <= kMax) return number;
  return fail(file + ": " + key, "expected a number from 0.1 to 10, found " + it->dump().substr(0, 40));
}

// Which crop the settings of one profile name that it says nothing of itself: each once.
std::set<double> crops_of_settings(const Json& profile) {
  std::set<double> crops;
  const auto settings = profile.find("compatible_settings");
  if (settings == profile.end() || !settings->is_array()) return crops;
  for (const Json& setting : *settings)
    if (const auto crop = setting.find("crop"); crop != setting.end() && crop->is_number())
      crops.insert(crop->get<double>());
  return crops;
}

std::string listed(const std::set<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + text_of(number);
  return text;
}

// Gyroflow: the image that the lens throws is `stretch` times wider than the footage, of which stabilisation has kept
// the share `crop` (core/lens_profile.rs and core/stabilization/frame_transform.rs of Gyroflow 1.5).
Result<void> read_factors(const Json& profile, const std::string& file, Fields& fields) {
  double* const factors[]{&fields.kept_share, &fields.stretch.x, &fields.stretch.y};
  const char* const keys[]{"crop", "input_horizontal_stretch", "input_vertical_stretch"};
  for (std::size_t i = 0; i < std::size(keys); ++i) {
    const auto it = profile.find(keys[i]);
    const bool is_unset = i > 0 && it != profile.end() && it->is_number() && std::abs(it->get<double>()) <= 0.01;
    if (is_unset) continue;  // Gyroflow takes a stretch up to 0.01 as not set
    const Result<double> number = factor(profile, keys[i], file);
    if (!number) return fail(number.error());
    *factors[i] = *number;
  }
  std::set<double> others = crops_of_settings(profile);
  others.erase(fields.kept_share);
  if (!others.empty())
    fields.warnings.push_back(
        {file + ": compatible_settings", "name the stabilisation crops " + listed(others) + " too; read with crop " +
                                             text_of(fields.kept_share) +
                                             ". If the camera has stabilised the footage, write its \"crop\" into a "
                                             "copy of the profile"});
  if (const auto it = profile.find("interpolations"); it != profile.end() && !it->empty())
    fields.warnings.push_back({file + ": interpolations", "the lens at other focal lengths is not used"});
  return {};
}

Result<Fields> profile_fields(const Json& profile, const std::string& file) {
  if (const auto good = check_model(profile, file); !good) return fail(good.error());
  constexpr std::array<std::array<const char*, 3>, 2> kParts{{
      {"fisheye_params", "camera_matrix", "camera_matrix"},
      {"fisheye_params", "distortion_coeffs", "distortion_coefficients"},
  }};
  Fields fields;
  if (const auto good = read_factors(profile, file, fields); !good) return fail(good.error());
  fields.emplace("fisheye_model", Field{.name = "fisheye_params", .numbers = {1}});
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
  if (json_depth(text) > kMaxNesting) return fail(too_deep(file_name));
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
