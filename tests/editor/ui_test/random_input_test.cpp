// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <glm/glm.hpp>
#include <random>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kEvents = 300;
// Of a short run, in which so many must change the project: it goes on until they have, since which do depends on how
// quickly dialogs and views come, and painting a mask, for one, changes nothing.
constexpr int kWantedChanges = kEvents / 20;
constexpr int kMostEvents = 4 * kEvents;
constexpr int kEventsOfAProject = 400;  // of a long run: random input makes projects larger and larger
constexpr int kKinds = 8;  // of events; one more has dialogs, other sizes of the window and attempts to quit

// SIGS_TEST_MINUTES: for so long instead, with events of all kinds.
double asked_minutes() {
  const char* const asked = std::getenv("SIGS_TEST_MINUTES");
  return asked == nullptr ? 0 : std::atof(asked);
}

constexpr double kMenu_px = 26;  // the menu bar is left alone: it could end the program

// Draws events; the same ones from the same seed everywhere (the library's distributions are not).
class RandomInput {
 public:
  RandomInput(EditorDriver& editor, unsigned seed, int kinds) : editor_(editor), random_(seed), kinds_(kinds) {}

  void send_event() {
    switch (below(kinds_)) {
      case 0:
        editor_.click(x(), y(), button());
        break;
      case 1:
        drag_place();
        break;
      case 2:
        click_place();
        break;
      case 3:
        editor_.drag(x(), y(), x(), y(), button(), one_of({"", "", "shift", "ctrl", "alt"}));
        break;
      case 4:
        editor_.wheel(x(), y(), below(2) == 0 ? 2 : -2);
        break;
      case 5:
      case 6:
        send_key();
        break;
      case 7:
        editor_.type(one_of({"0", "-1", "1e9", "nan", "inf", "-", "aircraft", "12.5", "99999999999", "../x"}));
        break;
      default:
        send_rare_event();
    }
  }

  // As a person does who wants nothing of what was done.
  void open_instead(UiTest& ui_test, const fs::path& project) {
    answer_all();
    editor_.set_hurried(false);
    set_size(1600, 960);
    const int before = revision_of(editor_.state());
    editor_.key("ctrl+o");
    ui_test.wait_for_place("browser/answer");
    editor_.settle();
    editor_.key("ctrl+l");
    editor_.settle();
    editor_.type(project.string());
    editor_.key("Return");
    const auto is_there = [before](const Json& now) { return revision_of(now) > before && !is_unsaved(now); };
    while (!is_there(editor_.state())) {
      const char* const no = "question/Don't save";
      editor_.wait_for("the project, or a question", [&](const Json& now) { return is_there(now) || shows(now, no); });
      if (editor_.has_place(no)) editor_.click(no);
    }
    editor_.wait_for_image();
    editor_.set_hurried(true);
  }

  // Out of every dialog and text field.
  void answer_all() {
    for (int i = 0; i < 6; ++i) editor_.key("Escape");
    for (const char* const place : {"question/Cancel", "export/cancel"})
      if (editor_.has_place(place)) editor_.click(place);
  }

