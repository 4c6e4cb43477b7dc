// SPDX-License-Identifier: MIT
#include "dataset/recipe.h"

namespace sigs {

Result<ReadRecipe> read_recipe(const std::filesystem::path& path) {
  return fail(path.string(), "cannot be read yet", ErrorKind::unavailable);
}

}  // namespace sigs
