// SPDX-License-Identifier: MIT
#include "evaluation/readers/json_fields.h"

#include <fmt/format.h>

#include <cmath>

#include "base/input_file.h"
#include "base/text.h"

namespace sigs {

Result<Json> JsonFields::document() const {
  const Result<std::string> text = read_text(path_);
  if (!text) return fail(text.error());
  return parsed_json(std::string(without_bom(*text)), path_.string(), ErrorKind::bad_data);
}

const Json* JsonFields::field(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::string JsonFields::text(const Json& object, const char* key) {
  const Json* const found = field(object, key);
  if (found != nullptr && found->is_string()) return found->get<std::string>();
  wrong(key, "is not a text");
  return {};
}

double JsonFields::number(const Json& object, const char* key) {
  const Json* const found = field(object, key);
  const double value = found != nullptr && found->is_number() ? found->get<double>() : std::nan("");
  if (!(std::abs(value) <= 1e9)) wrong(key, "is not a number of a magnitude up to 1e9");
  return value;
}

int JsonFields::whole(const Json& object, const char* key) {
  const double value = number(object, key);
  if (!is_wrong() && value != std::floor(value)) wrong(key, "is not a whole number");
  return is_wrong() ? 0 : static_cast<int>(value);
}

std::optional<double> JsonFields::optional_number(const Json& object, const char* key) {
  return field(object, key) != nullptr ? std::optional(number(object, key)) : std::nullopt;
}

std::optional<int> JsonFields::optional_whole(const Json& object, const char* key) {
  return field(object, key) != nullptr ? std::optional(whole(object, key)) : std::nullopt;
}

std::array<double, 4> JsonFields::four_numbers(const Json& object, const char* key) {
  const Json* const list = field(object, key);
  std::array<double, 4> numbers{};
  bool is_good = list != nullptr && list->is_array() && list->size() == numbers.size();
  for (std::size_t i = 0; is_good && i < numbers.size(); ++i) {
    is_good = (*list)[i].is_number();
    if (is_good) numbers[i] = (*list)[i].get<double>();
    is_good = is_good && std::abs(numbers[i]) <= 1e9;
  }
  if (!is_good) wrong(key, "is not a list of 4 numbers of a magnitude up to 1e9");
  return numbers;
}

void JsonFields::wrong(const char* key, const std::string& what) {
  if (error_.empty()) error_ = fmt::format("{}.{} {}", place_, key, what);
}

}  // namespace sigs
