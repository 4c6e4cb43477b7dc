// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <set>
#include <string>
#include <vector>

#include "editor/ui_test/authoring_steps.h"

namespace sigs::test {

// The reader, his window and his files.
struct Reader {
  UiTest ui_test{"tutorial"};
  EditorDriver& editor = ui_test.editor();
  std::filesystem::path folder = ui_test.folder() / "flights";
  std::filesystem::path project = folder / "sample.json";

  [[nodiscard]] nlohmann::json saved() { return ui_test.saved(project); }

  // Without messages, which would cover what is looked at.
  void image(const std::string& what) {
    ui_test.dismiss_messages();
    ui_test.image(what);
  }

  // Closes blocks of the inspector, so that those below come into sight.
  void fold(const std::vector<std::string>& blocks) {
    for (const std::string& block : blocks) {
      editor.click("inspector/" + block);
      editor.settle();
    }
  }
};

// Nothing tells how the camera of the sample moves, so that it stands.
inline const glm::dvec3 kStandingCamera_m(0, 0, -150);

// Where the command line has the aircraft in a frame of the saved project, and whether it is in view.
struct Truth {
  glm::dvec3 position_m;
  double range_m;
  bool in_view;
};
[[nodiscard]] Truth truth_at(Reader& reader, int frame);

// The footage shows a place of the world at (x, y) of the screen: by the guessed lens, a pinhole of 70 degrees across
// 1280 pixels. The camera turns by less than a tenth of a degree, a pixel.
void check_shown_at(Reader& reader, const glm::dvec3& at_m, double x, double y);

// Settings that the window lists as guessed, and that the notes beside the project do, which are for people.
[[nodiscard]] std::set<std::string> guesses_shown(const nlohmann::json& state);
[[nodiscard]] std::set<std::string> guesses_noted(const std::filesystem::path& notes);

// Takes an image of this name; the number of its pixels of the red in which flight beyond the limits is drawn, behind
// the waypoints on the timeline.
[[nodiscard]] int red_pixels_of_timeline(Reader& reader, const std::string& image);

// Mean brightness of the left and of the right half of the aircraft as `sigs frame` composites it.
struct Halves {
  double left;
  double right;
};
[[nodiscard]] Halves brightness_of(Reader& reader, int frame);

// For a line of shell.
[[nodiscard]] std::string quoted(const std::filesystem::path& path);

}  // namespace sigs::test
