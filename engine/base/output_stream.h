// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/file_lock.h"
#include "base/result.h"

namespace sigs {

// Bytes written one after the other to a file, a pipe or a socket, without a buffer of its own: what was written has
// left the process. A pipe whose reader is slow makes the writer wait. The process has to ignore SIGPIPE.
class OutputStream {
 public:
  // Creates a file; one that exists is emptied. Error cannot_create.
  [[nodiscard]] static Result<OutputStream> create(const std::filesystem::path& path);

  // Writes to a duplicate of a descriptor that the process has been given.
  //   name    in messages: "standard output"
  //   cancel  while it is true, waiting for the reader soon ends with the error interrupted; null, or outlives it
  // Errors: usage (not open for writing).
  [[nodiscard]] static Result<OutputStream> of_descriptor(int descriptor, std::string name,
                                                          const std::atomic<bool>* cancel = nullptr);

  // Writes all of the bytes. Errors: write_failed (the disk is full, the reader has closed its end), interrupted.
  [[nodiscard]] Result<void> write(std::string_view bytes);

  // Closes it; nothing can be written afterwards. Error write_failed, where the system reports it only here.
  [[nodiscard]] Result<void> close();

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  OutputStream(Descriptor descriptor, std::string name, const std::atomic<bool>* cancel);
  [[nodiscard]] Result<void> wait_for_reader() const;

  Descriptor descriptor_;  // not open: closed
  std::string name_;
  const std::atomic<bool>* cancel_ = nullptr;
  std::size_t chunk_bytes_ = 0;  // written at a time; of a pipe what never blocks where poll() has said so
};

// Whether a descriptor is a terminal, which images must not be written to.
[[nodiscard]] bool is_terminal(int descriptor);

}  // namespace sigs
