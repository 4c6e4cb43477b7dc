// SPDX-License-Identifier: MIT
#include "editor/views/new_project/new_project_dialog.h"

#include <fmt/format.h>

#include <utility>

#include "base/text.h"
#include "editor/document/field_edits.h"
#include "editor/views/export_view.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

void small_text(const std::string& text, ImU32 shade) {
  draw_wrapped(shortened(text), shade, Font::small);
}

// Some room above the next setting.
void begin_group() {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::Dummy({0, scaled(2)});
}

AskForFile question_for(const char* title, std::string_view field, const std::string& start) {
  return {.title = title, .extensions = extensions_for(field), .start = typed_path(start)};
}

}  // namespace

NewProjectDialog::NewProjectDialog(ModelGallery& gallery, std::function<void()> wake)
    : gallery_(gallery), facts_(std::move(wake), video_facts) {}

void NewProjectDialog::open(const fs::path& video, fs::path elsewhere) {
  elsewhere_ = std::move(elsewhere);
  form_ = {};
  if (gallery_.samples().empty()) form_.sample.reset();
  set_video(form_, video.string(), elsewhere_);
  changed();
  open_ = true;
  focus_video_ = true;
}

void NewProjectDialog::changed() {
  problem_.reset();
  note_.clear();
  asked_about_.clear();
}

void NewProjectDialog::take_dropped(const fs::path& file) {
  changed();
  note_ = editor::take_dropped(form_, file, elsewhere_);
}

bool NewProjectDialog::draw_path(const ViewContext& context, const char* name, std::string& text, AskForFile wanted) {
  ImGui::PushID(name);
  const float browse = dialog_button_width("Browse...");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - browse - ImGui::GetStyle().ItemSpacing.x);
  const bool is_typed = context.ui_probe.noted(text_input("##path", text), fmt::format("new project/{}", name));
  ImGui::SameLine();
  if (context.ui_probe.noted(ImGui::Button("Browse...", {browse, ImGui::GetFrameHeight()}),
                             fmt::format("new project/{} browse", name)))
    context.edits.ask(std::move(wanted));
  ImGui::PopID();
  return is_typed;
}

void NewProjectDialog::choose(LensChoice lens) {
  form_.lens = lens;
  changed();
}

bool NewProjectDialog::draw_problem(const ViewContext& context, FormRow row) const {
  if (!problem_ || problem_->row != row) return false;
  small_text(capitalised(problem_->what), color::kBad);
  context.ui_probe.note_item("new project/problem");
  return true;
}

void NewProjectDialog::look_at_video() {
  const fs::path video = typed_path(form_.video);
  const VideoFactsState state = facts_.state();
  std::error_code code;
  if (video.empty() || !fs::is_regular_file(video, code)) return;
  if (state.phase != JobPhase::none && state.request == video) return;
  if (state.is_running())
    facts_.forget();
  else
    (void)facts_.start(video);
}

void NewProjectDialog::draw_video_facts(const ViewContext& context) {
  const VideoFactsState state = facts_.state();
  if (form_.video.empty()) {
    small_text("Or drop a video onto this window.", color::kQuiet);
  } else if (state.phase == JobPhase::none || state.request != typed_path(form_.video)) {
    small_text("", color::kQuiet);
  } else if (state.is_running()) {
    small_text("Reading...", color::kQuiet);
  } else if (state.phase == JobPhase::done) {
    const VideoFacts& facts = *state.value;
    small_text(fmt::format("{} pixels, {}, {}, {} frames/s", image_size_text(facts.size_px, " x "),
                           count_text(facts.frames, "frame"), clock_text(facts.duration_s), number_text(facts.rate_hz)),
               color::kQuiet);
    context.ui_probe.note_item("new project/facts");
  } else if (state.phase == JobPhase::failed) {
    small_text(state.error.text(), color::kBad);
  }
}

void NewProjectDialog::draw_video(const ViewContext& context) {
  begin_setting("Video", "Of a real flight, as the camera made it");
  if (std::exchange(focus_video_, false) && form_.video.empty()) ImGui::SetKeyboardFocusHere();
  AskForFile wanted = question_for("Choose the video", "footage.video", form_.video);
  wanted.chosen = [this](const fs::path& path) {
    set_video(form_, path.string(), elsewhere_);
    changed();
  };
  if (draw_path(context, "video", form_.video, std::move(wanted))) {
    set_video(form_, form_.video, elsewhere_);
    changed();
  }
  look_at_video();
  if (!draw_problem(context, FormRow::video)) draw_video_facts(context);
}

