// SPDX-License-Identifier: MIT
#include "editor/views/dialogs.h"

#include <fmt/format.h>

#include <algorithm>

#include "camera/camera.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

void close_row(UiProbe& ui_probe, bool& closed) {
  ImGui::Dummy({0, scaled(6)});
  align_buttons_right({"Close"});
  if (ui_probe.noted(dialog_button("Close", true), "dialog/Close")) closed = true;
}

void draw_help_group(std::span<const HelpLine> lines, std::size_t& i) {
  const std::string& group = lines[i].group;
  draw_text(group, color::kText, Font::bold);
  if (ImGui::BeginTable(group.c_str(), 2)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 1.1F);
    for (; i < lines.size() && lines[i].group == group; ++i) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      draw_wrapped(lines[i].keys, color::kAccent);
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", lines[i].what.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::Dummy({0, scaled(6)});
}

namespace fs = std::filesystem;

void colored_text(ImU32 color, const std::string& text) {
  draw_text(elided(text, ImGui::GetContentRegionAvail().x), color);
  tooltip_for_item(text.c_str());
}

constexpr double kMin_s = 3;
constexpr double kMinError_s = 15;
constexpr double kReading_s = 0.05;  // more for each letter
constexpr std::size_t kMaxToasts = 5;

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

std::optional<int> draw_question(const Question& question, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog((question.title + "###question").c_str(), 460, 0, closed)) return std::nullopt;
  std::optional<int> answer;
  ImGui::Dummy({0, scaled(4)});
  ImGui::TextWrapped("%s", shortened(question.text).c_str());
  ImGui::Dummy({0, scaled(10)});
  // As on other desktops: what changes nothing comes first, the usual answer last.
  std::vector<const char*> labels;
  for (std::size_t i = question.answers.size(); i-- > 0;) labels.push_back(question.answers[i].c_str());
  align_buttons_right(labels);
  for (std::size_t i = question.answers.size(); i-- > 0;) {
    if (ui_probe.noted(dialog_button(question.answers[i].c_str(), i == 0), "question/" + question.answers[i]))
      answer = static_cast<int>(i);
    if (i > 0) ImGui::SameLine();
  }
  if (enter_pressed()) answer = 0;
  if (closed) answer = static_cast<int>(question.answers.size()) - 1;
  end_dialog(!answer);
  return answer;
}

bool draw_help(std::span<const HelpLine> lines, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog("Keys###help", 860, 560, closed)) return !closed;
  const float bottom = dialog_buttons_height();
  const bool wide = ImGui::GetContentRegionAvail().x > scaled(560);
  ImGui::BeginChild("lines", {0, ImGui::GetContentRegionAvail().y - bottom});
  if (ImGui::BeginTable("halves", wide ? 2 : 1)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool second = !wide;
    for (std::size_t i = 0; i < lines.size();) {
      if (!second && i >= (lines.size() + 1) / 2) {
        ImGui::TableNextColumn();
        second = true;
      }
      draw_help_group(lines, i);
    }
    ImGui::EndTable();
  }
  ImGui::EndChild();
  close_row(ui_probe, closed);
  end_dialog(!closed);
  return !closed;
}

bool draw_about(const std::string& version, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog("About###about", 420, 0, closed)) return !closed;
  draw_text("SIGS", color::kText, Font::title);
  ImGui::TextDisabled("Version %s", version.c_str());
  ImGui::Dummy({0, scaled(4)});
  ImGui::TextWrapped(
      "Puts simulated intruder aircraft into real footage from unmanned aircraft, through the camera's own lens, and "
      "writes the exact ground truth next to it.");
  ImGui::Dummy({0, scaled(4)});
  ImGui::TextDisabled("MIT licence");
  close_row(ui_probe, closed);
  end_dialog(!closed);
  return !closed;
}

bool SettingsDialog::draw(Settings& settings, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog("Settings###settings", 480, 0, closed)) return !closed;
  if (ImGui::BeginTable("settings", 2)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.2F);
    begin_setting("Size of the text", "Everything else follows it");
    ImGui::SetNextItemWidth(-1);
    auto font_px = static_cast<int>(font_px_ > 0 ? font_px_ : settings.font_px);
    if (ui_probe.noted(ImGui::SliderInt("##font", &font_px, static_cast<int>(kMinFont_px),
                                        static_cast<int>(kMaxFont_px), "%d px", ImGuiSliderFlags_AlwaysClamp),
                       "settings/font"))
      font_px_ = font_px;
    if (ImGui::IsItemDeactivatedAfterEdit() && font_px_ > 0) settings.font_px = font_px_;
    if (!ImGui::IsItemActive()) font_px_ = 0;
    begin_setting("Keep unsaved changes after",
                  "Seconds after a change until it is kept on disk for the case of a crash");
    ImGui::SetNextItemWidth(-1);
    auto autosave_s = static_cast<float>(settings.autosave_s);
    if (ui_probe.noted(ImGui::SliderFloat("##autosave", &autosave_s, 1, 300, "%.0f s",
                                          ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic),
                       "settings/autosave"))
      settings.autosave_s = autosave_s;
    begin_setting("Playing starts again at the end", "Loop over the range between in and out");
    ImGui::Checkbox("##loop", &settings.loop);
    ui_probe.note_item("settings/loop");
    ImGui::EndTable();
  }
  close_row(ui_probe, closed);
  end_dialog(!closed);
  return !closed;
}

