// SPDX-License-Identifier: MIT
#include "editor/views/export_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "editor/preview/export_plan.h"
#include "editor/widgets/dialog.h"
#include "project/json.h"
#include "project/project.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

bool marks_range(const Document& document) {
  return document.in().has_value() || document.out().has_value();
}

// As the command line has it: decoding and writing take a core of their own.
int usual_jobs() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

VideoInfo video_of(const PreviewOutput& shown) {
  return shown.scene && shown.scene->footage->video ? *shown.scene->footage->video : VideoInfo{};
}

std::vector<fs::path> outputs_of_request(const ViewContext& context, const ExportRequest& request) {
  if (request.project.cameras.empty()) return outputs_of(request.project, video_of(context.shown), request.folder);
  std::vector<VideoInfo> footage;
  if (context.rig != nullptr)
    for (const PreviewOutput& camera : *context.rig) footage.push_back(video_of(camera));
  return outputs_of_rig(request.project, footage, request.folder);
}

// The first problem of what is exported, with the camera that has it.
std::string problem_of(const ViewContext& context, bool only_active) {
  const auto in = [](const PreviewOutput& shown) {
    if (!shown.scene || shown.scene->draft.problems.empty()) return std::string();
    const Problem& problem = shown.scene->draft.problems.front();
    return problem.field + ": " + problem.what;
  };
  if (context.rig == nullptr || only_active) return in(context.shown);
  for (std::size_t i = 0; i < context.rig->size(); ++i)
    if (const std::string text = in((*context.rig)[i]); !text.empty())
      return context.document.cameras()[i].name + ": " + text;
  return "";
}

// Of the whole dialog, before an export and from its start on. What there is to say is scrolled where it needs more
// room than is left.
constexpr double kSetupHeight = 660;
constexpr double kCamerasHeight = 60;  // more, of a rig
constexpr double kReportHeight = 340;
constexpr int kCommandLines = 3;

// A label, then a plate for the command's lines, with the room between them and after them.
float command_height() {
  const ImGuiStyle& style = ImGui::GetStyle();
  return ImGui::GetFrameHeight() + 2 * style.ItemSpacing.y + 2 * style.WindowPadding.y +
         kCommandLines * ImGui::GetTextLineHeightWithSpacing();
}

// A plate from here to `below` pixels above the dialog's lower edge, for texts of any number. Call ImGui::EndChild()
// after it.
void begin_plate(const char* id, float below) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float least = 2 * (ImGui::GetTextLineHeightWithSpacing() + style.WindowPadding.y);
  const float room = ImGui::GetContentRegionAvail().y - below - style.ItemSpacing.y;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, color::kPanel);
  ImGui::BeginChild(id, {0, std::max(least, room)}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleColor();
}

}  // namespace

void ExportView::open(const Document& document) {
  open_ = true;
  overwrite_asked_ = false;
  if (folder_.empty()) folder_ = usual_export_folder(document.project()).string();
  only_range_ = marks_range(document);
}

ExportRequest ExportView::request_of(const ViewContext& context) const {
  const Document& document = context.document;
  const bool is_of_one = only_active_ && !document.cameras().empty();
  ExportRequest request{.project = is_of_one ? seen_by(document.whole(), document.active_camera()) : document.whole(),
                        .folder = folder_,
                        .jobs = jobs_ > 0 ? jobs_ : usual_jobs()};
  if (!only_range_ || !marks_range(document)) return request;
  request.frames = FrameRange{document.range_first(), document.range_last()};
  if (const Scene* const scene = shown_scene(context); is_of_one && scene != nullptr)
    request.frames = FrameRange{std::max(scene->first_frame, own_frame_at(*scene, document.range_first())),
                                std::min(scene->last_frame, own_frame_at(*scene, document.range_last()))};
  return request;
}

void ExportView::draw(const ViewContext& context, ExportJob& job) {
  closed_ = false;
  const ExportState state = job.state();
  const double setup = kSetupHeight + (context.document.cameras().size() > 1 ? kCamerasHeight : 0);
  if (!begin_dialog("Export###export", 620, state.phase == JobPhase::none ? setup : kReportHeight, closed_)) {
    open_ = open_ && !closed_;
    return;
  }
  if (state.phase == JobPhase::none)
    draw_setup(context, job);
  else if (state.is_running())
    draw_running(context, job, state);
  else
    draw_done(context, job, state);
  open_ = !closed_;
  end_dialog(open_);
}

