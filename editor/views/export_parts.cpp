// SPDX-License-Identifier: MIT
#include "editor/views/export_view.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "base/text.h"
#include "editor/document/field_edits.h"
#include "editor/widgets/dialog.h"
#include "labels/labels.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

// This desktop's program that opens folders and files, xdg-open; "": it has none.
fs::path opener() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "xdg-open";
    if (::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

// Only what may be called between fork and exec in a program with threads.
[[noreturn]] void run_detached(const char* program, const char* argument) {
  ::setsid();
  if (::fork() != 0) ::_exit(0);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) ::dup2(nowhere, stream);
  ::execl(program, program, argument, static_cast<char*>(nullptr));
  ::_exit(127);
}

// Opens it with that program, which outlives us. False where that cannot be started.
bool open_with_desktop(const fs::path& path) {
  const std::string program = opener().string();
  const std::string argument = fs::absolute(path).string();
  if (program.empty()) return false;
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) run_detached(program.c_str(), argument.c_str());
  int status = 0;
  return ::waitpid(child, &status, 0) == child;
}

// In the order of the project's choices.
constexpr std::array kCodecs{"ffv1 (lossless)",
                             "h264 (small)",
                             "hevc (smaller, slower)",
                             "av1 (smaller, slow)",
                             "mjpeg",
                             "png (numbered images)",
                             "tiff (numbered images)",
                             "jpeg (numbered images)",
                             "raw (uncompressed)",
                             "source (mostly copied)"};
constexpr std::array kContainers{"auto", "mkv", "mp4", "avi", "nut", "y4m"};
constexpr std::array kMasks{"none", "video", "png (numbered images)"};

template <class Choice, std::size_t N>
bool choose(const ViewContext& context, const char* id, const std::array<const char*, N>& names, Choice& value,
            float width) {
  ImGui::SetNextItemWidth(width);
  auto index = static_cast<int>(value);
  constexpr int kCount = static_cast<int>(N);  // all of them in sight
  const bool changed =
      context.ui_probe.noted(ImGui::Combo((std::string("##") + id).c_str(), &index, names.data(), kCount, kCount),
                             fmt::format("export/{}", id));
  if (changed) value = static_cast<Choice>(index);
  return changed;
}

