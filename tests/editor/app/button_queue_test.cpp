// SPDX-License-Identifier: MIT
#include "editor/app/window.h"

#include <doctest/doctest.h>

using namespace sigs::editor;

TEST_CASE("two clicks that came within one update are two clicks, each where it was made") {
  ButtonQueue queue;
  for (int click = 0; click < 2; ++click) {
    queue.push({0, true, 10.0 * click, 5});
    queue.push({0, false, 10.0 * click + 1, 6});
  }
  for (int click = 0; click < 2; ++click) {
    const Buttons pressed = queue.take_for_update();
    CHECK(pressed.down[0]);
    REQUIRE(pressed.at.has_value());
    CHECK(pressed.at->x == 10.0 * click);
    const Buttons dragged = queue.take_for_update();  // to where it is released
    CHECK(dragged.down[0]);
    CHECK(dragged.at->x == 10.0 * click + 1);
    const Buttons released = queue.take_for_update();
    CHECK_FALSE(released.down[0]);
    CHECK(released.at->x == 10.0 * click + 1);
  }
  CHECK(queue.empty());
}

TEST_CASE("a button that stays down is down in every update, and the mouse is where it is") {
  ButtonQueue queue;
  queue.push({2, true, 1, 1});
  CHECK(queue.take_for_update().down[2]);
  const Buttons later = queue.take_for_update();
  CHECK(later.down[2]);
  CHECK_FALSE(later.at.has_value());
}

TEST_CASE("different buttons change in the same update, in order") {
  ButtonQueue queue;
  queue.push({0, true, 1, 1});
  queue.push({1, true, 2, 2});
  queue.push({0, false, 2, 2});
  queue.push({1, false, 2, 2});
  const Buttons first = queue.take_for_update();
  CHECK(first.down[0]);
  CHECK(first.down[1]);
  CHECK(first.at->x == 2);
  const Buttons second = queue.take_for_update();
  CHECK_FALSE(second.down[0]);
  CHECK_FALSE(second.down[1]);
}

TEST_CASE("buttons unknown to ImGui are ignored") {
  ButtonQueue queue;
  queue.push({7, true, 0, 0});
  queue.push({-1, true, 0, 0});
  CHECK(queue.empty());
}
