// SPDX-License-Identifier: MIT
#include "editor/document/disk_change.h"

#include <system_error>

namespace sigs::editor {

DiskChange::State DiskChange::state_of(const std::filesystem::path& file) {
  std::error_code no_size;
  std::error_code no_time;
  State state;
  state.bytes = std::filesystem::file_size(file, no_size);
  state.time = std::filesystem::last_write_time(file, no_time);
  state.is_there = !no_size && !no_time;
  return state.is_there ? state : State();
}

void DiskChange::remember(const std::filesystem::path& file) {
  file_ = file.empty() ? file : std::filesystem::absolute(file);
  known_ = file_.empty() ? State() : state_of(file_);
}

bool DiskChange::changed() const {
  if (file_.empty()) return false;
  const State present = state_of(file_);
  return present.is_there && present != known_;
}

}  // namespace sigs::editor