 private:
  void set_size(int width_px, int height_px) {
    width_px_ = width_px;
    height_px_ = height_px;
    editor_.resize(width_px_, height_px_);
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  // Not F11 where the window changes its size otherwise too: which size it has then would not be known.
  void send_key() {
    const std::string key = one_of(
        {"Delete", "Return", "Return", "ctrl+d", "ctrl+z",      "ctrl+shift+z", "i",      "o",        "x",    "Escape",
         "space",  "j",      "l",      "Left",   "shift+Right", "Home",         "End",    "Up",       "Down", "ctrl+d",
         "Insert", "f",      "n",      "Tab",    "question",    "F11",          "ctrl+e", "BackSpace"});
    if (key != "F11" || kinds_ == kKinds) editor_.key(key);
  }

  void click_place() {
    const glm::dvec2 at = one_of_the_places();
    editor_.click(at.x, at.y, button());
  }

  void drag_place() {
    const glm::dvec2 at = one_of_the_places();
    const glm::dvec2 to(at.x + below(300) - 150, at.y + below(300) - 150);
    editor_.drag(at.x, at.y, to.x, to.y, 1, one_of({"", "", "shift", "ctrl"}));
  }

  void send_rare_event() {
    switch (below(4)) {
      case 0:
        set_size(900 + below(701), 600 + below(361));
        break;
      case 1:
        editor_.key(one_of({"ctrl+o", "ctrl+n", "ctrl+shift+s", "ctrl+e", "ctrl+s"}));
        break;
      case 2:
        try_to_quit();
        break;
      default:
        answer_all();
    }
  }

  // With unsaved changes alone: then the editor asks, and stays.
  void try_to_quit() {
    answer_all();
    if (!editor_.state().value("unsaved", false)) return;
    editor_.set_hurried(false);
    editor_.key("ctrl+q");
    answer_all();
    editor_.set_hurried(true);
  }

  double x() { return below(width_px_); }
  double y() { return kMenu_px + below(height_px_ - static_cast<int>(kMenu_px)); }
  int button() { return std::array{1, 1, 1, 3, 2}[static_cast<std::size_t>(below(5))]; }
  std::string one_of(const std::vector<std::string>& words) {
    return words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
  }
  static glm::dvec2 middle_of(const Json& rect) {
    return {rect[0].get<double>() + rect[2].get<double>() / 2, rect[1].get<double>() + rect[3].get<double>() / 2};
  }
  // Below the menu bar, and not on the window's last pixels.
  bool is_in_window(const glm::dvec2& at) const {
    return at.x >= 0 && at.x < width_px_ - 1 && at.y > kMenu_px && at.y < height_px_ - 1;
  }
  // The middle of something that the window shows now, except the menu bar. It may be gone when the mouse comes there.
  glm::dvec2 one_of_the_places() {
    std::vector<glm::dvec2> middles;
    const Json state = editor_.state();
    if (state.contains("places"))
      for (const auto& [name, rect] : state["places"].items())
        if (const glm::dvec2 middle = middle_of(rect); !name.starts_with("menu/") && is_in_window(middle))
          middles.push_back(middle);
    if (middles.empty()) return {width_px_ / 2, height_px_ / 2};
    return middles[static_cast<std::size_t>(below(static_cast<int>(middles.size())))];
  }

  EditorDriver& editor_;
  std::mt19937 random_;
  int kinds_;
  int width_px_ = 1600;  // of the window
  int height_px_ = 960;
};

}  // namespace

TEST_CASE("no sequence of keys and mouse input crashes the editor, and it still saves") {
  if (!can_drive_windows()) return;
  UiTest ui_test("random_input");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("two-intruders"), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  const double minutes = asked_minutes();
  RandomInput random_input(editor, 2024, minutes > 0 ? kKinds + 1 : kKinds);
  editor.set_hurried(true);
  int revision = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double, std::ratio<60>>(minutes);
  int events = 0;
  const auto goes_on = [&] {
    if (minutes > 0) return std::chrono::steady_clock::now() < end;
    return events < kEvents || (revision <= kWantedChanges && events < kMostEvents);
  };
  for (; goes_on(); ++events) {
    if (minutes > 0 && events % kEventsOfAProject == kEventsOfAProject - 1)
      random_input.open_instead(ui_test, put(sample_project("two-intruders"), project));
    random_input.send_event();
    revision = std::max(revision, revision_of(editor.state()));
    if (events % 8 == 0) editor.key("Escape");  // a dialog swallows what comes
    REQUIRE_MESSAGE(editor.running(), "it ended after event " << events << " with " << editor.exit_status());
  }
  editor.set_hurried(false);
  ui_test.image("after");
  MESSAGE(events, " events, ", revision, " changes of the project");
  CHECK(revision > (minutes > 0 ? events / 100 : kWantedChanges));
  random_input.answer_all();
  if (minutes > 0) return;  // the project may be another one
  const Json saved = ui_test.saved(project);
  CHECK(saved.contains("intruders"));
}

}  // namespace sigs::test
