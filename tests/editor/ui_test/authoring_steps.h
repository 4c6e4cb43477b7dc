// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "editor/ui_test/ui_test.h"

// What a user does to author an encounter, for tests that begin with different projects. Each returns when it is done
// and shown, and checks what can be told without knowing the project.
namespace sigs::test {

constexpr double kMouse_px = 1.6;  // the mouse is at whole pixels, places are rounded outwards

// From the middle of a place on the screen.
[[nodiscard]] double apart_px(const ScreenPlace& place, double x, double y);

// A double click at (x, y) over the footage, which adds the first intruder's waypoint of this number there.
void add_over_footage(UiTest& ui_test, double x, double y, int waypoint);

// By the menu of the place (x, y) in the world view; `waypoint` is the number that it gets.
void add_in_world(UiTest& ui_test, double x, double y, int waypoint);

// Picks a waypoint in the world view ("world/waypoint/0/1"), so that its handle is there.
void pick_in_world(UiTest& ui_test, const std::string& waypoint);
// Drags an arrow of the handle ("z") or a square ("xy") outwards by a share of its distance from the middle; held_key
// as in EditorDriver::drag().
void drag_handle(UiTest& ui_test, const std::string& part, double share = 0.5, const std::string& held_key = {});
// The world's point has moved along one axis alone.
void check_moved_along(const glm::dvec3& from_m, const glm::dvec3& to_m, int axis);

// By the dialog, from the key to the end; images are called export, exporting and exported.
void export_in_window(UiTest& ui_test, const std::filesystem::path& folder);
// Lines of shell, which must end well.
void run_well(const std::string& lines);
// Both folders hold these files, with the same bytes.
void check_same_files(const std::filesystem::path& here, const std::filesystem::path& there,
                      const std::vector<std::string>& names);

}  // namespace sigs::test
