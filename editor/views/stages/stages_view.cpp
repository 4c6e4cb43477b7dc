// SPDX-License-Identifier: MIT
#include "editor/views/stages/stages_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/views/viewport/footage_eye.h"
#include "editor/views/viewport/picture_icons.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr std::array kMethods{MethodChoice::direct, MethodChoice::classic, MethodChoice::plain};
constexpr float kMostGain = 64;

std::string name_of(MethodChoice method) {
  switch (method) {
    case MethodChoice::direct:
      return "direct";
    case MethodChoice::classic:
      return "classic";
    case MethodChoice::plain:
      return "plain";
  }
  return "";
}

std::string name_of_intruder(const Studio& studio, int in_scene) {
  const std::optional<int> intruder = project_intruder(studio, in_scene);
  return intruder ? shortened(studio.project().intruders[static_cast<std::size_t>(*intruder)].name, 60)
                  : "intruder " + std::to_string(in_scene);
}

std::string gain_text(double gain) {
  return " x" + std::to_string(std::lround(gain));
}

// For the longest of its texts and its arrow.
float method_choice_width() {
  return ImGui::CalcTextSize("with classic").x + ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().FramePadding.x;
}

// A list to choose from, with the usual room between its lines; the view itself has none between its pictures.
bool begin_choice(const char* id, const std::string& shown) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(6)});
  const bool open = ImGui::BeginCombo(id, shown.c_str());
  if (!open) ImGui::PopStyleVar();
  return open;
}

void end_choice() {
  ImGui::EndCombo();
  ImGui::PopStyleVar();
}

const cv::Mat* stage_picture(const Picture& picture, const char* name) {
  for (const Stage& stage : picture.stages)
    if (stage_name(stage.name).stage == name) return &stage.picture;
  return nullptr;
}

}  // namespace

MethodChoice StagesView::own_method(const Studio& studio) const {
  return studio.project().compositing.method;
}

MethodChoice StagesView::other_method(const Studio& studio) const {
  const MethodChoice own = own_method(studio);
  if (look_ != Look::against_method) return method_.value_or(own);
  if (method_ && *method_ != own) return *method_;
  return own == MethodChoice::classic ? MethodChoice::direct : MethodChoice::classic;
}

void StagesView::wish(const Studio& studio) {
  studio.wishes.stages = true;
  const MethodChoice other = other_method(studio);
  if (other != own_method(studio)) studio.wishes.compare_with = other;
  if (studio.shown.staged) staged_ = studio.shown.staged;
  if (studio.shown.compared) compared_ = studio.shown.compared;
  if (compared_ && compared_->method != other) compared_.reset();
  if (!studio.shown.scene) staged_ = compared_ = nullptr;
}

void StagesView::forget() {
  staged_ = compared_ = nullptr;
  differences_ = {};
}

const Picture* StagesView::looked_at(const Studio& studio) const {
  const bool other = look_ != Look::against_method && other_method(studio) != own_method(studio);
  return other ? compared_.get() : staged_.get();
}

std::vector<int> StagesView::choices(const Studio& studio) const {
  const Picture* const picture = looked_at(studio);
  return picture != nullptr ? intruders_of(picture->stages) : std::vector<int>();
}

std::optional<int> StagesView::intruder(const Studio& studio) const {
  const std::vector<int> all = choices(studio);
  const auto there = [&](std::optional<int> number) {
    return number && std::find(all.begin(), all.end(), *number) != all.end();
  };
  if (there(intruder_)) return intruder_;
  const std::optional<int> current = current_intruder(studio);
  const std::optional<int> worked_on = current ? scene_intruder(studio, *current) : std::nullopt;
  if (there(worked_on)) return worked_on;
  return all.empty() ? std::nullopt : std::optional(all.front());
}

