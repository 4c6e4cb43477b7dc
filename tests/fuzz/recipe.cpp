// SPDX-License-Identifier: MIT
#include "dataset/recipe.h"

#include "base/ensure.h"
#include "dataset/design_domain.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

namespace {

void try_domain(const FuzzInput& input) {
  const Result<ReadDomain> read = parse_design_domain(std::string(input.bytes), input.folder / "d.json");
  if (!read) return check_message(read.error());
  check_messages(read->warnings);
  for (const DomainCondition& condition : read->domain.conditions) ENSURE(condition.bins() > 0);
}

}  // namespace

void try_recipe(const FuzzInput& input) {
  try_domain(input);
  const Result<ReadRecipe> read = parse_recipe(std::string(input.bytes), input.folder / "r.json");
  if (!read) return check_message(read.error());
  check_messages(read->warnings);
  ENSURE(read->recipe.text == input.bytes);
}

}  // namespace sigs::fuzz
