// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/input_file.h"  // read_text, the other half of write_text
#include "base/result.h"
#include "base/staged_outputs.h"

namespace sigs {

// One output that appears under its final name only when it is complete; several that belong together are
// StagedOutputs. Write to part(), then keep(); without keep() the part is removed when this goes out of scope.
class PartialFile {
 public:
  // Makes the part, empty, in a staging folder beside the final name. Error cannot_create where the final name is taken
  // and overwrite is false, the folder is not there, the final name is that of a folder or a device, or another process
  // is writing an output of that name. The part is called as the final file will be, for libraries that look at it.
  [[nodiscard]] static Result<PartialFile> create(std::filesystem::path final_path, bool overwrite);

  // The same for a folder of files, which is empty at first. may_go: whether the folder that is there may be replaced.
  [[nodiscard]] static Result<PartialFile> create_folder(std::filesystem::path final_path, bool overwrite,
                                                         StagedOutputs::MayGo may_go = {});

  [[nodiscard]] const std::filesystem::path& part() const { return part_; }
  [[nodiscard]] const std::filesystem::path& final_path() const { return final_; }

  // Gives the part its final name once it is on the disk. Errors as StagedOutputs::keep().
  [[nodiscard]] Result<void> keep() { return outputs_.keep(); }

 private:
  PartialFile(std::filesystem::path final_path, std::filesystem::path part, StagedOutputs outputs);

  std::filesystem::path final_;
  std::filesystem::path part_;
  StagedOutputs outputs_;
};

// A whole small file. Errors: cannot_create, write_failed (also when the disk is full).
[[nodiscard]] Result<void> write_text(const std::filesystem::path& path, std::string_view text, bool overwrite);

}  // namespace sigs
