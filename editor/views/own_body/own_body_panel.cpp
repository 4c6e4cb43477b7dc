// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_panel.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/views/export_parts.h"
#include "editor/views/inspector/field_rows.h"
#include "editor/views/own_body/own_body_pictures.h"
#include "editor/widgets/dialog.h"
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

// Until the end of the last frame that was passed, from the first that the project uses.
double seconds_of(const Studio& studio, int frames) {
  if (!has_footage(studio) || frames < 1) return 0;
  const FootageShape& shape = studio.shown.scene->footage->shape;
  const auto there = static_cast<int>(shape.times_s.size());
  const int first = std::clamp(studio.project().footage.first_frame, 0, std::max(0, there - 1));
  const int last = std::min(first + frames, there) - 1;
  if (last < first) return 0;
  return shape.times_s[static_cast<std::size_t>(last)] - shape.times_s[static_cast<std::size_t>(first)] +
         shape.frame_interval_s;
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
  if (state.found) draw_found(studio, state);
}

void OwnBodyPanel::draw_found(const Studio& studio, const DetectionState& state) const {
  const OwnBody& found = *state.found;
  if (state.phase != DetectionPhase::done) {
    note("Before: " + result_text(found));
    return;
  }
  const std::vector<std::string> doubts = doubts_about(found, seconds_of(studio, found.frames_passed));
  const bool is_doubted = !doubts.empty();
  note_line(is_doubted ? Icon::warning : Icon::check, is_doubted ? color::kPartly : color::kGood, result_text(found));
  studio.places.note_item("own body/found");
  for (const std::string& doubt : doubts) note(doubt, true);
  if (is_doubted) studio.places.note_item("own body/doubt");
}

bool OwnBodyPanel::draw_start_from(const Studio& studio, OwnBodyWork& work) const {
  const std::uint64_t before = work.painting().state();
  if (work.found_waits() && !work.detection().is_running())
    note(
        "What was painted by hand is kept. Start from \"Detected\" to take the result instead; Ctrl + Z brings back "
        "the strokes.",
        true);
  ButtonFlow flow;
  if (flow.button("Detected", "The mask that was found", work.detection().found != nullptr)) work.start_from_found();
  studio.places.note_item("own body/start from found");
  if (work.could_start_from_project(studio.project()) && !work.is_used(studio.project())) {
    if (flow.button("Project's", "The mask that the project uses")) work.start_from_project(studio.project());
    studio.places.note_item("own body/start from project");
  }
  if (flow.button("File...", "A mask in a file")) work.ask_start_from_file(studio.project());
  studio.places.note_item("own body/start from file");
  if (flow.button("Empty", "Nothing is masked")) work.start_from_empty();
  studio.places.note_item("own body/clear");
  if (work.edge_waits()) {
    note("The soft edge counts for strokes from now on. This mask has the edge that it had.");
    if (flow.button("Soften this mask", "The whole mask gets the edge of the setting; Ctrl + Z brings the other back"))
      work.soften();
    studio.places.note_item("own body/soften");
  }
  return work.painting().state() != before;
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
  const std::filesystem::path folder = usual_mask_file(studio.project()).parent_path();
  const bool is_elsewhere = folder != std::filesystem::absolute(studio.project().file).lexically_normal().parent_path();
  note_line(Icon::warning, color::kPartly,
            "The project uses " + name + (is_elsewhere ? ", which lies elsewhere: other projects may use it too" : "") +
                ". Replace it, or take a new name?");
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
  note(work.mask_text(project), is_unsaved);
  if (is_unsaved) studio.places.note_item("own body/unsaved");
  if (work.is_used(project)) studio.places.note_item("own body/used");
  if (!work.painting().empty()) note(share_text(work.share()));
  asks_to_replace_ = asks_to_replace_ && work.could_replace(project);
  if (asks_to_replace_) {
    draw_replacing(studio, work);
    return;
  }
  if (wide_button("Use in project", true,
                  work.fits() && !work.is_used(project) && (is_unsaved || !work.file().empty()))) {
    asks_to_replace_ = work.could_replace(project);
    if (!asks_to_replace_) work.use(project);
  }
  studio.places.note_item("own body/use");
  tooltip_for_item("Saves the mask and hides intruders behind it");
  if (wide_button("Save as...", false, !work.painting().empty())) work.ask_save_as(project);
  studio.places.note_item("own body/save");
  tooltip_for_item("A PNG of 8 bits, of the footage's size: 255 is own body");
}

bool OwnBodyPanel::draw(const Studio& studio, OwnBodyWork& work) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(4)});
  heading("Detect");
  draw_settings(studio);
  ImGui::Spacing();
  draw_detection(studio, work);
  heading("Start from");
  bool is_started = false;
  if (work.fits())
    is_started = draw_start_from(studio, work);
  else
    draw_misfit(studio, work);
  heading("Mask");
  draw_file(studio, work);
  ImGui::PopStyleVar();
  return is_started;
}

}  // namespace sigs::editor
