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
// StagedOutputs. Write to temporary_path(), then commit(); without commit() the temporary file is removed when this
// goes out of scope.
class TemporaryFile {
 public:
  // Makes the temporary file, empty, in a staging folder beside the final name. Error cannot_create where the final
  // name is taken and overwrite is false, the folder is not there, the final name is that of a folder or a device, or
  // another process is writing an output of that name. The temporary file is called as the final file will be, for
  // libraries that look at it.
  [[nodiscard]] static Result<TemporaryFile> create(std::filesystem::path final_path, bool overwrite);

  // The same for a folder of files, which is empty at first. may_replace: whether the folder that is there may be
  // replaced.
  [[nodiscard]] static Result<TemporaryFile> create_folder(std::filesystem::path final_path, bool overwrite,
                                                           StagedOutputs::MayReplace may_replace = {});

  [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_path_; }
  [[nodiscard]] const std::filesystem::path& final_path() const { return final_; }

  // Gives the temporary file its final name once it is on the disk. Errors as StagedOutputs::commit().
  [[nodiscard]] Result<void> commit() { return outputs_.commit(); }

 private:
  TemporaryFile(std::filesystem::path final_path, std::filesystem::path temporary_path, StagedOutputs outputs);

  std::filesystem::path final_;
  std::filesystem::path temporary_path_;
  StagedOutputs outputs_;
};

// A whole small file. Errors: cannot_create, write_failed (also when the disk is full).
[[nodiscard]] Result<void> write_text(const std::filesystem::path& path, std::string_view text, bool overwrite);

}  // namespace sigs
