// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "base/result.h"
#include "project/json.h"

namespace sigs::editor {

// A project file that was asked for, read or not.
struct LoadedProject {
  std::filesystem::path path;
  Result<ReadProject> read;
};

// Reads project files on threads of their own: a slow disk does not hold up the window. The last one asked for counts;
// what was asked for before is dropped when it comes.
class ProjectLoader {
 public:
  // wake  called from the other thread once a file is read
  explicit ProjectLoader(std::function<void()> wake);

  void start(std::filesystem::path path);
  void drop() { pending_.reset(); }
  // Of what is being read; "" while nothing is.
  [[nodiscard]] std::filesystem::path path() const;
  [[nodiscard]] std::optional<LoadedProject> take();

 private:
  struct Pending;
  std::function<void()> wake_;
  std::shared_ptr<Pending> pending_;
};

}  // namespace sigs::editor
