// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_panel.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "editor/views/export_parts.h"
#include "editor/views/inspector/field_rows.h"
#include "editor/views/own_body/own_body_pictures.h"
#include "editor/widgets/dialog.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

void heading(const char* text) {
  ImGui::Dummy({0, scaled(4)});
  ImGui::PushFont(font(Font::bold));
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

// As wide as the panel.
bool wide_button(const char* label, bool is_main, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  if (is_main) {
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(40, 98, 165, 255));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(52, 118, 194, 255));
  }
  const bool clicked = ImGui::Button(label, {-1, scaled(28)});
  if (is_main) ImGui::PopStyleColor(2);
  ImGui::EndDisabled();
  return clicked;
}

bool has_footage(const Studio& studio) {
  return studio.shown.scene && studio.shown.scene->footage->video.has_value();
}

// How much of the footage that is.
std::string frames_text(const Studio& studio) {
  const OwnBodySettings& settings = studio.project().own_body;
  const auto there = static_cast<int>(studio.shown.scene->footage->shape.times_s.size());
  const int first = std::clamp(studio.project().footage.first_frame, 0, std::max(0, there - 1));
  const int passed = std::min(settings.frames, there - first);
  if (passed < 1) return "";
  const int used = (passed - 1) / std::max(1, settings.every) + 1;
  std::string text = "Frames " + std::to_string(first) + " to " + std::to_string(first + passed - 1);
  if (used != passed) text += ", " + std::to_string(used) + " of them used";
  return text;
}

}  // namespace

void OwnBodyPanel::draw_settings(const Studio& studio) {
  if (!sheet_ || sheet_revision_ != studio.document.revision().number) {
    sheet_.emplace(studio.project());
    sheet_revision_ = studio.document.revision().number;
  }
  problems_.refresh(studio);
  FieldRows rows(studio, *sheet_, problems_.by_field(), memory_, "own body/");
  const std::string own =
      studio.project().own_body.method == OwnBodyMethod::paper ? "own_body.paper." : "own_body.stable.";
  for (const Field& field : sheet_->fields()) {
    const bool is_of_a_method = field.key.starts_with("own_body.paper.") || field.key.starts_with("own_body.stable.");
    if (field.key.starts_with("own_body.") && (!is_of_a_method || field.key.starts_with(own))) rows.row(field.key);
  }
  rows.finish();
}

void OwnBodyPanel::draw_running(const Studio& studio, OwnBodyWork& work) const {
  const DetectionState& state = work.detection();
  const double share = state.total > 0 ? double(state.done) / state.total : 0;
  ImGui::ProgressBar(static_cast<float>(share), {-1, scaled(10)}, "");
  note(progress_text(state));
  studio.places.note_item("own body/progress");
  if (wide_button("Stop", false, !state.is_stopping)) work.job().cancel();
  studio.places.note_item("own body/stop");
}

void OwnBodyPanel::draw_detection(const Studio& studio, OwnBodyWork& work) const {
  const DetectionState& state = work.detection();
  if (state.is_running()) {
    draw_running(studio, work);
    return;
  }
  if (has_footage(studio)) note(frames_text(studio));
  if (wide_button("Detect", true, has_footage(studio))) work.start(studio.document);
  studio.places.note_item("own body/detect");
  if (!has_footage(studio)) note("The footage cannot be read: choose a video in the inspector.", true);
  if (state.phase == DetectionPhase::failed) {
    note_line(Icon::warning, color::kBad, state.error.what);
    studio.places.note_item("own body/failed");
  }
  if (state.phase == DetectionPhase::cancelled) {
    note("Stopped.");
    studio.places.note_item("own body/stopped");
  }
  if (!state.found) return;
  if (state.phase == DetectionPhase::done) {
    note_line(Icon::check, color::kGood, result_text(*state.found));
    studio.places.note_item("own body/found");
  } else {
    note("Before: " + result_text(*state.found));
  }
  for (const Warning& warning : state.found->warnings) note(warning.text(), true);
}

