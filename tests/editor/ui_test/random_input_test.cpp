// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kEvents = 300;
constexpr double kMenu_px = 26;  // the menu bar is left alone: it could end the program

// Draws events; the same ones from the same seed everywhere (the library's distributions are not).
class RandomInput {
 public:
  RandomInput(EditorDriver& editor, unsigned seed) : editor_(editor), random_(seed) {}

  void send_event() {
    switch (below(8)) {
      case 0:
        editor_.click(x(), y(), button());
        break;
      case 1:
        editor_.drag(one_of_the_places(), below(300) - 150, below(300) - 150, 1, one_of({"", "", "shift", "ctrl"}));
        break;
      case 2:
        editor_.click(one_of_the_places(), button());
        break;
      case 3:
        editor_.drag(x(), y(), x(), y(), button(), one_of({"", "", "shift", "ctrl", "alt"}));
        break;
      case 4:
        editor_.wheel(x(), y(), below(2) == 0 ? 2 : -2);
        break;
      case 5:
      case 6:
        editor_.key(
            one_of({"Delete",   "Return", "Return", "ctrl+d", "ctrl+z", "ctrl+shift+z", "i",        "o",   "x",
                    "Escape",   "space",  "j",      "l",      "Left",   "shift+Right",  "Home",     "End", "Up",
                    "Down",     "ctrl+d", "Insert", "f",      "n",      "Tab",          "question", "F11", "ctrl+e",
                    "BackSpace"}));
        break;
      default:
        editor_.type(one_of({"0", "-1", "1e9", "nan", "inf", "-", "aircraft", "12.5", "99999999999", "../x"}));
    }
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double x() { return below(1600); }
  double y() { return kMenu_px + below(960 - static_cast<int>(kMenu_px)); }
  int button() { return std::array{1, 1, 1, 3, 2}[static_cast<std::size_t>(below(5))]; }
  std::string one_of(const std::vector<std::string>& words) {
    return words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
  }
  // Of what the window shows now, except the menu bar.
  std::string one_of_the_places() {
    std::vector<std::string> names;
    const Json state = editor_.state();
    if (state.contains("places"))
      for (const auto& [name, rect] : state["places"].items())
        if (!name.starts_with("menu/") && rect[1] > kMenu_px && rect[1] < 950) names.push_back(name);
    return names.empty() ? "timeline/ruler" : one_of(names);
  }

  EditorDriver& editor_;
  std::mt19937 random_;
};

// Out of every dialog and text field.
void wait_until_idle(EditorDriver& editor) {
  for (int i = 0; i < 6; ++i) editor.key("Escape");
  if (editor.has_place("question/Cancel")) editor.click("question/Cancel");
  if (editor.has_place("export/cancel")) editor.click("export/cancel");
}

}  // namespace

TEST_CASE("no sequence of keys and mouse input crashes the editor, and it still saves") {
  if (!can_drive_windows()) return;
  UiTest ui_test("random_input");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("two-intruders"), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  RandomInput random_input(editor, 2024);
  editor.set_hurried(true);
  int revision = 0;
  for (int i = 0; i < kEvents; ++i) {
    random_input.send_event();
    revision = std::max(revision, revision_of(editor.state()));
    if (i % 8 == 0) editor.key("Escape");  // a dialog swallows what comes
    REQUIRE_MESSAGE(editor.running(), "it ended after event " << i << " with " << editor.exit_status());
  }
  editor.set_hurried(false);
  ui_test.image("after");
  CHECK(revision > kEvents / 20);  // enough of it changed the project
  wait_until_idle(editor);
  const Json saved = ui_test.saved(project);
  CHECK(saved.contains("intruders"));
}

}  // namespace sigs::test
