// SPDX-License-Identifier: MIT
#include "base/output_stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>

namespace sigs {

namespace {

constexpr std::size_t kFileChunk_bytes = std::size_t{1} << 20;
constexpr int kPollInterval_ms = 100;  // how soon an interruption is noticed

bool is_regular_file(int descriptor) {
  struct stat state {};
  return ::fstat(descriptor, &state) == 0 && S_ISREG(state.st_mode);
}

}  // namespace

OutputStream::OutputStream(Descriptor descriptor, std::string name, const std::atomic<bool>* cancel)
    : descriptor_(std::move(descriptor)),
      name_(std::move(name)),
      cancel_(cancel),
      chunk_bytes_(is_regular_file(descriptor_.number()) ? kFileChunk_bytes : PIPE_BUF) {}

Result<OutputStream> OutputStream::create(const std::filesystem::path& path) {
  Descriptor descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!descriptor.is_open())
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  return OutputStream(std::move(descriptor), path.string(), nullptr);
}

Result<OutputStream> OutputStream::of_descriptor(int descriptor, std::string name, const std::atomic<bool>* cancel) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
    return fail(std::move(name), "is not open for writing", ErrorKind::usage);
  Descriptor own(::fcntl(descriptor, F_DUPFD_CLOEXEC, 3));
  if (!own.is_open())
    return fail(std::move(name), std::string("cannot be used: ") + std::strerror(errno), ErrorKind::cannot_create);
  return OutputStream(std::move(own), std::move(name), cancel);
}

// A reader that has closed its end is noticed by the writing.
Result<void> OutputStream::wait_for_reader() const {
  pollfd state{.fd = descriptor_.number(), .events = POLLOUT, .revents = 0};
  while (true) {
    if (cancel_ != nullptr && cancel_->load()) return fail("", "interrupted", ErrorKind::interrupted);
    const int ready = ::poll(&state, 1, kPollInterval_ms);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return {};
  }
}

Result<void> OutputStream::write(std::string_view bytes) {
  while (!bytes.empty()) {
    if (const Result<void> ready = wait_for_reader(); !ready) return ready;
    const ssize_t written = ::write(descriptor_.number(), bytes.data(), std::min(bytes.size(), chunk_bytes_));
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written < 0 && errno == EPIPE)
      return fail(name_, "its reader has closed it before the end", ErrorKind::write_failed);
    if (written < 0)
      return fail(name_, std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> OutputStream::close() {
  if (!descriptor_.is_open()) return {};
  if (::close(descriptor_.release()) == 0 || errno == EINTR) return {};
  return fail(name_, std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
}

bool is_terminal(int descriptor) {
  return ::isatty(descriptor) == 1;
}

}  // namespace sigs
