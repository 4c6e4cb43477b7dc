// SPDX-License-Identifier: MIT
#include "cli/logic_process.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/pose.h"
#include "base/text.h"

namespace sigs::cli {

namespace {

// A running program with a pipe to it and one from it.
class LogicProcess {
 public:
  LogicProcess(pid_t process, std::FILE* to, std::FILE* from) : process_(process), to_(to), from_(from) {}
  LogicProcess(const LogicProcess&) = delete;
  LogicProcess& operator=(const LogicProcess&) = delete;
  ~LogicProcess() {
    std::fclose(to_);
    std::fclose(from_);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  // None: it has ended.
  std::optional<std::string> answer(const std::string& question) {
    if (std::fputs(question.c_str(), to_) < 0 || std::fflush(to_) != 0) return std::nullopt;
    std::string line;
    for (int c = std::fgetc(from_); c != EOF; c = std::fgetc(from_)) {
      if (c == '\n') return line;
      if (line.size() < 200) line += static_cast<char>(c);
    }
    return std::nullopt;
  }

 private:
  pid_t process_;
  std::FILE* to_;
  std::FILE* from_;
};

std::string question_of(const ThreatView& view) {
  return fmt::format(
      "{{\"encounter\": {}, \"time_s\": {}, \"bearing_deg\": {}, \"elevation_deg\": {}, "
      "\"bearing_rate_deg_s\": {}, \"elevation_rate_deg_s\": {}, \"range_m\": {}, "
      "\"own_speed_mps\": {}}}\n",
      view.encounter, exact_text(view.time_s), exact_text(deg_of_rad(view.bearing_rad)),
      exact_text(deg_of_rad(view.elevation_rad)), exact_text(deg_of_rad(view.bearing_rate_radps)),
      exact_text(deg_of_rad(view.elevation_rate_radps)), view.range_m ? exact_text(*view.range_m) : "null",
      exact_text(view.own_speed_mps));
}

}  // namespace

Result<Logic> logic_of_command(const std::string& command) {
  const auto cannot_start = [&] {
    return fail("--logic-command " + command, std::string("cannot be started: ") + std::strerror(errno),
                ErrorKind::unavailable);
  };
  std::array<int, 2> to{}, from{};
  if (pipe(to.data()) != 0) return cannot_start();
  if (pipe(from.data()) != 0) {
    close(to[0]);
    close(to[1]);
    return cannot_start();
  }
  const pid_t process = fork();
  if (process == 0) {
    dup2(to[0], STDIN_FILENO);
    dup2(from[1], STDOUT_FILENO);
    for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(to[0]);
  close(from[1]);
  if (process < 0) {
    close(to[1]);
    close(from[0]);
    return cannot_start();
  }
  const auto running = std::make_shared<LogicProcess>(process, fdopen(to[1], "w"), fdopen(from[0], "r"));
  return Logic([running, command](const ThreatView& view) -> Result<ManoeuvreKind> {
    const std::optional<std::string> answer = running->answer(question_of(view));
    if (!answer) return fail("--logic-command " + command, "ended without an answer");
    const std::optional<ManoeuvreKind> kind = manoeuvre_named(trimmed(*answer));
    if (!kind)
      return fail("--logic-command " + command,
                  fmt::format("answered \"{}\"; there are {}", *answer, listed(kManoeuvreNames)));
    return *kind;
  });
}

}  // namespace sigs::cli
