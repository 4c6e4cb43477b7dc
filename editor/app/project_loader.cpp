// SPDX-License-Identifier: MIT
#include "editor/app/project_loader.h"

#include <mutex>
#include <utility>

#include "base/threads.h"

namespace sigs::editor {

// Shared with the reading thread, which may outlive the loader where a disk does not answer.
struct ProjectLoader::Pending {
  std::filesystem::path path;
  std::mutex mutex;
  FileStamp as_read;
  std::optional<Result<ReadProject>> read;
};

ProjectLoader::ProjectLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

void ProjectLoader::start(std::filesystem::path path) {
  pending_ = std::make_shared<Pending>();
  // The project keeps an absolute path: it means the same file in messages, lists of recent ones and after a crash.
  pending_->path = std::filesystem::absolute(path).lexically_normal();
  const auto read_it = [pending = pending_, wake = wake_] {
    FileStamp as_read = stamp_of(pending->path);
    Result<ReadProject> read = guarded([&] { return read_project(pending->path); }, pending->path.string());
    {
      const std::lock_guard lock(pending->mutex);
      pending->as_read = std::move(as_read);
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
  return LoadedProject{done->path, std::move(done->as_read), std::move(*done->read)};
}

}  // namespace sigs::editor
