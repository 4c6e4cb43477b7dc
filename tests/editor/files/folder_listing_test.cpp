// SPDX-License-Identifier: MIT
#include "editor/widgets/file_browser.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "support/test_data.h"

using namespace sigs::editor;
using sigs::test::TemporaryFolder;

namespace {

std::string names_of(const std::vector<FolderEntry>& entries) {
  std::string text;
  for (const FolderEntry& entry : entries) text += entry.name + " ";
  return text;
}

}  // namespace

TEST_CASE("folders come first, numbers count as numbers, hidden files are left out") {
  const FolderListing listing{.folder = "/x",
                              .entries = {{"clip 10.mp4", false, 5, {}},
                                          {"Clip 9.MP4", false, 7, {}},
                                          {"zebra", true, 0, {}},
                                          {".hidden", false, 1, {}},
                                          {"notes.txt", false, 6, {}}}};
  CHECK(names_of(shown_entries(listing, {".mp4"}, {})) == "zebra Clip 9.MP4 clip 10.mp4 ");
  CHECK(names_of(shown_entries(listing, {}, {SortBy::size, true})) == "zebra Clip 9.MP4 notes.txt clip 10.mp4 ");
  CHECK(names_of(shown_entries(listing, {".mp4"}, {SortBy::name, true})) == "zebra clip 10.mp4 Clip 9.MP4 ");
}

TEST_CASE("natural order is a total order") {
  const std::vector<std::string> names{"", "0", "00", "1", "a", "A", "a1", "a01", "a2", "a10", "a10b", "b", "\xC3\xA4"};
  for (const std::string& a : names)
    for (const std::string& b : names) {
      CHECK(natural_order(a, b) == -natural_order(b, a));
      CHECK((natural_order(a, b) == 0) == (a == b));
      for (const std::string& c : names)
        if (natural_order(a, b) < 0 && natural_order(b, c) < 0) CHECK(natural_order(a, c) < 0);
    }
}

TEST_CASE("sizes are written in B, KB, MB and so on") {
  CHECK(size_text(0) == "0 B");
  CHECK(size_text(999) == "999 B");
  CHECK(size_text(1400) == "1.4 KB");
  CHECK(size_text(999'960) == "1.0 MB");
  CHECK(size_text(250'000'000) == "250 MB");
  CHECK(size_text(~std::uintmax_t{0}) == "18.4 EB");
}

TEST_CASE("a folder is read with sizes and times, and an unreadable one says why") {
  const TemporaryFolder folder;
  std::ofstream(folder / "five") << "12345";
  std::filesystem::create_directory(folder / "inner");
  std::filesystem::create_symlink("nowhere", folder / "dangling");
  FolderReader reader;
  reader.read(folder.path());
  for (int i = 0; i < 500 && reader.is_reading(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::vector<FolderEntry> entries = shown_entries(reader.listing(), {}, {});
  REQUIRE(entries.size() == 3);
  CHECK(entries[0].is_folder);
  CHECK(entries[1].name == "dangling");
  CHECK(entries[2].bytes == 5);
  CHECK(time_text(entries[2].changed).size() == 16);
  CHECK(time_text({}).empty());
  CHECK_FALSE(listing_of(folder / "nowhere").problem.empty());
  CHECK_FALSE(listing_of(folder / "five").problem.empty());
}
