// SPDX-License-Identifier: MIT
#include "encounter_model/model_sections.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"

namespace sigs {

namespace {

constexpr int kMaxLines = 100000;
constexpr std::size_t kMaxShown = 40;  // bytes of a stranger's text in a message

std::string shown(std::string_view text) {
  const std::string line = line_text(text.substr(0, kMaxShown));
  return text.size() > kMaxShown ? line + "..." : line;
}

Result<double> number_of(std::string_view word, const std::string& place, double low, double high) {
  const std::optional<double> number = finite_number(word);
  if (!number) return fail(place, fmt::format("\"{}\" is not a finite number", shown(word)));
  if (*number < low || *number > high)
    return fail(place,
                fmt::format("{} lies outside {} to {}", shown(word), short_number_text(low), short_number_text(high)));
  return *number;
}

}  // namespace

std::string place_in(const std::string& file, int line, std::string_view section) {
  return fmt::format("{}: line {}, # {}", file, line, shown(section));
}

Result<std::vector<ModelSection>> model_sections(std::string_view text, const std::string& file) {
  std::vector<ModelSection> sections;
  text = without_bom(text);
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(next_line(text));
    if (line.empty()) continue;
    if (number > kMaxLines)
      return fail(fmt::format("{}: line {}", file, number), "more lines than any encounter model has");
    if (line.front() == '#') {
      const std::string_view name = trimmed(line.substr(1));
      const auto is_same = [&](const ModelSection& section) { return section.name == name; };
      if (std::any_of(sections.begin(), sections.end(), is_same))
        return fail(place_in(file, number, name), "this section is there twice; each may be there once");
      if (sections.size() >= 100)
        return fail(place_in(file, number, name), "more than 100 sections; this is not an encounter model");
      sections.push_back({.name = name, .line = number, .lines = {}});
    } else if (sections.empty()) {
      return fail(fmt::format("{}: line {}", file, number),
                  fmt::format("expected a section such as \"# labels_initial\", found \"{}\"; this is not an encounter "
                              "model",
                              shown(line)));
    } else {
      sections.back().lines.push_back({number, line});
    }
  }
  return sections;
}

Result<std::vector<double>> numbers_in(const SectionLine& line, std::string_view section, const std::string& file,
                                       double low, double high) {
  std::vector<double> numbers;
  std::string_view rest = line.text;
  for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest)) {
    const Result<double> number = number_of(word, place_in(file, line.number, section), low, high);
    if (!number) return fail(number.error());
    numbers.push_back(*number);
  }
  return numbers;
}

Result<std::vector<double>> numbers_in(const ModelSection& section, const std::string& file, double expected,
                                       double low, double high) {
  std::vector<double> numbers;
  for (const SectionLine& line : section.lines) {
    Result<std::vector<double>> more = numbers_in(line, section.name, file, low, high);
    if (!more) return more;
    if (numbers.empty())
      numbers = std::move(*more);
    else
      numbers.insert(numbers.end(), more->begin(), more->end());
  }
  if (static_cast<double>(numbers.size()) != expected)
    return fail(place_in(file, section.line, section.name),
                fmt::format("expected {} numbers, found {}",
                            expected < 1e15 ? number_text(expected, 0) : short_number_text(expected), numbers.size()));
  return numbers;
}

}  // namespace sigs
