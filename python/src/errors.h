// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

#include "base/result.h"

namespace sigs::python {

// An error of the engine on its way to Python, where it becomes an exception of sigs.errors. Thrown in functions that
// Python calls, and nowhere else.
class Raised : public std::exception {
 public:
  explicit Raised(Error error) : error_(std::move(error)), text_(error_.text()) {}
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  Error error_;
  std::string text_;
};

// The value; throws Raised where there is none.
template <class T>
T value_or_raise(Result<T> result) {
  if (!result) throw Raised(std::move(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

// "bad_project": the name of an error's kind in Python.
[[nodiscard]] const char* name_of(ErrorKind kind);

// Makes Python see Raised as sigs.errors' classes.
void translate_errors();

}  // namespace sigs::python
