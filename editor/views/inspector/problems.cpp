// SPDX-License-Identifier: MIT
#include "editor/views/inspector/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <utility>

#include "base/text.h"
#include "editor/document/field_edits.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/waypoint_actions.h"
#include "export/export_project.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

constexpr int kMaxShown = 20;
constexpr std::size_t kMaxLine = 400;  // bytes
constexpr float kMaxShareOfPanel = 0.3F;

// The number behind "name[" in a key.
std::optional<std::size_t> index_in(std::string_view key, std::string_view name) {
  const std::size_t at = key.find(name);
  if (at == std::string_view::npos) return std::nullopt;
  return std::strtoul(std::string(key.substr(at + name.size())).c_str(), nullptr, 10);
}

// Text over as many lines as it needs, that is clicked as a whole.
bool wrapped_line(const std::string& text) {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y;
  const bool is_clicked = ImGui::Selectable("##line", false, 0, {width, height});
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), place, ImGui::GetColorU32(ImGuiCol_Text),
                                      text.c_str(), nullptr, width);
  return is_clicked;
}

std::string line_of(const ViewContext& context, const Problem& problem) {
  return shortened(place_of(context.project(), problem.field) + ": " + problem.what, kMaxLine);
}

// How long texts are shown: guesses stand in whole at their fields.
enum class Lines { wrapped, cut };

// The field whose line was clicked.
std::optional<std::string> draw_lines(const ViewContext& context, const std::vector<Problem>& problems,
                                      const std::string& name, Lines lines) {
  std::optional<std::string> clicked;
  int shown = 0;
  for (const Problem& problem : problems) {
    if (++shown > kMaxShown) break;
    ImGui::PushID(shown);
    const std::string whole = line_of(context, problem);
    const std::string line = lines == Lines::cut ? elided(whole, ImGui::GetContentRegionAvail().x) : whole;
    if (wrapped_line(line)) clicked = problem.field;
    context.ui_probe.note_item(fmt::format("inspector/{}/{}", name, problem.field), line == whole ? "" : whole);
    ImGui::PopID();
  }
  if (problems.size() > kMaxShown) note(fmt::format("{} more", problems.size() - kMaxShown), true);
  return clicked;
}

// Of all lines, or as much of the panel as a list may take; the rest is scrolled to.
float height_of_lines(const ViewContext& context, const std::vector<Problem>& problems, Lines lines) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = ImGui::GetContentRegionAvail().x - style.ScrollbarSize;
  float height = style.ItemSpacing.y;
  for (const Problem& problem : problems)
    height += style.ItemSpacing.y +
              (lines == Lines::cut ? ImGui::GetTextLineHeight()
                                   : ImGui::CalcTextSize(line_of(context, problem).c_str(), nullptr, false, width).y);
  return std::min(height, ImGui::GetContentRegionAvail().y * kMaxShareOfPanel);
}

std::optional<std::string> draw_list(const ViewContext& context, const std::vector<Problem>& problems,
                                     const std::string& name, ImU32 shade, Lines lines = Lines::wrapped,
                                     bool opens_first = false) {
  if (problems.empty()) return std::nullopt;
  const std::string title = count_text(static_cast<std::int64_t>(problems.size()), name);
  ImGui::PushStyleColor(ImGuiCol_Text, shade);
  const std::string id = name + "s";
  const ImGuiTreeNodeFlags first = opens_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
  const bool is_open = ImGui::TreeNodeEx(id.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth | first, "%s", title.c_str());
  context.ui_probe.note_item("inspector/" + id);
  ImGui::PopStyleColor();
  if (!is_open) return std::nullopt;
  ImGui::PushFont(font(Font::small));
  ImGui::BeginChild(id.c_str(), {0, height_of_lines(context, problems, lines)});
  const std::optional<std::string> clicked = draw_lines(context, problems, name, lines);
  ImGui::EndChild();
  ImGui::PopFont();
  ImGui::TreePop();
  return clicked;
}

// The list is of fields; of the path that a file's warning names, its last part is enough.
Problem in_field(const std::string& field, const Warning& warning) {
  return {field, Warning{std::filesystem::path(warning.where).filename().string(), warning.what}.text()};
}