void NewProjectDialog::draw_field_of_view(const ViewContext& context) {
  if (context.ui_probe.noted(
          ImGui::RadioButton("Field of view", form_.lens == LensChoice::field_of_view), "new project/field of view",
          "Horizontal, of the whole image; from the camera's data sheet. The lens is taken as free of "
          "distortion"))
    choose(LensChoice::field_of_view);
  ImGui::SameLine(scaled(150));
  ImGui::SetNextItemWidth(scaled(90));
  if (context.ui_probe.noted(text_input("##fov", form_.fov_deg, "e.g. 70"), "new project/degrees"))
    choose(LensChoice::field_of_view);
  ImGui::SameLine();
  ImGui::TextDisabled("degrees, left to right");
}

void NewProjectDialog::draw_calibration(const ViewContext& context) {
  if (context.ui_probe.noted(ImGui::RadioButton("Calibration", form_.lens == LensChoice::calibration),
                             "new project/calibrated", "A file of OpenCV, ROS or Gyroflow for this camera"))
    choose(LensChoice::calibration);
  ImGui::SameLine(scaled(150));
  AskForFile wanted = question_for("Choose the calibration", "footage.calibration",
                                   form_.calibration.empty() ? form_.video : form_.calibration);
  if (form_.calibration.empty()) wanted.start = wanted.start.parent_path();
  wanted.chosen = [this](const fs::path& path) {
    form_.calibration = path.string();
    choose(LensChoice::calibration);
  };
  if (draw_path(context, "calibration", form_.calibration, std::move(wanted))) choose(LensChoice::calibration);
}

void NewProjectDialog::draw_lens(const ViewContext& context) {
  begin_group();
  begin_setting("Lens", "How the camera projects the world");
  const VideoFactsState state = facts_.state();
  const bool is_known = state.phase == JobPhase::done && state.request == typed_path(form_.video);
  const bool is_stated = is_known && !state.value->lens.empty();
  if (context.ui_probe.noted(ImGui::RadioButton(is_stated ? "As the video states###guess" : "Guess###guess",
                                                form_.lens == LensChoice::guess),
                             "new project/guess"))
    choose(LensChoice::guess);
  ImGui::SameLine(scaled(150));
  const std::string hint = is_stated  ? state.value->lens
                           : is_known ? "the video does not tell its lens: a usual one is assumed"
                                      : "from what the video tells, else a usual lens";
  ImGui::TextDisabled("%s", elided(hint, ImGui::GetContentRegionAvail().x).c_str());
  tooltip_for_item(hint.c_str());
  draw_field_of_view(context);
  draw_calibration(context);
  draw_problem(context, FormRow::lens);
}

void NewProjectDialog::draw_model(const ViewContext& context) {
  begin_group();
  begin_setting("Model", "Of the aircraft that is put into the video");
  const fs::path own = form_.sample ? fs::path() : typed_path(form_.model);
  if (const auto pressed = gallery_.draw(context, "new project/model", form_.sample, own)) {
    form_.sample = pressed->sample;
    changed();
  }
  if (!form_.sample) {
    AskForFile wanted = question_for("Choose the aircraft's model", "intruders[0].model.file", form_.model);
    wanted.chosen = [this](const fs::path& path) {
      form_.model = path.string();
      changed();
    };
    if (draw_path(context, "model file", form_.model, std::move(wanted))) changed();
  }
  draw_problem(context, FormRow::model);
}

void NewProjectDialog::draw_look(const ViewContext& context) {
  begin_group();
  begin_setting("Look", "How the camera shows the aircraft");
  if (context.ui_probe.noted(ImGui::Checkbox("Match the footage", &form_.matches_footage),
                             "new project/match the footage",
                             "Light, blur, noise, haze and compression as the footage shows them; takes some seconds"))
    changed();
}

