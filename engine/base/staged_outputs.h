// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "base/staging_folder.h"

namespace sigs {

// Files and folders that get their final names together, or none of them. Until then they lie in staging folders beside
// their final places, under their final names, so that libraries see the right extension and the last step is a rename;
// without commit() they go with this object. Nothing that was there before is opened, followed, emptied or removed, but
// what commit() replaces, and that only once the newer ones are in place.
class StagedOutputs {
 public:
  // What a final name may belong to already. new_names: nothing. replace: a file for a file, a folder for a folder.
  enum class Existing { refuse, replace };
  explicit StagedOutputs(Existing existing) : existing_(existing) {}

  // Whether a folder that is there may be replaced whole: an error says why not. Asked before the work, and again of
  // what the folder holds when it is to be replaced.
  using MayReplace = std::function<Result<void>(const std::filesystem::path& folder)>;

  // Makes an empty file or folder; where it lies for now. Error cannot_create: the final name is taken, the folder
  // around it is not there, another run is writing an output of this name.
  [[nodiscard]] Result<std::filesystem::path> add_file(const std::filesystem::path& final_path);
  [[nodiscard]] Result<std::filesystem::path> add_folder(const std::filesystem::path& final_path,
                                                         MayReplace may_replace = {});

  // Waits until all of them are on the disk, then gives them their final names, then waits until those are on the disk.
  // Signals wait meanwhile. On an error all is as it was before. What was replaced goes at the end. Call it once.
  // Errors: cannot_create where a name was taken in between, write_failed.
  [[nodiscard]] Result<void> commit();

  // Final names, in the order in which outputs were added.
  [[nodiscard]] std::vector<std::filesystem::path> final_paths() const;

  // An error of writing, with final names in place of those in the staging folders.
  [[nodiscard]] Error with_final_names(Error error) const;

 private:
  enum class Kind { file, folder };
  enum class Placed { no, as_new, instead };
  struct Output {
    std::filesystem::path final_path;
    Kind kind = Kind::file;
    MayReplace may_replace;
    StagingFolder* staging = nullptr;
    Placed placed = Placed::no;

    [[nodiscard]] std::filesystem::path staged() const { return staging->new_place(final_path.filename()); }
    [[nodiscard]] std::filesystem::path aside() const { return staging->old_place(final_path.filename()); }
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

}  // namespace sigs
