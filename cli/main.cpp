// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "base/threads.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/process.h"

namespace {

// Whether the word is meant as a subcommand, and there is none of that name; then it is said.
bool is_unknown(CLI::App& program, const std::string& above, const std::string& word) {
  const std::vector<CLI::App*> commands = program.get_subcommands({});
  const auto is_asked_for = [&](const CLI::App* command) { return command->get_name() == word; };
  if (word.starts_with('-') || std::ranges::any_of(commands, is_asked_for)) return false;
  sigs::cli::print_error(
      {above + word, "no such command; there are " + sigs::cli::names_of(commands), sigs::ErrorKind::usage});
  return true;
}

// The first option that was given an empty value, as a shell leaves it whose variable is not set.
const CLI::Option* empty_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (std::ranges::count(option->results(), "") > 0) return option;
  for (const CLI::App* below : command.get_subcommands())
    if (const CLI::Option* const option = empty_option(*below)) return option;
  return nullptr;
}

int run(int argc, char** argv) {
  using namespace sigs::cli;
  const Program made = make_program();
  CLI::App& program = *made.app;
  if (argc > 1 && is_unknown(program, "", argv[1])) return static_cast<int>(sigs::ErrorKind::usage);
  if (argc > 2 && argv[1] == std::string_view("evaluate") &&
      is_unknown(*program.get_subcommand("evaluate"), "evaluate ", argv[2]))
    return static_cast<int>(sigs::ErrorKind::usage);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(sigs::ErrorKind::usage);
  }
  listen_for_interrupts();
  prepare_mesa();
  for (const AddedCommand& command : made.commands) {
    if (!command.app->parsed()) continue;
    if (const CLI::Option* const empty = empty_option(*command.app)) {
      print_error({empty->get_name(), "has no value; give one, or leave the option out", sigs::ErrorKind::usage});
      return static_cast<int>(sigs::ErrorKind::usage);
    }
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
  sigs::end_plainly_without_memory();
  const sigs::Result<int> status = sigs::guarded([&]() -> sigs::Result<int> { return run(argc, argv); });
  if (status) return *status;
  sigs::cli::print_error(status.error());
  return static_cast<int>(status.error().kind);
}
