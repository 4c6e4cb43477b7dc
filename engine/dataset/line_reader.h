// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace sigs {

// The lines of a text that this program wrote, one after the other. An error stays, and says what is wrong with which
// file; lines are empty from then on.
class LineReader {
 public:
  explicit LineReader(std::filesystem::path file) : file_(std::move(file)), in_(file_, std::ios::binary) {
    if (!in_)
      problem_ = Error{file_.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::cannot_read};
  }

  // The next line without its end; none at the end of the text.
  [[nodiscard]] std::optional<std::string> next() {
    std::string line;
    if (problem_) return std::nullopt;
    if (std::getline(in_, line)) {
      ++number_;
      return line;
    }
    if (in_.bad()) problem_ = Error{file_.string(), "cannot be read to its end", ErrorKind::cannot_read};
    return std::nullopt;
  }

  // The next line, of which the program wrote the beginning and the end; what stands between.
  [[nodiscard]] std::string between(std::string_view before, std::string_view after) {
    const std::optional<std::string> line = next();
    if (line && line->size() >= before.size() + after.size() && line->starts_with(before) && line->ends_with(after))
      return line->substr(before.size(), line->size() - before.size() - after.size());
    mark_malformed();
    return {};
  }

  // The line last read is not what it should be.
  void mark_malformed() {
    if (!problem_)
      problem_ = Error{file_.string() + ": line " + std::to_string(number_),
                       "is not as sigs writes it; make the video anew", ErrorKind::bad_data};
  }

  [[nodiscard]] Result<void> state() const { return problem_ ? Result<void>(fail(*problem_)) : Result<void>(); }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::optional<Error> problem_;
  int number_ = 0;
};

}  // namespace sigs
