// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "project/json_reading.h"

namespace sigs {

// What is wrong with a recipe while it is read: the first error, and every warning.
struct RecipeLog {
  std::string file;
  std::optional<Error> error;
  std::vector<Warning> warnings;

  void wrong(const std::string& key, const std::string& what, ErrorKind kind = ErrorKind::bad_data);
  void warn(const std::string& key, const std::string& what);
};

// One { ... } of a recipe, read key by key. What is not as it should be goes to the log, and reading goes on with
// something harmless; the caller looks at the log in the end. Json and log must outlive it.
class RecipeNode {
 public:
  RecipeNode(const Json& json, std::string key, RecipeLog& log);

  [[nodiscard]] std::string key_of(std::string_view name) const;  // "videos[0].name"
  [[nodiscard]] RecipeLog& log() const { return *log_; }

  // The value as it stands; null where there is none. Each call marks its key as known.
  [[nodiscard]] const Json* value(std::string_view name);

  [[nodiscard]] std::optional<std::string> text(std::string_view name);
  [[nodiscard]] std::string needed_text(std::string_view name);  // not empty
  [[nodiscard]] std::optional<int> whole(std::string_view name, int low, int high);
  [[nodiscard]] std::vector<std::string> texts(std::string_view name);  // empty where there is none
  [[nodiscard]] std::map<std::string, std::string> text_map(std::string_view name);
  [[nodiscard]] std::vector<RecipeNode> nodes(std::string_view name);  // a list that may not be empty

  // Once all keys that there may be are read: warns of the others. "about" is for the reader alone, anywhere.
  void done();

 private:
  const Json* json_;
  std::string key_;
  RecipeLog* log_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace sigs