// Of footage, models and the camera's log.
std::vector<Problem> warnings_of_files(const OpenedScene& opened) {
  std::vector<Problem> found;
  if (opened.footage && opened.footage->video)
    for (const Warning& warning : warnings_of(*opened.footage->video))
      found.push_back(in_field("footage.video", warning));
  std::set<const Model*> reported;
  const std::vector<int>& numbers = opened.draft.intruder_of_project;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0) continue;
    const Model* const model = opened.draft.scene.intruders[static_cast<std::size_t>(numbers[i])].model;
    if (model == nullptr || !reported.insert(model).second) continue;
    for (const Warning& warning : model->mesh.warnings)
      found.push_back(in_field(fmt::format("intruders[{}].model.file", i), warning));
  }
  // Those of models are among the scene's too.
  std::set<std::string> told;
  for (const Problem& problem : found) told.insert(problem.what);
  for (const Warning& warning : opened.draft.scene.warnings)
    if (Problem of_log = in_field("camera.track.file", warning); told.insert(of_log.what).second)
      found.push_back(std::move(of_log));
  return found;
}

// Of all frames, once all have been looked at. None of a rig: what one camera of several never shows is no mistake.
std::optional<Visibility> whole_visibility(const OpenedScene& opened, const Survey* survey) {
  if (opened.project->rig_view) return std::nullopt;
  const Scene& scene = opened.draft.scene;
  const int frames = scene.last_frame - scene.first_frame + 1;
  const bool is_whole =
      survey != nullptr && survey->revision == opened.revision && static_cast<int>(survey->estimates.size()) == frames;
  return is_whole ? std::optional(visibility_of(*survey, frames)) : std::nullopt;
}

// What is wrong with these by the placeholder's frames may be right by the footage's own frames and log.
bool hangs_on_footage(std::string_view field) {
  return field.starts_with("light.sun.") || (field.starts_with("camera.track.") && field != "camera.track.file");
}

std::vector<Problem> lines_of(const ProblemsByField& problems) {
  std::vector<Problem> lines;
  for (const auto& [field, problem] : problems) lines.push_back(problem);
  return lines;
}

// How much hangs on a guess: all distances on the lens, all places on the camera, the look of one aircraft on the rest.
int weight_of(std::string_view field) {
  constexpr std::array<std::string_view, 4> kFirst{"footage.", "camera.", "intruders", "light."};
  const auto found = std::ranges::find_if(kFirst, [&](std::string_view begin) { return field.starts_with(begin); });
  return static_cast<int>(found - kFirst.begin());
}

}  // namespace

