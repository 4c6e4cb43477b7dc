// SPDX-License-Identifier: MIT
#include "camera/calibration_formats.h"

#include <fmt/format.h>
#include <yaml-cpp/binary.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs::calibration {
namespace {

// The error of a file that nests deeper than kMaxNesting.
Error too_deep(const std::string& file_name) {
  return {file_name, fmt::format("has more than {} lists, keys or tags within one another", kMaxNesting)};
}

// YAML by yaml-cpp.

template <class Number>
void append_all(const std::vector<unsigned char>& bytes, std::size_t from, Field& field) {
  for (; from + sizeof(Number) <= bytes.size(); from += sizeof(Number)) {
    Number number{};
    std::memcpy(&number, bytes.data() + from, sizeof number);
    field.numbers.push_back(number);
  }
}

// What OpenCV writes as Base64: 24 bytes that state the numbers' type, "1d", then the numbers as they are in memory.
void append_binary(const YAML::Node& node, Field& field) {
  constexpr std::size_t kHeader_bytes = 24;
  std::string text = node.Scalar();
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  const std::vector<unsigned char> bytes = YAML::DecodeBase64(text);
  const std::string header(bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(std::min(kHeader_bytes, bytes.size())));
  const std::string_view type = trimmed(header);
  if (type.ends_with('d'))
    append_all<double>(bytes, kHeader_bytes, field);
  else if (type.ends_with('f'))
    append_all<float>(bytes, kHeader_bytes, field);
  else if (type.ends_with('i'))
    append_all<std::int32_t>(bytes, kHeader_bytes, field);
  else
    field.not_a_number = "binary data";
}

// With a point as decimal separator whatever the locale, which yaml-cpp's own conversion follows; ".inf" and ".nan" are
// read by that.
std::optional<double> number_of(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  double number = 0;
  if (text.find_first_of("0123456789") == std::string::npos && YAML::convert<double>::decode(node, number))
    return number;
  return parsed_number(text);
}

void append(const YAML::Node& node, Field& field) {
  if (node.IsScalar() && node.Tag() == "tag:yaml.org,2002:binary") {
    append_binary(node, field);
  } else if (const std::optional<double> number = node.IsScalar() ? number_of(node) : std::nullopt) {
    field.numbers.push_back(*number);
  } else if (node.IsSequence()) {
    for (const YAML::Node& element : node) append(element, field);
  } else if (!field.not_a_number) {
    field.not_a_number = node.IsScalar() ? node.Scalar() : "?";
  }
}

Field field_of(std::string name, const YAML::Node& node) {
  Field field{.name = std::move(name)};
  if (node.IsScalar()) field.text = node.Scalar();
  if (!node.IsMap()) {
    append(node, field);
    return field;
  }
  const YAML::Node rows = node["rows"];
  const YAML::Node cols = node["cols"];
  std::size_t row_count = 0;
  std::size_t col_count = 0;
  if (rows && cols && YAML::convert<std::size_t>::decode(rows, row_count) &&
      YAML::convert<std::size_t>::decode(cols, col_count))
    field.stated_count = row_count * col_count;
  if (const YAML::Node data = node["data"]) append(data, field);
  return field;
}

// Receives the elements one by one before nodes are built from them, and stops at those from which nodes cannot be
// built safely: nodes that contain themselves have no end, and aliases of aliases grow without bound.
class NestingGuard : public YAML::EventHandler {
 public:
  explicit NestingGuard(const std::string& file_name) : file_name_(file_name) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw YAML::ParserException(mark, "an alias (*name) is not read; write the value itself");
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void enter(const YAML::Mark& mark) {
    if (++depth_ > kMaxNesting) throw YAML::ParserException(mark, too_deep(file_name_).what);
  }

  const std::string& file_name_;
  int depth_ = 0;
};

Fields fields_of(const YAML::Node& map) {
  Fields fields;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) continue;
    const std::string& name = entry.first.Scalar();
    fields.emplace(name, field_of(name, entry.second));
    if (entry.second.IsMap() && !entry.second["data"]) fields.groups.push_back({name, fields_of(entry.second)});
  }
  return fields;
}

Result<Fields> plain_yaml_fields(const std::string& text, const std::string& file_name) {
  try {
    NestingGuard guard(file_name);
    std::istringstream stream(text);
    YAML::Parser(stream).HandleNextDocument(guard);
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) return fail(file_name, "not a calibration: expected XML, or YAML or JSON with keys");
    return fields_of(root);
  } catch (const YAML::Exception& error) {
    return fail(file_name, fmt::format("line {}: {}", error.mark.line + 1, error.msg));
  } catch (const std::exception& error) {
    if (is_out_of_memory()) return fail(thrown_error(file_name));
    return fail(file_name, fmt::format("not readable as YAML: {}", error.what()));
  }
}

// OpenCV FileStorage in XML.

void append(const cv::FileNode& node, Field& field) {
  if (node.isInt() || node.isReal()) {
    field.numbers.push_back(node.real());
  } else if (node.isSeq()) {
    for (const cv::FileNode& element : node) append(element, field);
  } else if (!field.not_a_number) {
    field.not_a_number = node.isString() ? node.string() : "?";
  }
}

Field field_of(const cv::FileNode& node) {
  Field field{.name = node.name()};
  if (node.isString()) field.text = node.string();
  if (!node.isMap()) {
    append(node, field);
    return field;
  }
  const cv::FileNode rows = node["rows"];
  const cv::FileNode cols = node["cols"];
  if (rows.isInt() && cols.isInt() && rows.real() >= 0 && cols.real() >= 0)
    field.stated_count = static_cast<std::size_t>(rows.real() * cols.real());
  const cv::FileNode data = node["data"];
  if (!data.empty()) append(data, field);
  return field;
}

