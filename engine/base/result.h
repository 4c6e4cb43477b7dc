// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace sigs {

// What went wrong, as the exit status of the program says it (sysexits.h).
enum class ErrorKind {
  usage = 64,          // the command line makes no sense
  bad_data = 65,       // an input could be read but is not what it should be
  cannot_read = 66,    // an input is missing or cannot be opened
  unavailable = 69,    // no OpenGL, no such encoder
  cannot_create = 73,  // an output cannot be created
  write_failed = 74,   // an output could not be written to its end (disk full)
  bad_project = 78,    // the project file is wrong
  interrupted = 130,   // the user stopped it
};

// One mistake of the outside world: where ("gopro.xml: camera_matrix"), and what to do about it in one line.
struct Error {
  std::string where;
  std::string what;
  ErrorKind kind = ErrorKind::bad_data;

  [[nodiscard]] std::string text() const { return where.empty() ? what : where + ": " + what; }
};

// Something worth telling that stops nothing: a missing texture, an unknown key.
struct Warning {
  std::string where;
  std::string what;

  [[nodiscard]] std::string text() const { return where.empty() ? what : where + ": " + what; }
};

template <class T>
using Result = tl::expected<T, Error>;

// return fail("gopro.xml: camera_matrix", "expected 9 numbers, found 8");
[[nodiscard]] inline tl::unexpected<Error> fail(std::string where, std::string what,
                                                ErrorKind kind = ErrorKind::bad_data) {
  return tl::unexpected<Error>(Error{std::move(where), std::move(what), kind});
}

// Hands an error on to the caller: if (!camera) return fail(camera.error());
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace sigs