void ExportView::draw_folder(const ViewContext& context) {
  begin_setting("Folder");
  const float browse = dialog_button_width("Browse...");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - browse - ImGui::GetStyle().ItemSpacing.x);
  if (context.ui_probe.noted(text_input("##folder", folder_), "export/folder")) overwrite_asked_ = false;
  ImGui::SameLine();
  if (dialog_button("Browse..."))
    context.edits.ask(AskForFile{
        .title = "Export into", .of_folder = true, .start = folder_, .chosen = [this](const fs::path& folder) {
          folder_ = folder.string();
        }});
}

void ExportView::draw_range(const ViewContext& context) {
  const Document& document = context.document;
  begin_setting("Frames");
  const std::string whole = fmt::format("whole project ({} to {})", document.first_frame(), document.last_frame());
  if (context.ui_probe.noted(ImGui::RadioButton(whole.c_str(), !only_range_ || !marks_range(document)), "export/whole"))
    only_range_ = false;
  const std::string part = fmt::format("in to out ({} to {})###range", document.range_first(), document.range_last());
  ImGui::BeginDisabled(!marks_range(document));
  if (ImGui::RadioButton(marks_range(document) ? part.c_str() : "in to out (not marked)###range",
                         only_range_ && marks_range(document)))
    only_range_ = true;
  ImGui::EndDisabled();
  context.ui_probe.note_item("export/range");
}

void ExportView::draw_cameras(const ViewContext& context) {
  const std::vector<RigCamera>& cameras = context.document.cameras();
  if (cameras.size() < 2) return;
  begin_setting("Cameras");
  const std::string all = fmt::format("all {}, and what they see together", cameras.size());
  if (context.ui_probe.noted(ImGui::RadioButton(all.c_str(), !only_active_), "export/all cameras"))
    only_active_ = false;
  const std::string one = shortened(cameras[context.document.active_camera()].name, 40) + " alone###one camera";
  if (context.ui_probe.noted(ImGui::RadioButton(one.c_str(), only_active_), "export/one camera")) only_active_ = true;
}

void ExportView::draw_choices(const ViewContext& context) {
  draw_folder(context);
  draw_cameras(context);
  draw_range(context);
  begin_setting("Video");
  draw_video_choices(context);
  draw_quality(context);
  begin_setting("Masks");
  draw_mask_choice(context);
  begin_setting("Labels");
  draw_label_choice(context);
  draw_thresholds(context);
  begin_setting("Threads");
  ImGui::SetNextItemWidth(scaled(150));
  const std::string automatic = fmt::format("automatic ({})", usual_jobs());
  ImGui::SliderInt("##jobs", &jobs_, 0, std::max(2, usual_jobs() + 1), jobs_ == 0 ? automatic.c_str() : "%d",
                   ImGuiSliderFlags_AlwaysClamp);
  tooltip_for_item("Frames that are made side by side; the result does not depend on it");
}

const Assignments& ExportView::assignments(const Document& document) {
  const std::uint64_t revision = document.has_unsaved_changes() ? document.state().number : 0;
  if (std::exchange(assignments_of_, revision) == revision && assignments_) return *assignments_;
  assignments_ = Assignments();
  if (revision == 0 && document.has_file()) return *assignments_;
  const Result<ReadProject> saved = read_project(document.whole().file);
  assignments_ =
      saved ? assignments_between(saved->project, document.whole()) : Assignments{.texts = {}, .are_all = false};
  return *assignments_;
}

void ExportView::draw_command(const ViewContext& context) {
  ExportRequest request = request_of(context);
  request.overwrite = !there_.empty();
  const std::string command = export_command(request, assignments(context.document).texts);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("The same from the command line:");
  ImGui::SameLine(ImGui::GetContentRegionMax().x - icon_button_width());
  if (context.ui_probe.noted(icon_button("copy command", Icon::copy, "Copy"), "export/copy command")) {
    ImGui::SetClipboardText(command.c_str());
    context.edits.ask(ShowMessage{"Copied"});
  }
  begin_plate("command", dialog_buttons_height());
  draw_wrapped(shortened(command), color::kQuiet, Font::mono);
  ImGui::EndChild();
}

