// SPDX-License-Identifier: MIT
#include "editor/document/rig_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/paths.h"
#include "editor/document/project_paths.h"

namespace sigs::editor {

namespace {

bool is_taken(const Project& whole, const std::string& name) {
  return std::ranges::find(whole.cameras, name, &RigCamera::name) != whole.cameras.end();
}

std::string new_name(const Project& whole, const std::filesystem::path& video) {
  std::string name = video.stem().string();
  if (name.empty() || !file_name_error(name).empty()) name = fmt::format("camera {}", whole.cameras.size() + 1);
  const std::string stem = name;
  for (int number = 2; is_taken(whole, name); ++number) name = fmt::format("{} {}", stem, number);
  return name;
}

}  // namespace

void add_camera(Project& whole, const std::filesystem::path& video) {
  if (whole.cameras.empty()) {
    whole.cameras.emplace_back().name = "camera 1";
    whole.cameras.front().footage = std::exchange(whole.footage, {});
  }
  RigCamera added;
  added.name = new_name(whole, video);
  added.footage.video = path_in_project(whole, video);
  whole.cameras.push_back(std::move(added));
}

void remove_camera(Project& whole, std::size_t camera) {
  if (camera == 0 || camera >= whole.cameras.size()) return;
  whole.cameras.erase(whole.cameras.begin() + static_cast<std::ptrdiff_t>(camera));
  if (whole.cameras.size() > 1 || whole.cameras.front().mount != MountSettings()) return;
  RigCamera& left = whole.cameras.front();
  whole.footage = std::move(left.footage);
  if (left.readout_s) whole.camera.readout_s = left.readout_s;
  if (left.exposure_s) whole.camera.exposure_s = left.exposure_s;
  if (left.appearance) whole.appearance = *left.appearance;
  whole.cameras.clear();
}

std::string why_not_called(const Project& whole, std::size_t camera, const std::string& name) {
  if (name.empty()) return "A camera needs a name.";
  if (const std::string wrong = file_name_error(name); !wrong.empty()) return "The name " + wrong + ".";
  for (std::size_t i = 0; i < whole.cameras.size(); ++i)
    if (i != camera && whole.cameras[i].name == name) return "Another camera is called so.";
  return "";
}

}  // namespace sigs::editor
