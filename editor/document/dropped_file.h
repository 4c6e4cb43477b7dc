// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "editor/document/document.h"
#include "project/project.h"

namespace sigs::editor {

enum class DroppedKind { nothing, project, video, calibration, model, mask, results };

// Kind of a file that was dropped onto the window, recognised by its first bytes, else by its extension.
struct DroppedFile {
  DroppedKind kind = DroppedKind::nothing;
  std::filesystem::path path;
  std::string problem;  // where kind is nothing: the message to show
};
[[nodiscard]] DroppedFile classified_drop(const std::filesystem::path& path);

// The change that the file makes to the project: footage, calibration or mask are replaced; a model replaces that of
// the selected intruder, or is a further intruder 300 m ahead of the camera. Nothing for projects, for results of
// trackers and for what is none of these.
[[nodiscard]] std::optional<ChangeProject> change_by(const DroppedFile& dropped, const Selection& selection);

}  // namespace sigs::editor
