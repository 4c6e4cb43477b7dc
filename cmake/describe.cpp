// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "cli/describe/command_facts.h"
#include "cli/commands.h"
#include "editor/app/command_line.h"

// Writes the man pages and the completion of sigs and sigs-editor into a folder: man/, bash/, zsh/.

namespace {

namespace fs = std::filesystem;

bool write(const fs::path& file, const std::string& text) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) std::fprintf(stderr, "error: %s: could not be written\n", file.c_str());
  return static_cast<bool>(stream);
}

bool describe(const CLI::App& app, const fs::path& folder) {
  using namespace sigs::cli;
  const CommandFacts program = facts_of(app);
  const std::function<bool(const CommandFacts&)> write_pages = [&](const CommandFacts& command) {
    bool is_written = write(folder / "man" / man_page_name(command), man_page(command, program, SIGS_VERSION));
    for (const CommandFacts& below : command.commands) is_written = write_pages(below) && is_written;
    return is_written;
  };
  const bool are_written = write_pages(program);
  return write(folder / "bash" / program.name, bash_completion(program)) &&
         write(folder / "zsh" / ("_" + program.name), zsh_completion(program)) && are_written;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: sigs_describe FOLDER\n");
    return 64;
  }
  const sigs::cli::Program program = sigs::cli::make_program();
  sigs::editor::EditorOptions options;
  const auto editor = sigs::editor::make_command_line(options);
  return describe(*program.app, argv[1]) && describe(*editor, argv[1]) ? 0 : 74;
}
