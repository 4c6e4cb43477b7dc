// SPDX-License-Identifier: MIT
#include "base/partial_file.h"

#include <doctest/doctest.h>

#include <fstream>

#include "support/test_data.h"

using namespace sigs;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

int files_in(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a file that is not kept leaves nothing behind") {
  const test::TemporaryFolder folder;
  {
    const Result<PartialFile> file = PartialFile::create(folder / "x.mkv", false);
    REQUIRE(file.has_value());
    CHECK(file->part().extension() == ".mkv");
    put(file->part(), "half");
  }
  CHECK(files_in(folder.path()) == 0);
}

TEST_CASE("a file that is kept has its final name and nothing else is there") {
  const test::TemporaryFolder folder;
  Result<PartialFile> file = PartialFile::create(folder / "x.txt", false);
  REQUIRE(file.has_value());
  put(file->part(), "whole");
  CHECK_FALSE(fs::exists(folder / "x.txt"));
  REQUIRE(file->keep().has_value());
  CHECK(read_text(folder / "x.txt").value() == "whole");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("what is there already is kept unless overwriting was asked for") {
  const test::TemporaryFolder folder;
  put(folder / "x.txt", "old");
  const Result<void> refused = write_text(folder / "x.txt", "new", false);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().kind == ErrorKind::cannot_create);
  CHECK(read_text(folder / "x.txt").value() == "old");
  REQUIRE(write_text(folder / "x.txt", "new", true).has_value());
  CHECK(read_text(folder / "x.txt").value() == "new");
}

TEST_CASE("a moved file is removed once and only by its last owner") {
  const test::TemporaryFolder folder;
  Result<PartialFile> first = PartialFile::create(folder / "x.txt", false);
  REQUIRE(first.has_value());
  put(first->part(), "half");
  const fs::path part = first->part();
  {
    const PartialFile second = std::move(*first);
    CHECK(fs::exists(part));
  }
  CHECK_FALSE(fs::exists(part));
}

TEST_CASE("a folder that is not there and a file that is not there are said with their names") {
  const test::TemporaryFolder folder;
  const Result<PartialFile> file = PartialFile::create(folder / "no" / "x.txt", false);
  REQUIRE_FALSE(file.has_value());
  CHECK(file.error().kind == ErrorKind::cannot_create);
  const Result<std::string> text = read_text(folder / "no.txt");
  REQUIRE_FALSE(text.has_value());
  CHECK(text.error().kind == ErrorKind::cannot_read);
  CHECK(text.error().text().find("no.txt: no such file") != std::string::npos);
}

TEST_CASE("a full disk is an error and leaves nothing under the final name") {
  if (!fs::exists("/dev/full")) {
    std::printf("SKIPPED: there is no /dev/full\n");
    return;
  }
  const test::TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder / "x.part.txt");  // where the part of x.txt is written
  const Result<void> written = write_text(folder / "x.txt", "some text", false);
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().kind == ErrorKind::write_failed);
  CHECK_FALSE(fs::exists(folder / "x.txt"));
}

TEST_CASE("an empty file reads as empty text") {
  const test::TemporaryFolder folder;
  put(folder / "empty.txt", "");
  CHECK(read_text(folder / "empty.txt").value().empty());
}

TEST_CASE("two writers of one name never mix and the second is told so") {
  const test::TemporaryFolder folder;
  {
    const Result<PartialFile> first = PartialFile::create(folder / "x.txt", true);
    REQUIRE(first.has_value());
    const Result<PartialFile> second = PartialFile::create(folder / "x.txt", true);
    REQUIRE_FALSE(second.has_value());
    CHECK(second.error().kind == ErrorKind::cannot_create);
    CHECK(second.error().text().find("is being written by another process") != std::string::npos);
    CHECK(fs::exists(first->part()));
  }
  CHECK(PartialFile::create(folder / "x.txt", true).has_value());
}

TEST_CASE("what a killed process left behind stands in nobody's way") {
  const test::TemporaryFolder folder;
  put(folder / "x.part.txt", "half");
  Result<PartialFile> file = PartialFile::create(folder / "x.txt", false);
  REQUIRE(file.has_value());
  put(file->part(), "whole");
  REQUIRE(file->keep().has_value());
  CHECK(read_text(folder / "x.txt").value() == "whole");
  fs::create_directory(folder / "y.part");
  put(folder / "y.part/stale.png", "old");
  Result<PartialFile> pictures = PartialFile::create_folder(folder / "y", false);
  REQUIRE(pictures.has_value());
  CHECK(fs::is_empty(pictures->part()));
  REQUIRE(pictures->keep().has_value());
  CHECK(fs::is_directory(folder / "y"));
}

TEST_CASE("a file is not written over a folder of its name") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "x.mkv");
  const Result<PartialFile> file = PartialFile::create(folder / "x.mkv", true);
  REQUIRE_FALSE(file.has_value());
  CHECK(file.error().kind == ErrorKind::cannot_create);
}
