// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// The smallest of 1, 2 and 5 times a power of ten that is no less than `minimum`; 1 where that is no positive number.
[[nodiscard]] double round_step(double minimum);

// The multiple of the step nearest to a value, in the digits that the step has: 0.3, not 0.30000000000000004.
[[nodiscard]] double rounded_to(double value, double step);

}  // namespace sigs::editor