void draw_written(const ViewContext& context, const ExportState& state) {
  for (std::size_t i = 0; i < state.value->written.size(); ++i) {
    const fs::path& path = state.value->written[i];
    ImGui::PushID(static_cast<int>(i));
    if (icon_button("copy path", Icon::copy, "Copy the path")) {
      ImGui::SetClipboardText(path.c_str());
      context.edits.ask(ShowMessage{"Copied " + path.filename().string()});
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(elided(path.string(), ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopID();
  }
}

bool is_chosen(const ExportSettings& output, std::string_view format) {
  return std::ranges::find(output.labels, format) != output.labels.end();
}

// The formats stay in one order, however they are chosen.
void choose_label(ExportSettings& output, std::string_view format, bool chosen) {
  std::vector<std::string> labels;
  for (const LabelFormat& one : label_formats())
    if (one.name == format ? chosen : is_chosen(output, one.name)) labels.emplace_back(one.name);
  output.labels = std::move(labels);
}

void draw_label_format(const ViewContext& context, const LabelFormat& format) {
  const std::string name(format.name);
  bool chosen = is_chosen(context.project().output, name);
  if (context.ui_probe.noted(ImGui::Checkbox(name.c_str(), &chosen), "export/labels/" + name, std::string(format.help)))
    context.edits.change("labels", [name, chosen](Project& p) { choose_label(p.output, name, chosen); });
}

bool has_thresholds(const ExportSettings& output) {
  return std::ranges::any_of(output.labels, [](const std::string& label) {
    const LabelFormat* const format = label_format(label);
    return format != nullptr && format->has_thresholds;
  });
}

// Which labels a threshold leaves out, and which formats it does not apply to.
std::string threshold_help(std::string_view left_out) {
  return fmt::format("No label where {}; {} leave nothing out", left_out, listed(names_without_thresholds(), " and "));
}

}  // namespace

void note_line(Icon icon, ImU32 color, const std::string& text) {
  icon_label(icon, color);
  ImGui::SameLine();
  draw_wrapped(shortened(text), color);
}

void draw_video_choices(const ViewContext& context) {
  ExportSettings output = context.project().output;
  if (choose(context, "codec", kCodecs, output.codec, scaled(210)))
    context.edits.change("codec", [codec = output.codec](Project& p) {
      // A container that was chosen for another codec may not hold this one.
      if (p.output.codec != codec) p.output.container = ContainerChoice::automatic;
      p.output.codec = codec;
      if (const int worst = max_crf(codec); worst > 0) p.output.crf = std::min(p.output.crf, worst);
    });
  ImGui::SameLine();
  ImGui::BeginDisabled(writes_images(output.codec) || output.codec == VideoCodec::source);
  if (choose(context, "container", kContainers, output.container, scaled(90)))
    context.edits.change("container", [container = output.container](Project& p) { p.output.container = container; });
  ImGui::EndDisabled();
  tooltip_for_item(
      "Container; auto: mkv for ffv1, mp4 for h264, hevc and av1, avi for mjpeg, nut for raw, the footage's own for "
      "source");
}

void draw_quality(const ViewContext& context) {
  ExportSettings output = context.project().output;
  const int worst = max_crf(output.codec);
  const bool is_jpeg = output.codec == VideoCodec::jpeg;
  begin_setting(label_of(is_jpeg ? "export.video.quality" : "export.video.crf").c_str());
  ImGui::SetNextItemWidth(scaled(210));
  ImGui::BeginDisabled(worst == 0 && !is_jpeg);
  int& value = is_jpeg ? output.jpeg_quality : output.crf;
  const char* const format = worst > 0 || is_jpeg ? "%d" : "not of this codec";
  if (ImGui::SliderInt("##crf", &value, is_jpeg ? 1 : 0, is_jpeg ? 100 : std::max(worst, 51), format,
                       ImGuiSliderFlags_AlwaysClamp))
    context.edits.change(
        "quality", [output](Project& p) { p.output.crf = output.crf, p.output.jpeg_quality = output.jpeg_quality; },
        "export crf");
  if (ImGui::IsItemDeactivated()) context.edits.end_gesture();
  ImGui::EndDisabled();
  context.ui_probe.note_item("export/crf", is_jpeg ? "1 worst, 100 best"
                                           : worst > 0
                                               ? fmt::format("0 lossless, 18 visually so, {} worst", worst).c_str()
                                               : "Counts for h264, hevc, av1 and jpeg alone");
}

void draw_thresholds(const ViewContext& context) {
  ExportSettings output = context.project().output;
  ImGui::BeginDisabled(!has_thresholds(output));
  begin_setting(label_of("export.label_min_pixels").c_str());
  ImGui::SetNextItemWidth(scaled(150));
  if (ImGui::DragInt("##min pixels", &output.label_min_pixels, 0.2F, 1, 1'000'000, "%d px",
                     ImGuiSliderFlags_AlwaysClamp))
    context.edits.change(
        "min pixels", [px = output.label_min_pixels](Project& p) { p.output.label_min_pixels = px; },
        "export least pixels");
  if (ImGui::IsItemDeactivated()) context.edits.end_gesture();
  context.ui_probe.note_item("export/least pixels", threshold_help("fewer pixels show the intruder"));
  begin_setting(label_of("export.label_min_visible_fraction").c_str());
  ImGui::SetNextItemWidth(scaled(150));
  auto percent = static_cast<float>(100 * output.label_min_visible_fraction);
  if (ImGui::SliderFloat("##least visible", &percent, 0, 100, "%.0f %%", ImGuiSliderFlags_AlwaysClamp))
    context.edits.change(
        "least visible",
        [share = std::round(percent) / 100.0](Project& p) { p.output.label_min_visible_fraction = share; },
        "export least visible");
  if (ImGui::IsItemDeactivated()) context.edits.end_gesture();
  context.ui_probe.note_item("export/least visible", threshold_help("less of the intruder can be seen"));
  ImGui::EndDisabled();
}

void draw_mask_choice(const ViewContext& context) {
  ExportSettings output = context.project().output;
  if (choose(context, "masks", kMasks, output.masks, scaled(210)))
    context.edits.change("masks", [masks = output.masks](Project& p) { p.output.masks = masks; });
}

void draw_label_choice(const ViewContext& context) {
  constexpr int kColumns = 5;
  const float column = scaled(84);
  const float left = ImGui::GetCursorPosX();
  int place = 0;
  for (const LabelFormat& format : label_formats()) {
    if (place % kColumns != 0) {
      ImGui::SameLine();
      ImGui::SetCursorPosX(left + static_cast<float>(place % kColumns) * column);
    }
    ++place;
    draw_label_format(context, format);
  }
}

std::string progress_text(const ExportState& state) {
  if (state.is_stopping) return "Stopping...";
  if (state.total == 0) return "Opening footage and models...";
  std::string text = fmt::format("{} of {}", state.done, count_text(state.total, "frame"));
  if (state.done == state.total) return text + ", finishing the files...";
  if (state.rate_hz) text += fmt::format(", {:.1f} frames/s", *state.rate_hz);
  if (state.left_s) text += fmt::format(", {} left", clock_text(*state.left_s));
  return text;
}

std::string short_progress_text(const ExportState& state) {
  if (state.total == 0) return "Export begins";
  std::string text = fmt::format("Export {} %", 100 * state.done / state.total);
  if (state.left_s) text += fmt::format(", {} left", clock_text(*state.left_s));
  return text;
}

void draw_result(const ViewContext& context, const ExportState& state) {
  if (state.phase == JobPhase::failed) {
    note_line(Icon::warning, color::kBad, state.error.text());
    ImGui::TextDisabled("Nothing was written.");
    return;
  }
  if (state.phase == JobPhase::cancelled)
    return note_line(Icon::info, color::kQuiet, "Cancelled. Nothing was written.");
  const double wall_s = state.value->times.wall_s;
  const int frames = state.value->frames;
  note_line(Icon::check, color::kGood,
            fmt::format("{} in {}, {:.1f} frames/s", count_text(frames, "frame"), clock_text(wall_s),
                        frames / std::max(wall_s, 1e-3)));
  draw_written(context, state);
  static const bool can_open_with_desktop = !opener().empty();
  if (!can_open_with_desktop) return;
  if (context.ui_probe.noted(dialog_button("Open folder"), "export/open folder") &&
      !open_with_desktop(state.request.folder))
    context.edits.ask(ShowMessage{state.request.folder.string() + " could not be opened", true});
}

void draw_warnings(const ExportState& state) {
  constexpr std::size_t kMax = 100;
  const std::size_t count = state.warnings.size();
  for (std::size_t i = 0; i < std::min(kMax, count); ++i)
    note_line(Icon::warning, color::kPartly, state.warnings[i].text());
  if (count > kMax) ImGui::TextDisabled("and %zu more", count - kMax);
}

}  // namespace sigs::editor
