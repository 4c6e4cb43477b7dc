// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "project/project.h"

namespace sigs::editor {

// The project as it has to read when its file lies elsewhere: relative paths are rewritten to mean the same files,
// absolute ones stay, as somebody wanted them so. A project without a file could name its files absolutely alone (and
// relative paths are from the current folder): on its first save they are named as path_in_project() does.
[[nodiscard]] Project moved_to(Project project, const std::filesystem::path& file);

// How a project names a file: relative to the project's own folder where that takes no more than four steps up, else
// absolute. A project without a file names all files absolutely.
[[nodiscard]] std::string path_in_project(const Project& project, const std::filesystem::path& file);

// A file that the project names and that is not there.
struct MissingFile {
  std::string field;            // "footage.video"
  std::string path;             // as the project has it
  std::filesystem::path place;  // where that is: absolute

  [[nodiscard]] bool operator==(const MissingFile&) const = default;
};
[[nodiscard]] std::vector<MissingFile> missing_files(const Project& project);

// What a field gets whose file was found: the file itself; of a rig's calibration the same camera of it, of a pattern
// of images, one of which was chosen, the pattern in that folder.
[[nodiscard]] std::filesystem::path place_at(const MissingFile& missing, const std::filesystem::path& chosen);

// A field's file at another place.
struct Relinked {
  std::string field;
  std::filesystem::path place;

  [[nodiscard]] bool operator==(const Relinked&) const = default;
};

// Where the others probably are, once one is found: what has moved with it lies at the same place relative to it. The
// folders that both of its places end with count as moved along, first as many as possible, then fewer; at last the
// new folder itself is looked into. Proposes only files that exist; the found one is not among them.
[[nodiscard]] std::vector<Relinked> suggested_places(const std::vector<MissingFile>& missing, const MissingFile& found,
                                                     const std::filesystem::path& new_place);

// Writes them into the project, as path_in_project names files. Fields that it does not have are passed over.
void relink(Project& project, const std::vector<Relinked>& places);

// A file that belongs to a project: NAME + ending + extension beside it; beside the footage where the project was never
// saved.
[[nodiscard]] std::filesystem::path file_beside(const Project& project, const std::string& ending,
                                                const std::string& extension);
// One that is not there yet: the same, else NAME + ending_2 + extension and so on.
[[nodiscard]] std::filesystem::path new_file_beside(const Project& project, const std::string& ending,
                                                    const std::string& extension);

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
