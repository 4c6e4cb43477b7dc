// SPDX-License-Identifier: MIT
#include "support/files.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "support/test_data.h"

namespace sigs::test {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  REQUIRE_MESSAGE(text.has_value(), file.string());
  return *text;
}

nlohmann::json json_of(const fs::path& file) {
  return nlohmann::json::parse(text_of(file));
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).string());
  std::sort(files.begin(), files.end());
  return files;
}

std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const std::string& file : files_below(folder)) contents[file] = text_of(folder / file);
  return contents;
}

void write_file_and_folders(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  write_file(file, text);
}

}  // namespace sigs::test
