// SPDX-License-Identifier: MIT
#include "editor/views/inspector/field_rows.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/geometry/rulers.h"

namespace sigs::editor {

namespace {

// What is set as finely far from zero as near it.
struct FineField {
  std::string_view key;
  double step;  // a pixel of dragging
  const char* format;
};
constexpr std::array<FineField, 3> kFineFields{{{"camera.track.offset_s", 0.002, "%.3f s"},
                                                {"geo.latitude_deg", 1e-5, "%.7f\u00b0"},
                                                {"geo.longitude_deg", 1e-5, "%.7f\u00b0"}}};

double min_step(const Field& field) {
  constexpr std::array<std::pair<std::string_view, double>, 5> kSteps{
      {{"m", 0.1}, {"deg", 0.1}, {"m/s", 0.05}, {"px/m", 1e-5}, {"frame", 0.2}}};
  for (const auto& [unit, step] : kSteps)
    if (field.unit == unit) return step;
  return std::holds_alternative<int*>(field.value) ? 0.05 : 0.005;
}

// How much a number changes a pixel of dragging: a half percent of it, or what suits its unit where it is near zero.
double drag_step(double value, const Field& field) {
  for (const FineField& fine : kFineFields)
    if (field.key == fine.key) return fine.step;
  const double share = std::abs(value) * 0.005;
  const bool has_no_zero = field.minimum > 0 && share > 0;
  return round_step(has_no_zero ? share : std::max(share, min_step(field)));
}

// Whole frames as whole numbers, so that dragging keeps to them.
std::string format_of(double value, const Field& field) {
  for (const FineField& fine : kFineFields)
    if (field.key == fine.key) return fine.format;
  const bool is_whole = field.unit == "frame" && value == std::round(value);
  return is_whole ? "%.0f" : number_format(value, field.unit);
}

bool number_input(const char* id, int& value, const Field& field, float width, Typing& typing) {
  const auto low = static_cast<int>(std::max(field.minimum, -1e9));
  const auto high = static_cast<int>(std::min(field.maximum, 1e9));
  ImGui::SetNextItemWidth(width);
  const auto step = static_cast<float>(std::min(drag_step(value, field), 1.0));
  const bool is_changed = ImGui::DragInt(id, &value, step, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  double number = value;
  const bool is_new = takes_effect(is_changed, number, typing);
  value = static_cast<int>(number);
  return is_new;
}

// Over a number that is 0 and means something else, while it is not changed.
void cover_with_word(const std::string& word) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  const ImVec2 size = ImGui::CalcTextSize(word.c_str());
  const ImGuiCol frame = ImGui::IsItemHovered() ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_PopupBg), ImGui::GetStyle().FrameRounding);
  list.AddRectFilled(low, high, ImGui::GetColorU32(frame), ImGui::GetStyle().FrameRounding);
  list.AddText({std::round((low.x + high.x - size.x) / 2), std::round((low.y + high.y - size.y) / 2)},
               ImGui::GetColorU32(ImGuiCol_Text), word.c_str());
}

// Over the item before, while nothing is typed there.
void cover_with_end_of(const std::string& path) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  const std::string shown = elided_front(path, high.x - low.x - 2 * padding.x);
  if (shown == path) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_PopupBg), ImGui::GetStyle().FrameRounding);
  list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
  list.AddText({low.x + padding.x, low.y + padding.y}, ImGui::GetColorU32(ImGuiCol_Text), shown.c_str());
}

std::optional<Edited> typed_text_input(const std::string& value, const Field& field, float width, Typing& typing) {
  const bool was_typed = typing.key == field.key;
  std::string text = was_typed ? typing.text : value;
  ImGui::SetNextItemWidth(width);
  text_input("##text", text, field.required ? "required" : "none");
  // The keyboard can be taken away between two updates too: by the window that is to be closed.
  const bool is_left = ImGui::IsItemDeactivated() || (was_typed && !ImGui::IsItemActive());
  const bool is_finished = is_left && (was_typed || ImGui::IsItemDeactivatedAfterEdit());
  if (ImGui::IsItemActive()) typing = {field.key, text};
  if (is_left) typing = {};
  if (field.is_path && !ImGui::IsItemActive()) cover_with_end_of(text);
  if (is_finished && text != value) return Edited{text, true};
  return std::nullopt;
}

template <class Names>
std::optional<int> combo(const Names& names, int chosen, const std::string& shown, float width) {
  std::optional<int> taken;
  ImGui::SetNextItemWidth(width);
  if (!ImGui::BeginCombo("##names", elided(shown, width).c_str())) return taken;
  for (int i = 0; i < static_cast<int>(names.size()); ++i)
    if (ImGui::Selectable(shortened(with_spaces(names[static_cast<std::size_t>(i)])).c_str(), i == chosen)) taken = i;
  ImGui::EndCombo();
  return taken;
}

std::optional<Edited> named_text_input(const std::string& value, const RowOptions& look, float width) {
  const auto found = std::ranges::find(look.names, value);
  const std::optional<int> taken = combo(look.names, static_cast<int>(found - look.names.begin()), value, width);
  if (!taken) return std::nullopt;
  return Edited{look.names[static_cast<std::size_t>(*taken)], true};
}