std::vector<StageTile> StagesView::input_tiles(const Picture& picture) {
  const cv::Mat* const input = stage_picture(picture, "input1");
  const cv::Mat* const output = stage_picture(picture, "output");
  if (input == nullptr || output == nullptr) return {};
  return {{"Input 1", "The footage", *input},
          {"Output", "The finished frame", *output},
          {"|Output - Input 1|" + gain_text(gain_), "What compositing changed; black: nothing",
           differences_.of(*output, *input, gain_)}};
}

std::vector<StageTile> StagesView::method_tiles(const Studio& studio) {
  std::vector<StageTile> tiles;
  if (staged_) tiles.push_back({"A: " + name_of(own_method(studio)), "By the project's own method", staged_->bgr});
  const MethodChoice other = other_method(studio);
  if (!compared_ || !staged_ || compared_->frame != staged_->frame) return tiles;
  tiles.push_back({"B: " + name_of(other), "The same frame by the other method", compared_->bgr});
  tiles.push_back({"|A - B|" + gain_text(gain_), "Where the methods differ; black: nowhere",
                   differences_.of(staged_->bgr, compared_->bgr, gain_)});
  return tiles;
}

std::vector<StageTile> StagesView::tiles(const Studio& studio) {
  if (look_ == Look::against_method) return method_tiles(studio);
  const Picture* const picture = looked_at(studio);
  if (picture == nullptr) return {};
  if (look_ == Look::against_input) return input_tiles(*picture);
  std::vector<StageTile> made = stage_tiles(picture->stages, intruder(studio));
  if (made.empty() && !picture->bgr.empty()) made.push_back({"Output", "The finished frame", picture->bgr});
  return made;
}

ToolbarItem StagesView::look_button(const char* label, const char* tooltip, Look look) {
  return {.button = {.id = label, .label = label, .tooltip = tooltip, .on = look_ == look}, .clicked = [this, look] {
            look_ = look;
            grid_.show_all();
          }};
}

std::string StagesView::own_label(const Studio& studio) const {
  return "own: " + name_of(own_method(studio));
}

void StagesView::draw_method_choice(const Studio& studio) {
  const std::string own = own_label(studio);
  const bool comparing = look_ == Look::against_method;
  const std::string shown = comparing ? "with " + name_of(other_method(studio)) : method_ ? name_of(*method_) : own;
  ImGui::SetNextItemWidth(method_choice_width());
  const bool open = begin_choice("##method", shown);
  studio.places.note_item("stages/method");
  if (open) {
    if (!comparing && ImGui::Selectable(own.c_str(), other_method(studio) == own_method(studio))) method_.reset();
    for (const MethodChoice method : kMethods) {
      if (method == own_method(studio)) continue;
      if (ImGui::Selectable(name_of(method).c_str(), method == other_method(studio))) method_ = method;
      studio.places.note_item("stages/method/" + name_of(method));
    }
    end_choice();
  }
  tooltip_for_item(comparing ? "The method to compare the project's own with"
                             : "The method to look at: the project's own, or another; the project stays as it is");
}

void StagesView::draw_intruder_choice(const Studio& studio) {
  const std::optional<int> chosen = intruder(studio);
  ImGui::SetNextItemWidth(scaled(120));
  if (begin_choice("##intruder", chosen ? name_of_intruder(studio, *chosen) : "")) {
    for (const int number : choices(studio)) {
      ImGui::PushID(number);
      if (ImGui::Selectable(name_of_intruder(studio, number).c_str(), chosen == number)) intruder_ = number;
      ImGui::PopID();
    }
    end_choice();
  }
  tooltip_for_item("Whose stages");
}

