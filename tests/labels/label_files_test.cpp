// SPDX-License-Identifier: MIT
#include "labels/label_files.h"

#include <doctest/doctest.h>

#include <fstream>

#include "base/staged_outputs.h"
#include "support/test_data.h"

namespace sigs::test {

namespace fs = std::filesystem;

TEST_CASE("a linked image is the same file and costs no space") {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.png") << "image";
  REQUIRE(link_or_copy(folder / "a.png", folder / "b.png").has_value());
  CHECK(fs::equivalent(folder / "a.png", folder / "b.png"));
  fs::remove(folder / "a.png");
  CHECK(*read_text(folder / "b.png") == "image");
}

TEST_CASE("on another file system an image is copied") {
  const TemporaryFolder folder;
  const fs::path there = "/dev/shm/" + folder.path().filename().string() + ".png";
  std::ofstream(there) << "image";
  if (!fs::exists(there)) {
    say_skipped("no /dev/shm");
    return;
  }
  const Result<void> copied = link_or_copy(there, folder / "b.png");
  const bool is_other = !fs::equivalent(there, folder / "b.png");
  fs::remove(there);
  REQUIRE(copied.has_value());
  if (!is_other) MESSAGE("/dev/shm is the same file system here");
  CHECK(*read_text(folder / "b.png") == "image");
}

TEST_CASE("a link takes no other file's name, and an image that is not there is an error") {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.png") << "image";
  std::ofstream(folder / "b.png") << "other";
  for (const auto& [from, to] :
       {std::pair("a.png", "b.png"), std::pair("missing.png", "c.png"), std::pair("a.png", "no/c.png")}) {
    const Result<void> linked = link_or_copy(folder / from, folder / to);
    REQUIRE_FALSE(linked.has_value());
    CHECK(linked.error().kind == ErrorKind::write_failed);
    CHECK(linked.error().where == (folder / to).string());
  }
  CHECK(*read_text(folder / "b.png") == "other");
}

}  // namespace sigs::test
