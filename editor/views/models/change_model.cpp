// SPDX-License-Identifier: MIT
#include "editor/views/models/change_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/document/field_edits.h"
#include "editor/document/project_paths.h"
#include "editor/views/export_view.h"
#include "editor/widgets/dialog.h"
#include "first_project/first_model.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr const char* kOwnModel = "OBJ file...";
constexpr int kImageWidth_px = 220;
constexpr int kImageHeight_px = 132;
constexpr float kImageShape = float(kImageHeight_px) / kImageWidth_px;
constexpr ImU32 kSky = IM_COL32(104, 118, 138, 255);  // dark and white models stand out alike
constexpr double kTileWidth = 92;                     // at least

// The sample that a model was copied from, by its name.
std::optional<std::size_t> sample_called(const std::vector<SampleModel>& samples, const std::string& model) {
  const fs::path name = fs::path(model).filename();
  const auto found =
      std::ranges::find_if(samples, [&](const SampleModel& sample) { return sample.file.filename() == name; });
  if (found == samples.end()) return std::nullopt;
  return static_cast<std::size_t>(found - samples.begin());
}

}  // namespace

ModelGallery::ModelGallery(const fs::path& samples, std::function<void()> wake)
    : samples_(sample_models_in(samples)),
      images_({kImageWidth_px, kImageHeight_px}, std::move(wake), model_thumbnail) {}

bool ModelGallery::draw_tile(const ViewContext& context, const std::string& name, const fs::path& file, bool is_chosen,
                             float width) {
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float image_height = width * kImageShape;
  const float text_height = font(Font::small)->FontSize + scaled(6);
  const bool is_pressed = ImGui::InvisibleButton(name.c_str(), {width, image_height + text_height});
  const bool is_hovered = ImGui::IsItemHovered();
  if (is_hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{place.x + width, place.y + image_height + text_height};
  const ImVec2 image_end{end.x, place.y + image_height};
  const float rounding = scaled(4);
  list.AddRectFilled(place, end, is_chosen || is_hovered ? IM_COL32(58, 64, 76, 255) : IM_COL32(46, 50, 58, 255),
                     rounding);
  list.AddRectFilled(place, image_end, kSky, rounding, ImDrawFlags_RoundCornersTop);
  const auto image = file.empty() ? nullptr : images_.of(file);
  if (image && !image->empty()) {
    list.AddImage(context.textures.of(*image, Filter::smooth), place, image_end);
    context.ui_probe.note("gallery image/" + name, {dv(place), dv(image_end)});
  } else {
    draw_icon(list, file.empty() ? Icon::folder : Icon::aircraft, {(place.x + end.x) / 2, (place.y + image_end.y) / 2},
              scaled(20), faded(color::kText, 0.7));
  }
  if (is_chosen || is_hovered)
    list.AddRect(place, end, is_chosen ? color::kAccent : faded(color::kAccent, 0.5), rounding, 0, scaled(1.5));
  ImGui::PushFont(font(Font::small));
  const std::string shown = elided(name, width - scaled(6));
  const float text = ImGui::CalcTextSize(shown.c_str()).x;
  list.AddText({place.x + (width - text) / 2, image_end.y + scaled(1)}, is_chosen ? color::kText : color::kQuiet,
               shown.c_str());
  ImGui::PopFont();
  tooltip_for_item(file.empty() ? "A model of yours, as Wavefront OBJ" : shown == name ? "" : name.c_str());
  return is_pressed;
}

std::optional<ModelGallery::Pressed> ModelGallery::draw(const ViewContext& context, const std::string& place,
                                                        std::optional<std::size_t> chosen, const fs::path& own) {
  const float gap = scaled(6);
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>((room + gap) / (scaled(kTileWidth) + gap)));
  const float width = (room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
  std::optional<Pressed> pressed;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  for (std::size_t i = 0; i <= samples_.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0, gap);
    const std::optional<std::size_t> one = i < samples_.size() ? std::optional(i) : std::nullopt;
    std::error_code code;
    const fs::path own_file = fs::is_regular_file(own, code) ? own : fs::path();
    const std::string name = one ? samples_[i].name : kOwnModel;
    const bool is_pressed =
        draw_tile(context, name, one ? samples_[i].file : own_file, chosen == one, std::floor(width));
    const bool is_twice = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (is_pressed || is_twice) pressed = Pressed{.sample = one, .twice = is_twice};
    context.ui_probe.note_item(place + "/" + name);
  }
  ImGui::PopStyleVar();
  return pressed;
}

Result<ChosenModel> chosen_model(const ModelChoice& choice, const JobControl& control) {
  SceneFiles files;
  Result<FirstModel> model =
      is_sample_model(choice.model) ? sample_model(choice.model, files) : users_model(choice.model, files);
  if (!model) return fail(model.error());
  ChosenModel chosen{.file = choice.model,
                     .settings = model->settings,
                     .category = model->category,
                     .guesses = {},
                     .warnings = std::move(model->warnings)};
  for (const FirstProjectNote& note : model->notes)
    if (note.is_guess && note.field.find(".model.") != std::string::npos) chosen.guesses.push_back(note.text);
  if (const Result<void> on = check_interrupt(control.cancel); !on) return fail(on.error());
  if (choice.project.file.empty()) return chosen;
  Result<fs::path> copy = model_copied_into(fs::absolute(choice.project.file).parent_path(), choice.model);
  if (!copy) return fail(copy.error());
  chosen.file = *std::move(copy);
  return chosen;
}

