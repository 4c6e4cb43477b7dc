// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/views/export_view.h"
#include "editor/views/inspector/field_rows.h"
#include "editor/views/viewport/overlays.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

void panel_heading(const char* text) {
  ImGui::Dummy({0, scaled(4)});
  draw_text(text, color::kText, Font::bold);
}

// As wide as the panel.
bool wide_button(const char* label, bool is_main, bool enabled) {
  return dialog_button(label, is_main, enabled, -1);
}

bool has_footage(const ViewContext& context) {
  return context.shown.scene && context.shown.scene->footage->video.has_value();
}

// How much of the footage that is.
std::string frames_text(const ViewContext& context) {
  const OwnBodySettings& settings = context.project().own_body;
  const auto there = static_cast<int>(context.shown.scene->footage->shape.times_s.size());
  const int first = std::clamp(context.project().footage.first_frame, 0, std::max(0, there - 1));
  const int passed = std::min(settings.frames, there - first);
  if (passed < 1) return "";
  const int used = (passed - 1) / std::max(1, settings.every) + 1;
  std::string text = fmt::format("Frames {} to {}", first, first + passed - 1);
  if (used != passed) text += fmt::format(", {} of them used", used);
  return text;
}

// Until the end of the last frame that was passed, from the first that the project uses.
double seconds_of(const ViewContext& context, int frames) {
  if (!has_footage(context) || frames < 1) return 0;
  const FootageShape& shape = context.shown.scene->footage->shape;
  const auto there = static_cast<int>(shape.times_s.size());
  const int first = std::clamp(context.project().footage.first_frame, 0, std::max(0, there - 1));
  const int last = std::min(first + frames, there) - 1;
  if (last < first) return 0;
  return shape.times_s[static_cast<std::size_t>(last)] - shape.times_s[static_cast<std::size_t>(first)] +
         shape.frame_interval_s;
}

}  // namespace

void OwnBodyPanel::draw_settings(const ViewContext& context) {
  memory_.refresh(context);
  problems_.refresh(context);
  FieldRows rows(context, problems_.by_field(), memory_, "own body/");
  const std::string own =
      context.project().own_body.method == OwnBodyMethod::paper ? "own_body.paper." : "own_body.stable.";
  for (const Field& field : rows.sheet().fields()) {
    const bool is_of_a_method = field.key.starts_with("own_body.paper.") || field.key.starts_with("own_body.stable.");
    if (field.key.starts_with("own_body.") && (!is_of_a_method || field.key.starts_with(own))) rows.row(field.key);
  }
  rows.finish();
}

void OwnBodyPanel::draw_running(const ViewContext& context, OwnBodySession& session) const {
  const DetectionState& state = session.detection();
  ImGui::ProgressBar(share_done(state.done, state.total), {-1, scaled(10)}, "");
  note(progress_text(state));
  context.ui_probe.note_item("own body/progress");
  if (context.ui_probe.noted(wide_button("Stop", false, !state.is_stopping), "own body/stop")) session.job().cancel();
}

void OwnBodyPanel::draw_detection(const ViewContext& context, OwnBodySession& session) const {
  const DetectionState& state = session.detection();
  if (state.is_running()) return draw_running(context, session);
  if (has_footage(context)) note(frames_text(context));
  if (context.ui_probe.noted(wide_button("Detect", true, has_footage(context)), "own body/detect"))
    session.start(context.document);
  if (!has_footage(context)) note("The footage cannot be read: choose a video in the inspector.", true);
  if (state.phase == JobPhase::failed) {
    note_line(Icon::warning, color::kBad, state.error.what);
    context.ui_probe.note_item("own body/failed");
  }
  if (state.phase == JobPhase::cancelled) {
    note("Stopped.");
    context.ui_probe.note_item("own body/stopped");
  }
  if (state.value) draw_found(context, state);
}

void OwnBodyPanel::draw_found(const ViewContext& context, const DetectionState& state) const {
  const OwnBody& found = *state.value;
  if (state.phase != JobPhase::done) return note("Before: " + result_text(found));
  const std::vector<std::string> cautions = cautions_about(found, seconds_of(context, found.frames_passed));
  const bool has_cautions = !cautions.empty();
  note_line(has_cautions ? Icon::warning : Icon::check, has_cautions ? color::kPartly : color::kGood,
            result_text(found));
  context.ui_probe.note_item("own body/found");
  for (const std::string& caution : cautions) note(caution, true);
  if (has_cautions) context.ui_probe.note_item("own body/doubt");
}

