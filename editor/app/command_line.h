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
[[nodiscard]] std::unique_ptr<CLI::App> make_command_line(EditorOptions& options);

}  // namespace sigs::editor
