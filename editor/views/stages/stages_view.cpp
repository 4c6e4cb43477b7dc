// SPDX-License-Identifier: MIT
#include "editor/views/stages/stages_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr std::array kMethods{MethodChoice::direct, MethodChoice::classic, MethodChoice::plain};
constexpr float kMaxGain = 64;

std::string method_name(MethodChoice method) {
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

std::string name_of_intruder(const ViewContext& context, int in_scene) {
  const std::optional<int> intruder = project_intruder(context, in_scene);
  return intruder ? shortened(context.project().intruders[static_cast<std::size_t>(*intruder)].name, 60)
                  : fmt::format("intruder {}", in_scene);
}

std::string gain_text(double gain) {
  return fmt::format(" x{}", std::lround(gain));
}

// For the longest of its texts and its arrow.
float method_choice_width() {
  return ImGui::CalcTextSize("with classic").x + ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().FramePadding.x;
}

// A list to choose from, with the usual room between its lines; the view itself has none between its images.
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

const cv::Mat* stage_image(const PreviewImage& image, const char* name) {
  for (const Stage& stage : image.stages)
    if (stage_name(stage.name).stage == name) return &stage.image;
  return nullptr;
}

}  // namespace

MethodChoice StagesView::own_method(const ViewContext& context) const {
  return context.project().compositing.method;
}

MethodChoice StagesView::other_method(const ViewContext& context) const {
  const MethodChoice own = own_method(context);
  if (look_ != Mode::against_method) return method_.value_or(own);
  if (method_ && *method_ != own) return *method_;
  return own == MethodChoice::classic ? MethodChoice::direct : MethodChoice::classic;
}

void StagesView::request_preview(const ViewContext& context) {
  context.needs.stages = true;
  const MethodChoice other = other_method(context);
  if (other != own_method(context)) context.needs.compare_with = other;
  if (context.shown.staged) staged_ = context.shown.staged;
  if (context.shown.compared) compared_ = context.shown.compared;
  if (compared_ && compared_->method != other) compared_.reset();
  if (!context.shown.scene) staged_ = compared_ = nullptr;
}

void StagesView::forget() {
  staged_ = compared_ = nullptr;
  differences_ = {};
}

const PreviewImage* StagesView::image_with_stages(const ViewContext& context) const {
  const bool other = look_ != Mode::against_method && other_method(context) != own_method(context);
  return other ? compared_.get() : staged_.get();
}

std::vector<int> StagesView::choices(const ViewContext& context) const {
  const PreviewImage* const image = image_with_stages(context);
  return image != nullptr ? intruders_of(image->stages) : std::vector<int>();
}

std::optional<int> StagesView::intruder(const ViewContext& context) const {
  const std::vector<int> all = choices(context);
  const auto there = [&](std::optional<int> number) { return number && std::ranges::find(all, *number) != all.end(); };
  if (there(intruder_)) return intruder_;
  const std::optional<int> current = current_intruder(context);
  const std::optional<int> worked_on = current ? scene_intruder(context, *current) : std::nullopt;
  if (there(worked_on)) return worked_on;
  return all.empty() ? std::nullopt : std::optional(all.front());
}

std::vector<StageTile> StagesView::input_tiles(const PreviewImage& image) {
  const cv::Mat* const input = stage_image(image, "input1");
  const cv::Mat* const output = stage_image(image, "output");
  if (input == nullptr || output == nullptr) return {};
  return {{"Input 1", "The footage", *input},
          {"Output", "The finished frame", *output},
          {"|Output - Input 1|" + gain_text(gain_), "What compositing changed; black: nothing",
           differences_.of(*output, *input, gain_)}};
}

std::vector<StageTile> StagesView::method_tiles(const ViewContext& context) {
  std::vector<StageTile> tiles;
  if (staged_)
    tiles.push_back({"A: " + method_name(own_method(context)), "By the project's own method", staged_->bgr.whole()});
  const MethodChoice other = other_method(context);
  if (!compared_ || !staged_ || compared_->frame != staged_->frame) return tiles;
  tiles.push_back({"B: " + method_name(other), "The same frame by the other method", compared_->bgr.whole()});
  tiles.push_back({"|A - B|" + gain_text(gain_), "Where the methods differ; black: nowhere",
                   differences_.of(staged_->bgr.whole(), compared_->bgr.whole(), gain_)});
  return tiles;
}

std::vector<StageTile> StagesView::tiles(const ViewContext& context) {
  if (look_ == Mode::against_method) return method_tiles(context);
  const PreviewImage* const image = image_with_stages(context);
  if (image == nullptr) return {};
  if (look_ == Mode::against_input) return input_tiles(*image);
  std::vector<StageTile> made = stage_tiles(image->stages, intruder(context));
  if (made.empty() && !image->bgr.empty()) made.push_back({"Output", "The finished frame", image->bgr.whole()});
  return made;
}

ToolbarItem StagesView::look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look) {
  ToolbarItem item =
      choice_item({.id = label, .label = label, .tooltip = tooltip}, look_, look, [this] { grid_.show_all(); });
  item.drawn = [&context, label] { context.ui_probe.note_item(std::string("stages/") + label); };
  return item;
}

