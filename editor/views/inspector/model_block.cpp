// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "base/text.h"
#include "editor/preview/jobs.h"
#include "editor/preview/thumbnails.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr double kMaxListRows = 6;        // of the list, before it scrolls
constexpr double kMaxPreviewWidth = 300;  // where the text is 15 px high
constexpr double kTurnAPixel_rad = 0.01;  // a drag across the preview is about half a turn

std::string key_of(int intruder) {
  return fmt::format("intruders[{}]", intruder);
}

std::string decimetres(double metres) {
  return number_text(std::round(metres * 10) / 10);
}

void draw_buttons(const ViewContext& context, std::optional<int> intruder) {
  ButtonFlow flow;
  if (context.ui_probe.noted(flow.button("Add", "Another intruder, 300 m ahead of the camera and crossing"),
                             "inspector/add intruder"))
    add_intruder(context);
  if (context.ui_probe.noted(flow.button("Duplicate", "A copy of this one, 30 m to its right", intruder.has_value()),
                             "inspector/duplicate intruder"))
    duplicate_intruder(context, *intruder);
  if (context.ui_probe.noted(flow.button("Delete", "Takes this intruder out of the project", intruder.has_value()),
                             "inspector/delete intruder"))
    delete_intruder(context, *intruder);
}

RowOptions look_of(const Field& field, const IntruderSettings& intruder) {
  RowOptions look;
  if (field.key.ends_with(".forward") || field.key.ends_with(".up")) look.names = {"+x", "-x", "+y", "-y", "+z", "-z"};
  if (field.key.ends_with(".scale") && intruder.model.length_m > 0)
    look.off_because = "The length says how large it is.";
  return look;
}

bool is_named_as_rotor(const std::string& name) {
  const std::string lower = lower_case(name);
  return std::ranges::any_of(std::array{"prop", "rotor", "blade"},
                             [&](const char* word) { return lower.find(word) != std::string::npos; });
}

// The names by which a part of a model is chosen: materials, groups and objects, each once; those of rotors first.
std::vector<std::string> part_names(const ViewContext& context, int intruder) {
  std::vector<std::string> names;
  const std::optional<int> in_scene = scene_intruder(context, intruder);
  if (!in_scene) return names;
  const Mesh& mesh = shown_scene(context)->intruders[static_cast<std::size_t>(*in_scene)].model->mesh;
  std::set<std::string> there{""};
  const auto add = [&](const std::string& name) {
    if (there.insert(name).second) names.push_back(name);
  };
  for (const Material& material : mesh.materials) add(material.name);
  for (const std::string& name : mesh.group_names) add(name);
  std::stable_partition(names.begin(), names.end(), is_named_as_rotor);
  return names;
}

// Of the first part that is named as one, if there is any: a propeller ahead, else a rotor above.
RotorSettings likely_rotor(const std::vector<std::string>& parts) {
  RotorSettings rotor{.axis = {0, 0, -1}};
  if (!parts.empty() && is_named_as_rotor(parts.front())) rotor.part = parts.front();
  if (lower_case(rotor.part).find("prop") != std::string::npos) rotor.axis = {1, 0, 0};
  return rotor;
}

// In the middle of what is left of a frame.
void draw_centred(ImVec2 low, ImVec2 size, const std::string& text) {
  const std::string shown = elided(text, size.x - scaled(12));
  const ImVec2 extent = ImGui::CalcTextSize(shown.c_str());
  ImGui::GetWindowDrawList()->AddText({low.x + (size.x - extent.x) / 2, low.y + (size.y - extent.y) / 2}, color::kQuiet,
                                      shown.c_str());
}

// However it is spelt: a project that was saved elsewhere names the same file by another way.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code code;
  return std::filesystem::absolute(a, code).lexically_normal() == std::filesystem::absolute(b, code).lexically_normal();
}