void OwnBodyPanel::draw_start_from(const Studio& studio, OwnBodyWork& work) const {
  if (work.found_waits() && !work.detection().is_running())
    note(
        "What was painted by hand is kept. Start from \"Detected\" to take the result instead; Ctrl + Z brings back "
        "the strokes.",
        true);
  ButtonFlow flow;
  if (flow.button("Detected", "The mask that was found", work.detection().found != nullptr)) work.start_from_found();
  studio.places.note_item("own body/start from found");
  if (flow.button("File...", "A mask in a file")) work.ask_start_from_file(studio.project());
  studio.places.note_item("own body/start from file");
  if (flow.button("Empty", "Nothing is masked")) work.start_from_empty();
  studio.places.note_item("own body/clear");
}

void OwnBodyPanel::draw_misfit(const Studio& studio, OwnBodyWork& work) const {
  if (work.painting().empty()) return;
  note_line(Icon::warning, color::kPartly,
            "This mask was painted for footage of another size. Save it, or begin anew.");
  if (wide_button("Begin anew", false, true)) work.begin_anew();
  studio.places.note_item("own body/begin anew");
}

void OwnBodyPanel::draw_replacing(const Studio& studio, OwnBodyWork& work) {
  const std::string name = usual_mask_file(studio.project()).filename().string();
  note_line(Icon::warning, color::kPartly, "The project uses " + name + ". Replace it, or take a new name?");
  ButtonFlow flow;
  if (flow.button("New name...", "The old mask stays as it is")) {
    work.ask_save_and_use(studio.project());
    asks_to_replace_ = false;
  }
  studio.places.note_item("own body/new name");
  if (flow.button("Replace", usual_mask_file(studio.project()).c_str())) {
    work.replace_and_use(studio.project());
    asks_to_replace_ = false;
  }
  studio.places.note_item("own body/replace");
  if (flow.button("Cancel", "")) asks_to_replace_ = false;
}

void OwnBodyPanel::draw_file(const Studio& studio, OwnBodyWork& work) {
  const Project& project = studio.project();
  const bool is_unsaved = work.unsaved() != 0;
  const std::string name = work.file().filename().string();
  const float room = ImGui::GetContentRegionAvail().x;
  if (work.is_used(project)) {
    note(elided(name + ", used in the project", room));
    studio.places.note_item("own body/used");
  } else if (is_unsaved) {
    note(elided(name.empty() ? "Not saved" : name + ", not saved", room), true);
    studio.places.note_item("own body/unsaved");
  } else {
    note(name.empty() ? "Nothing painted" : elided(name + ", not used in the project", room));
  }
  asks_to_replace_ = asks_to_replace_ && work.could_replace(project);
  if (asks_to_replace_) {
    draw_replacing(studio, work);
    return;
  }
  if (wide_button("Use in project", true, work.fits() && !work.is_used(project) && (is_unsaved || !name.empty()))) {
    asks_to_replace_ = work.could_replace(project);
    if (!asks_to_replace_) work.use(project);
  }
  studio.places.note_item("own body/use");
  tooltip_for_item("Saves the mask and hides intruders behind it");
  if (wide_button("Save as...", false, !work.painting().empty())) work.ask_save_as(project);
  studio.places.note_item("own body/save");
  tooltip_for_item("A PNG of 8 bits, of the footage's size: 255 is own body");
}

void OwnBodyPanel::draw(const Studio& studio, OwnBodyWork& work) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(4)});
  heading("Detect");
  draw_settings(studio);
  ImGui::Spacing();
  draw_detection(studio, work);
  heading("Start from");
  if (work.fits())
    draw_start_from(studio, work);
  else
    draw_misfit(studio, work);
  heading("Mask");
  draw_file(studio, work);
  ImGui::PopStyleVar();
}

}  // namespace sigs::editor