void RelinkDialog::open(const Project& project) {
  missing_ = missing_files(project);
  places_.clear();
  suggested_.clear();
  open_ = true;
}

void RelinkDialog::found(const MissingFile& missing, const fs::path& place) {
  places_[missing.field] = place;
  for (const Relinked& other : suggested_places(missing_, missing, place)) suggested_[other.field] = other.place;
}

void RelinkDialog::browse(const ViewContext& context, const MissingFile& missing) {
  const bool is_calibration = missing.field.ends_with("footage.calibration");
  const fs::path file = is_calibration ? calibration_name(missing.place).file : missing.place;
  const std::string extension = file.extension().string();
  context.edits.ask(
      AskForFile{.title = fmt::format("Where is {}?", file.filename().string()),
                 .extensions = extension.empty() ? std::vector<std::string>() : std::vector{extension},
                 .of_folder = extension.empty() && missing.field.ends_with("footage.video"),
                 .start = missing.place.parent_path(),
                 .chosen = [this, missing](const fs::path& place) { found(missing, place_at(missing, place)); }});
}

void RelinkDialog::draw_rows(const ViewContext& context) {
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    const MissingFile& missing = missing_[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    colored_text(color::kText, missing.path);
    colored_text(color::kQuiet, missing.field);
    ImGui::TableNextColumn();
    const auto place = places_.find(missing.field);
    const auto suggested = suggested_.find(missing.field);
    if (place != places_.end())
      colored_text(color::kGood, place->second.string());
    else if (suggested != suggested_.end())
      colored_text(color::kPartly, "perhaps " + suggested->second.string());
    else
      colored_text(color::kBad, "missing");
    ImGui::TableNextColumn();
    if (context.ui_probe.noted(dialog_button("Browse..."), "relink/browse." + missing.field)) browse(context, missing);
    ImGui::PopID();
  }
}

void RelinkDialog::draw(const ViewContext& context) {
  bool closed = false;
  if (!begin_dialog("Missing files###relink", 760, 420, closed)) {
    open_ = open_ && !closed;
    return;
  }
  ImGui::TextWrapped("%s", missing_.empty() ? "All files that the project names are there."
                                            : "These files are not where the project says. Show where one of them is; "
                                              "the others are looked for near it.");
  const float bottom = dialog_buttons_height();
  const float height = std::max(scaled(60), ImGui::GetContentRegionAvail().y - bottom);
  if (ImGui::BeginTable("missing", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) {
    ImGui::TableSetupColumn("file", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("place", ImGuiTableColumnFlags_WidthStretch, 1.2F);
    ImGui::TableSetupColumn("browse", ImGuiTableColumnFlags_WidthFixed, dialog_button_width("Browse..."));
    draw_rows(context);
    ImGui::EndTable();
  }
  const bool has_suggestions =
      std::ranges::any_of(suggested_, [this](const auto& item) { return !places_.contains(item.first); });
  align_buttons_right({"Use suggestions", "Cancel", "Use these"});
  if (context.ui_probe.noted(dialog_button("Use suggestions", false, has_suggestions), "relink/suggestions"))
    places_.insert(suggested_.begin(), suggested_.end());
  ImGui::SameLine();
  if (dialog_button("Cancel")) closed = true;
  ImGui::SameLine();
  if (context.ui_probe.noted(dialog_button("Use these", true, !places_.empty()), "relink/apply")) {
    std::vector<Relinked> places;
    for (const auto& [field, place] : places_) places.push_back({field, place});
    context.edits.change_whole("find missing files", [places](Project& project) { relink(project, places); });
    closed = true;
  }
  open_ = !closed;
  end_dialog(open_);
}

void Toasts::show(const ShowMessage& shown_message, double now_s) {
  const ShowMessage message{shortened(shown_message.text), shown_message.is_error};
  const double min_duration_s = message.is_error ? kMinError_s : kMin_s;
  const double until_s = now_s + min_duration_s + kReading_s * static_cast<double>(message.text.size());
  const auto same = std::ranges::find_if(
      toasts_, [&](const Toast& toast) { return toast.text == message.text && toast.is_error == message.is_error; });
  if (same != toasts_.end()) {
    same->until_s = until_s;
    ++same->times;
    return;
  }
  toasts_.push_back({message.text, message.is_error, until_s});
  if (toasts_.size() <= kMaxToasts) return;
  // Passing ones make room first.
  const auto passing = std::ranges::find_if(toasts_, [](const Toast& toast) { return !toast.is_error; });
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
