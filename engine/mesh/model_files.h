// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "base/paths.h"
#include "base/result.h"

namespace sigs {

// All files that read_obj() reads: the OBJ file, the MTL files that its lines name, and the images that lines of those
// name, as far as they exist. A line with blanks may name one file or several: each file that could be meant is listed.
// Error cannot_read for the OBJ file.
[[nodiscard]] Result<std::vector<std::filesystem::path>> files_of_model(const std::filesystem::path& file);

// Stamps of all files of models. A model's files are listed once, and anew where one of them or one of their folders
// has changed; without a change only stamps are asked for.
class ModelStamps {
 public:
  // Of one model: never empty, its own file first. Valid until the next call.
  [[nodiscard]] const std::vector<FileStamp>& of(const std::filesystem::path& file);

 private:
  struct Listed {
    std::vector<FileStamp> files;
    std::vector<FileStamp> folders;  // that hold them: a file that was missing appears in one of these
  };
  std::map<std::filesystem::path, Listed> listed_;
};

}  // namespace sigs
