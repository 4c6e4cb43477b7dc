// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_file.h"  // read_text, the counterpart of write_text
#include "base/result.h"
#include "base/staging_folder.h"

namespace sigs {

// Outputs that appear under their final names only when they are complete: several of them together (StagedOutputs),
// one alone (TemporaryFile), or a short text at once (write_text).

// Files and folders that get their final names together, or none of them does. Until then they lie under the same names
// in staging folders beside their final places, so that libraries find the right extension and the last step is a
// rename. Without commit() they are removed with this object. Nothing that existed before is opened, followed, emptied
// or removed, except what commit() replaces, and that only after the newer ones have their names.
class StagedOutputs {
 public:
  // Whether a final name may be in use already. refuse: it must be free. replace: a file replaces a file, a folder
  // replaces a folder.
  enum class Existing { refuse, replace };
  explicit StagedOutputs(Existing existing) : existing_(existing) {}

  // Says whether an existing folder may be replaced with all its contents; an error says why not. Called before the
  // work, and again for the contents at the moment of the replacement.
  using MayReplace = std::function<Result<void>(const std::filesystem::path& folder)>;

  // Creates an empty file or folder and returns its temporary path. Error cannot_create: the final name is in use, the
  // folder that is to contain it does not exist, or another process is writing an output of this name.
  [[nodiscard]] Result<std::filesystem::path> add_file(const std::filesystem::path& final_path);
  [[nodiscard]] Result<std::filesystem::path> add_folder(const std::filesystem::path& final_path,
                                                         MayReplace may_replace = {});

  // The outputs of another one become outputs of this one, behind its own.
  void take(StagedOutputs other);

  // Waits until all outputs are on the disk, gives them their final names, and waits until those are on the disk.
  // SIGHUP, SIGINT and SIGTERM are held back while the names change. What was replaced is removed at the end. On an
  // error everything is as before. Call it once. Errors: cannot_create where a name was taken meanwhile, write_failed.
  [[nodiscard]] Result<void> commit();

  // Final paths, in the order in which the outputs were added.
  [[nodiscard]] std::vector<std::filesystem::path> final_paths() const;

  // The error with final paths in place of temporary ones, which the user does not know.
  [[nodiscard]] Error with_final_names(Error error) const;

 private:
  enum class Kind { file, folder };
  enum class Placed { no, as_new, instead };  // has not its final name yet; took a free one; replaced an older output
  struct Output {
    std::filesystem::path final_path;
    Kind kind = Kind::file;
    MayReplace may_replace;
    StagingFolder* staging = nullptr;
    Placed placed = Placed::no;

    [[nodiscard]] std::filesystem::path staged() const { return staging->new_place(final_path.filename()); }
    [[nodiscard]] std::filesystem::path backup() const { return staging->old_place(final_path.filename()); }
  };

  [[nodiscard]] Result<std::filesystem::path> add(Output output);
  [[nodiscard]] Result<void> check_free(const Output& output) const;
  [[nodiscard]] Result<StagingFolder*> staging_beside(const std::filesystem::path& final_path);
  [[nodiscard]] Result<void> place(Output& output) const;
  [[nodiscard]] Result<void> replace(Output& output) const;
  [[nodiscard]] Error undo_all(Error error);
  [[nodiscard]] Result<void> flush_names() const;

  Existing existing_;
  std::vector<std::unique_ptr<StagingFolder>> stagings_;  // one for each folder that outputs go into
  std::vector<Output> outputs_;
};

// Folders made for what is to be written. Those that are empty at the end go again: a run that fails or is interrupted
// leaves nothing behind. A folder that was there before stays.
class CreatedFolders {
 public:
  CreatedFolders() = default;
  CreatedFolders(CreatedFolders&&) = default;
  CreatedFolders& operator=(CreatedFolders&&) = delete;
  ~CreatedFolders();

  // The folder and those above it, where they are not there. Error cannot_create.
  [[nodiscard]] Result<void> make(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> created_;  // the outer before the inner
};

// One output that appears under its final name only when it is complete. Write to temporary_path(), then call commit();
// without commit() the temporary file is removed with this object.
class TemporaryFile {
 public:
  // Creates an empty temporary file in a staging folder beside the final path. It has the same name as the final file,
  // for libraries that look at the extension. Error cannot_create: the final name is in use and `overwrite` is false,
  // it is the name of a folder or a device, its folder does not exist, or another process is writing an output of that
  // name.
  [[nodiscard]] static Result<TemporaryFile> create(std::filesystem::path final_path, bool overwrite);

  // The same for a folder, which is empty at first.
  //   may_replace  whether an existing folder may be replaced; see StagedOutputs::MayReplace
  [[nodiscard]] static Result<TemporaryFile> create_folder(std::filesystem::path final_path, bool overwrite,
                                                           StagedOutputs::MayReplace may_replace = {});

  [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_path_; }
  [[nodiscard]] const std::filesystem::path& final_path() const { return final_; }

  // Waits until the file is on the disk and gives it its final name. Errors as those of StagedOutputs::commit().
  [[nodiscard]] Result<void> commit() { return outputs_.commit(); }

 private:
  TemporaryFile(std::filesystem::path final_path, std::filesystem::path temporary_path, StagedOutputs outputs);

  std::filesystem::path final_;
  std::filesystem::path temporary_path_;
  StagedOutputs outputs_;
};

// Writes a text as a file that appears only when it is complete. Errors: cannot_create as those of
// TemporaryFile::create(), write_failed (also when the disk is full).
[[nodiscard]] Result<void> write_text(const std::filesystem::path& path, std::string_view text, bool overwrite);

}  // namespace sigs
