// SPDX-License-Identifier: MIT
#include "base/numbered_files.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "support/test_data.h"

namespace sigs::test {

TEST_CASE("a pattern gives the names that printf gives, and takes back no others") {
  for (const char* const text : {"img_%06d.png", "%d.tiff", "a%03d_left.jpg", "%%_%02d%%.png"}) {
    const std::optional<NumberPattern> pattern = number_pattern_of(std::filesystem::path("folder%d") / text);
    REQUIRE_MESSAGE(pattern, text);
    for (const int number : {0, 7, 42, 123456, 2147483647}) {
      char name[64];
      std::snprintf(name, sizeof name, text, number);
      CHECK(pattern->name_of(number) == name);
      CHECK(pattern->number_in(name) == number);
    }
  }
  const NumberPattern pattern = number_pattern_of("img_%04d.png").value();
  for (const char* const name : {"img_123.png", "img_00123.png", "img_.png", "img_12a4.png", "img_-123.png",
                                 "img_0123.jpg", "x_0123.png", "img_99999999999999999999.png"})
    CHECK_MESSAGE(!pattern.number_in(name), name);
}

TEST_CASE("names without exactly one place for a number are no patterns") {
  for (const char* const name :
       {"clip.mkv", "%d_%d.png", "%5d.png", "%s.png", "%00d.png", "%019d.png", "100%.png", "%", "%%d.png", "a%06.png"})
    CHECK_MESSAGE(!number_pattern_of(name), name);
}

TEST_CASE("the files of a pattern come by number from the lowest one") {
  const TemporaryFolder folder;
  for (const int number : {12, 9, 10, 11}) write_file(folder / ("f" + std::to_string(number) + ".png"), "");
  write_file(folder / "f13.jpg", "");
  const auto files = files_of_pattern(folder / "f%d.png").value();
  REQUIRE(files.size() == 4);
  CHECK(files.front() == folder / "f9.png");
  CHECK(files.back() == folder / "f12.png");
}

TEST_CASE("a missing number is named") {
  const TemporaryFolder folder;
  for (const char* const name : {"f_0003.png", "f_0004.png", "f_0006.png", "f_0009.png"}) write_file(folder / name, "");
  const auto files = files_of_pattern(folder / "f_%04d.png");
  REQUIRE_FALSE(files);
  CHECK(files.error().kind == ErrorKind::bad_data);
  CHECK(files.error().text().find("f_0005.png is missing") != std::string::npos);
  const auto none = files_of_pattern(folder / "g_%04d.png");
  REQUIRE_FALSE(none);
  CHECK(none.error().kind == ErrorKind::cannot_read);
}

TEST_CASE("names are in the order in which people count, and that is an order") {
  const std::vector<std::string> ordered{"",
                                         "1.png",
                                         "01.png",
                                         "2.png",
                                         "2a.png",
                                         "10.png",
                                         "010.png",
                                         "a",
                                         "a1b2",
                                         "a1b10",
                                         "a02b1",
                                         "a2b1",
                                         "a10",
                                         "a99999999999999999999999",
                                         "a100000000000000000000000",
                                         "b"};
  std::vector<std::string> sorted = ordered;
  for (int round = 0; round < 20; ++round) {
    std::next_permutation(sorted.begin(), sorted.end());
    std::reverse(sorted.begin() + round % 7, sorted.end());
    std::vector<std::string> again = sorted;
    std::sort(again.begin(), again.end(), [](const auto& a, const auto& b) { return natural_less(a, b); });
    std::vector<std::string> expected = ordered;
    // Of equal numbers those with zeros come first, as bytes.
    std::swap(expected[1], expected[2]);
    std::swap(expected[5], expected[6]);
    CHECK(again == expected);
  }
}

}  // namespace sigs::test
