// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/partial_file.h"
#include "base/result.h"
#include "cli/made_folders.h"

namespace sigs::cli {

// The folder of one evaluation: there whole, or not at all.
class EvaluationFolder {
 public:
  // Keeps the name for this run. A folder that is there must be empty or, with overwrite, hold nothing but what an
  // evaluation writes. inputs are read by this run and may not lie in it. Error cannot_create.
  [[nodiscard]] static Result<EvaluationFolder> reserved(const std::filesystem::path& folder, bool overwrite,
                                                         const std::vector<std::filesystem::path>& inputs);

  // Where its files are written to.
  [[nodiscard]] const std::filesystem::path& part() const { return file_.part(); }

  // Gives it its name. Returns where the files lie that were written to part().
  [[nodiscard]] Result<std::vector<std::filesystem::path>> keep(const std::vector<std::filesystem::path>& written);

 private:
  EvaluationFolder(std::filesystem::path shown, MadeFolders folders, PartialFile file)
      : shown_(std::move(shown)), folders_(std::move(folders)), file_(std::move(file)) {}

  std::filesystem::path shown_;  // as the user calls it
  MadeFolders folders_;          // those above it
  PartialFile file_;
};

}  // namespace sigs::cli
