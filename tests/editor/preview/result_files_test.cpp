// SPDX-License-Identifier: MIT
#include "editor/preview/scoring.h"

#include <doctest/doctest.h>

#include <set>

using namespace sigs::editor;

TEST_CASE("each file that is loaded has a colour and a number of its own") {
  ResultFiles results;
  for (const char* const path : {"/a/one.csv", "/a/two.csv", "/b/one.csv"}) results.add(path);
  REQUIRE(results.files().size() == 3);
  std::set<int> ids;
  for (int i = 0; i < 3; ++i) {
    const ResultFile& file = results.files()[static_cast<std::size_t>(i)];
    CHECK(file.color == i);
    CHECK(file.is_shown);
    ids.insert(file.id);
  }
  CHECK(ids.size() == 3);
  CHECK_FALSE(ids.contains(0));
}

TEST_CASE("a colour that became free is given to the next, the others keep theirs") {
  ResultFiles results;
  for (const char* const path : {"/a", "/b", "/c"}) results.add(path);
  const int removed = results.files()[1].id;
  results.remove(removed);
  results.remove(4711);
  REQUIRE(results.files().size() == 2);
  CHECK(results.files()[1].color == 2);
  results.add("/d");
  CHECK(results.files()[2].color == 1);
  CHECK(results.files()[2].id != removed);
}

TEST_CASE("a file that is loaded again stays one and is shown, however its path is written") {
  ResultFiles results;
  results.add("/a/b/kcf.csv");
  results.set_shown(results.files()[0].id, false);
  CHECK_FALSE(results.files()[0].is_shown);
  results.add("/a/x/../b/./kcf.csv");
  REQUIRE(results.files().size() == 1);
  CHECK(results.files()[0].is_shown);
  results.clear();
  CHECK(results.files().empty());
}

TEST_CASE("a path from where the program was started is found from anywhere") {
  ResultFiles results;
  results.add("kcf.csv");
  CHECK(results.files()[0].path == std::filesystem::absolute("kcf.csv"));
}
