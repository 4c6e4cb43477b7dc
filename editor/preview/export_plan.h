// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/export_project.h"

namespace sigs::editor {

// Where an export goes unless the person says otherwise: "out" beside the project file, else in the home folder.
[[nodiscard]] std::filesystem::path usual_export_folder(const Project& project);

// What an export will be called: videos and annotations, or folders of numbered images. footage: the project's.
[[nodiscard]] std::vector<std::filesystem::path> outputs_of(const Project& project, const VideoInfo& footage,
                                                            const std::filesystem::path& folder);

// The same of a project with several cameras, whose footage is given by their index.
[[nodiscard]] std::vector<std::filesystem::path> outputs_of_rig(const Project& whole,
                                                                const std::vector<VideoInfo>& footage,
                                                                const std::filesystem::path& folder);

// Those that are there: they would be overwritten.
[[nodiscard]] std::vector<std::filesystem::path> those_there(std::vector<std::filesystem::path> paths);

// What `--set` needs to make one project of the other: "export.video.codec=h264".
struct Assignments {
  std::vector<std::string> texts;
  bool are_all = true;  // false: more is needed, and those are the settings of the export alone
};

// Not all can be said where waypoints or intruders are added or taken away, or more than kMaxAssignments settings
// differ.
inline constexpr std::size_t kMaxAssignments = 12;
[[nodiscard]] Assignments assignments_between(const Project& saved, const Project& present);

// The equal command, quoted for a shell: "sigs export 'my project.json' --frames 10-20 --out out"; of one camera of a
// rig with `--camera`.
//   assignments  for `--set`
[[nodiscard]] std::string export_command(const ExportRequest& request,
                                         const std::vector<std::string>& assignments = {});

}  // namespace sigs::editor
