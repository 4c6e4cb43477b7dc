// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs {

// What is wrong with a name that becomes a file's or a folder's: it must not be empty, up to 200 bytes long (endings
// go behind it, and file systems take 255), without / and control characters, not beginning with a dot.
// Empty: nothing is wrong.
[[nodiscard]] std::string wrong_with_file_name(const std::string& name);

}  // namespace sigs
