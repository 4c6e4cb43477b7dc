// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace sigs::editor {

// How the project's file lay on disk when it was last read or saved here: someone else may write it meanwhile.
class DiskChange {
 public:
  // Right after reading or saving. "": there is no file.
  void remember(const std::filesystem::path& file);

  // Whether its size or time is another one. A file that is gone holds nobody's work: not changed.
  [[nodiscard]] bool changed() const;

 private:
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
