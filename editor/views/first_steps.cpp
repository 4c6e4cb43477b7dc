// SPDX-License-Identifier: MIT
#include "editor/views/start_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "editor/document/field_edits.h"
#include "editor/document/project_paths.h"
#include "editor/views/viewport/horizon_tool.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/dialog.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

struct FirstStep {
  const char* name;
  const char* what;  // is wanted
  std::string key;   // of the field
  std::string file;  // chosen, "": none yet
  std::vector<std::string> extensions;
  std::function<void(const fs::path&)> choose;  // none: nothing is chosen, the line over the footage is dragged
  std::string problem = {};                     // with the file that was chosen

  [[nodiscard]] bool is_done() const { return !file.empty() && problem.empty(); }
};

// Three files, then the horizon.
using Steps = std::array<FirstStep, 4>;
constexpr std::size_t kFiles = 3;

// The first that has no model; else as many as there are: one more is wanted.
std::size_t intruder_without_model(const Project& project) {
  const auto found = std::ranges::find_if(project.intruders,
                                          [](const IntruderSettings& intruder) { return intruder.model.file.empty(); });
  return static_cast<std::size_t>(found - project.intruders.begin());
}

std::function<void(const fs::path&)> put_file(const ViewContext& context, const char* name, const char* key) {
  return [&edits = context.edits, name, key](const fs::path& path) {
    edits.change(name, [key, path](Project& project) { put_value(project, key, path_in_project(project, path)); });
  };
}

std::function<void(const fs::path&)> put_aircraft(const ViewContext& context) {
  return [&edits = context.edits, intruder = new_intruder(context)](const fs::path& path) {
    edits.change("choose aircraft", [intruder, path](Project& project) {
      const std::size_t wanted = intruder_without_model(project);
      if (wanted == project.intruders.size()) {
        project.intruders.push_back(intruder);
        project.intruders.back().name = path.stem().string();
      }
      project.intruders[wanted].model.file = path_in_project(project, path);
    });
  };
}

// What is wrong with files that were chosen, by the newest scene that is open.
Steps with_problems(Steps steps, const PreviewOutput& shown) {
  if (!shown.scene) return steps;
  for (FirstStep& step : steps)
    for (const Problem& problem : shown.scene->draft.problems)
      if (problem.field == step.key && !step.file.empty()) step.problem = problem.what;
  if (shown.scene->footage && !steps[0].file.empty()) steps[0].problem = shown.scene->footage->problem;
  return steps;
}

// "": not known yet.
std::string horizon_text(const ViewContext& context) {
  const CameraSettings& camera = context.project().camera;
  if (camera.attitude_file.empty() && is_turned_by_file(context)) return camera.track.file;
  if (!knows_horizon(camera)) return "";
  if (!camera.attitude_file.empty()) return camera.attitude_file;
  return fmt::format("roll {}, pitch {}", number_text(camera.roll_deg.value_or(0), "deg"),
                     number_text(camera.pitch_deg.value_or(0), "deg"));
}

Steps steps_of(const ViewContext& context) {
  const Project& project = context.project();
  const bool has_aircraft = !project.intruders.empty() && intruder_without_model(project) == project.intruders.size();
  Steps steps{{{.name = "Video",
                .what = "The video of a real flight",
                .key = "footage.video",
                .file = project.footage.video,
                .extensions = extensions_for("footage.video"),
                .choose = put_file(context, "choose video", "footage.video")},
               {.name = "Calibration",
                .what = "Of the camera that took it: OpenCV, ROS or Gyroflow",
                .key = "footage.calibration",
                .file = project.footage.calibration.empty() && states_lens(project.footage)
                            ? "none is needed: 360 degree footage"
                            : project.footage.calibration,
                .extensions = extensions_for("footage.calibration"),
                .choose = put_file(context, "choose calibration", "footage.calibration")},
               {.name = "Model",
                .what = "Of the aircraft, as Wavefront OBJ; it is put 300 m ahead",
                .key = "intruders[0].model.file",
                .file = has_aircraft ? project.intruders.front().model.file : "",
                .extensions = extensions_for("intruders[0].model.file"),
                .choose = put_aircraft(context)},
               {.name = "Horizon",
                .what = "Drag the line onto the footage's horizon, its ends to tilt it",
                .key = "camera.attitude_deg",
                .file = horizon_text(context),
                .extensions = {},
                .choose = {}}}};
  return with_problems(std::move(steps), context.shown);
}

// Once the horizon is next, its line is shown.
const char* button_of(const FirstStep& step, bool is_next) {
  if (step.choose) return "Choose...";
  return is_next ? "It fits" : "Show line";
}

void ask(const ViewContext& context, const FirstStep& step, bool is_next) {
  if (!step.choose) return is_next ? keep_horizon(context) : context.edits.ask(ShowHorizon{});
  // Calibration and model often lie near the footage: the browser starts where it was last.
  context.edits.ask(
      AskForFile{.title = std::string("Choose: ") + step.name, .extensions = step.extensions, .chosen = step.choose});
}

