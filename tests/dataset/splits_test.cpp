// SPDX-License-Identifier: MIT
#include "dataset/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace sigs;

namespace {

const std::vector<SplitShare> kShares{{"train", 0.7}, {"val", 0.1}, {"test", 0.2}};

std::vector<SplitCandidate> videos(int count) {
  std::vector<SplitCandidate> list;
  for (int i = 0; i < count; ++i) list.push_back({.video = "video" + std::to_string(i)});
  return list;
}

std::map<std::string, int> counts(const std::vector<std::string>& splits) {
  std::map<std::string, int> found;
  for (const std::string& split : splits) ++found[split];
  return found;
}

std::vector<std::string> shared_out(const std::vector<SplitCandidate>& candidates, std::uint64_t seed = 0) {
  const Result<std::vector<std::string>> splits = splits_of(candidates, kShares, seed);
  REQUIRE(splits);
  return *splits;
}

// Hamilton's method, written the textbook way: whole parts first, the rest by the largest remainders.
std::map<std::string, int> largest_remainders(const std::vector<SplitShare>& shares, int videos) {
  std::map<std::string, int> seats;
  std::vector<std::pair<double, std::string>> rests;
  int given = 0;
  for (const SplitShare& share : shares) {
    const double quota = share.share * videos;
    seats[share.name] = static_cast<int>(std::floor(quota));
    given += seats[share.name];
    rests.emplace_back(quota - std::floor(quota), share.name);
  }
  std::stable_sort(rests.begin(), rests.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; given < videos; ++i, ++given) ++seats[rests[i].second];
  return seats;
}

}  // namespace

TEST_CASE("single videos are divided by the largest-remainder method") {
  const std::vector<SplitShare> shares{{"train", 0.61}, {"val", 0.13}, {"test", 0.26}};
  for (int count = 0; count < 120; ++count) {
    const Result<std::vector<std::string>> splits = splits_of(videos(count), shares, 3);
    REQUIRE(splits);
    std::map<std::string, int> wanted = largest_remainders(shares, count);
    std::erase_if(wanted, [](const auto& seat) { return seat.second == 0; });
    CHECK(counts(*splits) == wanted);
  }
}

TEST_CASE("splits depend on names and seed, not on the order of videos") {
  std::vector<SplitCandidate> list = videos(40);
  const std::vector<std::string> splits = shared_out(list);
  std::map<std::string, std::string> by_name;
  for (std::size_t i = 0; i < list.size(); ++i) by_name[list[i].video] = splits[i];
  std::reverse(list.begin(), list.end());
  const std::vector<std::string> again = shared_out(list);
  for (std::size_t i = 0; i < list.size(); ++i) CHECK(again[i] == by_name[list[i].video]);
  CHECK(shared_out(videos(40), 1) != splits);
}

TEST_CASE("splits mix videos: neighbours in the recipe are not kept together") {
  const std::vector<std::string> splits = shared_out(videos(100));
  int changes = 0;
  for (std::size_t i = 1; i < splits.size(); ++i) changes += splits[i] != splits[i - 1] ? 1 : 0;
  // With shares .7 .1 .2 neighbours differ in 46 % of cases; 30 is more than 3 sigma below.
  CHECK(changes > 30);
}

TEST_CASE("videos of one unit share a split, and no split lacks more than one unit of its share") {
  std::vector<SplitCandidate> list = videos(200);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].unit = "background" + std::to_string(i % 20);
  const std::vector<std::string> splits = shared_out(list);
  std::map<std::string, std::set<std::string>> of_unit;
  for (std::size_t i = 0; i < list.size(); ++i) of_unit[list[i].unit].insert(splits[i]);
  for (const auto& entry : of_unit) CHECK_MESSAGE(entry.second.size() == 1, entry.first);
  const std::map<std::string, int> found = counts(splits);
  CHECK(found.at("train") == 140);
  CHECK(found.at("val") == 20);
  CHECK(found.at("test") == 40);
}

TEST_CASE("large units are placed first, so that small ones balance the shares") {
  std::vector<SplitCandidate> list = videos(10);
  for (std::size_t i = 0; i < 6; ++i) list[i].unit = "large";
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    CHECK(counts(*splits_of(list, std::vector<SplitShare>{{"train", 0.6}, {"test", 0.4}}, seed)) ==
          std::map<std::string, int>{{"train", 6}, {"test", 4}});
}

TEST_CASE("three backgrounds kept together make three splits") {
  std::vector<SplitCandidate> list = videos(24);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].unit = std::to_string(i % 3);
  CHECK(counts(*splits_of(list, std::vector<SplitShare>{{"train", 0.34}, {"val", 0.33}, {"test", 0.33}}, 0)) ==
        std::map<std::string, int>{{"train", 8}, {"val", 8}, {"test", 8}});
}

TEST_CASE("a fixed split is kept and applies to its whole unit") {
  std::vector<SplitCandidate> list = videos(30);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].unit = "unit" + std::to_string(i % 3);
  list[4].fixed = "test";  // unit1
  const std::vector<std::string> splits = shared_out(list);
  for (std::size_t i = 1; i < list.size(); i += 3) CHECK(splits[i] == "test");
}

TEST_CASE("fixed videos do not count towards the shares of the others") {
  std::vector<SplitCandidate> list = videos(20);
  for (std::size_t i = 0; i < 10; ++i) list[i].fixed = "test";
  CHECK(counts(shared_out(list)) == std::map<std::string, int>{{"train", 7}, {"val", 1}, {"test", 12}});
}

TEST_CASE("one unit in two fixed splits is an error that names all three") {
  std::vector<SplitCandidate> list = videos(2);
  list[0] = {"a", "train", "clouds"};
  list[1] = {"b", "test", "clouds"};
  const Result<std::vector<std::string>> splits = splits_of(list, kShares, 0);
  REQUIRE(!splits);
  CHECK(splits.error().what == "\"clouds\" is in train and in test, but keep_together keeps it in one split");
}

TEST_CASE("without shares only fixed videos have a split") {
  std::vector<SplitCandidate> list = videos(3);
  list[1].fixed = "mine";
  const Result<std::vector<std::string>> splits = splits_of(list, {}, 0);
  REQUIRE(splits);
  CHECK(*splits == std::vector<std::string>{"", "mine", ""});
}

TEST_CASE("a split with no share gets nothing") {
  const Result<std::vector<std::string>> splits =
      splits_of(videos(50), std::vector<SplitShare>{{"none", 0}, {"all", 1}}, 0);
  REQUIRE(splits);
  CHECK(counts(*splits) == std::map<std::string, int>{{"all", 50}});
}
