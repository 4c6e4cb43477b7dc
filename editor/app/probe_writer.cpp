// SPDX-License-Identifier: MIT
#include "editor/app/probe_writer.h"

#include <imgui.h>

#include <iterator>
#include <string>
#include <vector>

#include "base/staged_outputs.h"

namespace sigs::editor {

namespace {

std::vector<std::string> problems_of(const PreviewOutput& shown) {
  std::vector<std::string> problems;
  if (!shown.scene) return problems;
  if (!shown.scene->footage->problem.empty()) problems.push_back(shown.scene->footage->problem);
  for (const Problem& problem : shown.scene->draft.problems) problems.push_back(problem.field + ": " + problem.what);
  return problems;
}

constexpr int kTurnsToShow = 3;  // what an event leads to, as in App

nlohmann::json input_of(const ImGuiIO& io, int released_keys) {
  unsigned buttons = 0;
  for (unsigned i = 0; i < std::size(io.MouseDown); ++i) buttons |= io.MouseDown[i] ? 1U << i : 0U;
  return {{"mouse", {io.MousePos.x, io.MousePos.y}}, {"buttons", buttons}, {"released_keys", released_keys}};
}

}  // namespace

// Once per update.
bool ProbeWriter::is_at_rest(const nlohmann::json& input, bool has_input_left) {
  if (has_input_left || input != last_input_)
    turns_to_rest_ = kTurnsToShow;
  else if (turns_to_rest_ > 0)
    --turns_to_rest_;
  last_input_ = input;
  return turns_to_rest_ == 0;
}

void ProbeWriter::write(const Document& document, const PreviewOutput& shown, const UiProbe& ui_probe,
                        const ProbedWindow& window) {
  if (!wanted()) return;
  nlohmann::json json;
  json["frame"] = document.playhead();
  json["revision"] = document.revision().number;
  json["unsaved"] = document.has_unsaved_changes();
  json["current"] = shown.image_is_current;
  json["busy"] = shown.busy;
  json["page"] = window.page;
  json["problems"] = problems_of(shown);
  const MemoryUse& memory = shown.memory;
  json["memory"] = {{"pictures", memory.images},   {"decoded", memory.decoded}, {"shown", memory.shown},
                    {"textures", memory.textures}, {"sum", memory.sum()},       {"limit", memory.limit}};
  json["turns_a_second"] = window.updates_per_second;
  const nlohmann::json input = input_of(ImGui::GetIO(), window.released_keys);
  json.update(input);
  json["at_rest"] = is_at_rest(input, window.has_input_left);
  for (const auto& [name, rect] : ui_probe.all())
    json["places"][name] = {rect.low.x, rect.low.y, rect.size().x, rect.size().y};
  ++update_;
  const std::string text = json.dump();
  if (text == last_) return;
  json["turn"] = update_;
  if (write_text(file_, json.dump() + "\n", true)) last_ = text;
}

}  // namespace sigs::editor