bool OwnBodyPanel::draw_start_from(const ViewContext& context, OwnBodySession& session) const {
  const std::uint64_t before = session.painting().state();
  if (session.found_waits() && !session.detection().is_running())
    note(
        "What was painted by hand is kept. Start from \"Detected\" to take the result instead; Ctrl + Z brings back "
        "the strokes.",
        true);
  ButtonFlow flow;
  if (context.ui_probe.noted(flow.button("Detected", "The mask that was found", session.detection().value != nullptr),
                             "own body/start from found"))
    session.start_from_found();
  if (session.could_start_from_project(context.project()) && !session.is_used(context.project())) {
    if (context.ui_probe.noted(flow.button("Project's", "The mask that the project uses"),
                               "own body/start from project"))
      session.start_from_project(context.project());
  }
  if (context.ui_probe.noted(flow.button("File...", "A mask in a file"), "own body/start from file"))
    session.ask_start_from_file(context.project());
  if (const cv::Mat clouds = clouds_of_frame(context);
      !clouds.empty() && context.ui_probe.noted(flow.button("Clouds", "Those that are found in the frame shown"),
                                                "own body/start from clouds"))
    session.start_from_clouds(clouds);
  if (context.ui_probe.noted(flow.button("Empty", "Nothing is masked"), "own body/clear")) session.start_from_empty();
  if (session.edge_waits()) {
    note("The soft edge counts for strokes from now on. This mask has the edge that it had.");
    if (context.ui_probe.noted(
            flow.button("Feather this mask",
                        "The whole mask gets the edge of the setting; Ctrl + Z brings the other back"),
            "own body/feather"))
      session.feather();
  }
  return session.painting().state() != before;
}

void OwnBodyPanel::draw_misfit(const ViewContext& context, OwnBodySession& session) const {
  if (session.painting().empty()) return;
  note_line(Icon::warning, color::kPartly,
            "This mask was painted for footage of another size. Save it, or begin anew.");
  if (context.ui_probe.noted(wide_button("Begin anew", false, true), "own body/begin anew")) session.begin_anew();
}

void OwnBodyPanel::draw_replacing(const ViewContext& context, OwnBodySession& session) {
  const std::string name = usual_mask_file(context.project()).filename().string();
  const std::filesystem::path folder = usual_mask_file(context.project()).parent_path();
  const bool is_elsewhere =
      folder != std::filesystem::absolute(context.project().file).lexically_normal().parent_path();
  note_line(Icon::warning, color::kPartly,
            fmt::format("The project uses {}{}. Replace it, or take a new name?", name,
                        is_elsewhere ? ", which lies elsewhere: other projects may use it too" : ""));
  ButtonFlow flow;
  if (context.ui_probe.noted(flow.button("New name...", "The old mask stays as it is"), "own body/new name")) {
    session.ask_save_and_use(context.project());
    asks_to_replace_ = false;
  }
  if (context.ui_probe.noted(flow.button("Replace", usual_mask_file(context.project()).c_str()), "own body/replace")) {
    session.replace_and_use(context.project());
    asks_to_replace_ = false;
  }
  if (flow.button("Cancel", "")) asks_to_replace_ = false;
}

void OwnBodyPanel::draw_file(const ViewContext& context, OwnBodySession& session) {
  const Project& project = context.project();
  const bool is_unsaved = session.unsaved() != 0;
  note(session.mask_text(project), is_unsaved);
  if (is_unsaved) context.ui_probe.note_item("own body/unsaved");
  if (session.is_used(project)) context.ui_probe.note_item("own body/used");
  if (!session.painting().empty()) note(share_text(session.share()));
  asks_to_replace_ = asks_to_replace_ && session.could_replace(project);
  if (asks_to_replace_) return draw_replacing(context, session);
  if (context.ui_probe.noted(
          wide_button("Use in project", true,
                      session.fits() && !session.is_used(project) && (is_unsaved || !session.file().empty())),
          "own body/use", "Saves the mask and hides intruders behind it")) {
    asks_to_replace_ = session.could_replace(project);
    if (!asks_to_replace_) session.use(project);
  }
  if (context.ui_probe.noted(wide_button("Save as...", false, !session.painting().empty()), "own body/save",
                             "A PNG of 8 bits, of the footage's size: 255 is own body"))
    session.ask_save_as(project);
  if (context.ui_probe.noted(
          wide_button("Use as occluder...", false, session.fits() && !session.painting().empty()), "own body/occluder",
          "Not the own body, but what stands in the world: trees, hills or clouds as this frame shows them. Saves the "
          "mask; it hides what is farther than \"Its distance\", and follows the camera's motion"))
    session.ask_use_as_occluder(project, footage_frame(context));
}

bool OwnBodyPanel::draw(const ViewContext& context, OwnBodySession& session) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(4)});
  panel_heading("Detect");
  draw_settings(context);
  ImGui::Spacing();
  draw_detection(context, session);
  panel_heading("Start from");
  bool is_started = false;
  if (session.fits())
    is_started = draw_start_from(context, session);
  else
    draw_misfit(context, session);
  panel_heading("Mask");
  draw_file(context, session);
  ImGui::PopStyleVar();
  return is_started;
}

}  // namespace sigs::editor
