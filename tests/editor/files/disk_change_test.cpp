// SPDX-License-Identifier: MIT
#include "editor/app/project_loader.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <string>

#include "support/test_data.h"

using sigs::editor::DiskChange;
using sigs::test::TemporaryFolder;

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

}  // namespace

TEST_CASE("a file of the same size and time has not changed") {
  const TemporaryFolder folder;
  write(folder / "p.json", "one");
  DiskChange change;
  CHECK_FALSE(change.changed());
  change.remember(folder / "p.json");
  CHECK_FALSE(change.changed());
}

TEST_CASE("another size or time is a change by another program") {
  const TemporaryFolder folder;
  const auto path = folder / "p.json";
  write(path, "one");
  DiskChange change;
  change.remember(path);
  const auto time = std::filesystem::last_write_time(path);
  write(path, "longer");
  std::filesystem::last_write_time(path, time);
  CHECK_MESSAGE(change.changed(), "the size alone");
  change.remember(path);
  CHECK_FALSE(change.changed());
  std::filesystem::last_write_time(path, time + std::chrono::seconds(3));
  CHECK_MESSAGE(change.changed(), "the time alone");
}

TEST_CASE("a removed file can be saved again; one that appeared meanwhile cannot be replaced") {
  const TemporaryFolder folder;
  const auto path = folder / "p.json";
  write(path, "one");
  DiskChange change;
  change.remember(path);
  std::filesystem::remove(path);
  CHECK_FALSE(change.changed());
  change.remember(path);
  write(path, "one");
  CHECK(change.changed());
}
