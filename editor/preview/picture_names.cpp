// SPDX-License-Identifier: MIT
#include "editor/preview/picture_names.h"

#include <string>
#include <system_error>

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

std::string whole_path(const Project& project, const std::string& path) {
  if (path.empty()) return {};
  std::error_code code;
  const fs::path resolved_path = resolved(project, path);
  const fs::path absolute = fs::absolute(resolved_path, code);
  return (code ? resolved_path : absolute).lexically_normal().string();
}

}  // namespace

FileStamp stamp_of(const fs::path& path) {
  FileStamp stamp{.path = path};
  if (path.empty()) return stamp;
  std::error_code code;
  stamp.bytes = fs::file_size(path, code);
  if (code) stamp.bytes = 0;
  stamp.changed = fs::last_write_time(path, code);
  stamp.exists = !code;
  if (code) stamp.changed = {};
  return stamp;
}

PictureName picture_name_of(const Project& project) {
  PictureName name{.project = project};
  Project& kept = name.project;
  kept.file.clear();
  kept.name.clear();
  kept.own_body = {};  // only the mask that came of it counts
  kept.output = {};
  kept.unknown_json.clear();
  std::vector<std::string*> paths{&kept.footage.video, &kept.footage.calibration, &kept.footage.own_body_mask,
                                  &kept.camera.attitude_file};
  for (IntruderSettings& intruder : kept.intruders) {
    intruder.unknown_json.clear();
    for (WaypointSettings& waypoint : intruder.trajectory.waypoints) waypoint.unknown_json.clear();
    paths.push_back(&intruder.model.file);
  }
  for (std::string* path : paths) {
    *path = whole_path(project, *path);
    name.files.push_back(stamp_of(*path));
  }
  return name;
}

FileStamp footage_name_of(const Project& project) {
  return stamp_of(whole_path(project, project.footage.video));
}

}  // namespace sigs::editor