void StagesView::draw_gain() {
  auto gain = static_cast<float>(gain_);
  ImGui::SetNextItemWidth(scaled(110));
  if (ImGui::SliderFloat("##gain", &gain, 1, kMostGain, "gain x%.0f",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
    gain_ = std::round(gain);
  tooltip_for_item("How much differences are brightened");
}

void StagesView::zoom_to_intruder(const Studio& studio) {
  const Picture* const picture = looked_at(studio);
  if (picture == nullptr) return;
  const std::optional<int> chosen = intruder(studio);
  for (const IntruderTruth& truth : picture->truth.intruders) {
    if (chosen && truth.id != *chosen) continue;
    if (!truth.box) continue;
    const cv::Rect& box = *truth.box;
    grid_.show({box.x - 0.5, box.y - 0.5, static_cast<double>(box.width), static_cast<double>(box.height)});
    return;
  }
  studio.edits.ask(Say{"No intruder is visible in this frame.", false});
}

void StagesView::draw_toolbar_of(const Studio& studio) {
  std::vector<ToolbarItem> items{
      look_button("Stages", "Every picture on the way to the finished frame", Look::stages),
      look_button("Against input", "What compositing changed in the footage", Look::against_input),
      look_button("Between methods", "The frame by two methods, and where they differ", Look::against_method),
      {.is_gap = true},
      {.width = method_choice_width(), .content = [&] { draw_method_choice(studio); }}};
  if (look_ != Look::stages) items.push_back({.width = scaled(110), .content = [this] { draw_gain(); }});
  if (look_ == Look::stages && choices(studio).size() > 1)
    items.push_back({.width = scaled(120), .content = [&] { draw_intruder_choice(studio); }});
  items.push_back({.is_gap = true});
  items.push_back({.button = {.id = "to intruder",
                              .icon = picture_icon::target,
                              .label = "To intruder",
                              .tooltip = "Zoom to the intruder"},
                   .clicked = [&] { zoom_to_intruder(studio); }});
  items.push_back({.button = {.id = "fit",
                              .icon = picture_icon::fit,
                              .label = "Fit",
                              .tooltip = "The whole picture (F or 0)",
                              .on = grid_.look().is_fitted()},
                   .clicked = [this] { grid_.fit(); }});
  items.push_back({.button = {.id = "exact",
                              .label = "1:1",
                              .tooltip = "One pixel of the screen for each of the picture (1)",
                              .on = grid_.look().zoom() == 1},
                   .clicked = [this] { grid_.zoom_to_exact(); }});
  draw_toolbar(items);
}

void StagesView::draw_notice(const Studio& studio, const ScreenRect& rect) const {
  const Picture* const picture = looked_at(studio);
  std::string text;
  if (picture == nullptr)
    text = studio.shown.scene ? "Making the stages..." : "Opening the project...";
  else if (!picture->problem.empty())
    text = picture->problem;
  else if (picture->frame != studio.document.playhead() || picture->revision != studio.document.revision().number)
    text = "updating...";
  else if (look_ == Look::stages && stage_picture(*picture, "bent") == nullptr &&
           stage_picture(*picture, "input2") == nullptr)
    text = "No intruder can be seen in this frame: the output is the footage.";
  if (text.empty()) studio.places.note("stages/ready", rect);
  if (text.empty()) return;
  PictureCanvas canvas{*ImGui::GetWindowDrawList(), rect, {}, {}};
  draw_label(canvas, {rect.low.x + scaled(8), rect.high.y - scaled(8)}, text, color::kPartly);
}

void StagesView::draw(const Studio& studio) {
  ImGui::PushID("stages");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  wish(studio);
  draw_toolbar_of(studio);
  const glm::dvec2 low = glm::round(dv(ImGui::GetCursorScreenPos()));
  const ScreenRect rect{low, low + glm::max(glm::floor(dv(ImGui::GetContentRegionAvail())), 1.0)};
  const std::vector<StageTile> shown = tiles(studio);
  const Picture* const picture = looked_at(studio);
  if (!shown.empty() && grid_.take_escape()) studio.wishes.own_escape = true;
  if (!shown.empty() && picture != nullptr) grid_.draw(shown, picture->bgr.size(), rect, studio.textures);
  draw_notice(studio, rect);
  ImGui::PopStyleVar();
  ImGui::PopID();
}

}  // namespace sigs::editor
