// SPDX-License-Identifier: MIT
#include "labels/label_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

namespace sigs {

int frame_count(const FootageTruth& footage) {
  return footage.last_frame - footage.first_frame + 1;
}

double rate_hz(const FootageTruth& footage) {
  return static_cast<double>(footage.frame_rate_num) / footage.frame_rate_den;
}

std::string rate_text(const FootageTruth& footage) {
  return fmt::format("{}/{}", footage.frame_rate_num, footage.frame_rate_den);
}

int whole_rate_hz(const FootageTruth& footage) {
  return std::max(1, static_cast<int>(std::lround(rate_hz(footage))));
}

std::string line_name(std::string_view text) {
  const std::string line = line_text(text);
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return "unnamed";
  return line.substr(first, line.find_last_not_of(' ') - first + 1);
}

std::string word_name(std::string_view text) {
  std::string word = line_name(text);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

// A double-quoted scalar of YAML has JSON's escapes, except for surrogate pairs of \u, which YAML does not join. So
// other characters are written as they are, except for those that YAML forbids: what XML forbids, DEL, the C1 controls.
std::string yaml_text(std::string_view text) {
  const std::string quoted = json_string(xml_text(text));
  std::string out;
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    const auto byte = static_cast<unsigned char>(quoted[i]);
    const bool is_c1 = byte == 0xC2 && static_cast<unsigned char>(quoted[i + 1]) < 0xA0;
    const unsigned code = is_c1 ? static_cast<unsigned char>(quoted[++i]) : byte;
    if (is_c1 || code == 0x7F)
      out += fmt::format("\\x{:02x}", code);
    else
      out += quoted[i];
  }
  return out;
}

std::string json_string(std::string_view text) {
  return json_line(nlohmann::ordered_json(text));
}

std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void add_element(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_child(name).text() = xml_text(text).c_str();
}

void add_element(pugi::xml_node node, const char* name, int number) {
  add_element(node, name, std::to_string(number));
}

}  // namespace sigs
