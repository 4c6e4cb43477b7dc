// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace sigs {

// The kind of an error. The number is the exit status of the program (sysexits.h).
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

// A mistake in what comes from outside: files, settings, the machine.
//   where  the file and the place in it, or the setting: "gopro.xml: camera_matrix"; may be empty
//   what   one line that says what is wrong and, where possible, what to do about it
struct Error {
  std::string where;
  std::string what;
  ErrorKind kind = ErrorKind::bad_data;

  // "where: what" as it is printed: on one line, without control characters, in UTF-8 (line_text() in base/text.h).
  // Both may quote what a stranger's file contains; of more than 4800 bytes the middle is left out.
  [[nodiscard]] std::string text() const;
};

// Something that the user should know but that stops nothing: a missing texture, an unknown key.
struct Warning {
  std::string where;
  std::string what;

  // As Error::text().
  [[nodiscard]] std::string text() const;
};

// A value, or the error that prevented it. Functions that can fail for reasons outside the program return it.
template <class T, class E = Error>
using Result = tl::expected<T, E>;

// The failure to return: return fail("gopro.xml: camera_matrix", "expected 9 numbers, found 8");
[[nodiscard]] inline tl::unexpected<Error> fail(std::string where, std::string what,
                                                ErrorKind kind = ErrorKind::bad_data) {
  return tl::unexpected<Error>(Error{std::move(where), std::move(what), kind});
}

// Passes an error on to the caller: if (!camera) return fail(camera.error());
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace sigs
