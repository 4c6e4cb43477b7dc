// SPDX-License-Identifier: MIT
// Loaded before the C library (LD_PRELOAD), so that the program meets file systems, and points in time, that a test
// cannot create otherwise. Each variable of the environment changes one call:
//   SIGS_TEST_FLOCK=N           flock() fails with errno N
//   SIGS_TEST_NO_RENAMEAT2=1    renameat2() fails with EINVAL where it has flags, as on NFS
//   SIGS_TEST_FAIL_RENAME=NAME  giving a file or folder the final name NAME fails with EIO, but not putting back an
//   older SIGS_TEST_KILL_AT=N         the process is killed (SIGKILL) right before its N-th renaming, counted from 1
//   SIGS_TEST_TERM_AT=N         the process gets two SIGTERM right before its N-th renaming

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

std::atomic<int> renamings{0};

int number_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? 0 : std::atoi(text);
}

std::string name_of(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

// Whether a renaming or a linking is to fail.
bool fails(const char* from, const char* to) {
  const char* const wrong = std::getenv("SIGS_TEST_FAIL_RENAME");
  const auto has = [](const char* path, const char* piece) { return std::strstr(path, piece) != nullptr; };
  const bool is_final = !has(to, ".sigs-") && !has(to, ".part/");
  if (wrong == nullptr || !is_final || has(from, "/old/") || name_of(to) != wrong) return false;
  errno = EIO;
  return true;
}

// The same of a renaming, which is counted.
bool meets(const char* from, const char* to) {
  const int number = ++renamings;
  if (number == number_of("SIGS_TEST_KILL_AT")) kill(getpid(), SIGKILL);
  if (number == number_of("SIGS_TEST_TERM_AT"))
    for (int i = 0; i < 2; ++i) kill(getpid(), SIGTERM);
  return fails(from, to);
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int flock(int file, int operation) {
  if (const int error = number_of("SIGS_TEST_FLOCK"); error != 0) {
    errno = error;
    return -1;
  }
  return next<int(int, int)>("flock")(file, operation);
}

int rename(const char* from, const char* to) {
  return meets(from, to) ? -1 : next<int(const char*, const char*)>("rename")(from, to);
}

int link(const char* from, const char* to) {
  return fails(from, to) ? -1 : next<int(const char*, const char*)>("link")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) {
  if (flags != 0 && number_of("SIGS_TEST_NO_RENAMEAT2") != 0) {
    errno = EINVAL;
    return -1;
  }
  if (meets(from, to)) return -1;
  return next<int(int, const char*, int, const char*, unsigned int)>("renameat2")(from_folder, from, to_folder, to,
                                                                                  flags);
}

}  // extern "C"
