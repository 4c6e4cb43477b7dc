// SPDX-License-Identifier: MIT
#include "evaluation/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/staged_outputs.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// A folder for one run's files, gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code code;
    const fs::path all = fs::temp_directory_path(code);
    std::string name = (all / "sigs-plot-XXXXXX").string();
    if (!code && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code code;
    if (!path_.empty()) fs::remove_all(path_, code);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }  // empty: none could be made

 private:
  fs::path path_;
};

constexpr int kCommandNotFound = 127;  // what a child that cannot be started ends with

// Exit status; errno as a negative number where it could not be started.
int run(const fs::path& program, const fs::path& out, const fs::path& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), kFlags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), kFlags, 0600);
  std::string name = "gnuplot";
  std::string own_settings = "-d";  // gnuplot's own, not the user's
  std::string file = program.string();
  char* const arguments[] = {name.data(), own_settings.data(), file.data(), nullptr};
  pid_t child = 0;
  const int code = posix_spawnp(&child, name.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (code != 0) return -code;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -errno;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

// What it complains of, in one line.
std::string error_line(const fs::path& err) {
  std::string text = read_text(err).value_or("");
  text.erase(0, text.find_first_not_of("\n "));
  const std::size_t place = text.find("line ");
  return place == std::string::npos ? text.substr(0, text.find('\n'))
                                    : text.substr(place, text.find('\n', place) - place);
}

}  // namespace

Result<std::string> gnuplot_output(const std::string& program) {
  const TemporaryFolder scratch;
  if (scratch.path().empty())
    return fail("gnuplot", "no temporary folder can be made, no plots are drawn: set TMPDIR to one",
                ErrorKind::unavailable);
  const fs::path file = scratch.path() / "plot.gp";
  if (const Result<void> written = write_text(file, program, true); !written) return fail(written.error());
  const int status = run(file, scratch.path() / "image", scratch.path() / "messages");
  if (status == -ENOENT || status == kCommandNotFound)
    return fail("gnuplot", "is not installed, no plots are drawn", ErrorKind::unavailable);
  if (status < 0)
    return fail("gnuplot", std::string("cannot be started: ") + std::strerror(-status), ErrorKind::unavailable);
  if (status != 0) return fail("gnuplot", "fails: " + error_line(scratch.path() / "messages"));
  Result<std::string> image = read_text(scratch.path() / "image");
  if (image && image->empty()) return fail("gnuplot", "drew nothing: " + error_line(scratch.path() / "messages"));
  return image;
}

}  // namespace sigs
