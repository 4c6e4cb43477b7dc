// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/input_file.h"  // read_text, the other half of write_text
#include "base/result.h"

namespace sigs {

// An output that appears under its final name only when it is complete. Write to part(), then keep(); without keep()
// the part is removed when this goes out of scope. The part lies beside the final file, so that the last step is a
// rename.
class PartialFile {
 public:
  // Makes the part, empty, and keeps others from writing it: two exports of one name never mix.
  // Error cannot_create where the final file exists and overwrite is false, the folder is not there, the final name is
  // that of a folder, or another process is writing the same part.
  // The part keeps the final extension ("x.part.mkv"), for libraries that look at it.
  [[nodiscard]] static Result<PartialFile> create(std::filesystem::path final_path, bool overwrite);

  // The same for a folder of files, which is empty at first.
  [[nodiscard]] static Result<PartialFile> create_folder(std::filesystem::path final_path, bool overwrite);

  PartialFile(PartialFile&& other) noexcept;
  PartialFile& operator=(PartialFile&& other) noexcept;
  ~PartialFile();

  [[nodiscard]] const std::filesystem::path& part() const { return part_; }
  [[nodiscard]] const std::filesystem::path& final_path() const { return final_; }

  // Gives the part its final name. Error write_failed where that cannot be done.
  [[nodiscard]] Result<void> keep();

 private:
  enum class Kind { file, folder };
  [[nodiscard]] static Result<PartialFile> create(std::filesystem::path final_path, bool overwrite, Kind kind);
  PartialFile(std::filesystem::path final_path, std::filesystem::path part, int lock);
  void discard() noexcept;

  std::filesystem::path final_;
  std::filesystem::path part_;  // empty: nothing to remove
  int lock_ = -1;               // file descriptor that holds the lock on the part; -1: none
};

// A whole small file. Errors: cannot_create, write_failed (also when the disk is full).
[[nodiscard]] Result<void> write_text(const std::filesystem::path& path, std::string_view text, bool overwrite);

}  // namespace sigs