// From the model's middle along an axis of it, with a word at the tip.
void draw_axis(ImDrawList& list, ImVec2 low, ImVec2 size, const glm::dvec3& axis_in_body, double turn_rad, ImU32 color,
               const char* word) {
  const cv::Size size_px(static_cast<int>(size.x), static_cast<int>(size.y));
  const glm::dvec2 begin = turntable_point_px({0, 0, 0}, turn_rad, size_px);
  const glm::dvec2 end = turntable_point_px(axis_in_body, turn_rad, size_px);
  const ImVec2 from{low.x + static_cast<float>(begin.x), low.y + static_cast<float>(begin.y)};
  const ImVec2 tip{low.x + static_cast<float>(end.x), low.y + static_cast<float>(end.y)};
  list.AddLine(from, tip, color, scaled(1.5));
  const double length = glm::length(end - begin);
  if (length > 1) {
    const glm::dvec2 along = (end - begin) / length * static_cast<double>(scaled(8));
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) * 0.45;
    const auto at = [&](const glm::dvec2& p) {
      return ImVec2{low.x + static_cast<float>(p.x), low.y + static_cast<float>(p.y)};
    };
    list.AddTriangleFilled(at(end + along * 0.4), at(end - along * 0.6 + across), at(end - along * 0.6 - across),
                           color);
  }
  const ImVec2 extent = ImGui::CalcTextSize(word);
  const float x = tip.x >= from.x ? tip.x + scaled(6) : tip.x - scaled(6) - extent.x;
  list.AddText({std::clamp(x, low.x + scaled(2), low.x + size.x - extent.x - scaled(2)),
                std::clamp(tip.y - extent.y / 2, low.y, low.y + size.y - extent.y)},
               color, word);
}

}  // namespace

void ModelBlock::draw_list(const ViewContext& context, const FieldRows& rows) {
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  const std::optional<int> chosen = current_intruder(context);
  const auto count = static_cast<int>(intruders.size());
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("intruders", {0, line * static_cast<float>(std::min<double>(count, kMaxListRows))});
  ImGuiListClipper clipper;
  clipper.Begin(count, line);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      if (context.ui_probe.noted(ImGui::Selectable("##intruder", chosen == i), "inspector/" + key_of(i)))
        context.edits.select({Selected::intruder, i, 0});
      const ImVec2 low = ImGui::GetItemRectMin();
      const ImVec2 high = ImGui::GetItemRectMax();
      ImDrawList& list = *ImGui::GetWindowDrawList();
      const float middle = (low.y + high.y) / 2;
      list.AddCircleFilled({low.x + scaled(10), middle}, scaled(4), intruder_color(i), 12);
      const bool is_wrong = has_problem(rows.problems(), key_of(i));
      const std::string& name = intruders[static_cast<std::size_t>(i)].name;
      const std::string shown = elided(name.empty() ? "(no name)" : name, high.x - low.x - scaled(is_wrong ? 44 : 24));
      list.AddText({low.x + scaled(20), middle - ImGui::GetFontSize() / 2}, color::kText, shown.c_str());
      if (is_wrong) draw_icon(list, Icon::warning, {high.x - scaled(12), middle}, ImGui::GetFontSize(), color::kBad);
      ImGui::PopID();
    }
  ImGui::EndChild();
}

void ModelBlock::draw_preview(const ViewContext& context, int intruder) {
  const float width = std::min(ImGui::GetContentRegionAvail().x, scaled(kMaxPreviewWidth));
  const ImVec2 size{std::floor(width), std::floor(width * 0.6F)};
  ImGui::InvisibleButton("preview", size);
  context.ui_probe.note_item("inspector/model preview");
  const ModelImage* const model = context.shown.model.get();
  const std::string& file = context.project().intruders[static_cast<std::size_t>(intruder)].model.file;
  const bool is_of_this = model != nullptr && is_same_file(model->file, resolved(context.project(), file));
  const bool has_failed = is_of_this && !model->problem.empty();
  // The line of its size is there before the size is known, and while the image is out of sight: nothing below moves.
  const auto leave_line = [&] {
    if (!file.empty() && !has_failed) note(" ");
  };
  if (!ImGui::IsItemVisible()) return leave_line();
  if (ImGui::IsItemActive())
    turn_rad_ = std::remainder(turn_rad_ - kTurnAPixel_rad * static_cast<double>(ImGui::GetIO().MouseDelta.x),
                               2 * std::numbers::pi);
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  context.needs.turntable = PreviewRequest::Turntable{
      .intruder = intruder, .turn_rad = turn_rad_, .size_px = {static_cast<int>(size.x), static_cast<int>(size.y)}};
  tooltip_for_item(
      "Drag to turn. Does the model's nose point along the arrow, its top upwards? If not, change the axes below.");

  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, color::kCanvas, scaled(4));
  if (!is_of_this || model->rgba.empty()) {
    draw_centred(low, size, file.empty() ? "no model" : has_failed ? "no image" : "...");
    return leave_line();
  }
  list.AddImage(context.textures.of(model->rgba, Filter::smooth), low, high);
  context.ui_probe.note_item("inspector/model image");
  draw_axis(list, low, size, {1, 0, 0}, turn_rad_, color::kAccent, "nose");
  draw_axis(list, low, size, {0, 0, -1}, turn_rad_, color::kText, "top");
  note(fmt::format("{} m long, {} m span, {} m high", decimetres(model->size_m.x), decimetres(model->size_m.y),
                   decimetres(model->size_m.z)));
}

