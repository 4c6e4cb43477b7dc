// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::cli {

// Images and layers of some megabytes come and go with every frame. Memory that the program keeps instead of handing
// it back to the system costs no page faults when it is taken again.
void tune_allocator();

}  // namespace sigs::cli