void ExportView::draw_notes(const ViewContext& context) {
  const float before = ImGui::GetCursorPosY();
  if (overwrite_asked_ && !there_.empty()) {
    std::string names;
    for (const fs::path& path : there_) names += (names.empty() ? "" : ", ") + path.filename().string();
    note_line(Icon::warning, color::kPartly, fmt::format("Already there: {}. Replace?", names));
  }
  if (!assignments(context.document).are_all)
    note_line(
        Icon::info, color::kAccent,
        "There are unsaved changes. They are exported; the command below has the settings of the export alone and "
        "else takes the project as it was last saved. Save it first (Ctrl+S) for the same from the command "
        "line.");
  if (const std::string problem = problem_of(context, only_active_); !problem.empty())
    note_line(Icon::warning, color::kBad, problem);
  if (const std::string names = labels_without_images(context.document.project().output); !names.empty())
    note_line(Icon::warning, color::kPartly,
              fmt::format("Labels {} name numbered images, which a video does not have: choose png, tiff or jpeg as "
                          "Video, or make them with FFmpeg afterwards.",
                          names));
  if (ImGui::GetCursorPosY() == before) ImGui::TextDisabled("No warnings.");
}

void ExportView::draw_setup(const ViewContext& context, ExportJob& job) {
  if (ImGui::BeginTable("choices", 2)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, scaled(112));
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    draw_choices(context);
    ImGui::EndTable();
  }
  if (!overwrite_asked_) there_.clear();
  begin_plate("notes", command_height() + dialog_buttons_height());
  draw_notes(context);
  ImGui::EndChild();
  draw_command(context);
  ImGui::Dummy({0, scaled(6)});
  const bool replace = overwrite_asked_ && !there_.empty();
  const char* const go = replace ? "Replace" : "Export";
  align_buttons_right({"Close", go});
  if (context.ui_probe.noted(dialog_button("Close"), "export/close")) closed_ = true;
  ImGui::SameLine();
  const bool clicked = context.ui_probe.noted(dialog_button(go, true, !folder_.empty()), "export/go");
  if (!clicked) return;
  ExportRequest request = request_of(context);
  const std::vector<fs::path> there = those_there(outputs_of_request(context, request));
  // What was agreed to be replaced is what was shown.
  if (!there.empty() && there != there_) {
    there_ = there;
    overwrite_asked_ = true;
    return;
  }
  request.overwrite = !there.empty();
  overwrite_asked_ = false;
  job.start(std::move(request));
}

void ExportView::draw_running(const ViewContext& context, ExportJob& job, const ExportState& state) {
  ImGui::TextUnformatted(
      elided(state.request.project.name + " into " + state.request.folder.string(), ImGui::GetContentRegionAvail().x)
          .c_str());
  ImGui::Dummy({0, scaled(2)});
  ImGui::ProgressBar(share_done(state.done, state.total), {-1, scaled(10)}, "");
  ImGui::TextDisabled("%s", progress_text(state).c_str());
  begin_plate("notes", dialog_buttons_height());
  if (state.warnings.empty()) ImGui::TextDisabled("No warnings so far.");
  draw_warnings(state);
  ImGui::EndChild();
  ImGui::Dummy({0, scaled(6)});
  align_buttons_right({"Cancel export", "Go on in the background"});
  if (context.ui_probe.noted(dialog_button("Cancel export", false, !state.is_stopping), "export/cancel")) job.cancel();
  ImGui::SameLine();
  if (context.ui_probe.noted(dialog_button("Go on in the background", true), "export/hide")) closed_ = true;
}

void ExportView::draw_done(const ViewContext& context, ExportJob& job, const ExportState& state) {
  begin_plate("notes", dialog_buttons_height());
  draw_result(context, state);
  draw_warnings(state);
  ImGui::EndChild();
  ImGui::Dummy({0, scaled(6)});
  align_buttons_right({"Export again", "Close"});
  if (context.ui_probe.noted(dialog_button("Export again"), "export/again")) {
    job.forget();
    overwrite_asked_ = false;
  }
  ImGui::SameLine();
  if (context.ui_probe.noted(dialog_button("Close", true), "export/close")) {
    job.forget();
    closed_ = true;
  }
}

}  // namespace sigs::editor
