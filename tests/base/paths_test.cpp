// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <fstream>

#include "base/paths.h"
#include "support/test_data.h"

using namespace sigs;

namespace fs = std::filesystem;

TEST_CASE("the contents of a folder are listed in order of names, whatever their type") {
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

TEST_CASE("an input is recognized under any of its names, and other files are not taken for inputs") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "out/deep");
  std::ofstream(folder / "out/deep/input") << "x";
  std::ofstream(folder / "outside") << "x";
  fs::create_symlink(folder / "out/deep/input", folder / "link");
  fs::create_hard_link(folder / "out/deep/input", folder / "second");
  fs::create_directory_symlink(folder / "out", folder / "out-link");
  fs::create_symlink(folder / "outside", folder / "out/link-in");
  const auto is_kept = [&](const fs::path& output, const fs::path& input) {
    return check_inputs_not_overwritten({folder / output}, {folder / input}).has_value();
  };
  for (const char* const input :
       {"out/deep/input", "link", "second", "out-link/deep/input", "out/../link", "out/link-in"})
    for (const char* const output : {"out", "out/", "out-link", "out/deep/.."}) CHECK_FALSE(is_kept(output, input));
  CHECK_FALSE(is_kept("out/deep/input", "second"));
  CHECK_FALSE(is_kept("second", "link"));
  CHECK_FALSE(is_kept("outside", "out/link-in"));
  CHECK(is_kept("outside", "link"));
  CHECK(is_kept("out", ""));
  CHECK(is_kept("out", "none"));
  CHECK(is_kept("none", "outside"));
  CHECK(is_kept("out-lin", "out-link/deep/input"));
}

TEST_CASE("names that cannot be file names are recognized") {
  for (const std::string& name :
       {std::string("a"), std::string("flight 7"), std::string("\xc3\xa4"), std::string(200, 'n')})
    CHECK(file_name_error(name).empty());
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string(".a"), std::string("a/b"),
        std::string("a\0b", 3), std::string("a\nb"), std::string("a\x7f"), std::string(201, 'n')})
    CHECK_FALSE(file_name_error(name).empty());
}
