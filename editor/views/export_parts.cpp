// SPDX-License-Identifier: MIT
#include "editor/views/export_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "editor/views/readable.h"
#include "editor/widgets/dialog.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/open_outside.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

// In the order of the project's choices.
constexpr std::array kCodecs{"ffv1 (lossless)", "h264 (small)", "mjpeg", "png (numbered pictures)"};
constexpr std::array kContainers{"auto", "mkv", "mp4", "avi"};
constexpr std::array kMasks{"none", "video", "png (numbered pictures)"};

template <class Choice, std::size_t N>
bool choose(const Studio& studio, const char* id, const std::array<const char*, N>& names, Choice& value, float width) {
  ImGui::SetNextItemWidth(width);
  auto index = static_cast<int>(value);
  const bool changed = ImGui::Combo((std::string("##") + id).c_str(), &index, names.data(), static_cast<int>(N));
  studio.places.note_item(std::string("export/") + id);
  if (changed) value = static_cast<Choice>(index);
  return changed;
}

void draw_written(const Studio& studio, const ExportState& state) {
  for (std::size_t i = 0; i < state.report.written.size(); ++i) {
    const fs::path& path = state.report.written[i];
    ImGui::PushID(static_cast<int>(i));
    if (icon_button("copy path", Icon::copy, "Copy the path")) {
      ImGui::SetClipboardText(path.c_str());
      studio.edits.ask(Say{"Copied " + path.filename().string()});
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(elided(path.string(), ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopID();
  }
}

}  // namespace

void note_line(Icon icon, ImU32 color, const std::string& text) {
  icon_label(icon, color);
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void draw_video_choices(const Studio& studio) {
  ExportSettings output = studio.project().output;
  if (choose(studio, "codec", kCodecs, output.codec, scaled(210)))
    studio.edits.change("codec", [codec = output.codec](Project& p) {
      // A container that was chosen for another codec may not hold this one.
      if (p.output.codec != codec) p.output.container = ContainerChoice::automatic;
      p.output.codec = codec;
    });
  if (output.codec == CodecChoice::png) return;
  ImGui::SameLine();
  if (choose(studio, "container", kContainers, output.container, scaled(90)))
    studio.edits.change("container", [container = output.container](Project& p) { p.output.container = container; });
  tooltip_for_item("Container; auto: mkv for ffv1, mp4 for h264, avi for mjpeg");
  if (output.codec != CodecChoice::h264) return;
  ImGui::SetNextItemWidth(scaled(210));
  if (ImGui::SliderInt("##crf", &output.crf, 0, 51, "crf %d", ImGuiSliderFlags_AlwaysClamp))
    studio.edits.change(
        "crf", [crf = output.crf](Project& p) { p.output.crf = crf; }, "export crf");
  if (ImGui::IsItemDeactivated()) studio.edits.end_gesture();
  studio.places.note_item("export/crf");
  tooltip_for_item("Quality of h264: 0 lossless, 18 visually so, 51 worst");
}

void draw_mask_choice(const Studio& studio) {
  ExportSettings output = studio.project().output;
  if (choose(studio, "masks", kMasks, output.masks, scaled(210)))
    studio.edits.change("masks", [masks = output.masks](Project& p) { p.output.masks = masks; });
}

void draw_label_choice(const Studio& studio) {
  const std::vector<std::string>& labels = studio.project().output.labels;
  bool xml = std::find(labels.begin(), labels.end(), "xml") != labels.end();
  if (ImGui::Checkbox("SIGS XML", &xml))
    studio.edits.change("labels", [xml](Project& p) {
      std::erase(p.output.labels, "xml");
      if (xml) p.output.labels.emplace_back("xml");
    });
  studio.places.note_item("export/labels");
}

std::string progress_text(const ExportState& state) {
  if (state.is_stopping) return "Stopping...";
  if (state.total == 0) return "Opening footage and models...";
  std::string text = std::to_string(state.done) + " of " + std::to_string(state.total) + " frames";
  if (state.done == state.total) return text + ", finishing the files...";
  if (state.rate_hz) {
    std::array<char, 48> rate{};
    std::snprintf(rate.data(), rate.size(), ", %.1f frames/s", *state.rate_hz);
    text += rate.data();
  }
  if (state.left_s) text += ", " + clock_text(*state.left_s) + " left";
  return text;
}

void draw_result(const Studio& studio, const ExportState& state) {
  if (state.phase == ExportPhase::failed) {
    note_line(Icon::warning, color::kBad, state.error.text());
    ImGui::TextDisabled("Nothing was written.");
    return;
  }
  if (state.phase == ExportPhase::cancelled) {
    note_line(Icon::info, color::kQuiet, "Cancelled. Nothing was written.");
    return;
  }
  const double wall_s = state.report.times.wall_s;
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%d frames in %s, %.1f frames/s", state.report.frames,
                clock_text(wall_s).c_str(), state.report.frames / std::max(wall_s, 1e-3));
  note_line(Icon::check, color::kGood, text.data());
  draw_written(studio, state);
  if (!can_open_outside()) return;
  if (dialog_button("Open folder") && !open_outside(state.request.folder))
    studio.edits.ask(Say{state.request.folder.string() + " could not be opened", true});
  studio.places.note_item("export/open folder");
}

void draw_warnings(const ExportState& state) {
  constexpr std::size_t kMost = 6;
  const std::size_t count = state.warnings.size();
  for (std::size_t i = 0; i < std::min(kMost, count); ++i)
    note_line(Icon::warning, color::kPartly, state.warnings[i].text());
  if (count > kMost) ImGui::TextDisabled("and %zu more", count - kMost);
}

}  // namespace sigs::editor
