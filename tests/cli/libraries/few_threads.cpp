// SPDX-License-Identifier: MIT
// Loaded before the system's libraries: while THREADS_AT_MOST threads run that were started, no more can be started, as
// under a limit of the system.
#include <dlfcn.h>
#include <pthread.h>
#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

std::atomic<int> running{0};

struct Start {
  void* (*body)(void*);
  void* argument;
};

void end_thread(void*) {
  --running;
}

void* run(void* started) {
  const Start start = *static_cast<Start*>(started);
  delete static_cast<Start*>(started);
  void* result = nullptr;
  pthread_cleanup_push(end_thread, nullptr);
  result = start.body(start.argument);
  pthread_cleanup_pop(1);
  return result;
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                              void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  const char* const most = std::getenv("THREADS_AT_MOST");
  if (running++ >= (most == nullptr ? 1'000'000 : std::atoi(most))) {
    --running;
    return EAGAIN;
  }
  Start* const start = new Start{body, argument};
  const int error = create(thread, attributes, run, start);
  if (error != 0) {
    delete start;
    --running;
  }
  return error;
}
