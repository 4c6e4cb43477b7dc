// SPDX-License-Identifier: MIT
#include "editor/app/probe.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/partial_file.h"

namespace sigs::editor {

namespace {

std::vector<std::string> problems_of(const Shown& shown) {
  std::vector<std::string> problems;
  if (!shown.scene) return problems;
  if (!shown.scene->footage->problem.empty()) problems.push_back(shown.scene->footage->problem);
  for (const Problem& problem : shown.scene->draft.problems) problems.push_back(problem.field + ": " + problem.what);
  return problems;
}

}  // namespace

void Probe::tell(const Document& document, const Shown& shown, const Places& places, const ProbedWindow& window) {
  if (!wanted()) return;
  nlohmann::json json;
  json["frame"] = document.playhead();
  json["revision"] = document.revision().number;
  json["unsaved"] = document.has_unsaved_changes();
  json["current"] = shown.picture_is_current;
  json["busy"] = shown.busy;
  json["page"] = window.page;
  json["problems"] = problems_of(shown);
  const MemoryUse& memory = shown.memory;
  json["memory"] = {{"pictures", memory.pictures}, {"decoded", memory.decoded}, {"shown", memory.shown},
                    {"textures", memory.textures}, {"sum", memory.sum()},       {"limit", memory.limit}};
  json["turns_a_second"] = window.turns_a_second;
  for (const auto& [name, rect] : places.all())
    json["places"][name] = {rect.low.x, rect.low.y, rect.size().x, rect.size().y};
  ++turn_;
  const std::string text = json.dump();
  if (text == last_) return;
  json["turn"] = turn_;
  if (write_text(file_, json.dump() + "\n", true)) last_ = text;
}

}  // namespace sigs::editor
