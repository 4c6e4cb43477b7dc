// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "base/json.h"
#include "base/result.h"

namespace sigs {

// Reads fields of one JSON file of another program. The first that is wrong is the file's error, so that callers need
// not check each of them.
class JsonFields {
 public:
  explicit JsonFields(std::filesystem::path path) : path_(std::move(path)) {}

  // The whole document. Errors: cannot_read; bad_data (no JSON, nested too deeply).
  [[nodiscard]] Result<Json> document() const;

  // The place that is read from here on, for messages: "annotations[3]".
  void enter(std::string place) { place_ = std::move(place); }

  // The object's value of this key; null where there is none, or it is null, or `object` is no object.
  [[nodiscard]] static const Json* field(const Json& object, const char* key);

  // Values that must be there: text; a number of a magnitude up to 1e9; a whole one; a list of four such numbers. What
  // is returned where it is not so has no meaning.
  [[nodiscard]] std::string text(const Json& object, const char* key);
  [[nodiscard]] double number(const Json& object, const char* key);
  [[nodiscard]] int whole(const Json& object, const char* key);
  [[nodiscard]] std::array<double, 4> four_numbers(const Json& object, const char* key);

  // The same of values that need not be there.
  [[nodiscard]] std::optional<double> optional_number(const Json& object, const char* key);
  [[nodiscard]] std::optional<int> optional_whole(const Json& object, const char* key);

  // Keeps "PLACE.KEY WHAT" as the error where there is none yet.
  void wrong(const char* key, const std::string& what);

  [[nodiscard]] bool is_wrong() const { return !error_.empty(); }
  [[nodiscard]] tl::unexpected<Error> failure() const { return fail(path_.string(), error_); }
  [[nodiscard]] tl::unexpected<Error> failure(const std::string& what) const { return fail(path_.string(), what); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::string place_;
  std::string error_;
};

}  // namespace sigs
