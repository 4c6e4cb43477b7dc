// SPDX-License-Identifier: MIT
#include "errors.h"

namespace sigs::python {

namespace py = pybind11;

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::bad_data:
      return "bad_data";
    case ErrorKind::cannot_read:
      return "cannot_read";
    case ErrorKind::unavailable:
      return "unavailable";
    case ErrorKind::cannot_create:
      return "cannot_create";
    case ErrorKind::write_failed:
      return "write_failed";
    case ErrorKind::bad_project:
      return "bad_project";
    case ErrorKind::interrupted:
      return "interrupted";
  }
  return "bad_data";
}

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Raised& raised) {
      const Error& error = raised.error();
      const py::object made =
          py::module_::import("sigs.errors").attr("error_of")(error.where, error.what, name_of(error.kind));
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
    }
  });
}

}  // namespace sigs::python
