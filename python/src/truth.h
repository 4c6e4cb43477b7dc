// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "truth/annotation.h"

namespace sigs::python {

// The truth of a frame as an object of sigs.truth.FrameTruth: the names and units of the label file, with all digits.
[[nodiscard]] pybind11::object truth_object(const FrameTruth& truth);

}  // namespace sigs::python
