// SPDX-License-Identifier: MIT
#include "editor/preview/frame_cache.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace sigs::editor;

namespace {

using Cache = FrameCache<int>;

ContentId content(std::uint64_t number) {
  return {.low = number};
}

FrameKey key(std::uint64_t number, int frame) {
  return {content(number), frame};
}

void put(Cache& cache, FrameKey key, std::size_t bytes) {
  cache.put(key, std::make_shared<const int>(key.frame), bytes);
}

}  // namespace

TEST_CASE("a cached image is found under its own content and frame alone") {
  Cache cache(100);
  put(cache, key(1, 5), 10);
  REQUIRE(cache.find(key(1, 5)));
  CHECK(*cache.find(key(1, 5)) == 5);
  CHECK(cache.find(key(1, 6)) == nullptr);
  CHECK(cache.find(key(2, 5)) == nullptr);
  CHECK(cache.bytes() == 10);
}

TEST_CASE("a full cache evicts the frame farthest from the playhead") {
  Cache cache(40);
  cache.set_playhead(key(1, 10));
  for (const int frame : {10, 7, 12, 14}) put(cache, key(1, frame), 10);
  put(cache, key(1, 11), 10);
  CHECK(cache.frames_of(content(1)) == std::vector<int>{7, 10, 11, 12});
  put(cache, key(1, 9), 10);
  CHECK(cache.frames_of(content(1)) == std::vector<int>{9, 10, 11, 12});
  put(cache, key(1, 30), 10);  // farther than all: it does not stay
  CHECK(cache.frames_of(content(1)) == std::vector<int>{9, 10, 11, 12});
}

TEST_CASE("frames of other contents are evicted before those of the current one, and only from a full cache") {
  Cache cache(40);
  cache.set_playhead(key(2, 10));
  put(cache, key(1, 10), 10);
  put(cache, key(1, 11), 10);
  put(cache, key(2, 90), 10);
  put(cache, key(2, 10), 10);
  CHECK(cache.frames_of(content(1)).size() == 2);  // there for an undo
  put(cache, key(2, 11), 10);
  CHECK(cache.frames_of(content(1)) == std::vector<int>{10});
  CHECK(cache.frames_of(content(2)) == std::vector<int>{10, 11, 90});
  put(cache, key(2, 12), 10);
  CHECK(cache.frames_of(content(1)).empty());
  CHECK(cache.frames_of(content(2)) == std::vector<int>{10, 11, 12, 90});
}

TEST_CASE("of other contents that are equally far the oldest is evicted first") {
  Cache cache(30);
  cache.set_playhead(key(9, 4));
  for (const std::uint64_t number : {3, 1, 2}) put(cache, key(number, 4), 10);
  put(cache, key(9, 4), 10);
  CHECK(cache.find(key(3, 4)) == nullptr);
  CHECK(cache.find(key(1, 4)) != nullptr);
  CHECK(cache.find(key(2, 4)) != nullptr);
}

TEST_CASE("putting a frame again replaces it and counts it once") {
  Cache cache(100);
  put(cache, key(1, 5), 60);
  put(cache, key(1, 5), 30);
  CHECK(cache.bytes() == 30);
  CHECK(cache.would_keep(key(1, 5), 100));
  CHECK_FALSE(cache.would_keep(key(1, 6), 101));
}

TEST_CASE("a lower limit evicts at once what no longer fits") {
  Cache cache(40);
  cache.set_playhead(key(1, 10));
  for (const int frame : {10, 7, 12, 14}) put(cache, key(1, frame), 10);
  cache.set_limit(25);
  CHECK(cache.frames_of(content(1)) == std::vector<int>{10, 12});
  CHECK(cache.bytes() == 20);
  cache.set_limit(30);
  CHECK(cache.would_keep(key(1, 11), 10));
  CHECK_FALSE(cache.would_keep(key(1, 90), 20));
}

TEST_CASE("one frame larger than the whole cache is not kept and a cache of nothing keeps nothing") {
  Cache cache(50);
  put(cache, key(0, 1), 51);
  CHECK(cache.bytes() == 0);
  Cache none(0);
  put(none, key(0, 1), 1);
  CHECK(none.find(key(0, 1)) == nullptr);
}

TEST_CASE("distances do not overflow") {
  constexpr int kMax = std::numeric_limits<int>::max();
  constexpr int kMin = std::numeric_limits<int>::min();
  Cache cache(20);
  cache.set_playhead(key(1, kMin));
  put(cache, key(1, kMax), 10);
  put(cache, key(1, 0), 10);
  put(cache, key(1, kMin), 10);
  CHECK(cache.frames_of(content(1)) == std::vector<int>{kMin, 0});
}

TEST_CASE("after any sequence of calls the memory limit holds and the rule's best frames are kept") {
  std::mt19937 random(7);
  const auto any = [&random](int maximum) { return std::uniform_int_distribution<int>(0, maximum)(random); };
  Cache cache(1000);
  std::map<FrameKey, std::size_t> truth;
  std::map<ContentId, int> came;  // since when there are frames of a content
  FrameKey playhead = key(1, 50);
  // By brute force: the minimum of all.
  const auto is_less = [&](FrameKey a, FrameKey b) {
    const bool a_other = a.content != playhead.content, b_other = b.content != playhead.content;
    if (a_other != b_other) return a_other;
    const int a_away = std::abs(a.frame - playhead.frame), b_away = std::abs(b.frame - playhead.frame);
    if (a_away != b_away) return a_away > b_away;
    return a.content != b.content ? came[a.content] < came[b.content] : a.frame < b.frame;
  };
  const auto any_key = [&any] { return key(static_cast<std::uint64_t>(any(4)), any(200)); };
  for (int i = 0; i < 5000; ++i) {
    if (i % 50 == 0) playhead = any_key();
    cache.set_playhead(playhead);
    const FrameKey added = any_key();
    const auto bytes = static_cast<std::size_t>(any(120));
    const bool kept = cache.would_keep(added, bytes);
    put(cache, added, bytes);
    const bool is_known = std::any_of(truth.begin(), truth.end(),
                                      [&](const auto& entry) { return entry.first.content == added.content; });
    if (!is_known) came[added.content] = i;
    truth[added] = bytes;
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
    REQUIRE((cache.find(added) != nullptr) == truth.contains(added));
    REQUIRE(kept == truth.contains(added));
  }
  for (std::uint64_t number = 0; number <= 4; ++number)
    for (int frame = 0; frame <= 200; ++frame)
      CHECK((cache.find(key(number, frame)) != nullptr) == truth.contains(key(number, frame)));
}
