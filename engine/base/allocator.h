// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// Makes the process's allocator keep memory of up to 32 MiB a block instead of returning it to the system. Images and
// layers of some megabytes are allocated for every frame; memory that is kept costs no page faults when it is used
// again. All threads share two heaps: a heap for each thread, glibc's default, keeps that memory many times
// (docs/reliability.md). For programs, before they start threads; nothing happens with another allocator than glibc's.
void tune_allocator();

}  // namespace sigs
