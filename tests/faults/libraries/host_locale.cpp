// SPDX-License-Identifier: MIT
// Loaded before the C library (LD_PRELOAD): chooses the locale of the environment for C and C++, as a program around
// the engine may, Python's locale.setlocale() for one. It does so when `sigs` has read its command line, whose numbers
// no other program reads, and prepares for signals. Children of `sigs` run without it.
#include <dlfcn.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <stdexcept>

namespace {

bool choose() {
  unsetenv("LD_PRELOAD");
  try {
    if (std::setlocale(LC_ALL, "") == nullptr) throw std::runtime_error("no such locale");
    std::locale::global(std::locale(""));
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return true;
}

}  // namespace

extern "C" sighandler_t signal(int number, sighandler_t handler) {
  static const bool is_chosen = choose();
  static_cast<void>(is_chosen);
  return reinterpret_cast<sighandler_t (*)(int, sighandler_t)>(dlsym(RTLD_NEXT, "signal"))(number, handler);
}
