// SPDX-License-Identifier: MIT
#include "export/label_folder.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace sigs {

namespace fs = std::filesystem;

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

bool fits(std::string_view path, std::string_view pattern) {
  if (pattern.empty()) return path.empty();
  const std::string_view rest = pattern.substr(1);
  if (pattern.front() == '*')
    return fits(path, rest) || (!path.empty() && path.front() != '/' && fits(path.substr(1), pattern));
  if (path.empty()) return false;
  if (pattern.front() == '#')
    return is_digit(path.front()) && (fits(path.substr(1), rest) || fits(path.substr(1), pattern));
  return path.front() == pattern.front() && fits(path.substr(1), rest);
}

Result<void> check_label_folder(const fs::path& folder, const LabelFormat& format) {
  if (format.files.empty()) return {};
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    if (it->is_directory(code) && !it->is_symlink(code)) continue;
    const std::string path = it->path().lexically_relative(folder).generic_string();
    const auto is_written = [&path](std::string_view pattern) { return fits(path, pattern); };
    if (std::none_of(format.files.begin(), format.files.end(), is_written))
      return fail(folder.string(), "holds " + path + ", which no export wrote; choose another folder",
                  ErrorKind::cannot_create);
  }
  if (code && code != std::errc::no_such_file_or_directory)
    return fail(folder.string(), "cannot be looked through: " + code.message(), ErrorKind::cannot_create);
  return {};
}

}  // namespace sigs