void NewProjectDialog::draw_file(const ViewContext& context) {
  begin_group();
  begin_setting("Save as", "The project file; what the project needs beside it goes into the same folder");
  AskForFile wanted{.title = "Save the project as",
                    .extensions = {".json"},
                    .for_saving = true,
                    .start = typed_path(form_.file),
                    .chosen = [this](const fs::path& path) {
                      form_.file = path.string();
                      form_.is_file_chosen = true;
                      changed();
                      asked_about_ = typed_path(form_.file);  // the browser has asked
                    }};
  if (draw_path(context, "file", form_.file, std::move(wanted))) {
    form_.is_file_chosen = !trimmed(form_.file).empty();
    changed();
  }
  std::error_code code;
  if (!draw_problem(context, FormRow::file) && !asked_about_.empty() && fs::exists(asked_about_, code)) {
    small_text(asked_about_.filename().string() + " is there already. Replace it?", color::kPartly);
    context.ui_probe.note_item("new project/replace");
  }
}

void NewProjectDialog::draw_rows(const ViewContext& context, const FirstProjectState& making) {
  draw_wrapped("Puts one simulated aircraft into a video of yours. All of it can be changed afterwards.",
               color::kQuiet);
  ImGui::Dummy({0, scaled(2)});
  if (ImGui::BeginTable("rows", 2)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, scaled(80));
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    draw_video(context);
    draw_lens(context);
    draw_model(context);
    draw_look(context);
    draw_file(context);
    ImGui::EndTable();
  }
  if (std::exchange(tells_end_, false)) {
    if (making.phase == JobPhase::failed) note_ = making.error.text();
    if (making.phase == JobPhase::cancelled) note_ = "Cancelled; nothing was written.";
  }
  if (note_.empty()) return;
  note_line(Icon::warning, color::kBad, note_);
  context.ui_probe.note_item("new project/note");
}

void NewProjectDialog::try_to_create(NewProjectChoice& choice) {
  problem_ = problem_of(form_);
  if (problem_) return;
  FirstProjectOptions options = options_of(form_, gallery_.samples());
  std::error_code code;
  const bool is_there = fs::exists(options.out, code);
  // What was agreed to be replaced is what was shown.
  if (is_there && asked_about_ != options.out) {
    asked_about_ = options.out;
    return;
  }
  options.overwrite = is_there;
  note_.clear();
  choice.create = std::move(options);
}

void NewProjectDialog::draw_buttons(const ViewContext& context, NewProjectChoice& choice) {
  ImGui::Dummy({0, scaled(6)});
  if (context.ui_probe.noted(dialog_button("Empty project"), "new project/empty",
                             "Without a video: the files are chosen one by one"))
    choice.empty = true;
  ImGui::SameLine();
  std::error_code code;
  const bool replaces = !asked_about_.empty() && fs::exists(asked_about_, code);
  const char* const go = replaces ? "Replace" : "Create";
  align_buttons_right({"Cancel", go});
  if (context.ui_probe.noted(dialog_button("Cancel"), "new project/cancel")) closed_ = true;
  ImGui::SameLine();
  bool wants = context.ui_probe.noted(dialog_button(go, true), "new project/create");
  if (enter_pressed()) wants = true;
  if (wants && !closed_) try_to_create(choice);
}

void NewProjectDialog::draw_progress(const ViewContext& context, const FirstProjectState& state,
                                     NewProjectChoice& choice) {
  ImGui::TextUnformatted(elided("Making " + state.request.out.string(), ImGui::GetContentRegionAvail().x).c_str());
  ImGui::Dummy({0, scaled(2)});
  ImGui::ProgressBar(share_done(state.done, state.total), {-1, scaled(10)}, "");
  const std::string text = state.is_stopping ? "stopping" : state.step.empty() ? "reading the video" : state.step;
  ImGui::TextDisabled("%s", elided(capitalised(text) + "...", ImGui::GetContentRegionAvail().x).c_str());
  ImGui::Dummy({0, scaled(6)});
  align_buttons_right({"Cancel"});
  if (context.ui_probe.noted(dialog_button("Cancel", false, !state.is_stopping), "new project/stop")) closed_ = true;
  choice.cancel = std::exchange(closed_, false);
}

NewProjectChoice NewProjectDialog::draw(const ViewContext& context, const FirstProjectState& making) {
  NewProjectChoice choice;
  closed_ = false;
  if (!begin_dialog("New project###new project", 760, 0, closed_)) {
    open_ = open_ && !closed_;
    return choice;
  }
  if (making.is_running()) {
    draw_progress(context, making, choice);
  } else {
    draw_rows(context, making);
    draw_buttons(context, choice);
  }
  if (choice.empty) closed_ = true;
  open_ = !closed_;
  end_dialog(open_);
  return choice;
}

}  // namespace sigs::editor