Fields fields_of(const cv::FileNode& root) {
  Fields fields;
  if (!root.isMap()) return fields;
  for (const cv::FileNode& node : root) {
    Field field = field_of(node);
    fields.emplace(field.name, std::move(field));
  }
  return fields;
}

// OpenCV's error message, on one line.
std::string reason(const cv::Exception& error) {
  std::string text = error.err.empty() ? std::string("syntax error") : error.err;
  std::ranges::replace(text, '\n', ' ');
  return text;
}

Result<Fields> opencv_xml_fields(const std::string& text, const std::string& file_name) {
  if (xml_depth(text) > kMaxNesting) return fail(too_deep(file_name));  // the storage recurses for each level
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!storage.isOpened()) return fail(file_name, "not an OpenCV calibration file");
    return fields_of(storage.root());
  } catch (const cv::Exception& error) {
    if (is_out_of_memory()) return fail(thrown_error(file_name));
    return fail(file_name, "not readable as an OpenCV file: " + reason(error));
  } catch (const std::exception& error) {
    if (is_out_of_memory()) return fail(thrown_error(file_name));
    return fail(file_name, fmt::format("not readable as an OpenCV file: {}", error.what()));
  }
}

// OpenCV's own header of YAML is "%YAML:1.0"; the standard has a space in the colon's place. As a comment it leaves the
// numbers of lines as they are.
std::string without_opencv_header(std::string text) {
  if (text.starts_with("%YAML:")) text.front() = '#';
  return text;
}

// JSON by nlohmann::json, Gyroflow's lens profiles among it.

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

// Whether a key is missing, null, "" or the given word.
bool is_unset_or(const Json& profile, const char* key, std::string_view word) {
  const auto it = profile.find(key);
  if (it == profile.end() || it->is_null()) return true;
  return it->is_string() && (it->get<std::string>().empty() || it->get<std::string>() == word);
}

Result<void> check_model(const Json& profile, const std::string& file) {
  if (!is_unset_or(profile, "distortion_model", "opencv_fisheye"))
    return fail(file + ": distortion_model", fmt::format("Gyroflow's model {} is not supported; opencv_fisheye is",
                                                         profile["distortion_model"].dump()));
  if (!is_unset_or(profile, "digital_lens", ""))
    return fail(file + ": digital_lens",
                fmt::format("the digital lens {} is not supported", profile["digital_lens"].dump()));
  return {};
}

// A number of the profile; 1 where it is missing or null.
Result<double> factor(const Json& profile, const char* key, const std::string& file) {
  const auto it = profile.find(key);
  if (it == profile.end() || it->is_null()) return 1;
  constexpr double kMin = 0.1;
  constexpr double kMax = 10;
  const double number = it->is_number() ? it->get<double>() : 0;
  if (number >= kMin && number <= kMax) return number;
  return fail(file + ": " + key, "expected a number from 0.1 to 10, found " + it->dump().substr(0, 40));
}

// The crops that the compatible settings of a profile name, each once.
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
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(text_of(number));
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Gyroflow: the image of the lens is `stretch` times wider than the footage, of which stabilisation has kept the share
// `crop` (core/lens_profile.rs and core/stabilization/frame_transform.rs of Gyroflow 1.5).
Result<void> read_factors(const Json& profile, const std::string& file, Fields& fields) {
  double* const factors[]{&fields.kept_share, &fields.stretch.x, &fields.stretch.y};
  const char* const keys[]{"crop", "input_horizontal_stretch", "input_vertical_stretch"};
  for (std::size_t i = 0; i < std::size(keys); ++i) {
    const auto it = profile.find(keys[i]);
    const bool is_unset = i > 0 && it != profile.end() && it->is_number() && std::abs(it->get<double>()) <= 0.01;
    if (is_unset) continue;  // Gyroflow takes a stretch of up to 0.01 as not set
    const Result<double> number = factor(profile, keys[i], file);
    if (!number) return fail(number.error());
    *factors[i] = *number;
  }
  std::set<double> others = crops_of_settings(profile);
  others.erase(fields.kept_share);
  if (!others.empty())
    fields.warnings.push_back(
        {file + ": compatible_settings",
         fmt::format(
             "name the stabilisation crops {} too; read with crop {}. If the camera has stabilised the footage, "
             "write its \"crop\" into a copy of the profile",
             listed(others), text_of(fields.kept_share))});
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

Result<Fields> json_fields(const std::string& text, const std::string& file_name) {
  if (json_depth(text) > kMaxNesting) return fail(too_deep(file_name));
  try {
    const Json json = Json::parse(text);
    if (json.is_object() && json.contains("fisheye_params")) return profile_fields(json, file_name);
    return plain_yaml_fields(json.dump(), file_name);
  } catch (const Json::parse_error& error) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::min(error.byte, text.size()), '\n');
    return fail(file_name, fmt::format("line {}: not readable as JSON", line));
  } catch (const std::exception& error) {
    if (is_out_of_memory()) return fail(thrown_error(file_name));
    return fail(file_name, fmt::format("not readable as JSON: {}", error.what()));
  }
}

}  // namespace

std::string text_of(double number) {
  if (std::isnan(number)) return "nan";  // whose sign has no meaning
  std::array<char, 32> digits{};         // the shortest text that reads back as a double has at most 24 characters
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

Result<Fields> fields_in(const std::string& text, const std::string& file_name) {
  if (text.empty()) return fail(file_name, "is empty");
  if (text.find('\0') != std::string::npos) return fail(file_name, "is not a text file");
  if (text.starts_with('<')) return opencv_xml_fields(text, file_name);
  if (text.starts_with('{')) return json_fields(text, file_name);
  return plain_yaml_fields(without_opencv_header(text), file_name);
}

}  // namespace sigs::calibration
