// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include "base/input_file.h"

namespace sigs::test {

TEST_CASE("tags, comments and empty elements are distinguished") {
  CHECK(xml_depth("<?xml version=\"1.0\"?><!DOCTYPE a><a><b/><c d=\"e\"/><f></f></a>") == 2);
  CHECK(xml_depth("<a><!-- <b><c> > --><d/></a>") == 2);
  CHECK(xml_depth("<a><b><c>") == 3);
  CHECK(xml_depth("") == 0);
  CHECK(xml_depth("<") == 1);
  CHECK(xml_depth("</a></a><a>") <= 1);
}

TEST_CASE("brackets in quotes do not nest") {
  CHECK(json_depth(R"({"a": [1, "[[[", "\"[["]})") == 2);
  CHECK(json_depth("[[[") == 3);
  CHECK(json_depth("") == 0);
}

}  // namespace sigs::test
