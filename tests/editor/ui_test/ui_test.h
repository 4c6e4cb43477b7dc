// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "editor/ui_test/driver.h"
#include "support/test_data.h"

namespace sigs::test {

// A user at a window of 1600 x 960: an editor with settings and files of its own.
class UiTest {
 public:
  // Images are called NAME-*.png.
  explicit UiTest(std::string name, const nlohmann::json& settings = nlohmann::json::object());
  ~UiTest();  // leaves NAME-failed.png where the test has thrown

  EditorDriver& editor() { return editor_; }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

  // Into the build folder's screenshots/, with the mouse away from anything it would highlight.
  void image(const std::string& what);

  // Closes the messages, which would cover what is looked at.
  void dismiss_messages();

  // Until the interface shows the element of this name.
  void wait_for_place(const std::string& place);

  // With the mouse on the ruler. The first intruder's waypoints must span frame 0 to `last`.
  void scrub_to(int frame, int last = 199);
  // What changes the project; returns when it has, and the image with it.
  void edit(const std::function<void()>& action);
  // Ctrl+S; what lies in the file then.
  [[nodiscard]] nlohmann::json saved(const std::filesystem::path& project);
  // Into the text field at a place, instead of what is there.
  void fill_in(const std::string& place, const std::string& text);

 private:
  std::string name_;
  TemporaryFolder folder_;
  EditorDriver editor_;
};

// A sample project with its files named absolutely, so that its copy can lie anywhere.
[[nodiscard]] nlohmann::json sample_project(const std::string& name);
// Written as PROJECT.json; the file's path.
std::filesystem::path put(const nlohmann::json& project, const std::filesystem::path& file);

// Positions of an intruder's waypoints.
[[nodiscard]] std::vector<glm::dvec3> waypoints_m(const nlohmann::json& project, int intruder = 0);
[[nodiscard]] std::vector<double> waypoint_frames(const nlohmann::json& project, int intruder = 0);

// What the probe says.
[[nodiscard]] inline int revision_of(const nlohmann::json& state) {
  return state.value("revision", -1);
}
[[nodiscard]] inline bool is_unsaved(const nlohmann::json& state) {
  return state.value("unsaved", false);
}

}  // namespace sigs::test
