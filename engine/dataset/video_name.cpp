// SPDX-License-Identifier: MIT
#include "dataset/video_name.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "base/paths.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr std::array<std::string_view, 4> kParts{"background", "aircraft", "flight", "number"};
constexpr std::array<std::string_view, 5> kOwnNames{"labels", "splits", "index.json", "sha256sums",
                                                    "entry"};  // in lower case

std::string numbered(int number) {
  const std::string digits = std::to_string(number);
  return std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

std::optional<std::string> part_of(std::string_view name, const NameParts& parts) {
  if (name == kParts[0]) return parts.background;
  if (name == kParts[1]) return parts.aircraft;
  if (name == kParts[2]) return parts.flight;
  if (name == kParts[3]) return numbered(parts.number);
  return std::nullopt;
}

}  // namespace

std::string name_from(const std::string& pattern, const NameParts& parts) {
  std::string name;
  for (std::size_t i = 0; i < pattern.size();) {
    const std::size_t end = pattern[i] == '{' ? pattern.find('}', i) : std::string::npos;
    const std::optional<std::string> part =
        end == std::string::npos ? std::nullopt : part_of(std::string_view(pattern).substr(i + 1, end - i - 1), parts);
    name += part ? *part : std::string(1, pattern[i]);
    i = part ? end + 1 : i + 1;
  }
  return name;
}

std::string wrong_with_pattern(const std::string& pattern) {
  if (pattern.empty()) return "is empty; it names the videos";
  for (std::size_t begin = pattern.find('{'); begin != std::string::npos; begin = pattern.find('{', begin + 1)) {
    const std::size_t end = pattern.find('}', begin);
    if (end == std::string::npos) return "has a { without a }";
    const std::string part = pattern.substr(begin + 1, end - begin - 1);
    if (std::find(kParts.begin(), kParts.end(), part) == kParts.end())
      return "has no such part: {" + part + "}; there are {background}, {aircraft}, {flight} and {number}";
  }
  return {};
}

std::string wrong_with_video_name(const std::string& name) {
  if (std::find(kOwnNames.begin(), kOwnNames.end(), lower_case(name)) != kOwnNames.end())
    return "is kept for what the dataset has beside its videos; choose another name";
  return file_name_error(name);
}

}  // namespace sigs