void use_model(Project& project, int intruder, const ChosenModel& chosen) {
  IntruderSettings& changed = project.intruders.at(static_cast<std::size_t>(intruder));
  const bool is_by_model =
      changed.category == category_of_model(changed.model.file) || changed.category == IntruderSettings().category;
  const bool is_as_category = changed.trajectory.attitude == attitude_of_category(changed.category);
  if (is_by_model && is_as_category) changed.trajectory.attitude = attitude_of_category(chosen.category);
  if (is_by_model) changed.category = chosen.category;
  changed.model = chosen.settings;
  changed.model.file = path_in_project(project, chosen.file);
}

ChangeModelDialog::ChangeModelDialog(ModelGallery& gallery, std::function<void()> wake)
    : gallery_(gallery), job_(std::move(wake), chosen_model) {}

void ChangeModelDialog::open(const Project& project, int intruder) {
  if (intruder < 0 || static_cast<std::size_t>(intruder) >= project.intruders.size()) return;
  const std::string& file = project.intruders[static_cast<std::size_t>(intruder)].model.file;
  intruder_ = intruder;
  chosen_ = sample_called(gallery_.samples(), file);
  own_ = chosen_ || file.empty() ? fs::path() : resolved(project, file);
  problem_.clear();
  open_ = true;
}

void ChangeModelDialog::start(const ViewContext& context) {
  problem_.clear();
  const fs::path model = chosen_ ? gallery_.samples()[*chosen_].file : own_;
  if (model.empty()) {
    problem_ = "Choose a model.";
    return;
  }
  is_awaited_ = job_.start({.project = context.project(), .intruder = intruder_, .model = model});
}

void ChangeModelDialog::take_result(const ViewContext& context) {
  if (!is_awaited_ || job_.is_running()) return;
  is_awaited_ = false;
  const auto state = job_.state();
  if (state.phase == JobPhase::failed) problem_ = state.error.text();
  if (state.phase != JobPhase::done) return;
  context.edits.change("change model", [chosen = state.value, intruder = intruder_](Project& project) {
    use_model(project, intruder, *chosen);
  });
  std::string text = "Model: " + state.value->file.filename().string();
  for (const std::string& guess : state.value->guesses) text += "; guessed: " + guess;
  context.edits.ask(ShowMessage{text});
  for (const Warning& warning : state.value->warnings) context.edits.ask(ShowMessage{warning.text()});
  closed_ = true;
}

void ChangeModelDialog::draw_choice(const ViewContext& context) {
  ImGui::PushStyleColor(ImGuiCol_Text, color::kQuiet);
  ImGui::TextWrapped("%s", context.document.has_file()
                               ? "The model's files are copied into the project's folder; its flight stays."
                               : "The project was never saved: the model is used where it lies. Its flight stays.");
  ImGui::PopStyleColor();
  ImGui::Dummy({0, scaled(2)});
  const std::optional<ModelGallery::Pressed> pressed = gallery_.draw(context, "models", chosen_, own_);
  if (!pressed) return;
  problem_.clear();
  if (pressed->sample) {
    chosen_ = pressed->sample;
    if (pressed->twice) start(context);
    return;
  }
  context.edits.ask(AskForFile{.title = "Choose the aircraft's model",
                               .extensions = extensions_for("intruders[0].model.file"),
                               .start = own_,
                               .chosen = [this](const fs::path& path) {
                                 own_ = path;
                                 chosen_.reset();
                               }});
}

void ChangeModelDialog::draw(const ViewContext& context) {
  closed_ = false;
  if (!begin_dialog("Change model###change model", 680, 0, closed_)) {
    open_ = open_ && !closed_;
    return;
  }
  const bool is_copying = job_.is_running();
  ImGui::BeginDisabled(is_copying);
  draw_choice(context);
  ImGui::EndDisabled();
  if (!chosen_ && !own_.empty()) {
    ImGui::TextDisabled("%s", elided_front(own_.string(), ImGui::GetContentRegionAvail().x).c_str());
    context.ui_probe.note_item("models/own file");
  }
  if (!problem_.empty()) {
    note_line(Icon::warning, color::kBad, problem_);
    context.ui_probe.note_item("models/problem");
  }
  ImGui::Dummy({0, scaled(6)});
  align_buttons_right({"Cancel", "Use this model"});
  if (context.ui_probe.noted(dialog_button("Cancel"), "models/cancel")) closed_ = true;
  ImGui::SameLine();
  const bool is_entered = enter_pressed();
  if (dialog_button("Use this model", true, !is_copying) || (is_entered && !is_copying)) start(context);
  context.ui_probe.note_item("models/use");
  if (closed_ && is_awaited_) {
    job_.cancel();
    is_awaited_ = false;
  }
  take_result(context);
  open_ = !closed_;
  end_dialog(open_);
}

}  // namespace sigs::editor