void ModelBlock::draw_rotors(const ViewContext& context, FieldRows& rows, int intruder) {
  const std::vector<RotorSettings>& rotors =
      context.project().intruders[static_cast<std::size_t>(intruder)].model.rotors;
  const std::vector<std::string> parts = rotors.empty() ? std::vector<std::string>() : part_names(context, intruder);
  const auto change = [&](const char* what, auto&& edit) {
    context.edits.change(
        what, [=](Project& project) { edit(project.intruders[static_cast<std::size_t>(intruder)].model.rotors); });
  };
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    const std::string key = fmt::format("{}.model.rotors[{}]", key_of(intruder), i);
    ImGui::PushID(key.c_str());
    ImGui::Spacing();
    ImGui::AlignTextToFramePadding();
    ImGui::Text("Rotor %d", static_cast<int>(i) + 1);
    ImGui::SameLine();
    if (context.ui_probe.noted(ImGui::Button("Remove"), "inspector/remove rotor " + std::to_string(i),
                               "The part is drawn as the model has it"))
      change("remove rotor", [i](std::vector<RotorSettings>& all) {
        if (i < all.size()) all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
      });
    rows.rows(key + ".", [&](const Field& field) {
      RowOptions look;
      if (field.key.ends_with(".part")) look.names = parts;
      if (field.key.ends_with(".rpm")) look.suggested = 300;
      if (field.key.ends_with(".hub_m") && !(rotors[i].radius_m > 0)) look.off_because = "Counts with a radius alone.";
      return look;
    });
    ImGui::PopID();
  }
  if (context.ui_probe.noted(ImGui::Button("Add rotor"), "inspector/add rotor",
                             "Makes a part of the model turn, as the shutter sees it: a propeller or a rotor that its "
                             "files do not describe as one"))
    change("add rotor", [likely = likely_rotor(part_names(context, intruder))](std::vector<RotorSettings>& all) {
      all.push_back(likely);
    });
}

void ModelBlock::draw(const ViewContext& context, FieldRows& rows) {
  const std::optional<int> intruder = current_intruder(context);
  if (intruder)
    draw_list(context, rows);
  else
    note("No intruder yet. Add one, or drop a Wavefront OBJ file onto the window.");
  draw_buttons(context, intruder);
  if (!intruder) return;
  ImGui::Spacing();
  const std::string key = key_of(*intruder);
  const IntruderSettings& settings = context.project().intruders[static_cast<std::size_t>(*intruder)];
  rows.row(key + ".name");
  rows.row(key + ".model.file");
  if (context.ui_probe.noted(ImGui::Button("Change model..."), "inspector/change model",
                             "Shows the models that come with the program, and takes one of yours"))
    context.edits.ask(ShowModels{*intruder});
  draw_preview(context, *intruder);
  for (const Field& field : rows.sheet().fields())
    if (field.key.starts_with(key + ".model.") && field.key != key + ".model.file" &&
        !field.key.starts_with(key + ".model.rotors["))
      rows.row(field.key, look_of(field, settings));
  draw_rotors(context, rows, *intruder);
  rows.rows(key + ".contrail.", [&](const Field& field) {
    return off_where(settings.contrail.strands == 0 && !field.key.ends_with("strands"), "It has no contrail.");
  });
  if (context.project().footage.spectrum == Spectrum::thermal) return rows.rows(key + ".heat.");
  if (context.ui_probe.noted(ImGui::Button(settings.lights.is_dark() ? "Lights on" : "Lights off"), "inspector/lights",
                             "Position lights, strobes and beacons as aircraft of this category have them; seen at "
                             "dusk and by night. White is, in the block Light, says how dark it is."))
    context.edits.change(settings.lights.is_dark() ? "lights on" : "lights off", [=](Project& project) {
      IntruderSettings& changed = project.intruders[static_cast<std::size_t>(*intruder)];
      changed.lights = changed.lights.is_dark() ? usual_lights(changed.category) : LampSettings{};
    });
  if (!settings.lights.is_dark()) rows.rows(key + ".lights.");
}

}  // namespace sigs::editor
