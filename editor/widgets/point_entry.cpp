// SPDX-License-Identifier: MIT
#include "editor/widgets/point_entry.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <utility>

#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr const char* kId = "point entry";
constexpr double kMaxCoordinate_m = 1e8;

struct Row {
  const char* id;
  const char* name;
  const char* meaning;
  ImU32 color;
};
constexpr std::array<Row, 3> kRows{{{"##x", "X", "forward", color::kAxisX},
                                    {"##y", "Y", "right", color::kAxisY},
                                    {"##z", "Z", "down", color::kAxisZ}}};

bool enter_pressed() {
  return pressed(Key::enter) || pressed(Key::keypad_enter);
}

// What a person may type that is no place: an overflow, 1e400.
bool is_a_place(const glm::dvec3& p_m) {
  return std::isfinite(p_m.x) && std::isfinite(p_m.y) && std::isfinite(p_m.z);
}

}  // namespace

void PointEntry::open(std::string title, const glm::dvec3& point_m) {
  title_ = std::move(title);
  point_m_ = point_m;
  state_ = State::asked;
}

void PointEntry::draw_fields() {
  ImGui::PushFont(font(Font::bold));
  ImGui::TextUnformatted(title_.c_str());
  ImGui::PopFont();
  for (int i = 0; i < 3; ++i) {
    const Row& row = kRows[static_cast<std::size_t>(i)];
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(row.color), "%s", row.name);
    ImGui::SameLine(scaled(34));
    ImGui::SetNextItemWidth(scaled(130));
    if (i == 0 && appearing_) ImGui::SetKeyboardFocusHere();
    ImGui::InputDouble(row.id, &point_m_[i], 0, 0, "%.3f", ImGuiInputTextFlags_AutoSelectAll);
    ImGui::SameLine();
    ImGui::TextDisabled("m %s", row.meaning);
  }
}

// Closing waits for the next update: the key that closes it must find it open still, or the rest of the program would
// take that key as well.
std::optional<glm::dvec3> PointEntry::draw() {
  if (state_ == State::closed) return std::nullopt;
  appearing_ = state_ == State::asked;
  if (appearing_) {
    ImGui::OpenPopup(kId);
    state_ = State::open;
  }
  if (!ImGui::BeginPopup(kId)) {
    state_ = State::closed;
    return std::nullopt;
  }
  std::optional<glm::dvec3> taken;
  if (state_ == State::leaving) {
    state_ = State::closed;
    ImGui::CloseCurrentPopup();
  } else {
    draw_fields();
    const bool apply = ImGui::Button("Apply", {scaled(90), 0}) || enter_pressed();
    ImGui::SameLine();
    const bool leave = ImGui::Button("Cancel", {scaled(90), 0}) || pressed(Key::escape);
    if (apply && is_a_place(point_m_)) taken = glm::clamp(point_m_, -kMaxCoordinate_m, kMaxCoordinate_m);
    if (taken || leave) state_ = State::leaving;
  }
  ImGui::EndPopup();
  return taken;
}

}  // namespace sigs::editor
