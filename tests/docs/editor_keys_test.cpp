// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <regex>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "docs/markdown.h"
#include "support/test_data.h"

namespace sigs::test {

// The source is read rather than linked: these tests need no window.
TEST_CASE("the editor's page has the keys that the program has, in its order") {
  const std::string source = *read_text(source_dir() / "editor/app/shortcuts.cpp");
  const std::size_t begin = source.find("kShortcuts{{");
  REQUIRE(begin != std::string::npos);
  const std::string table = source.substr(begin, source.find("}};", begin) - begin);
  const std::regex row("\\{\"([^\"]*)\",\\s*\"([^\"]*)\",\\s*\"([^\"]*)\"\\}");
  std::vector<std::vector<std::string>> in_program;
  for (std::sregex_iterator it(table.begin(), table.end(), row), end; it != end; ++it)
    in_program.push_back({(*it)[1], (*it)[2], (*it)[3]});
  REQUIRE(in_program.size() > 20);
  CHECK(table_rows(page("editor.md"), "| for | keys | what |") == in_program);
}

}  // namespace sigs::test
