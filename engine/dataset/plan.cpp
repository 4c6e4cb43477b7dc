// SPDX-License-Identifier: MIT
#include "dataset/plan.h"

namespace sigs {

Result<Plan> plan_of(const Recipe& recipe) {
  return fail(recipe.file.string(), "cannot be expanded yet", ErrorKind::unavailable);
}

}  // namespace sigs
