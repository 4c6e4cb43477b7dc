// SPDX-License-Identifier: MIT
#include "docs/markdown.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "base/staged_outputs.h"
#include "support/test_data.h"

namespace sigs::test {

namespace fs = std::filesystem;

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    cell.erase(std::remove(cell.begin(), cell.end(), '`'), cell.end());
    cells.push_back(trimmed(cell));
  }
  return cells;
}

}  // namespace

std::string page(const std::string& name) {
  const Result<std::string> text = read_text(source_dir() / "docs" / name);
  if (!text) throw std::runtime_error(text.error().text());
  return *text;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> blocks(const std::string& markdown, const std::string& language) {
  std::vector<std::string> found;
  bool inside = false;
  for (const std::string& line : lines_of(markdown)) {
    if (!inside && line == "```" + language) {
      found.emplace_back();
      inside = true;
    } else if (inside && line == "```") {
      inside = false;
    } else if (inside) {
      found.back() += line + "\n";
    }
  }
  return found;
}

std::vector<std::vector<std::string>> table_rows(const std::string& markdown, const std::string& header) {
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (const std::string& line : lines_of(markdown)) {
    if (line == header)
      inside = true;
    else if (!line.starts_with("|"))
      inside = false;
    else if (inside && !line.starts_with("|--") && !line.starts_with("|:-"))
      rows.push_back(cells_of(line));
  }
  return rows;
}

}  // namespace sigs::test
