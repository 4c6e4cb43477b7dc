// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/test_data.h"

namespace fs = std::filesystem;

namespace {

using Graph = std::map<std::string, std::vector<std::string>>;  // header -> headers of ours that it includes

// Headers of the engine as "camera/lens.h", of the editor as "editor/app/app.h".
Graph include_graph() {
  Graph graph;
  const fs::path root = sigs::test::source_dir();
  for (const auto& [folder, prefix] : {std::pair{"engine", ""}, std::pair{"editor", "editor/"}})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h") continue;
      std::vector<std::string>& included =
          graph[prefix + entry.path().lexically_relative(root / folder).generic_string()];
      std::ifstream in(entry.path());
      const std::string begin = "#include \"";
      for (std::string line; std::getline(in, line);)
        if (line.starts_with(begin)) included.push_back(line.substr(begin.size(), line.rfind('"') - begin.size()));
    }
  return graph;
}

// The first cycle that is found from `header` on, as text; empty if there is none.
std::string circle_from(const std::string& header, const Graph& graph, std::vector<std::string>& way,
                        std::set<std::string>& cleared) {
  if (cleared.contains(header)) return {};
  for (std::size_t i = 0; i < way.size(); ++i)
    if (way[i] == header) {
      std::string text;
      for (std::size_t j = i; j < way.size(); ++j) text += way[j] + " -> ";
      return text + header;
    }
  const auto found = graph.find(header);
  if (found == graph.end()) return {};
  way.push_back(header);
  for (const std::string& next : found->second)
    if (std::string text = circle_from(next, graph, way, cleared); !text.empty()) return text;
  way.pop_back();
  cleared.insert(header);
  return {};
}

std::string first_circle(const Graph& graph) {
  std::set<std::string> cleared;
  for (const auto& [header, included] : graph) {
    std::vector<std::string> way;
    if (std::string text = circle_from(header, graph, way, cleared); !text.empty()) return text;
  }
  return {};
}

}  // namespace

TEST_CASE("no header includes what includes it") {
  const Graph graph = include_graph();
  REQUIRE(graph.size() > 200);
  CHECK(first_circle(graph) == "");
}

TEST_CASE("the check itself finds a cycle") {
  CHECK(first_circle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"a"}}}) == "a -> b -> c -> a");
  CHECK(first_circle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {}}}) == "");
}

TEST_CASE("no file of the engine, the editor or the program has more than 400 lines") {
  for (const char* const folder : {"engine", "editor", "cli"})
    for (const auto& entry : fs::recursive_directory_iterator(sigs::test::source_dir() / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      int lines = 0;
      for (std::string line; std::getline(in, line);) ++lines;
      CHECK_MESSAGE(lines <= 400, entry.path());
    }
}
