// SPDX-License-Identifier: MIT
#include "editor/app/project_loader.h"

#include <mutex>
#include <system_error>
#include <utility>

#include "base/threads.h"

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

// Shared with the reading thread, which may outlive the loader where a disk does not answer.
struct ProjectLoader::Pending {
  std::filesystem::path path;
  std::mutex mutex;
  std::optional<Result<ReadProject>> read;
};

ProjectLoader::ProjectLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

void ProjectLoader::start(std::filesystem::path path) {
  pending_ = std::make_shared<Pending>();
  // The project keeps an absolute path: it means the same file in messages, lists of recent ones and after a crash.
  pending_->path = std::filesystem::absolute(path).lexically_normal();
  const auto read_it = [pending = pending_, wake = wake_] {
    Result<ReadProject> read = guarded([&] { return read_project(pending->path); }, pending->path.string());
    {
      const std::lock_guard lock(pending->mutex);
      pending->read = std::move(read);
    }
    wake();
  };
  run_in_background(read_it);
}

std::filesystem::path ProjectLoader::path() const {
  return pending_ ? pending_->path : std::filesystem::path();
}

std::optional<LoadedProject> ProjectLoader::take() {
  const std::shared_ptr<Pending> done = pending_;
  if (!done) return std::nullopt;
  const std::lock_guard lock(done->mutex);
  if (!done->read) return std::nullopt;
  pending_.reset();
  return LoadedProject{done->path, std::move(*done->read)};
}

}  // namespace sigs::editor
