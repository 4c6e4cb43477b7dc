// SPDX-License-Identifier: MIT
#include "editor/document/result_files.h"

#include <algorithm>
#include <system_error>

namespace sigs::editor {

namespace fs = std::filesystem;

int ResultFiles::free_color() const {
  int color = 0;
  const auto is_taken = [&](const ResultFile& file) { return file.color == color; };
  while (std::any_of(files_.begin(), files_.end(), is_taken)) ++color;
  return color;
}

void ResultFiles::add(const fs::path& path) {
  std::error_code code;
  const fs::path absolute = fs::absolute(path, code);
  const fs::path place = (code ? path : absolute).lexically_normal();
  const auto same =
      std::find_if(files_.begin(), files_.end(), [&](const ResultFile& file) { return file.path == place; });
  if (same != files_.end())
    same->is_shown = true;
  else
    files_.push_back({.id = ++last_id_, .path = place, .color = free_color()});
}

void ResultFiles::remove(int id) {
  std::erase_if(files_, [id](const ResultFile& file) { return file.id == id; });
}

void ResultFiles::set_shown(int id, bool shown) {
  for (ResultFile& file : files_)
    if (file.id == id) file.is_shown = shown;
}

}  // namespace sigs::editor
