// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace sigs::editor {

// A file with what a tracker says of this footage, while it is looked at. Not part of the project.
struct ResultFile {
  int id = 0;  // its own as long as the program runs; 0: none
  std::filesystem::path path;
  int color = 0;         // the least one that no other file has
  bool is_shown = true;  // its boxes and its curve

  [[nodiscard]] bool operator==(const ResultFile&) const = default;
};

// Those that are loaded, in the order in which they came.
class ResultFiles {
 public:
  // A file that is there already is shown again, and stays one.
  void add(const std::filesystem::path& path);
  void remove(int id);
  void set_shown(int id, bool shown);
  void clear() { files_.clear(); }
  [[nodiscard]] const std::vector<ResultFile>& files() const { return files_; }

 private:
  [[nodiscard]] int free_color() const;

  std::vector<ResultFile> files_;
  int last_id_ = 0;
};

}  // namespace sigs::editor
