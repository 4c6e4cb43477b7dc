// SPDX-License-Identifier: MIT
#include "editor/views/start_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "editor/document/project_paths.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr int kCardImageWidth_px = 480;
constexpr int kCardImageHeight_px = 270;
constexpr float kCardImageShape = float(kCardImageHeight_px) / kCardImageWidth_px;

std::string time_ago(std::int64_t unix_s) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t minutes = (std::chrono::duration_cast<std::chrono::seconds>(now).count() - unix_s) / 60;
  const auto text = [](std::int64_t count, const char* unit) { return count_text(count, unit) + " ago"; };
  if (minutes < 1) return "just now";
  if (minutes < 60) return text(minutes, "minute");
  return minutes < 2880 ? text(minutes / 60, "hour") : text(minutes / 1440, "day");
}

std::string text_of(const AbandonedProject& project) {
  const std::string where = project.project_file.empty() ? "never saved" : project.project_file.string();
  return fmt::format("{}  -  {}, {}{}", shortened(project.name, 60), time_ago(project.written_unix_s), where,
                     project.has_mask ? ", with an own-body mask" : "");
}

void heading(const char* text) {
  ImGui::Dummy({0, scaled(10)});
  draw_text(text, color::kText, Font::bold);
  ImGui::Dummy({0, scaled(2)});
}

void quiet_text(const std::string& text) {
  draw_text(text, color::kQuiet);
}

// The text's first sentence below its headings, without line breaks and backquotes. A semicolon or colon before a space
// ends it too, and becomes a full stop.
std::string first_sentence(const std::string& markdown) {
  std::string text;
  std::size_t begin = 0;
  while (begin < markdown.size()) {
    const std::size_t end = std::min(markdown.find('\n', begin), markdown.size());
    const std::string line = markdown.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("#")) continue;
    if (line.empty() && !text.empty()) break;
    if (line.empty()) continue;
    text += (text.empty() ? "" : " ") + line;
  }
  std::erase(text, '`');
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if ((text[i] == '.' || text[i] == ';' || text[i] == ':') && text[i + 1] == ' ') return text.substr(0, i) + ".";
  return text;
}

}  // namespace

StartPage::StartPage(const fs::path& samples, std::function<void()> wake)
    : samples_(samples_in(samples)),
      images_({kCardImageWidth_px, kCardImageHeight_px}, std::move(wake), project_thumbnail) {}

std::vector<SampleProject> samples_in(const fs::path& folder) {
  std::vector<SampleProject> samples;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const fs::path file = it->path() / (it->path().filename().string() + ".json");
    std::error_code unknown;
    if (!fs::exists(file, unknown) || classified_drop(file).kind != DroppedKind::project) continue;  // or a recipe
    const Result<std::string> readme = read_text(it->path() / "README.md");
    samples.push_back({file, it->path().filename().string(), readme ? first_sentence(*readme) : std::string()});
  }
  std::ranges::sort(samples, {}, &SampleProject::name);
  return samples;
}

void StartPage::look_for(const std::vector<fs::path>& recent) {
  const bool same = std::equal(recent.begin(), recent.end(), recent_.begin(), recent_.end(),
                               [](const fs::path& path, const Recent& known) { return path == known.file; });
  if (same) return;
  recent_.clear();
  for (const fs::path& path : recent) {
    std::error_code code;
    recent_.push_back({path, fs::exists(path, code)});
  }
}

void StartPage::draw_head(const ViewContext& context, const fs::path& loading) {
  draw_text("SIGS", color::kText, Font::title);
  draw_wrapped("Puts simulated aircraft into real UAV footage, with exact ground truth.", color::kQuiet);
  ImGui::Dummy({0, scaled(6)});
  if (context.ui_probe.noted(dialog_button("New project", true), "start/new",
                             "Make a project of a video (Ctrl+N); or drop the video onto this window"))
    context.edits.ask(ShowNewProject{});
  ImGui::SameLine();
  if (context.ui_probe.noted(dialog_button("Open..."), "start/open",
                             "Open a project file (Ctrl+O); or drop one onto this window"))
    context.edits.ask(OpenProject{});
  quiet_text("or drop a video, a folder of images or a project onto this window");
  if (loading.empty()) return;
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  quiet_text(elided(fmt::format("Reading {}...", loading.filename().string()), ImGui::GetContentRegionAvail().x));
}

void StartPage::draw_abandoned(const ViewContext& context, const std::vector<AbandonedProject>& abandoned,
                               StartPageChoice& choice) {
  if (abandoned.empty()) return;
  heading("Not saved when the editor last ended");
  for (std::size_t i = 0; i < abandoned.size(); ++i) {
    const AbandonedProject& project = abandoned[i];
    const bool is_readable = project.problem.empty();
    ImGui::PushID(static_cast<int>(i));
    if (is_readable) {
      if (context.ui_probe.noted(dialog_button("Open##recover", true), fmt::format("start/recover.{}", i)))
        choice.recover = project;
      ImGui::SameLine();
    }
    if (context.ui_probe.noted(dialog_button("Discard##recover"), fmt::format("start/discard.{}", i)))
      choice.discard = project;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::string text = is_readable ? text_of(project) : "Cannot be read: " + project.recovery_file.string();
    draw_text(elided(text, ImGui::GetContentRegionAvail().x), is_readable ? color::kText : color::kPartly);
    tooltip_for_item(is_readable ? text.c_str() : (text + "\n" + project.problem).c_str());
    ImGui::PopID();
  }
}

