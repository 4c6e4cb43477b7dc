// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"

namespace sigs {

// The files that reading an OBJ file reads, itself first: also the MTL files that its lines name and the images that
// lines of those name, as far as they are there. A name with blanks may be several: all that could be meant are listed.
// Error cannot_read: that of the OBJ file.
[[nodiscard]] Result<std::vector<std::filesystem::path>> files_of_model(const std::filesystem::path& file);

}  // namespace sigs
