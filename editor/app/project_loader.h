// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "base/result.h"
#include "project/json.h"

namespace sigs::editor {

// A project file that was asked for: the project, or why it could not be read.
struct LoadedProject {
  std::filesystem::path path;
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

// Notices that another program has written the project's file since it was last read or saved here. Looks at the disk
// in the calls alone.
class DiskChange {
 public:
  // To be called right after reading or saving. "": there is no file.
  void remember(const std::filesystem::path& file);

  // Whether the file's size or time differs from what was remembered. A file that is gone counts as unchanged: there is
  // nobody's work to lose.
  [[nodiscard]] bool changed() const;

 private:
  // A file by size and time; equal for all files that are not there.
  struct State {
    bool is_there = false;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type time;

    [[nodiscard]] bool operator==(const State&) const = default;
  };
  [[nodiscard]] static State state_of(const std::filesystem::path& file);

  std::filesystem::path file_;
  State known_;
};

}  // namespace sigs::editor
