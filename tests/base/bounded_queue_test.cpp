// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <atomic>
#include <thread>
#include <vector>

#include "base/threads.h"

using namespace sigs;

TEST_CASE("a queue passes all items in order and never has more than its capacity") {
  constexpr int kItems = 2000;
  constexpr int kCapacity = 3;
  BoundedQueue<int> queue(kCapacity);
  std::atomic<int> put = 0;
  std::thread producer([&] {
    for (int i = 0; i < kItems; ++i) {
      queue.put(i);
      ++put;
    }
    queue.close();
  });
  std::vector<int> taken;
  bool bounded = true;
  while (const std::optional<int> item = queue.take()) {
    taken.push_back(*item);
    bounded = bounded && put <= static_cast<int>(taken.size()) + kCapacity;
  }
  producer.join();
  REQUIRE(taken.size() == kItems);
  for (int i = 0; i < kItems; ++i) REQUIRE(taken[static_cast<std::size_t>(i)] == i);
  CHECK(bounded);
}

TEST_CASE("a closed queue accepts nothing more and returns what is left") {
  BoundedQueue<int> queue(2);
  CHECK(queue.put(1));
  queue.close();
  CHECK_FALSE(queue.put(2));
  CHECK(queue.take() == 1);
  CHECK_FALSE(queue.take().has_value());
}

TEST_CASE("closing wakes threads that wait in put() and in take()") {
  BoundedQueue<int> full(1);
  CHECK(full.put(1));
  bool refused = false;
  std::thread producer([&] { refused = !full.put(2); });
  full.close();
  producer.join();
  CHECK(refused);
  BoundedQueue<int> empty(1);
  bool ended = false;
  std::thread consumer([&] { ended = !empty.take().has_value(); });
  empty.close();
  consumer.join();
  CHECK(ended);
}
