// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/csv.h"

namespace sigs::accuracy {

// What a tabulated lens loses, saves and takes, by tolerance: lens_table.csv.
void measure_lens_tables(const Call& call);

}  // namespace sigs::accuracy
