// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Ticks a lane in the open list of lanes, or unticks it; returns when the timeline shows it or no longer does.
void tick(UiTest& ui_test, const std::string& title, bool is_to_show) {
  EditorDriver& editor = ui_test.editor();
  editor.click("timeline/lanes/" + title);
  editor.wait_for("the lane " + title,
                  [&](const Json& now) { return shows(now, "timeline/lane/" + title) == is_to_show; });
}

}  // namespace

TEST_CASE("a person hides lanes of the timeline and shows others, without changing the project") {
  if (!can_drive_windows()) return;
  UiTest ui_test("lanes");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "head-on.json");
  editor.start({project.string()});
  const double curve_height = editor.place("timeline/lane/Distance").height;
  CHECK_FALSE(editor.has_place("timeline/lane/Load factor"));
  editor.click("timeline/lanes");
  ui_test.wait_for_place("timeline/lanes/Visibility");

  tick(ui_test, "Visibility", false);
  tick(ui_test, "Speed", false);
  editor.wait_for("higher curves", [&](const Json& now) {
    return now["places"]["timeline/lane/Distance"][3].get<double>() > curve_height;
  });
  tick(ui_test, "Load factor", true);
  tick(ui_test, "Visibility", true);
  // Strips above curves, in the order of the list, whichever was shown last.
  CHECK(editor.place("timeline/lane/Visibility").y < editor.place("timeline/lane/Distance").y);
  CHECK(editor.place("timeline/lane/Size").y < editor.place("timeline/lane/Load factor").y);
  CHECK_FALSE(is_unsaved(editor.state()));
}

}  // namespace sigs::test
