// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <memory>
#include <utility>

namespace sigs::python {

// Owns an object with threads, which a forked process inherits without its threads. There it is neither used nor
// destroyed: get() gives null, and what the copy holds stays allocated.
template <class T>
class ProcessBound {
 public:
  ProcessBound() = default;
  explicit ProcessBound(std::shared_ptr<T> object) : object_(std::move(object)), process_(getpid()) {}
  ProcessBound(ProcessBound&&) = delete;
  ProcessBound& operator=(ProcessBound&& other) noexcept {
    reset();
    object_ = std::move(other.object_);
    process_ = other.process_;
    return *this;
  }
  ~ProcessBound() { reset(); }

  // Null where there is none, or where it belongs to another process. Whoever uses it keeps it meanwhile: another
  // thread may reset this.
  [[nodiscard]] std::shared_ptr<T> get() const { return is_ours() ? object_ : nullptr; }

  // Whether it was made by the process that this one was forked from.
  [[nodiscard]] bool is_inherited() const { return object_ != nullptr && !is_ours(); }

  void reset() {
    if (object_ != nullptr && !is_ours()) new std::shared_ptr<T>(object_);  // never destroyed
    object_.reset();
  }

 private:
  [[nodiscard]] bool is_ours() const { return process_ == getpid(); }

  std::shared_ptr<T> object_;
  pid_t process_ = 0;
};

}  // namespace sigs::python
