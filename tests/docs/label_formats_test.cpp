// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
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

// Whether a sentence names it, as a word of its own.
bool names(const std::string& sentence, const LabelFormat& format) {
  return std::regex_search(sentence, std::regex("\\b" + std::string(format.name) + "\\b"));
}

// A page's text from these words on, up to the next full stop or the end of the cell.
std::string sentence_from(const std::string& page_name, const std::string& words) {
  const std::string text = page(page_name);
  const std::size_t begin = text.find(words);
  REQUIRE_MESSAGE(begin != std::string::npos, "docs/" << page_name << ": " << words);
  return text.substr(begin, std::min(text.find(". ", begin), text.find(" |", begin)) - begin);
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

TEST_CASE("a format's row says what is written, what is left out and whether the own body is in it, as the code does") {
  for (const Row& row : rows()) {
    const LabelFormat* const format = label_format(row.at(0));
    REQUIRE_MESSAGE(format != nullptr, row.at(0));
    CHECK_MESSAGE(row.at(1) == output_of(*format), row.at(0));
    CHECK_MESSAGE((row.at(7) != "nothing") == format->has_thresholds, row.at(0));
    CHECK_MESSAGE(row.at(6).empty() != format->has_ignored_regions, row.at(0) << ", own body");
  }
}

TEST_CASE("pages name the formats with regions to ignore, and those whose boxes are widened, as the code does") {
  const std::string widened = sentence_from("label-formats.md", "widen the boxes of");
  const std::string ignored = sentence_from("label-formats.md", "coco has them as crowd regions");
  const std::string in_recipes = sentence_from("dataset-recipe.md", "regions to ignore in");
  for (const LabelFormat& format : label_formats()) {
    CHECK_MESSAGE(names(widened, format) == format.widens_boxes, format.name << ": " << widened);
    CHECK_MESSAGE(names(ignored, format) == format.has_ignored_regions, format.name << ": " << ignored);
    CHECK_MESSAGE(names(in_recipes, format) == format.has_ignored_regions, format.name << ": " << in_recipes);
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
