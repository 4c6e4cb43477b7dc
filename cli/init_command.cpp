// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/process.h"
#include "first_project/first_project.h"

namespace sigs::cli {

namespace {

struct InitOptions {
  FirstProjectOptions project;
  double fov_deg = 0;
  std::string progress = "auto";
};

Result<void> init(const InitOptions& options, bool has_fov) {
  FirstProjectOptions project = options.project;
  if (has_fov) project.horizontal_fov_deg = options.fov_deg;
  defer_interrupts();
  Progress progress(options.progress);
  const auto tell = [&](int done, int total, const std::string& step) {
    if (done > 0) progress.update(done, total, step);
  };
  const Result<FirstProject> made = make_first_project(project, {.progress = tell, .cancel = &interrupt_flag()});
  progress.end();
  if (!made) return fail(made.error());
  for (const Warning& warning : made->warnings) print_warning(warning);
  // What the footage does not show of its look is one line: there is little to be done about it.
  std::vector<std::string> not_shown;
  for (const FirstProjectNote& note : made->notes) {
    if (note.is_not_shown)
      not_shown.push_back(note.field);
    else
      std::fprintf(stderr, "%s: %s: %s\n", note.is_guess ? "guessed" : "found", note.field.c_str(),
                   told_on_terminal(note).c_str());
  }
  if (!not_shown.empty())
    std::fprintf(stderr, "guessed: %s: the footage does not show them; the defaults stand (%s says why)\n",
                 fmt::format("{}", fmt::join(not_shown, ", ")).c_str(),
                 notes_file_of(made->project.file).filename().c_str());
  const std::string file = made->project.file.string();
  std::printf("%s\n", file.c_str());
  std::fprintf(stderr, "next: sigs check %s; sigs export %s --out out; sigs-editor %s\n", file.c_str(), file.c_str(),
               file.c_str());
  return {};
}

}  // namespace

Command add_init_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("init", "make a first project from a video");
  const auto options = std::make_shared<InitOptions>();
  add_subject(*command, "VIDEO", options->project.video, "the footage");
  CLI::Option* const calibration =
      add_input(*command, "--calibration", options->project.calibration, "the camera's calibration file");
  CLI::Option* const fov =
      add_range(*command, "--fov", options->fov_deg, "DEG", 1, 359, "horizontal field of view, in degrees");
  fov->excludes(calibration);
  add_timing_options(*command, options->project.timing);
  add_input(*command, "--model", options->project.model, "the intruder's model (obj); default: a light aircraft");
  add_output(*command, "--out", options->project.out,
             "the project file; default: NAME/NAME.json, of images NAME-project/NAME.json", "PROJECT.json");
  add_value(*command, "--name", options->project.name, "NAME", "the project's name; default: that of the file");
  command->add_flag("--plain", options->project.plain, "leave out what makes the intruder look as the footage does");
  command->add_flag("--force", options->project.overwrite, "replace files that are there already");
  add_progress_option(*command, options->progress);
  return [options, fov] { return init(*options, fov->count() > 0); };
}

}  // namespace sigs::cli
