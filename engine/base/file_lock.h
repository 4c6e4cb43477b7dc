// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/descriptor.h"

namespace sigs {

// Locks on whole files by flock(2): they end with the process, however that ends. Not every file system has them
// (NFS without lockd, Lustre without -o flock); there nobody can be kept out, and that is no error.
enum class LockAnswer {
  held,         // from here on by this open file
  taken,        // another open file, most likely another process, holds it
  unavailable,  // nobody can tell: there are no locks here
};

// What an errno of flock(LOCK_NB) means; 0: it succeeded. Only EWOULDBLOCK says that somebody holds the lock.
[[nodiscard]] LockAnswer lock_answer(int error);

// Takes the lock for one holder alone. Does not wait. The file must be open for writing: NFS asks for it.
[[nodiscard]] LockAnswer try_lock(const Descriptor& file);

// Whether another one holds the lock. Where there are no locks: no.
[[nodiscard]] bool is_locked_by_another(const Descriptor& file);

// Whether the path still names the open file, which may have been removed or renamed since.
[[nodiscard]] bool is_named(const Descriptor& file, const std::filesystem::path& path);

// Opens, or where asked for makes, a regular file for locking; nothing is written to it, no symbolic link followed, and
// a FIFO not waited for. Not open: errno says why; EINVAL for what is no regular file.
enum class LockFile { must_be_there, made_where_missing };
[[nodiscard]] Descriptor open_for_lock(const std::filesystem::path& path, LockFile which);

}  // namespace sigs
