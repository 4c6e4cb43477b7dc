// SPDX-License-Identifier: MIT
// Loaded before the C library (LD_PRELOAD), so that the program meets file systems, and points in time, that a test
// cannot create otherwise. Each variable of the environment changes one call:
//   SIGS_TEST_FLOCK=N           flock() fails with errno N
//   SIGS_TEST_NO_RENAMEAT2=1    renameat2() fails with EINVAL where it has flags, as on NFS
//   SIGS_TEST_FAIL_RENAME=NAME  giving a file or folder the final name NAME fails with EIO, but not putting back an
//                               older one
//   SIGS_TEST_KILL_AT=N         the process is killed (SIGKILL) right before its N-th renaming, counted from 1; lock
//   files
//                               do not count
//   SIGS_TEST_KILL_BEFORE=NAME, SIGS_TEST_KILL_AFTER=NAME
//                               the same right before, or after, something gets the final name NAME
//   SIGS_TEST_TERM_AT=N         the process gets two SIGTERM right before its N-th renaming
//   SIGS_TEST_CHANGED_INPUT=FILE, SIGS_TEST_CHANGE=HOW, SIGS_TEST_CHANGE_AT=N
//                               before the N-th read() of this file, by its absolute path, it is cut (half of it is
//                               left), emptied, continued (by zeros), overwritten (its second half by zeros) or removed

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

std::atomic<int> renamings{0};
std::atomic<int> reads_of_input{0};

int number_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? 0 : std::atoi(text);
}

std::string name_of(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

// Whether a renaming gives something the final name that a variable holds.
bool is_given(const char* variable, const char* from, const char* to) {
  const char* const name = std::getenv(variable);
  const auto has = [](const char* path, const char* piece) { return std::strstr(path, piece) != nullptr; };
  const bool is_final = !has(to, ".sigs-") && !has(to, ".part/");
  return name != nullptr && is_final && !has(from, "/old/") && name_of(to) == name;
}

// Whether a renaming or a linking is to fail.
bool fails(const char* from, const char* to) {
  if (!is_given("SIGS_TEST_FAIL_RENAME", from, to)) return false;
  errno = EIO;
  return true;
}

// The same of a renaming, which is counted.
bool meets(const char* from, const char* to) {
  if (name_of(to) == "lock") return false;  // of a staging folder
  const int number = ++renamings;
  if (number == number_of("SIGS_TEST_KILL_AT") || is_given("SIGS_TEST_KILL_BEFORE", from, to)) kill(getpid(), SIGKILL);
  if (number == number_of("SIGS_TEST_TERM_AT"))
    for (int i = 0; i < 2; ++i) kill(getpid(), SIGTERM);
  return fails(from, to);
}

// Writes so many zeros from a place on.
void write_zeros(int file, off_t from, off_t count) {
  constexpr std::array<char, 4096> kZeros{};
  for (off_t at = from; at < from + count; at += static_cast<off_t>(kZeros.size()))
    static_cast<void>(!pwrite(file, kZeros.data(), kZeros.size(), at));
}

void change_input(const char* path, const std::string& how) {
  struct stat state {};
  const int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0 || fstat(file, &state) != 0) return;
  const off_t half = state.st_size / 2;
  if (how == "cut" || how == "emptied") static_cast<void>(!ftruncate(file, how == "cut" ? half : 0));
  if (how == "continued") write_zeros(file, state.st_size, 65536);
  if (how == "overwritten") write_zeros(file, half, half);
  if (how == "removed") unlink(path);
  close(file);
}

// Counts the reads of the input that is to change, and changes it at its time.
void note_read(int file) {
  const char* const input = std::getenv("SIGS_TEST_CHANGED_INPUT");
  if (input == nullptr) return;
  std::array<char, 4096> path{};
  const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path.data(), path.size() - 1);
  if (length <= 0 || std::strcmp(path.data(), input) != 0) return;
  if (++reads_of_input != number_of("SIGS_TEST_CHANGE_AT")) return;
  const char* const how = std::getenv("SIGS_TEST_CHANGE");
  if (how != nullptr) change_input(input, how);
}

// After a renaming; its result.
int survived(int result, const char* from, const char* to) {
  if (result == 0 && is_given("SIGS_TEST_KILL_AFTER", from, to)) kill(getpid(), SIGKILL);
  return result;
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

ssize_t read(int file, void* bytes, size_t count) {
  note_read(file);
  return next<ssize_t(int, void*, size_t)>("read")(file, bytes, count);
}

int rename(const char* from, const char* to) {
  return meets(from, to) ? -1 : survived(next<int(const char*, const char*)>("rename")(from, to), from, to);
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
  const auto rename_for_real = next<int(int, const char*, int, const char*, unsigned int)>("renameat2");
  return survived(rename_for_real(from_folder, from, to_folder, to, flags), from, to);
}

}  // extern "C"
