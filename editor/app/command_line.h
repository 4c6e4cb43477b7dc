// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace sigs::editor {

struct EditorOptions {
  std::string project;
  std::string probe;  // file for driving the window from outside
};

// The command line of sigs-editor. What is parsed is written into `options`, which must outlive it. Its descriptions
// are also those of the man page (cli/describe).
[[nodiscard]] inline std::unique_ptr<CLI::App> make_command_line(EditorOptions& options) {
  auto program =
      std::make_unique<CLI::App>("Puts simulated aircraft into real UAV footage: the visual editor.", "sigs-editor");
  program->set_version_flag("--version", std::string("sigs-editor ") + SIGS_VERSION);
  program->add_option("PROJECT", options.project, "project file to open; none: the start page");
  program
      ->add_option("--probe", options.probe,
                   "write what the window shows and where into this file, for driving it from outside")
      ->option_text("FILE");
  return program;
}

}  // namespace sigs::editor
