// SPDX-License-Identifier: MIT
#include "editor/views/toasts.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr double kMin_s = 3;
constexpr double kMinError_s = 15;
constexpr double kReading_s = 0.05;  // more for each letter
constexpr std::size_t kMax = 5;

struct Plate {
  ScreenRect rect;
  bool hovered = false;
  bool clicked = false;
};

// One message, as wide as its text needs, standing on the middle of its lower edge.
Plate drawn(const std::string& id, const std::string& text, bool is_error, ImVec2 foot, float maximum_width) {
  const float wrap = maximum_width - scaled(64);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const ImVec2 whole{size.x + scaled(is_error ? 70 : 44), size.y + scaled(18)};
  const ImVec2 p{foot.x - whole.x / 2, foot.y - whole.y};
  ImGui::SetNextWindowPos(p);
  ImGui::SetNextWindowSize(whole);
  ImGui::SetNextWindowBgAlpha(0.97F);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, is_error ? IM_COL32(72, 34, 34, 255) : IM_COL32(50, 54, 64, 255));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(("##toast" + id).c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_icon(list, is_error ? Icon::warning : Icon::info, {p.x + scaled(18), p.y + whole.y / 2}, scaled(15),
            is_error ? color::kBad : color::kAccent);
  list.AddText(nullptr, 0, {p.x + scaled(34), p.y + scaled(9)}, color::kText, text.c_str(), nullptr, wrap);
  if (is_error)
    draw_icon(list, Icon::cross, {p.x + whole.x - scaled(16), p.y + whole.y / 2}, scaled(11), color::kQuiet);
  const bool hovered = ImGui::IsWindowHovered();
  const bool clicked = hovered && ImGui::IsMouseClicked(0);
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return {{{p.x, p.y}, {p.x + whole.x, p.y + whole.y}}, hovered, clicked};
}

}  // namespace

void Toasts::show(const ShowMessage& shown_message, double now_s) {
  const ShowMessage message{shortened(shown_message.text), shown_message.is_error};
  const double min_duration_s = message.is_error ? kMinError_s : kMin_s;
  const double until_s = now_s + min_duration_s + kReading_s * static_cast<double>(message.text.size());
  const auto same = std::find_if(toasts_.begin(), toasts_.end(), [&](const Toast& toast) {
    return toast.text == message.text && toast.is_error == message.is_error;
  });
  if (same != toasts_.end()) {
    same->until_s = until_s;
    ++same->times;
    return;
  }
  toasts_.push_back({message.text, message.is_error, until_s});
  if (toasts_.size() <= kMax) return;
  // Passing ones make room first.
  const auto passing = std::find_if(toasts_.begin(), toasts_.end(), [](const Toast& toast) { return !toast.is_error; });
  toasts_.erase(passing != toasts_.end() ? passing : toasts_.begin());
}

void Toasts::pass(double now_s) {
  std::erase_if(toasts_, [now_s](const Toast& toast) { return now_s > toast.until_s; });
}

void Toasts::draw(UiProbe& ui_probe, double now_s, ImVec2 foot, float width_px) {
  pass(now_s);
  if (toasts_.empty()) return;
  const float maximum_width = std::min(scaled(620), width_px - scaled(40));
  float y = foot.y;
  std::size_t clicked = toasts_.size();
  for (std::size_t i = toasts_.size(); i-- > 0;) {
    Toast& toast = toasts_[i];
    const std::string text = toast.times > 1 ? fmt::format("{}  ({} times)", toast.text, toast.times) : toast.text;
    const Plate plate = drawn(std::to_string(i), text, toast.is_error, {foot.x, y}, maximum_width);
    if (plate.hovered) toast.until_s = std::max(toast.until_s, now_s + 1);
    if (plate.clicked) clicked = i;
    ui_probe.note(fmt::format("toast/{}", i), plate.rect);
    y = static_cast<float>(plate.rect.low.y) - scaled(8);
  }
  if (clicked < toasts_.size()) toasts_.erase(toasts_.begin() + static_cast<std::ptrdiff_t>(clicked));
}

}  // namespace sigs::editor
