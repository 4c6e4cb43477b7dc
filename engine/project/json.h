// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "project/project.h"

namespace sigs {

// A project as it was read from its file.
struct ReadProject {
  Project project;
  std::vector<Warning> warnings;  // unknown keys; they are kept on save
};

// The most that a project file may have, so that a file of 64 MiB is an error rather than a wait (docs/limits.md):
// intruders; waypoints of all intruders together, which are two hours at a waypoint for each of 30 frames a second;
// cameras of a rig.
inline constexpr std::size_t kMaxIntruders = 10'000;
inline constexpr std::size_t kMaxWaypoints = 250'000;
inline constexpr std::size_t kMaxRotors = 64;  // of an intruder
inline constexpr std::size_t kMaxCameras = 100;

// Reads a project file. Checks its form only; validate() checks the values. Errors name file and field: cannot_read
// where there is no such file, else bad_project.
[[nodiscard]] Result<ReadProject> read_project(const std::filesystem::path& path);

// The same for the text of a file. `path` is the file's name in messages, and relative paths start in its folder.
[[nodiscard]] Result<ReadProject> parse_project(const std::string& text, const std::filesystem::path& path);

// The project as JSON text, with all fields and the unknown keys that were read. Numbers read back as the same values.
[[nodiscard]] std::string text_of(const Project& project);

// The value of a setting or of a group of settings, by its key ("camera.speed_mps", "intruders[0].trajectory"), as JSON
// text in one line. Empty where the project has none of that key. Equal texts are equal values.
[[nodiscard]] std::string setting_text(const Project& project, const std::string& key);
[[nodiscard]] std::vector<std::string> setting_texts(const Project& project, const std::vector<std::string>& keys);

// The settings of these keys, nested as in a project file. Keys that the project does not have are left out.
[[nodiscard]] Json settings_json(Project project, const std::vector<std::string>& keys);

// Writes the project file, which appears only when it is complete. Errors as those of write_text().
[[nodiscard]] Result<void> write_project(const Project& project, const std::filesystem::path& path, bool overwrite);

// A key of the project file that had another name in older files: "appearance.point_spread_px" is
// "appearance.psf_sigma_px" today. Old names are read wherever today's are; only today's are written.
struct RenamedKey {
  std::string_view old_key;
  std::string_view key;
};

[[nodiscard]] std::span<const RenamedKey> renamed_keys();

// The name that a key has today: its new one where it was renamed, else itself.
[[nodiscard]] std::string current_key(const std::string& key);

// Moves the values that stand under old names in a part of a project file to today's names, and gives back a warning
// for each. Where both stand there, today's counts and the old one stays as it is.
//   section  the part's key in the project, "appearance"; empty: the whole project
//   where    what warnings put before the key, "p.json: "
std::vector<Warning> rename_old_keys(Json& json, std::string_view section, const std::string& where);

}  // namespace sigs