std::string block_of(std::string_view key) {
  constexpr std::array<std::pair<std::string_view, const char*>, 15> kBlocks{{{"footage.occluder_", "Own body"},
                                                                              {"footage.cloud_", "Own body"},
                                                                              {"footage.", "Inputs"},
                                                                              {"mount.", kMountBlock},
                                                                              {"clock.", kMountBlock},
                                                                              {"camera.track.", kCameraLogBlock},
                                                                              {"camera.readout_s", kCameraLogBlock},
                                                                              {"camera.exposure_s", kCameraLogBlock},
                                                                              {"geo.", kPlaceBlock},
                                                                              {"own_body.", "Own body"},
                                                                              {"camera.", "Camera"},
                                                                              {"light.", "Light"},
                                                                              {"appearance.", "Appearance"},
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
  if (place.empty()) place = fmt::format("intruder {}", *intruder);
  if (const std::optional<std::size_t> waypoint = index_in(key, "waypoints["))
    return fmt::format("{}, waypoint {}", place, *waypoint);
  return place + ", " + label_of(key);
}

void ProblemList::find_warnings() {
  warnings_.clear();
  if (!scene_) return never_visible_.clear();
  const auto add = [&](const Problem& warning) { warnings_.emplace(warning.field, warning); };
  for (const Problem& warning : warnings_of_files(*scene_)) add(warning);
  if (horizons_)
    if (const auto level = level_contradiction(*horizons_, *scene_->project, scene_->draft.scene)) add(*level);
  for (const Problem& warning : scene_->draft.scene.issues) add(warning);
  const std::vector<IntruderSettings>& intruders = scene_->project->intruders;
  never_visible_.resize(intruders.size());
  if (scene_->project->rig_view) never_visible_.assign(intruders.size(), std::nullopt);
  for (std::size_t i = 0; i < intruders.size(); ++i) {
    const Survey* const survey = i < surveys_.size() ? surveys_[i].get() : nullptr;
    if (const std::optional<Visibility> visibility = whole_visibility(*scene_, survey))
      never_visible_[i] = never_visible(*visibility, intruders[i].name, i);
    if (never_visible_[i]) add(*never_visible_[i]);
  }
}

void ProblemList::refresh(const ViewContext& context) {
  const bool is_same_scene = context.shown.scene == scene_;
  const bool has_same_surveys = context.shown.surveys == surveys_ && context.horizons == horizons_;
  scene_ = context.shown.scene;
  horizons_ = context.horizons;
  surveys_ = context.shown.surveys;
  if (!is_same_scene || !has_same_surveys) find_warnings();
  if (is_same_scene) return;
  by_field_.clear();
  counts_.clear();
  if (!scene_) return;
  const bool has_footage = scene_->footage && scene_->footage->video;
  for (const Problem& problem : scene_->draft.problems)
    if (has_footage || !hangs_on_footage(problem.field)) by_field_.emplace(problem.field, problem);
  if (scene_->footage && !scene_->footage->problem.empty() && !by_field_.contains("footage.video"))
    by_field_.emplace("footage.video", Problem{"footage.video", scene_->footage->problem, ErrorKind::bad_data});
  for (const auto& [field, problem] : by_field_) ++counts_[block_of(field)];
}

std::optional<std::string> LossOfView::found(const ViewContext& context) {
  const std::shared_ptr<const OpenedScene>& opened = context.shown.scene;
  if (context.document.first_number() != document_) before_.clear();
  document_ = context.document.first_number();
  if (!opened || !opened->footage || !opened->footage->video || context.shown.surveys == surveys_) return std::nullopt;
  surveys_ = context.shown.surveys;
  const std::vector<IntruderSettings>& intruders = opened->project->intruders;
  std::map<std::string, Visibility> now;
  for (std::size_t i = 0; i < intruders.size(); ++i) {
    const std::optional<Visibility> visibility = whole_visibility(*opened, survey_of(context, int(i)).get());
    if (visibility)
      now.emplace(intruders[i].name, *visibility);
    else if (!intruders[i].trajectory.waypoints.empty())
      return std::nullopt;  // not all are known yet
  }
  const auto share = [](const Visibility& seen) { return double(seen.visible) / std::max(1, seen.frames); };
  std::optional<std::string> message;
  for (const auto& [name, visibility] : now) {
    const auto before = before_.find(name);
    if (message || before == before_.end() || share(visibility) >= share(before->second) / 2) continue;
    message = fmt::format("{} is in view in {} of {} frames now, in {} before this change; Undo takes it back", name,
                          visibility.visible, visibility.frames, before->second.visible);
  }
  before_ = std::move(now);
  return message;
}

int ProblemList::count_in(const std::string& block) const {
  const auto found = counts_.find(block);
  return found == counts_.end() ? 0 : found->second;
}

std::optional<std::string> ProblemList::draw(const ViewContext& context) const {
  const std::optional<std::string> problem = draw_list(context, lines_of(by_field_), "problem", color::kBad);
  const std::optional<std::string> warning = draw_list(context, lines_of(warnings_), "warning", color::kPartly);
  std::vector<Problem> guesses;
  if (context.guesses != nullptr) guesses = *context.guesses;
  std::ranges::stable_sort(guesses, [](const Problem& a, const Problem& b) {
    return std::pair(weight_of(a.field), a.field) < std::pair(weight_of(b.field), b.field);
  });
  const std::optional<std::string> guess =
      draw_list(context, guesses, "guessed setting", color::kAccent, Lines::cut, true);
  return problem ? problem : warning ? warning : guess;
}

}  // namespace sigs::editor
