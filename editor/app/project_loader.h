// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "base/result.h"
#include "editor/document/content_id.h"
#include "project/json.h"

namespace sigs::editor {

// A project file that was asked for: the project, or why it could not be read.
struct LoadedProject {
  std::filesystem::path path;
  FileStamp as_read;  // from before it was read: what is written meanwhile counts as a change
  Result<ReadProject> read;
};

// Reads project files on threads of their own, so that the window does not wait for a slow disk. The last file asked
// for counts; the result of an earlier request is dropped. A thread may outlive the loader where a disk does not
// answer, so wake has to stay callable until the program ends. For the window's thread.
class ProjectLoader {
 public:
  // wake  called from the other thread once a file is read
  explicit ProjectLoader(std::function<void()> wake);

  // Begins to read a file; take() gives the result once it is there.
  void start(std::filesystem::path path);
  // Absolute path of the file that is being read; "" while none is.
  [[nodiscard]] std::filesystem::path path() const;
  // The result, once; none while the file is being read.
  [[nodiscard]] std::optional<LoadedProject> take();

 private:
  struct Pending;
  std::function<void()> wake_;
  // Shared with the thread that reads; null: nothing is asked for.
  std::shared_ptr<Pending> pending_;
};

}  // namespace sigs::editor
