// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "export/export_project.h"

namespace sigs::editor {

// Where an export goes unless the person says otherwise: "out" beside the project file, else in the home folder.
[[nodiscard]] std::filesystem::path usual_export_folder(const Project& project);

// What an export will be called: videos and annotations, or folders of numbered images.
[[nodiscard]] std::vector<std::filesystem::path> outputs_of(const Project& project,
                                                            const std::filesystem::path& folder);

// Those that are there: they would be overwritten.
[[nodiscard]] std::vector<std::filesystem::path> outputs_there(const Project& project,
                                                               const std::filesystem::path& folder);

// The equal command, quoted for a shell: "sigs export 'my project.json' --frames 10-20 --out out".
[[nodiscard]] std::string export_command(const ExportRequest& request);

}  // namespace sigs::editor
