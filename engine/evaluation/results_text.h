// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "evaluation/results.h"

namespace sigs {

// Results in our own layout, as read_results reads them as ResultsFormat::csv: one line a box, in order of frames.
[[nodiscard]] std::string csv_text(const Results& results);

}  // namespace sigs
