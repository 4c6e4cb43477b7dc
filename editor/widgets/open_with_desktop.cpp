// SPDX-License-Identifier: MIT
#include "editor/widgets/open_with_desktop.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

fs::path opener() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "xdg-open";
    if (::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

// Only what may be called between fork and exec in a program with threads.
[[noreturn]] void run_detached(const char* program, const char* argument) {
  ::setsid();
  if (::fork() != 0) ::_exit(0);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) ::dup2(nowhere, stream);
  ::execl(program, program, argument, static_cast<char*>(nullptr));
  ::_exit(127);
}

}  // namespace

bool can_open_with_desktop() {
  static const bool can = !opener().empty();
  return can;
}

bool open_with_desktop(const fs::path& path) {
  const std::string program = opener().string();
  const std::string argument = fs::absolute(path).string();
  if (program.empty()) return false;
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) run_detached(program.c_str(), argument.c_str());
  int status = 0;
  return ::waitpid(child, &status, 0) == child;
}

}  // namespace sigs::editor
