// SPDX-License-Identifier: MIT
#include "base/thread.h"

#include <new>
#include <system_error>
#include <utility>

namespace sigs {

Result<std::thread> started_thread(std::function<void()> body) {
  const char* why = "out of memory";
  try {
    return std::thread(std::move(body));
  } catch (const std::system_error&) {
    why = "the system's limit of threads or memory is reached";
  } catch (const std::bad_alloc&) {
  }
  return fail("", std::string("no more threads can be started: ") + why, ErrorKind::unavailable);
}

}  // namespace sigs
