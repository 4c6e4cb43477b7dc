// SPDX-License-Identifier: MIT
#include "editor/app/command_line.h"

namespace sigs::editor {

std::unique_ptr<CLI::App> make_command_line(EditorOptions& options) {
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
