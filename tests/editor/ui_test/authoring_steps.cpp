// SPDX-License-Identifier: MIT
#include "editor/ui_test/authoring_steps.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/files.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

double apart_px(const ScreenPlace& place, double x, double y) {
  return std::hypot(place.center_x() - x, place.center_y() - y);
}

void add_over_footage(UiTest& ui_test, double x, double y, int waypoint) {
  EditorDriver& editor = ui_test.editor();
  ui_test.edit([&] {
    const int revision = revision_of(editor.state());
    // Again where it may have come as two clicks, which only select.
    while (!editor.double_click(x, y) && revision_of(editor.state()) == revision) {
    }
  });
  CHECK(apart_px(editor.place("viewport/waypoint/0/" + std::to_string(waypoint)), x, y) < kMouse_px);
}

void add_in_world(UiTest& ui_test, double x, double y, int waypoint) {
  EditorDriver& editor = ui_test.editor();
  editor.click(x, y, 3);
  ui_test.edit([&] { editor.click("world/menu/add waypoint"); });
  CHECK(apart_px(editor.place("world/waypoint/0/" + std::to_string(waypoint)), x, y) < kMouse_px);
}

void pick_in_world(UiTest& ui_test, const std::string& waypoint) {
  EditorDriver& editor = ui_test.editor();
  const ScreenPlace there = editor.place(waypoint);
  editor.click(waypoint);
  editor.wait_for("the handle at " + waypoint, [&](const Json&) {
    return editor.has_place("gizmo/middle") &&
           apart_px(editor.place("gizmo/middle"), there.center_x(), there.center_y()) < kMouse_px;
  });
}

void drag_handle(UiTest& ui_test, const std::string& part, double share, const std::string& held_key) {
  EditorDriver& editor = ui_test.editor();
  const ScreenPlace middle = editor.place("gizmo/middle");
  const ScreenPlace tip = editor.place("gizmo/" + part);
  ui_test.edit([&] {
    editor.drag("gizmo/" + part, share * (tip.center_x() - middle.center_x()),
                share * (tip.center_y() - middle.center_y()), 1, held_key);
  });
}

void check_moved_along(const glm::dvec3& from_m, const glm::dvec3& to_m, int axis) {
  for (int i = 0; i < 3; ++i) {
    if (i == axis)
      CHECK(std::abs(to_m[i] - from_m[i]) > 0.5);
    else
      CHECK(to_m[i] == doctest::Approx(from_m[i]).epsilon(1e-12));
  }
}

void export_in_window(UiTest& ui_test, const fs::path& folder) {
  EditorDriver& editor = ui_test.editor();
  editor.key("ctrl+e");
  ui_test.fill_in("export/folder", folder.string());
  ui_test.image("export");
  editor.click("export/go");
  (void)editor.place("export/hide");
  editor.settle();
  ui_test.image("exporting");
  // It reports its progress some ten times a second; the probe does not show it.
  editor.wait_for("the export's end", [&](const Json& now) { return shows(now, "export/again"); });
  ui_test.image("exported");
  editor.click("export/close");
}

void run_well(const std::string& lines) {
  const Run finished = run_together(lines);
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
}

void check_same_files(const fs::path& here, const fs::path& there, const std::vector<std::string>& names) {
  REQUIRE(files_below(here) == names);
  REQUIRE(files_below(there) == names);
  for (const std::string& name : names) {
    const std::string bytes = text_of(here / name);
    CHECK(bytes.size() > 1000);
    CHECK_MESSAGE(bytes == text_of(there / name), name << " differs");
  }
}

}  // namespace sigs::test
