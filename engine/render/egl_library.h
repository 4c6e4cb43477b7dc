// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"

namespace sigs {

// What to do where there is no OpenGL: which packages have it.
[[nodiscard]] std::string how_to_get_opengl();

// Whether the libraries of EGL and OpenGL can be loaded and have the functions that are called. libepoxy looks for them
// at the first call and ends the program where it does not find them, so this comes before. Error unavailable.
[[nodiscard]] Result<void> check_egl_library();

}  // namespace sigs