void StagesView::draw_method_choice(const ViewContext& context) {
  const std::string own = "own: " + method_name(own_method(context));
  const bool comparing = look_ == Mode::against_method;
  const std::string shown = comparing ? "with " + method_name(other_method(context))
                            : method_ ? method_name(*method_)
                                      : own;
  ImGui::SetNextItemWidth(method_choice_width());
  const bool open = begin_choice("##method", shown);
  context.ui_probe.note_item("stages/method");
  if (open) {
    if (!comparing && ImGui::Selectable(own.c_str(), other_method(context) == own_method(context))) method_.reset();
    for (const MethodChoice method : kMethods) {
      if (method == own_method(context)) continue;
      if (context.ui_probe.noted(ImGui::Selectable(method_name(method).c_str(), method == other_method(context)),
                                 "stages/method/" + method_name(method)))
        method_ = method;
    }
    end_choice();
  }
  tooltip_for_item(comparing ? "The method to compare the project's own with"
                             : "The method to look at: the project's own, or another; the project stays as it is");
}

void StagesView::draw_intruder_choice(const ViewContext& context) {
  const std::optional<int> chosen = intruder(context);
  ImGui::SetNextItemWidth(scaled(120));
  if (begin_choice("##intruder", chosen ? name_of_intruder(context, *chosen) : "")) {
    for (const int number : choices(context)) {
      ImGui::PushID(number);
      if (ImGui::Selectable(name_of_intruder(context, number).c_str(), chosen == number)) intruder_ = number;
      ImGui::PopID();
    }
    end_choice();
  }
  tooltip_for_item("Whose stages");
}

void StagesView::draw_gain() {
  auto gain = static_cast<float>(gain_);
  ImGui::SetNextItemWidth(scaled(110));
  if (ImGui::SliderFloat("##gain", &gain, 1, kMaxGain, "gain x%.0f",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
    gain_ = std::round(gain);
  tooltip_for_item("How much differences are brightened");
}

void StagesView::zoom_to_intruder(const ViewContext& context) {
  const PreviewImage* const image = image_with_stages(context);
  if (image == nullptr) return;
  const std::optional<int> chosen = intruder(context);
  for (const IntruderTruth& truth : image->truth.intruders) {
    if (chosen && truth.id != *chosen) continue;
    if (!truth.visible_box) continue;
    const cv::Rect& box = *truth.visible_box;
    grid_.show({box.x - 0.5, box.y - 0.5, static_cast<double>(box.width), static_cast<double>(box.height)});
    return;
  }
  context.edits.ask(ShowMessage{"No intruder is visible in this frame.", false});
}

void StagesView::draw_toolbar_of(const ViewContext& context) {
  std::vector<ToolbarItem> items{
      look_button(context, "Stages", "Every image on the way to the finished frame", Mode::stages),
      look_button(context, "Against input", "What compositing changed in the footage", Mode::against_input),
      look_button(context, "Between methods", "The frame by two methods, and where they differ", Mode::against_method),
      {.is_gap = true},
      {.width = method_choice_width(), .content = [&] { draw_method_choice(context); }}};
  if (look_ != Mode::stages) items.push_back({.width = scaled(110), .content = [this] { draw_gain(); }});
  if (look_ == Mode::stages && choices(context).size() > 1)
    items.push_back({.width = scaled(120), .content = [&] { draw_intruder_choice(context); }});
  items.push_back({.is_gap = true});
  items.push_back(
      {.button = {.id = "to intruder", .icon = Icon::target, .label = "To intruder", .tooltip = "Zoom to the intruder"},
       .clicked = [&] { zoom_to_intruder(context); }});
  add_zoom_items(items, {.is_fitted = grid_.look().is_fitted(),
                         .zoom = grid_.look().zoom(),
                         .fit = [this] { grid_.fit(); },
                         .to_exact = [this] { grid_.zoom_to_exact(); }});
  draw_toolbar(items);
}

void StagesView::draw_notice(const ViewContext& context, const ScreenRect& rect) const {
  const PreviewImage* const image = image_with_stages(context);
  std::string text;
  if (image == nullptr)
    text = context.shown.scene ? "Making the stages..." : "Opening the project...";
  else if (!image->problem.empty())
    text = image->problem;
  else if ((image == staged_.get() ? context.shown.staged : context.shown.compared) == nullptr)
    text = "updating...";
  else if (look_ == Mode::stages && stage_image(*image, "warped") == nullptr &&
           stage_image(*image, "input2") == nullptr)
    text = "No intruder can be seen in this frame: the output is the footage.";
  if (text.empty()) context.ui_probe.note("stages/ready", rect);
  if (text.empty()) return;
  draw_corner_label({*ImGui::GetWindowDrawList(), rect, {}, {}}, text, color::kPartly);
}

void StagesView::draw(const ViewContext& context) {
  ImGui::PushID("stages");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  request_preview(context);
  draw_toolbar_of(context);
  const glm::dvec2 low = glm::round(dv(ImGui::GetCursorScreenPos()));
  const ScreenRect rect{low, low + glm::max(glm::floor(dv(ImGui::GetContentRegionAvail())), 1.0)};
  const std::vector<StageTile> shown = tiles(context);
  const PreviewImage* const image = image_with_stages(context);
  if (!shown.empty() && grid_.handle_escape()) context.needs.own_escape = true;
  if (!shown.empty() && image != nullptr) grid_.draw(shown, image->bgr.size(), rect, context.textures);
  draw_notice(context, rect);
  ImGui::PopStyleVar();
  ImGui::PopID();
}

}  // namespace sigs::editor
