// SPDX-License-Identifier: MIT
#include "base/numbered_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/paths.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxDigits = 18;  // fits into 64 bits

bool is_decimal(char c) {
  return c >= '0' && c <= '9';
}

std::string_view leading_digits(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_decimal);
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

// The digits of "%06d" after its percent sign, and how long "06d" is; none: it is no such thing.
struct NumberPlace {
  int digits = 0;
  std::size_t length = 0;
};
std::optional<NumberPlace> number_place_in(std::string_view text) {
  const std::string_view width = leading_digits(text);
  if (width.size() >= text.size() || text[width.size()] != 'd' || width.size() > 3) return std::nullopt;
  if (width.empty()) return NumberPlace{.digits = 0, .length = 1};
  int digits = 0;
  std::from_chars(width.data(), width.data() + width.size(), digits);
  const bool is_allowed = width.front() == '0' && digits >= 1 && digits <= static_cast<int>(kMaxDigits);
  return is_allowed ? std::optional(NumberPlace{digits, width.size() + 1}) : std::nullopt;
}

}  // namespace

std::string NumberPattern::name_of(long long number) const {
  return fmt::format("{}{:0{}}{}", prefix, number, std::max(digits, 1), suffix);
}

std::optional<long long> NumberPattern::number_in(std::string_view name) const {
  if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix))
    return std::nullopt;
  const std::string_view digits_there = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  if (digits_there.size() > kMaxDigits || leading_digits(digits_there).size() != digits_there.size())
    return std::nullopt;
  long long number = 0;
  std::from_chars(digits_there.data(), digits_there.data() + digits_there.size(), number);
  return name_of(number) == name ? std::optional(number) : std::nullopt;
}

std::optional<NumberPattern> number_pattern_of(const fs::path& path) {
  const std::string name = path.filename().string();
  NumberPattern pattern;
  bool has_place = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    std::string& text = has_place ? pattern.suffix : pattern.prefix;
    if (name[i] != '%') {
      text += name[i];
      continue;
    }
    const std::string_view rest = std::string_view(name).substr(i + 1);
    if (rest.starts_with('%')) {
      text += '%';
      ++i;
      continue;
    }
    const std::optional<NumberPlace> place = number_place_in(rest);
    if (!place || std::exchange(has_place, true)) return std::nullopt;
    pattern.digits = place->digits;
    i += place->length;
  }
  return has_place ? std::optional(pattern) : std::nullopt;
}

bool is_number_pattern(const fs::path& path) {
  std::error_code code;
  return number_pattern_of(path) && !fs::exists(path, code);
}

Result<std::vector<fs::path>> files_of_pattern(const fs::path& path) {
  const std::optional<NumberPattern> pattern = number_pattern_of(path);
  if (!pattern) return fail(path.string(), "has no place for a number such as %06d", ErrorKind::cannot_read);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const Result<std::vector<fs::path>> there = folder_contents(folder);
  if (!there) return fail(there.error());
  std::vector<long long> numbers;
  for (const fs::path& file : *there)
    if (const std::optional<long long> number = pattern->number_in(file.filename().string()))
      numbers.push_back(*number);
  if (numbers.empty())
    return fail(path.string(), fmt::format("no file of this pattern is there, such as {}", pattern->name_of(0)),
                ErrorKind::cannot_read);
  std::sort(numbers.begin(), numbers.end());
  std::vector<fs::path> files;
  for (const long long number : numbers) {
    const long long due = numbers.front() + static_cast<long long>(files.size());
    if (number != due)
      return fail(path.string(), fmt::format("{} is missing; the files go from {} to {}", pattern->name_of(due),
                                             pattern->name_of(numbers.front()), pattern->name_of(numbers.back())));
    files.push_back(path.parent_path() / pattern->name_of(number));
  }
  return files;
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    std::string_view digits_a = leading_digits(a);
    std::string_view digits_b = leading_digits(b);
    if (digits_a.empty() || digits_b.empty()) {
      if (a.front() != b.front()) return static_cast<unsigned char>(a.front()) < static_cast<unsigned char>(b.front());
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    a.remove_prefix(digits_a.size());
    b.remove_prefix(digits_b.size());
    for (std::string_view* const digits : {&digits_a, &digits_b})
      digits->remove_prefix(std::min(digits->find_first_not_of('0'), digits->size()));
    if (digits_a.size() != digits_b.size()) return digits_a.size() < digits_b.size();
    if (digits_a != digits_b) return digits_a < digits_b;
  }
  return a.empty() != b.empty() ? a.empty() : whole_a < whole_b;
}

}  // namespace sigs
