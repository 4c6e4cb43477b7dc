// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>

#include "base/result.h"

namespace sigs {

// What was thrown, as a value; to be called where it is caught. Memory that cannot be had, OpenCV's included, and
// threads that cannot be started are `unavailable`, anything else is bad_data.
//   where  of the error
[[nodiscard]] Error thrown_error(const std::string& where = {});

// Whether what was thrown says that there is no more memory; to be called where it is caught.
[[nodiscard]] bool is_out_of_memory();

// Gives the Result that the job gives; what it throws comes back as an error. Each thread's work is run by it.
template <class Job>
[[nodiscard]] std::invoke_result_t<Job&> guarded(Job&& job, const std::string& where = {}) {
  try {
    return job();
  } catch (...) {
    return fail(thrown_error(where));
  }
}

}  // namespace sigs
