// SPDX-License-Identifier: MIT
// Loaded before the system's libraries: after THREADS_AT_MOST threads no more can be started.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

std::atomic<int> started{0};

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                              void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  const char* const most = std::getenv("THREADS_AT_MOST");
  if (most != nullptr && started++ >= std::atoi(most)) return EAGAIN;
  return create(thread, attributes, body, argument);
}
