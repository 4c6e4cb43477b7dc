// SPDX-License-Identifier: MIT
#include "dataset/recipe.h"

#include "base/ensure.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

void try_recipe(const FuzzInput& input) {
  const Result<ReadRecipe> read = parse_recipe(std::string(input.bytes), input.folder / "r.json");
  if (!read) return check_message(read.error());
  check_messages(read->warnings);
  ENSURE(read->recipe.text == input.bytes);
}

}  // namespace sigs::fuzz