bool color_input(glm::dvec3& value, float width) {
  std::array<float, 3> color{static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
  const std::array<float, 3> before = color;
  ImGui::SetNextItemWidth(width);
  ImGui::ColorEdit3("##color", color.data(), ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_Float);
  for (int i = 0; i < 3; ++i)
    if (color[static_cast<std::size_t>(i)] != before[static_cast<std::size_t>(i)])
      value[i] = std::round(static_cast<double>(color[static_cast<std::size_t>(i)]) * 1e4) / 1e4;
  return color != before;
}

// A box for each name that is usual or chosen.
std::optional<Edited> list_input(const std::vector<std::string>& values, const RowOptions& look) {
  std::vector<std::string> names = look.names;
  for (const std::string& value : values)
    if (std::ranges::find(names, value) == names.end()) names.push_back(value);
  std::optional<Edited> edited;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(values, name);
    bool is_chosen = found != values.end();
    if (!ImGui::Checkbox(shortened(name, 200).c_str(), &is_chosen)) continue;
    std::vector<std::string> changed = values;
    if (is_chosen)
      changed.push_back(name);
    else
      changed.erase(changed.begin() + (found - values.begin()));
    edited = Edited{changed, true};
  }
  return edited;
}

// Below each other where there is no room side by side.
bool vector_input(glm::dvec3& value, const Field& field, float width, Typing& typing) {
  constexpr std::array<const char*, 3> kIds{"##X", "##Y", "##Z"};
  const float gap = scaled(4);
  const bool side_by_side = (width - 2 * gap) / 3 >= scaled(64);
  const float each = side_by_side ? std::floor((width - 2 * gap) / 3) : width;
  Field part = field;
  if (side_by_side && each < scaled(110)) part.unit = field.unit == "m" ? "" : field.unit;  // the label has it
  bool has_changed = false;
  for (int i = 0; i < 3; ++i) {
    if (side_by_side && i > 0) ImGui::SameLine(0, gap);
    const auto axis = static_cast<std::size_t>(i);
    has_changed |= number_input(kIds[axis], value[i], part, each, typing);
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + scaled(3), high.y}, color::kAxes[axis], scaled(2),
                                              ImDrawFlags_RoundCornersLeft);
  }
  return has_changed;
}

struct Input {
  const Field& field;
  const RowOptions& look;
  float width;
  Typing& typing;

  template <class Number>
  std::optional<Edited> number(Number value) const {
    const std::string word = value == 0 ? word_for_zero(field.key) : "";
    const bool is_changed = number_input("##number", value, field, width, typing);
    if (!word.empty() && !ImGui::IsItemActive()) cover_with_word(word);
    if (!is_changed) return std::nullopt;
    return Edited{value};
  }
  std::optional<Edited> operator()(double* place) const { return number(*place); }
  std::optional<Edited> operator()(int* place) const { return number(*place); }

  template <class Number>
  std::optional<Edited> operator()(std::optional<Number>* place) const {
    std::optional<Number> value = *place;
    bool is_given = value.has_value();
    if (ImGui::Checkbox("##given", &is_given))
      return Edited{is_given ? std::optional<Number>(static_cast<Number>(look.suggested.value_or(0))) : std::nullopt,
                    true};
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    const float room = width - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemInnerSpacing.x;
    if (!value) {
      ImGui::AlignTextToFramePadding();
      ImGui::TextDisabled("%s", value_text(field, PlainValue(std::optional<Number>())).c_str());
      return std::nullopt;
    }
    if (!number_input("##number", *value, field, room, typing)) return std::nullopt;
    return Edited{value};
  }

  std::optional<Edited> operator()(std::string* place) const {
    return look.names.empty() ? typed_text_input(*place, field, width, typing) : named_text_input(*place, look, width);
  }
  std::optional<Edited> operator()(glm::dvec3* place) const {
    glm::dvec3 value = *place;
    if (!(look.is_color ? color_input(value, width) : vector_input(value, field, width, typing))) return std::nullopt;
    return Edited{value};
  }
  std::optional<Edited> operator()(std::vector<std::string>* place) const { return list_input(*place, look); }
  std::optional<Edited> operator()(const Choice& choice) const {
    const int chosen = choice.get();
    const std::optional<int> taken = combo(choice.names, chosen, value_text(field, ChosenName{chosen}), width);
    if (!taken) return std::nullopt;
    return Edited{ChosenName{*taken}, true};
  }
};

}  // namespace

std::optional<Edited> field_input(const Field& field, const RowOptions& look, float width, Typing& typing) {
  return std::visit(Input{field, look, width, typing}, field.value);
}

bool takes_effect(bool is_changed, double& value, Typing& typing) {
  const ImGuiID item = ImGui::GetItemID();
  const bool was_typed = typing.item == item;
  if (ImGui::TempInputIsActive(item)) {
    if (is_changed || was_typed)
      typing = is_changed ? Typing{.key = {}, .text = {}, .item = item, .number = value} : Typing();
    return false;
  }
  if (!was_typed) return is_changed;
  if (!is_changed) value = typing.number;  // the keyboard went elsewhere between two updates
  typing = {};
  return !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

bool number_input(const char* id, double& value, const Field& field, float width, Typing& typing) {
  const std::string format = format_of(value, field);
  ImGui::SetNextItemWidth(width);
  const bool is_changed = ImGui::DragScalar(
      id, ImGuiDataType_Double, &value, static_cast<float>(drag_step(value, field)),
      std::isfinite(field.minimum) ? &field.minimum : nullptr, std::isfinite(field.maximum) ? &field.maximum : nullptr,
      format.c_str(), ImGuiSliderFlags_AlwaysClamp);
  return takes_effect(is_changed, value, typing);
}

}  // namespace sigs::editor
