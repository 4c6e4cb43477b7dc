// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/csv.h"

namespace sigs::accuracy {

// Error, saved evaluations and memory of a tabulated lens, by tolerance: lens_table.csv.
void measure_lens_tables(const Call& call);

}  // namespace sigs::accuracy
