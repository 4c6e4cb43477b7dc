// SPDX-License-Identifier: MIT
#include "editor/preview/frame_cache.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace sigs::editor;

namespace {

using Cache = FrameCache<int>;

void put(Cache& cache, FrameKey key, std::size_t bytes) {
  cache.put(key, std::make_shared<const int>(key.frame), bytes);
}

}  // namespace

TEST_CASE("what was put into a cache is found under its own state and frame alone") {
  Cache cache(100);
  put(cache, {1, 5}, 10);
  REQUIRE(cache.find({1, 5}));
  CHECK(*cache.find({1, 5}) == 5);
  CHECK(cache.find({1, 6}) == nullptr);
  CHECK(cache.find({2, 5}) == nullptr);
  CHECK(cache.bytes() == 10);
}

TEST_CASE("a full cache lets the frame go that is farthest from the playhead") {
  Cache cache(40);
  cache.set_playhead({1, 10});
  for (const int frame : {10, 7, 12, 14}) put(cache, {1, frame}, 10);
  put(cache, {1, 11}, 10);
  CHECK(cache.frames_of(1) == std::vector<int>{7, 10, 11, 12});
  put(cache, {1, 9}, 10);
  CHECK(cache.frames_of(1) == std::vector<int>{9, 10, 11, 12});
  put(cache, {1, 30}, 10);  // farther than all: it does not stay
  CHECK(cache.frames_of(1) == std::vector<int>{9, 10, 11, 12});
}

TEST_CASE("frames of other states go before any of the present one but stay while there is room") {
  Cache cache(40);
  cache.set_playhead({2, 10});
  put(cache, {1, 10}, 10);
  put(cache, {1, 11}, 10);
  put(cache, {2, 90}, 10);
  put(cache, {2, 10}, 10);
  CHECK(cache.frames_of(1).size() == 2);  // there for an undo
  put(cache, {2, 11}, 10);
  CHECK(cache.frames_of(1) == std::vector<int>{10});
  CHECK(cache.frames_of(2) == std::vector<int>{10, 11, 90});
  put(cache, {2, 12}, 10);
  CHECK(cache.frames_of(1).empty());
  CHECK(cache.frames_of(2) == std::vector<int>{10, 11, 12, 90});
}

TEST_CASE("of other states that are equally far the older one goes first") {
  Cache cache(30);
  cache.set_playhead({9, 4});
  for (const std::uint64_t state : {3, 1, 2}) put(cache, {state, 4}, 10);
  put(cache, {9, 4}, 10);
  CHECK(cache.find({1, 4}) == nullptr);
  CHECK(cache.find({2, 4}) != nullptr);
  CHECK(cache.find({3, 4}) != nullptr);
}

TEST_CASE("putting a frame again replaces it and counts it once") {
  Cache cache(100);
  put(cache, {1, 5}, 60);
  put(cache, {1, 5}, 30);
  CHECK(cache.bytes() == 30);
  CHECK(cache.would_keep({1, 5}, 100));
  CHECK_FALSE(cache.would_keep({1, 6}, 101));
}

TEST_CASE("a lower limit lets go at once what no longer fits") {
  Cache cache(40);
  cache.set_playhead({1, 10});
  for (const int frame : {10, 7, 12, 14}) put(cache, {1, frame}, 10);
  cache.set_limit(25);
  CHECK(cache.frames_of(1) == std::vector<int>{10, 12});
  CHECK(cache.bytes() == 20);
  cache.set_limit(30);
  CHECK(cache.would_keep({1, 11}, 10));
  CHECK_FALSE(cache.would_keep({1, 90}, 20));
}

TEST_CASE("one frame larger than the whole cache is not kept and a cache of nothing keeps nothing") {
  Cache cache(50);
  put(cache, {0, 1}, 51);
  CHECK(cache.bytes() == 0);
  Cache none(0);
  put(none, {0, 1}, 1);
  CHECK(none.find({0, 1}) == nullptr);
}

TEST_CASE("distances do not overflow") {
  constexpr int kMax = std::numeric_limits<int>::max();
  constexpr int kMin = std::numeric_limits<int>::min();
  Cache cache(20);
  cache.set_playhead({1, kMin});
  put(cache, {1, kMax}, 10);
  put(cache, {1, 0}, 10);
  put(cache, {1, kMin}, 10);
  CHECK(cache.frames_of(1) == std::vector<int>{kMin, 0});
}

TEST_CASE("whatever comes the memory bound holds and the frames that stay are the best by the rule") {
  std::mt19937 random(7);
  const auto any = [&random](int maximum) { return std::uniform_int_distribution<int>(0, maximum)(random); };
  Cache cache(1000);
  std::map<FrameKey, std::size_t> truth;
  FrameKey playhead{1, 50};
  // By brute force: the minimum of all, looked at one by one.
  const auto is_less = [&playhead](FrameKey a, FrameKey b) {
    const bool a_other = a.state != playhead.state, b_other = b.state != playhead.state;
    if (a_other != b_other) return a_other;
    const int a_away = std::abs(a.frame - playhead.frame), b_away = std::abs(b.frame - playhead.frame);
    return a_away != b_away ? a_away > b_away : a < b;
  };
  for (int i = 0; i < 5000; ++i) {
    if (i % 50 == 0) playhead = {static_cast<std::uint64_t>(any(4)), any(200)};
    cache.set_playhead(playhead);
    const FrameKey key{static_cast<std::uint64_t>(any(4)), any(200)};
    const auto bytes = static_cast<std::size_t>(any(120));
    const bool kept = cache.would_keep(key, bytes);
    put(cache, key, bytes);
    truth[key] = bytes;
    std::size_t sum = 0;
    for (const auto& [other, size] : truth) sum += size;
    while (sum > 1000) {
      const auto minimum = std::min_element(truth.begin(), truth.end(),
                                            [&](const auto& a, const auto& b) { return is_less(a.first, b.first); });
      sum -= minimum->second;
      truth.erase(minimum);
    }
    REQUIRE(cache.bytes() == sum);
    REQUIRE(cache.bytes() <= 1000);
    REQUIRE((cache.find(key) != nullptr) == truth.contains(key));
    REQUIRE(kept == truth.contains(key));
  }
  for (std::uint64_t state = 0; state <= 4; ++state)
    for (int frame = 0; frame <= 200; ++frame)
      CHECK((cache.find({state, frame}) != nullptr) == truth.contains(FrameKey{state, frame}));
}
