// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

namespace sigs {

// A file descriptor that is closed at the end of its life. -1: no open file.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this == &other) return *this;
    reset();
    number_ = other.release();
    return *this;
  }
  ~Descriptor() { reset(); }

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }

  // The number, for whoever closes the file instead.
  [[nodiscard]] int release() noexcept { return std::exchange(number_, -1); }

  // Closes the file. Leaves errno as it was.
  void reset() noexcept {
    if (number_ < 0) return;
    const int error = errno;
    close(release());
    errno = error;
  }

 private:
  int number_ = -1;
};

// Locks on whole files by flock(2). A lock belongs to the open file and ends with its process, however that ends. Some
// file systems have no locks (NFS without lockd, Lustre without -o flock). There no process can be excluded; that is
// not treated as an error.
enum class LockAnswer {
  held,         // this open file has the lock
  taken,        // another open file has it, most likely that of another process
  unavailable,  // the file system has no locks, so it cannot be known
};

// The meaning of errno after flock() with LOCK_NB; 0 means success. EWOULDBLOCK alone means `taken`.
[[nodiscard]] LockAnswer lock_answer(int error);

// Tries to take the exclusive lock, without waiting. The file must be open for writing: NFS requires it.
[[nodiscard]] LockAnswer try_lock(const Descriptor& file);

// Whether another open file has the lock. False where there are no locks.
[[nodiscard]] bool is_locked_by_another(const Descriptor& file);

// Whether the path still names the open file, which may have been removed or renamed meanwhile.
[[nodiscard]] bool is_named(const Descriptor& file, const std::filesystem::path& path);

// Opens a regular file for locking, and creates it where `which` allows it. Writes nothing to it, follows no symbolic
// link and does not wait for the other end of a FIFO. On failure the descriptor is not open and errno says why; EINVAL:
// not a regular file.
enum class LockFile { must_be_there, made_where_missing };
[[nodiscard]] Descriptor open_for_lock(const std::filesystem::path& path, LockFile which);

}  // namespace sigs
