// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/text.h"
#include "docs/markdown.h"
#include "labels/labels.h"

namespace sigs::test {
namespace {

using Row = std::vector<std::string>;

const char* const kTableHeader =
    "| format | written | frames counted | pixel convention of boxes | track ids | class numbers | own body | left out "
    "|";

std::vector<Row> rows() {
  return table_rows(page("label-formats.md"), kTableHeader);
}

// What its row has in the column "written".
std::string output_of(const LabelFormat& format) {
  return std::string("NAME").append(format.suffix).append(format.is_folder ? "/" : "");
}

}  // namespace

TEST_CASE("the label formats' page has a row for every format, in the program's order") {
  std::vector<std::string> on_page;
  for (const Row& row : rows()) on_page.push_back(row.at(0));
  std::vector<std::string> in_code;
  for (const LabelFormat& format : label_formats()) in_code.emplace_back(format.name);
  CHECK_MESSAGE(on_page == in_code, "the page has " << listed(on_page) << "; the code " << listed(in_code));
}

TEST_CASE("a format's row says what is written and whether thresholds leave something out, as the code does") {
  for (const Row& row : rows()) {
    const LabelFormat* const format = label_format(row.at(0));
    REQUIRE_MESSAGE(format != nullptr, row.at(0));
    CHECK_MESSAGE(row.at(1) == output_of(*format), row.at(0));
    CHECK_MESSAGE((row.at(7) != "nothing") == format->has_thresholds, row.at(0));
  }
}

TEST_CASE("the label formats' page has a section on every format") {
  const std::vector<std::string> lines = lines_of(page("label-formats.md"));
  for (const LabelFormat& format : label_formats())
    CHECK_MESSAGE(std::count(lines.begin(), lines.end(), std::string("## ").append(format.name)) == 1,
                  "## " << format.name);
}

TEST_CASE("the datasets' page says of every format how it is merged over videos, or that it is not") {
  const std::string text = page("dataset.md");
  std::set<std::string> named;
  for (const Row& row : table_rows(text, "| format | in `labels/` | how it is merged |")) named.insert(row.at(0));
  const std::string begin = "in the table (";
  const std::size_t first = text.find(begin);
  REQUIRE(first != std::string::npos);
  std::string rest = text.substr(first + begin.size());
  rest.erase(rest.find(')'));
  for (const LabelFormat& format : label_formats())
    CHECK_MESSAGE(named.contains(std::string(format.name)) != (rest.find(format.name) != std::string::npos),
                  format.name << " in docs/dataset.md");
}

}  // namespace sigs::test
