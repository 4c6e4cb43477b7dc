// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sigs::test {

// The whole text of docs/NAME. Throws where there is no such page.
[[nodiscard]] std::string page(const std::string& name);

// All pages below docs/.
[[nodiscard]] std::vector<std::filesystem::path> pages();

[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

// The contents of the page's fenced blocks in one language: ```json ... ```
[[nodiscard]] std::vector<std::string> blocks(const std::string& markdown, const std::string& language);

// The rows of all tables with this header ("| key | meaning |"), cell by cell, without backticks.
[[nodiscard]] std::vector<std::vector<std::string>> table_rows(const std::string& markdown, const std::string& header);

}  // namespace sigs::test