void draw_number(int number, bool is_done, bool is_next) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 centre{low.x + side / 2, low.y + side * 0.75F};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (is_done) {
    draw_icon(list, Icon::check, centre, ImGui::GetFontSize(), color::kGood);
  } else {
    const std::string text = std::to_string(number);
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const ImU32 shade = is_next ? color::kAccent : color::kQuiet;
    list.AddCircle(centre, side * 0.45F, shade, 24, scaled(1.5));
    list.AddText({centre.x - extent.x / 2, centre.y - extent.y / 2}, shade, text.c_str());
  }
  ImGui::Dummy({side, side * 1.5F});
}

void draw_step(const ViewContext& context, const FirstStep& step, int number, bool is_next) {
  const bool is_done = step.is_done();
  ImGui::PushID(number);
  draw_number(number, is_done, is_next);
  ImGui::SameLine();
  const float button = is_done ? 0 : dialog_button_width(button_of(step, is_next)) + scaled(8);
  const float room = ImGui::GetContentRegionAvail().x - button;
  const float left = ImGui::GetCursorPosX();
  const float top = ImGui::GetCursorPosY();
  ImGui::BeginGroup();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, scaled(1)});
  draw_text(elided(step.name, room), color::kText, Font::bold);
  ImGui::PushFont(font(Font::small));
  const std::string status_text = is_done                ? fs::path(step.file).filename().string()
                                  : step.problem.empty() ? step.what
                                                         : step.problem;
  draw_text(elided(status_text, room), step.problem.empty() ? color::kQuiet : color::kBad);
  if (!step.problem.empty()) tooltip_for_item(step.problem.c_str());
  ImGui::PopFont();
  ImGui::PopStyleVar();
  ImGui::EndGroup();
  if (!is_done) {
    ImGui::SetCursorPos({left + room + scaled(8), top + scaled(3)});
    if (context.ui_probe.noted(dialog_button(button_of(step, is_next), is_next),
                               std::string("first steps/") + step.name))
      ask(context, step, is_next);
    if (!step.choose && is_next) tooltip_for_item("The line lies on the footage's horizon as it is");
  }
  ImGui::PopID();
}

// Files can be dropped; and all of them can be had at once.
void draw_other_ways(const ViewContext& context) {
  constexpr const char* kFromVideo = "From a video...";
  const float button = dialog_button_width(kFromVideo);
  ImGui::AlignTextToFramePadding();
  const float room = ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x;
  ImGui::TextDisabled("%s", elided("Drop the files onto this window, or have all made:", room).c_str());
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - button);
  if (context.ui_probe.noted(ImGui::Button(kFromVideo, {button, ImGui::GetFrameHeight()}), "first steps/new",
                             "Another project, with lens, light and flight guessed (Ctrl+N)"))
    context.edits.ask(ShowNewProject{});
}

}  // namespace

void FirstSteps::draw(const ViewContext& context, const ScreenRect& room) {
  const Steps steps = steps_of(context);
  const auto next = std::ranges::find_if(steps, [](const FirstStep& step) { return !step.is_done(); });
  const std::uint64_t document = context.document.first_number();
  if (std::any_of(steps.begin(), steps.begin() + kFiles, [](const FirstStep& step) { return step.file.empty(); }))
    begun_ = document;
  if (next == steps.end() || put_away_ == document || begun_ != document) return;
  // With all files there, the image is to be seen: the step that is left lies at its lower edge.
  const bool is_last = next == steps.end() - 1;
  if (is_last && std::exchange(shown_, document) != document) context.edits.ask(ShowHorizon{});
  const float line = ImGui::GetFrameHeight();
  const auto rows = static_cast<float>(is_last ? 1 : steps.size());
  const float gaps = (rows + 1) * ImGui::GetStyle().ItemSpacing.y;
  const float below = is_last ? 0 : ImGui::GetFrameHeight();
  const ImVec2 size{std::min(scaled(480), static_cast<float>(room.size().x) - scaled(16)),
                    std::ceil(scaled(28) + line + rows * 1.5F * line + gaps + below)};
  if (size.x < scaled(220) || size.y > static_cast<float>(room.size().y)) return;
  const glm::dvec2 middle = (room.low + room.high) / 2.0;
  const float top =
      is_last ? static_cast<float>(room.high.y) - size.y - scaled(44) : static_cast<float>(middle.y) - size.y / 2;
  ImGui::SetCursorScreenPos({std::floor(static_cast<float>(middle.x) - size.x / 2), std::floor(top)});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, color::kPanel);
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, scaled(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(16), scaled(14)});
  ImGui::BeginChild("first steps", size, false, ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
  ImGui::AlignTextToFramePadding();
  draw_text(is_last ? "Last step" : "First steps", color::kText, Font::bold);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - icon_button_width());
  if (context.ui_probe.noted(icon_button("put away", Icon::cross, "Put this away; the inspector has all of it"),
                             "first steps/close"))
    put_away_ = document;
  for (std::size_t i = is_last ? kFiles : 0; i < steps.size(); ++i)
    draw_step(context, steps[i], static_cast<int>(i) + 1, &steps[i] == &*next);
  if (!is_last) draw_other_ways(context);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace sigs::editor