void StartPage::draw_card(const ViewContext& context, const SampleProject& sample, float width, float height) {
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float image_height = width * kCardImageShape;
  if (context.ui_probe.noted(ImGui::InvisibleButton(sample.name.c_str(), {width, height}),
                             "start/sample." + sample.name))
    context.edits.ask(OpenProject{sample.file});
  const bool hovered = ImGui::IsItemHovered();
  if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{place.x + width, place.y + height};
  const ImVec2 image_end{end.x, place.y + image_height};
  const float rounding = scaled(6);
  list.AddRectFilled(place, end, hovered ? IM_COL32(48, 52, 61, 255) : IM_COL32(38, 41, 48, 255), rounding);
  if (const auto image = images_.of(sample.file))
    list.AddImageRounded(context.textures.of(*image, Filter::smooth), place, image_end, {0, 0}, {1, 1}, IM_COL32_WHITE,
                         rounding, ImDrawFlags_RoundCornersTop);
  else
    list.AddRectFilled(place, image_end, color::kCanvas, rounding, ImDrawFlags_RoundCornersTop);
  if (hovered) list.AddRect(place, end, color::kAccent, rounding, 0, scaled(1.5));
  const float pad = scaled(10);
  const float line = ImGui::GetTextLineHeight();
  ImGui::PushFont(font(Font::bold));
  list.AddText({place.x + pad, image_end.y + pad}, color::kText, elided(sample.name, width - 2 * pad).c_str());
  ImGui::PopFont();
  const ImVec2 text{place.x + pad, image_end.y + pad + line + scaled(3)};
  list.PushClipRect(text, {end.x - pad, end.y - scaled(4)}, true);
  list.AddText(font(Font::small), font(Font::small)->FontSize, text, color::kQuiet, sample.text.c_str(), nullptr,
               width - 2 * pad);
  list.PopClipRect();
}

void StartPage::draw_samples(const ViewContext& context, float width) {
  if (samples_.empty()) return;
  heading("Sample projects");
  const float gap = scaled(14);
  const int maximum = std::max(1, static_cast<int>((width + gap) / (scaled(200) + gap)));
  const int columns = std::min(maximum, static_cast<int>(samples_.size()));
  const float card =
      std::min(scaled(300), (width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
  const float small = font(Font::small)->FontSize;
  float text = 0;
  for (const SampleProject& sample : samples_)
    text = std::max(text, font(Font::small)->CalcTextSizeA(small, FLT_MAX, card - scaled(20), sample.text.c_str()).y);
  const float height =
      card * kCardImageShape + scaled(26) + ImGui::GetTextLineHeight() + std::min(text, 4 * small + scaled(6));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) != 0)
      ImGui::SameLine(0, gap);
    else if (i > 0)
      ImGui::Dummy({0, gap - 2 * ImGui::GetStyle().ItemSpacing.y});
    draw_card(context, samples_[i], card, height);
  }
}

void StartPage::draw_recent(const ViewContext& context, float width) {
  if (recent_.empty()) return;
  heading("Recent projects");
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    const auto& [file, is_there] = recent_[i];
    const ImVec2 place = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight() + scaled(10);
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable("##recent", false, is_there ? 0 : ImGuiSelectableFlags_Disabled, {width, height}))
      context.edits.ask(OpenProject{file});
    ImGui::PopID();
    context.ui_probe.note_item(fmt::format("start/recent.{}", i),
                               is_there ? file.c_str() : (file.string() + " is not there").c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 main = is_there ? color::kText : faded(color::kQuiet, 0.6);
    const float y = place.y + scaled(5);
    draw_icon(list, Icon::file, {place.x + scaled(12), place.y + height / 2}, scaled(15), faded(main, 0.7));
    const std::string name = elided(file.stem().string(), width * 0.4F);
    list.AddText({place.x + scaled(28), y}, main, name.c_str());
    const float x = scaled(28) + std::max(scaled(150), ImGui::CalcTextSize(name.c_str()).x + scaled(16));
    const std::string folder = file.parent_path().string() + (is_there ? "" : "  (not there)");
    list.AddText({place.x + x, y}, faded(color::kQuiet, is_there ? 1 : 0.6),
                 elided(folder, width - x - scaled(6)).c_str());
  }
}

StartPageChoice StartPage::draw(const ViewContext& context, const std::vector<AbandonedProject>& abandoned,
                                const fs::path& loading) {
  look_for(context.settings.recent);
  images_.rest(!loading.empty());
  StartPageChoice choice;
  const float room = ImGui::GetContentRegionAvail().x;
  const float width = std::min(room - scaled(48), scaled(940));
  ImGui::BeginChild("start page", {0, 0});
  ImGui::SetCursorPos({(room - width) / 2, scaled(36)});
  ImGui::BeginChild("start content", {width, ImGui::GetContentRegionAvail().y}, false);
  draw_head(context, loading);
  draw_abandoned(context, abandoned, choice);
  const float inner = ImGui::GetContentRegionAvail().x;
  draw_samples(context, inner);
  draw_recent(context, inner);
  ImGui::Dummy({0, scaled(30)});
  ImGui::EndChild();
  ImGui::EndChild();
  return choice;
}

}  // namespace sigs::editor
