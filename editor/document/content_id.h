// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>

#include "base/paths.h"
#include "mesh/model_files.h"
#include "project/project.h"

namespace sigs::editor {

// A digest (FNV-1a, 128 bits, RFC 9923) of what images are made from. Equal digests mean equal content: two different
// contents of one session do not meet by chance. The default value belongs to nothing.
struct ContentId {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  [[nodiscard]] auto operator<=>(const ContentId&) const = default;
};

// Digest of the settings that the images and the truth of a project depend on, with its paths resolved to absolute
// ones. Left out are the project's own name and place, how its own body is looked for, its export settings, and keys
// that this program does not know. Reads nothing from disk.
[[nodiscard]] ContentId content_id_of(const Project& project);

// Digest of the stamps of all files that a project names (footage, calibration, mask, attitude, flight log, models with
// their materials and textures): another one as soon as one of them appears, disappears or is written. Of images named
// by a pattern it is their folder. Asks the file system.
//   models  keeps which files belong to a model
[[nodiscard]] ContentId input_files_id_of(const Project& project, ModelStamps& models);

// Digest of both: images with equal ids are the same.
[[nodiscard]] ContentId combined_id(const ContentId& content, const ContentId& input_files);

// How often files are looked at for changes from outside.
inline constexpr std::chrono::milliseconds kFileCheckInterval(1000);

// Digest of one stamp.
[[nodiscard]] ContentId id_of(const FileStamp& stamp);

}  // namespace sigs::editor
