// SPDX-License-Identifier: MIT
#include "editor/views/inspector/problems.h"

#include <imgui.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "editor/document/field_texts.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr int kMostShown = 20;

// The number behind "name[" in a key.
std::optional<std::size_t> index_in(std::string_view key, std::string_view name) {
  const std::size_t at = key.find(name);
  if (at == std::string_view::npos) return std::nullopt;
  return std::strtoul(std::string(key.substr(at + name.size())).c_str(), nullptr, 10);
}

}  // namespace

std::string block_of(std::string_view key) {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kBlocks{{{"footage.", "Inputs"},
                                                                             {"own_body.", "Own body"},
                                                                             {"camera.", "Camera"},
                                                                             {"light.", "Light"},
                                                                             {"compositing.", "Compositing"},
                                                                             {"export.", "Export"}}};
  for (const auto& [prefix, block] : kBlocks)
    if (key.starts_with(prefix)) return block;
  if (!key.starts_with("intruders[")) return "";
  return key.find(".trajectory") == std::string_view::npos ? "Intruders" : "Trajectory";
}

std::string place_of(const Project& project, std::string_view key) {
  const std::optional<std::size_t> intruder = index_in(key, "intruders[");
  if (!intruder) return block_of(key).empty() ? label_of(key) : block_of(key) + ", " + label_of(key);
  std::string place = *intruder < project.intruders.size() ? project.intruders[*intruder].name : "";
  if (place.empty()) place = "intruder " + std::to_string(*intruder);
  if (const std::optional<std::size_t> waypoint = index_in(key, "waypoints["))
    return place + ", waypoint " + std::to_string(*waypoint);
  return place + ", " + label_of(key);
}

void ProblemList::refresh(const Studio& studio) {
  if (studio.shown.scene == scene_) return;
  scene_ = studio.shown.scene;
  by_field_.clear();
  counts_.clear();
  if (!scene_) return;
  for (const Problem& problem : scene_->draft.problems) by_field_.emplace(problem.field, problem);
  if (scene_->footage && !scene_->footage->problem.empty() && !by_field_.contains("footage.video"))
    by_field_.emplace("footage.video", Problem{"footage.video", scene_->footage->problem, ErrorKind::bad_data});
  for (const auto& [field, problem] : by_field_) ++counts_[block_of(field)];
}

int ProblemList::count_in(const std::string& block) const {
  const auto found = counts_.find(block);
  return found == counts_.end() ? 0 : found->second;
}

std::optional<std::string> ProblemList::draw(const Studio& studio) const {
  if (by_field_.empty()) return std::nullopt;
  const std::size_t count = by_field_.size();
  const std::string title = count == 1 ? "1 problem" : std::to_string(count) + " problems";
  std::optional<std::string> clicked;
  ImGui::PushStyleColor(ImGuiCol_Text, color::kBad);
  const bool is_open = ImGui::TreeNodeEx("problems", ImGuiTreeNodeFlags_SpanAvailWidth, "%s", title.c_str());
  studio.places.note_item("inspector/problems");
  ImGui::PopStyleColor();
  if (!is_open) return std::nullopt;
  int shown = 0;
  for (const auto& [field, problem] : by_field_) {
    if (++shown > kMostShown) break;
    const std::string text = place_of(studio.project(), field) + ": " + problem.what;
    ImGui::PushID(shown);
    const std::string line = elided(text, ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable(line.empty() ? "..." : line.c_str())) clicked = field;
    tooltip_for_item(text.c_str());
    ImGui::PopID();
  }
  if (count > kMostShown) note(std::to_string(count - kMostShown) + " more", true);
  ImGui::TreePop();
  return clicked;
}

}  // namespace sigs::editor
