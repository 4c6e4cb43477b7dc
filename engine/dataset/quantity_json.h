// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>

#include "dataset/sample.h"
#include "project/json_reading.h"

namespace sigs {

// A quantity as a recipe writes it: 5, {"uniform": [a, b]}, {"normal": {"mean": m, "deviation": d, "low": a,
// "high": b}} (bounds may be left out) or {"choice": [a, b, ...]}. Else what is wrong with it.
[[nodiscard]] tl::expected<Quantity, std::string> quantity_of(const Json& json);

}  // namespace sigs
