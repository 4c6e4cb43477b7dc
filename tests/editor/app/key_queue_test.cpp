// SPDX-License-Identifier: MIT
#include "editor/app/window.h"

#include <doctest/doctest.h>

#include <string>

namespace sigs::editor {

namespace {

constexpr int kCtrl = 1;
constexpr int kEnter = 2;

KeyEvent key(int number, bool down, KeyKind kind) {
  return {.key = number, .down = down, .kind = kind};
}

void press_sign(KeyQueue& queue, char sign) {
  queue.push(key(sign, true, KeyKind::sign));
  queue.push({.character = static_cast<unsigned>(sign)});
  queue.push(key(sign, false, KeyKind::sign));
}

// "ab" for characters, "[3" and "]3" for key 3 going down and up, "|" between updates.
std::string turns_of(KeyQueue& queue, bool types_text) {
  std::string events_text;
  for (int turn = 0; !queue.empty() && turn < 100; ++turn) {
    if (turn > 0) events_text += '|';
    for (const KeyEvent& event : queue.take_for_update(types_text)) {
      if (event.character != 0)
        events_text += static_cast<char>(event.character);
      else
        events_text.append(event.down ? "[" : "]")
            .append(event.key > 9 ? std::string(1, static_cast<char>(event.key)) : std::to_string(event.key));
    }
  }
  return events_text;
}

}  // namespace

TEST_CASE("a key pressed and released between two updates is down in one update and up in the next") {
  KeyQueue queue;
  queue.push(key(kEnter, true, KeyKind::action));
  queue.push(key(kEnter, false, KeyKind::action));
  CHECK(turns_of(queue, false) == "[2|]2");
}

TEST_CASE("a modifier released before the key of its chord is still down in the update of that key") {
  KeyQueue queue;
  queue.push(key(kCtrl, true, KeyKind::modifier));
  queue.push(key('l', true, KeyKind::action));
  queue.push(key(kCtrl, false, KeyKind::modifier));
  queue.push(key('l', false, KeyKind::action));
  CHECK(turns_of(queue, false) == "[1[l|]1]l");
}

TEST_CASE("what is typed after a chord or Enter comes in a later update than that") {
  KeyQueue queue;
  queue.push(key(kEnter, true, KeyKind::action));
  queue.push({.character = 'x'});
  CHECK(turns_of(queue, true) == "[2|x");
}

TEST_CASE("what is typed before Enter is in the text when Enter ends it") {
  KeyQueue queue;
  press_sign(queue, 'a');
  press_sign(queue, 'b');
  queue.push(key(kEnter, true, KeyKind::action));
  CHECK(turns_of(queue, true) == "[aa]a[bb]b[2");
}

TEST_CASE("a text field takes a whole word in one update, a double letter too") {
  KeyQueue queue;
  for (const char sign : std::string("hello")) press_sign(queue, sign);
  std::string text;
  for (const KeyEvent& event : queue.take_for_update(true))
    if (event.character != 0) text += static_cast<char>(event.character);
  CHECK(text == "hello");
  CHECK(queue.empty());
}

TEST_CASE("outside of texts each press of a letter has an update of its own") {
  KeyQueue queue;
  press_sign(queue, 'k');
  press_sign(queue, 'k');
  CHECK(turns_of(queue, false) == "[kk|]k|[kk|]k");
}

}  // namespace sigs::editor
