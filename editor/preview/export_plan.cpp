// SPDX-License-Identifier: MIT
#include "editor/preview/export_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "export/export_project.h"
#include "labels/labels.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/project.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

bool is_plain(char c) {
  const std::string_view others = "_-./,:@%+=";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         others.find(c) != std::string_view::npos;
}

std::string quoted(const std::string& word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain) && word.front() != '-') return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

fs::path usual_export_folder(const Project& project) {
  if (!project.file.empty()) return fs::absolute(project.file).lexically_normal().parent_path() / "out";
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) / "out" : fs::absolute("out");
}

std::vector<fs::path> outputs_of(const Project& project, const VideoInfo& footage, const fs::path& folder) {
  const ExportSettings& output = project.output;
  std::string video = project.name;
  if (!writes_images(output.codec)) video += std::string(".") + extension_of(container_of(output, footage));
  std::vector<fs::path> paths{folder / video};
  if (output.masks == MasksChoice::video) paths.push_back(folder / (project.name + ".masks.mkv"));
  if (output.masks == MasksChoice::png) paths.push_back(folder / (project.name + ".masks"));
  for (const std::string& label : output.labels)
    if (const LabelFormat* format = label_format(label))
      paths.push_back(folder / (project.name + std::string(format->suffix)));
  if (!output.encounter.empty()) paths.push_back(folder / (project.name + std::string(kEncounterSuffix)));
  return paths;
}

std::vector<fs::path> outputs_of_rig(const Project& whole, const std::vector<VideoInfo>& footage,
                                     const fs::path& folder) {
  std::vector<fs::path> paths;
  for (std::size_t i = 0; i < whole.cameras.size(); ++i) {
    const VideoInfo own = i < footage.size() ? footage[i] : VideoInfo();
    for (fs::path& path : outputs_of(seen_by(whole, i), own, folder)) paths.push_back(std::move(path));
  }
  for (const std::string_view suffix : {kRigSuffix, kRigTableSuffix})
    paths.push_back(folder / (whole.name + std::string(suffix)));
  return paths;
}

std::vector<fs::path> those_there(std::vector<fs::path> paths) {
  std::erase_if(paths, [](const fs::path& path) {
    std::error_code code;
    return !fs::exists(path, code);
  });
  return paths;
}

Assignments assignments_between(const Project& saved, const Project& present) {
  Project copy = present;
  std::vector<std::string> keys;
  for (const Field& field : fields_of(copy)) keys.push_back(field.key);
  const std::vector<std::string> before = setting_texts(saved, keys);
  const std::vector<std::string> after = setting_texts(present, keys);
  Assignments all, of_export{.texts = {}, .are_all = false};
  Project reached = saved;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (before[i] == after[i]) continue;
    const nlohmann::json value = nlohmann::json::parse(after[i], nullptr, false);
    all.texts.push_back(keys[i] + "=" + (value.is_string() ? value.get<std::string>() : after[i]));
    all.are_all = all.are_all && all.texts.size() <= kMaxAssignments && set_field(reached, all.texts.back());
    if (keys[i].starts_with("export.")) of_export.texts.push_back(all.texts.back());
  }
  return all.are_all && text_of(reached) == text_of(present) ? all : of_export;
}

std::string export_command(const ExportRequest& request, const std::vector<std::string>& assignments) {
  const fs::path& file = request.project.file;
  std::string text = "sigs export " + (file.empty() ? std::string("PROJECT.json") : quoted(file.string()));
  if (request.project.rig_view) text += " --camera " + quoted(request.project.rig_view->name);
  for (const std::string& assignment : assignments) text += " --set " + quoted(assignment);
  if (request.frames) text += fmt::format(" --frames {}-{}", request.frames->first, request.frames->last);
  text += " --out " + quoted(request.folder.string());
  if (request.overwrite) text += " --force";
  return text;
}

}  // namespace sigs::editor
