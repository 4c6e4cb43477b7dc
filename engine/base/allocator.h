// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace sigs {

// Makes the process's allocator keep memory of up to 32 MiB a block instead of returning it to the system. Images and
// layers of some megabytes are allocated for every frame; memory that is kept costs no page faults when it is used
// again. All threads share two heaps: a heap for each thread, glibc's default, keeps that memory many times
// (docs/reliability.md). For programs, before they start threads; nothing happens with another allocator than glibc's.
void tune_allocator();

// Whether so many bytes of addresses can still be mapped. Some libraries end the program where they do not get the
// memory that they begin with; this is asked before they are loaded.
[[nodiscard]] bool has_free_memory(std::size_t bytes);

}  // namespace sigs
