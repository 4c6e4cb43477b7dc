// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "support/files.h"
#include "support/process.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// The help of "sigs", "sigs evaluate track", ..., and of "sigs-editor". Each is run once.
const std::string& help_text(const std::string& command) {
  static std::map<std::string, std::string> known;
  if (const auto found = known.find(command); found != known.end()) return found->second;
  const Run finished = run_together("'" + build_dir().string() + "'/" + command + " --help");
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
  return known[command] = finished.out;
}

// What stands at the beginning of the lines of the help: "--out", "-h".
std::set<std::string> options_of(const std::string& command) {
  std::set<std::string> options;
  std::istringstream lines(help_text(command));
  const std::regex option("^  ((-[a-zA-Z],)?(--[a-z][a-z-]*)).*");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, option)) options.insert(match[3]);
  }
  return options;
}

std::set<std::string> subcommands_of(const std::string& command) {
  const std::string& help = help_text(command);
  const std::size_t begin = help.find("\nSubcommands:");
  std::set<std::string> found;
  if (begin == std::string::npos) return found;
  std::istringstream lines(help.substr(begin + 1));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  ")) found.insert(line.substr(2, line.find(' ', 2) - 2));
  return found;
}

std::set<std::string> all_commands() {
  std::set<std::string> all{"sigs"};
  if (fs::exists(build_dir() / "sigs-editor")) all.insert("sigs-editor");
  for (const std::string& name : subcommands_of("sigs")) {
    all.insert("sigs " + name);
    for (const std::string& below : subcommands_of("sigs " + name)) all.insert("sigs " + name + " " + below);
  }
  return all;
}

fs::path described(const std::string& name) {
  return build_dir() / "described" / name;
}

// As plain text.
std::string page_of(std::string command) {
  std::ranges::replace(command, ' ', '-');
  const Run finished =
      run_command("gzip -dc '" + described("man/" + command + ".1.gz").string() + "' | sed 's/\\\\-/-/g'");
  REQUIRE_MESSAGE(finished.status == 0, finished.err);
  return finished.out;
}

// The lines of a shell that finds the function of the program's completion and completes these words.
std::string completed(const std::string& words) {
  const Run finished =
      run_command("exec bash <<'END'\nsource '" + described("bash/sigs").string() + "'\nset -- " + words +
                  "\nCOMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1))\n_sigs\n"
                  "printf '%s\\n' \"${COMPREPLY[@]}\" | sort\nEND\n");
  CHECK_MESSAGE(finished.status == 0, finished.err);
  return finished.out;
}

bool has_program(const std::string& name) {
  if (run_command("command -v " + name + " >/dev/null").status == 0) return true;
  say_skipped(name + " is absent");
  return false;
}

}  // namespace

TEST_CASE("every option that a command's help prints stands in its man page and in both completions") {
  REQUIRE(all_commands().size() > 15);
  for (const std::string& command : all_commands()) {
    const std::string program = command.substr(0, command.find(' '));
    const std::string man = page_of(command);
    const std::string bash = text_of(described("bash/" + program));
    const std::size_t begin = bash.find("'" + command + "')\n      options=");
    REQUIRE_MESSAGE(begin != std::string::npos, command);
    const std::string options = bash.substr(begin, bash.find('\n', bash.find("options=", begin)) - begin) + " ";
    std::string function = "_" + command;
    for (char& c : function)
      if (c == ' ' || c == '-') c = '_';
    const std::string zsh = text_of(described("zsh/_" + program));
    const std::size_t zsh_begin = zsh.find("\n" + function + "() {");
    REQUIRE_MESSAGE(zsh_begin != std::string::npos, function);
    const std::string zsh_options = zsh.substr(zsh_begin, zsh.find("\n}\n", zsh_begin) - zsh_begin);
    CHECK(options_of(command).contains("--help"));
    for (const std::string& option : options_of(command)) {
      CHECK_MESSAGE(man.find("\\fB" + option + "\\fR") != std::string::npos, command << ": man page: " << option);
      const bool is_in_bash = std::regex_search(options, std::regex("[ ']" + option + "[ ']"));
      CHECK_MESSAGE(is_in_bash, command << ": bash: " << option);
      CHECK_MESSAGE(zsh_options.find(option + "[") != std::string::npos, command << ": zsh: " << option);
    }
  }
}

TEST_CASE("every subcommand is named in the man page and the completions of the command above it") {
  for (const std::string& command : all_commands())
    for (const std::string& name : subcommands_of(command)) {
      CHECK_MESSAGE(page_of(command).find(name) != std::string::npos, command << " " << name);
      CHECK_MESSAGE(completed(command + " " + name).find(name + "\n") != std::string::npos, command << " " << name);
      CHECK_MESSAGE(text_of(described("zsh/_sigs")).find("'" + name + ":") != std::string::npos,
                    command << " " << name);
    }
}

TEST_CASE("bash completes the beginning of a subcommand, options and choices") {
  CHECK(completed("sigs exp") == "export\n");
  CHECK(completed("sigs evaluate tr") == "track\n");
  CHECK(completed("sigs export --cod") == "--codec\n");
  CHECK(completed("sigs export x.json --codec h26").starts_with("h264\n"));
  CHECK(completed("sigs export --progress p") == "plain\n");
  CHECK(completed("sigs evaluate track --tracker csrt,kc") == "csrt,kcf\n");
}

TEST_CASE("the page on the engine shows the example as it is built") {
  const std::string shown = text_of(source_dir() / "docs/engine-library.md");
  for (const char* const name : {"CMakeLists.txt", "main.cpp"}) {
    const std::string built = text_of(source_dir() / "docs/examples/one_frame" / name);
    CHECK_MESSAGE(shown.find("\n" + built + "```") != std::string::npos, name);
  }
}

TEST_CASE("the shells find no fault with their completions") {
  for (const char* const name : {"sigs", "sigs-editor"}) {
    const Run bash = run_together("bash -n '" + described(std::string("bash/") + name).string() + "'");
    CHECK_MESSAGE(bash.status == 0, bash.out);
  }
  if (!has_program("zsh")) return;
  for (const char* const name : {"_sigs", "_sigs-editor"}) {
    const Run zsh = run_together("zsh -n '" + described(std::string("zsh/") + name).string() + "'");
    CHECK_MESSAGE(zsh.status == 0, zsh.out);
  }
}

}  // namespace sigs::test
