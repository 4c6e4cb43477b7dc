// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace sigs::test {

// The whole of a file, which must be there.
[[nodiscard]] std::string text_of(const std::filesystem::path& file);

// The same as JSON.
[[nodiscard]] nlohmann::json json_of(const std::filesystem::path& file);

// Every file below a folder, by its path from there, in order.
[[nodiscard]] std::vector<std::string> files_below(const std::filesystem::path& folder);

// The same with what each holds.
[[nodiscard]] std::map<std::string, std::string> contents_of(const std::filesystem::path& folder);

// Writes a file, and makes the folders that it lies in where there are none.
void write_file_and_folders(const std::filesystem::path& file, const std::string& text);

}  // namespace sigs::test
