// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

#include "base/threads.h"
#include "cli/options.h"
#include "cli/process.h"
#include "cli/program.h"

namespace {

bool is_no_evaluation(std::string_view word) {
  return !word.starts_with('-') && word != "track" && word != "detect" && word != "performance" && word != "rig";
}

int run(int argc, char** argv) {
  using namespace sigs::cli;
  const Program made = make_program();
  CLI::App& program = *made.app;
  const auto is_asked_for = [&](const AddedCommand& command) { return command.app->get_name() == argv[1]; };
  const bool is_unknown = argc > 1 && argv[1][0] != '-' && std::ranges::none_of(made.commands, is_asked_for);
  if (is_unknown) {
    print_error(
        {argv[1], "no such command; there are " + names_of(program.get_subcommands({})), sigs::ErrorKind::usage});
    return static_cast<int>(sigs::ErrorKind::usage);
  }
  if (argc > 2 && argv[1] == std::string_view("evaluate") && is_no_evaluation(argv[2])) {
    print_error({std::string("evaluate ") + argv[2], "no such command; there are track, detect, performance and rig",
                 sigs::ErrorKind::usage});
    return static_cast<int>(sigs::ErrorKind::usage);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(sigs::ErrorKind::usage);
  }
  listen_for_interrupts();
  prepare_mesa();
  for (const AddedCommand& command : made.commands) {
    if (!command.app->parsed()) continue;
    if (const sigs::Result<void> done = command.run(); !done) {
      print_error(done.error());
      const sigs::ErrorKind kind = done.error().kind;
      return kind == sigs::ErrorKind::interrupted ? interrupted_status() : static_cast<int>(kind);
    }
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    print_error({"stdout", "could not be written", sigs::ErrorKind::write_failed});
    return static_cast<int>(sigs::ErrorKind::write_failed);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const sigs::Result<int> status = sigs::guarded([&]() -> sigs::Result<int> { return run(argc, argv); });
  if (status) return *status;
  sigs::cli::print_error(status.error());
  return static_cast<int>(status.error().kind);
}
