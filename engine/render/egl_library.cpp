// SPDX-License-Identifier: MIT
#include "render/egl_library.h"

#include <dlfcn.h>

#include <initializer_list>
#include <utility>

namespace sigs {
namespace {

// The first of them that can be loaded and has the functions. It stays loaded: libepoxy opens the same.
Result<void> check_library(std::initializer_list<const char*> names, std::initializer_list<const char*> functions) {
  std::string why;
  for (const char* const name : names) {
    void* const library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    const char* missing = nullptr;
    for (const char* const function : functions)
      if (library != nullptr && missing == nullptr && dlsym(library, function) == nullptr) missing = function;
    if (library != nullptr && missing == nullptr) return {};
    const char* const said = library == nullptr ? dlerror() : nullptr;
    why += (why.empty() ? "" : "; ") +
           (missing != nullptr ? std::string(name) + " has no " + missing : std::string(said != nullptr ? said : name));
  }
  return fail("OpenGL", "cannot be loaded (" + why + "); " + how_to_get_opengl(), ErrorKind::unavailable);
}

}  // namespace

std::string how_to_get_opengl() {
  return "install libegl1, libegl-mesa0 and libgl1-mesa-dri (Debian, Ubuntu), or a GPU's driver";
}

Result<void> check_egl_library() {
  Result<void> egl = check_library(
      {"libEGL.so.1"}, {"eglQueryString", "eglGetProcAddress", "eglGetError", "eglInitialize", "eglBindAPI",
                        "eglQueryAPI", "eglChooseConfig", "eglCreateContext", "eglDestroyContext", "eglMakeCurrent",
                        "eglGetCurrentContext", "eglGetCurrentDisplay", "eglQueryContext"});
  if (!egl) return egl;
  return check_library({"libOpenGL.so.0", "libGL.so.1"}, {"glGetString", "glGetIntegerv", "glGetError"});
}

}  // namespace sigs
