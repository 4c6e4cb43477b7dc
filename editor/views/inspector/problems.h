// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/views/inspector/field_rows.h"
#include "scene/visibility.h"

namespace sigs::editor {

// Blocks of the inspector that take some of a group's settings.
inline constexpr const char* kCameraLogBlock = "Camera log";
inline constexpr const char* kMountBlock = "Mount and clock";
inline constexpr const char* kPlaceBlock = "Place on the Earth";

// The inspector's block that a key belongs to; "" for the project's own.
[[nodiscard]] std::string block_of(std::string_view key);

// A problem's place in words: "light-aircraft, waypoint 2: frame".
[[nodiscard]] std::string place_of(const Project& project, std::string_view key);

// What is wrong with the project, and what can be used but is hardly meant, from the newest scene that is open and its
// surveys: what `sigs check` says of it.
class ProblemList {
 public:
  // Once per update, before the others; does something only where the scene or a survey is another one.
  void refresh(const ViewContext& context);
  [[nodiscard]] const ProblemsByField& by_field() const { return by_field_; }
  // Number of problems, warnings not counted, in a block.
  [[nodiscard]] int count_in(const std::string& block) const;

  // "2 problems", "3 warnings" and "4 guessed settings", to be opened as lists; the key of the one that was clicked.
  // The last is open at first.
  [[nodiscard]] std::optional<std::string> draw(const ViewContext& context) const;

 private:
  void find_warnings();

  std::shared_ptr<const OpenedScene> scene_;            // what they are of
  std::vector<std::shared_ptr<const Survey>> surveys_;  // likewise
  std::shared_ptr<const SeenHorizons> horizons_;        // likewise
  ProblemsByField by_field_;
  std::map<std::string, int> counts_;  // by block
  ProblemsByField warnings_;
  // By intruder: that it is never visible, as of the last survey that was whole. While a drag lasts none is.
  std::vector<std::optional<Problem>> never_visible_;
};

// Says at once that a change has taken an intruder out of view. While a drag lasts nothing is said: surveys are whole
// after it.
class LossOfView {
 public:
  // Once per update. A message where an intruder is in view in less than half of the share of frames that it was in
  // before the change; none else, for another document than before, and without footage.
  [[nodiscard]] std::optional<std::string> found(const ViewContext& context);

 private:
  std::uint64_t document_ = 0;                          // Document::first_number()
  std::vector<std::shared_ptr<const Survey>> surveys_;  // that were looked at last
  std::map<std::string, Visibility> before_;            // by the intruder's name
};

}  // namespace sigs::editor
