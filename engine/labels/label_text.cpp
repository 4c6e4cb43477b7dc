// SPDX-License-Identifier: MIT
#include "labels/label_text.h"

#include <algorithm>
#include <cmath>

#include "base/ensure.h"
#include "labels/xml_text.h"

namespace sigs {

const LabelledIntruder& labelled_intruder(const LabelSequence& sequence, int intruder) {
  const auto found = std::find_if(sequence.intruders.begin(), sequence.intruders.end(),
                                  [intruder](const LabelledIntruder& one) { return one.id == intruder; });
  ENSURE(found != sequence.intruders.end());
  return *found;
}

int category_index(const LabelSequence& sequence, int intruder) {
  const std::string& wanted = labelled_intruder(sequence, intruder).category;
  const auto category = std::find(sequence.categories.begin(), sequence.categories.end(), wanted);
  ENSURE(category != sequence.categories.end());
  return static_cast<int>(category - sequence.categories.begin());
}

std::string line_name(std::string_view text) {
  std::string line = xml_text(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }, ' ');
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return "unnamed";
  return line.substr(first, line.find_last_not_of(' ') - first + 1);
}

std::string word_name(std::string_view text) {
  std::string word = line_name(text);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

std::string joined(std::initializer_list<int> numbers, std::string_view separator) {
  std::string text;
  for (const int number : numbers) {
    if (!text.empty()) text += separator;
    text += std::to_string(number);
  }
  return text;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

std::string rate_text(const FootageTruth& footage) {
  return std::to_string(footage.frame_rate_num) + "/" + std::to_string(footage.frame_rate_den);
}

int whole_rate_hz(const FootageTruth& footage) {
  const double rate_hz = static_cast<double>(footage.frame_rate_num) / footage.frame_rate_den;
  return std::max(1, static_cast<int>(std::lround(rate_hz)));
}

}  // namespace sigs
