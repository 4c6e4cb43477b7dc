// SPDX-License-Identifier: MIT
#include "base/folder_contents.h"

#include <doctest/doctest.h>

#include <fstream>

#include "support/test_data.h"

using namespace sigs;

namespace fs = std::filesystem;

TEST_CASE("what lies in a folder is listed in order of names, whatever it is") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "b" / "below");
  for (const char* const name : {"c", "a <&>", "Z"}) std::ofstream(folder / name) << "text";
  fs::create_symlink("nowhere", folder / "d");
  const Result<std::vector<fs::path>> contents = folder_contents(folder.path());
  REQUIRE(contents);
  CHECK(*contents == std::vector<fs::path>{folder / "Z", folder / "a <&>", folder / "b", folder / "c", folder / "d"});
  CHECK(folder_contents(folder / "b" / "below").value().empty());
  CHECK(is_folder(folder / "b"));
  for (const char* const name : {"c", "d", "e"}) {
    CAPTURE(name);
    CHECK_FALSE(is_folder(folder / name));
    CHECK(folder_contents(folder / name).error().kind == ErrorKind::cannot_read);
  }
}
