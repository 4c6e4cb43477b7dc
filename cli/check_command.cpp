// SPDX-License-Identifier: MIT
#include "cli/check_command.h"

#include <cstdio>
#include <memory>
#include <optional>

#include "cli/options.h"
#include "export.h"
#include "project/validate.h"
#include "scene/path_stiffness.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

void print(const Error& error) {
  std::printf("%s\n", error.text().c_str());
}

// One line an intruder. The condition is that of spline/stiffness.h.
void print_paths(const Project& project, const Scene& scene) {
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const IntruderSettings& intruder = project.intruders[i];
    const std::size_t count = intruder.trajectory.waypoints.size();
    std::printf("intruders[%zu] \"%s\": %zu %s", i, intruder.name.c_str(), count,
                count == 1 ? "waypoint" : "waypoints");
    if (const std::optional<double> condition = path_condition(project, i, scene))
      std::printf(", condition %.4g", *condition);
    std::printf("\n");
  }
}

// What can be seen without opening anything; then what only opening shows.
Result<void> check(const ProjectOptions& options) {
  const Result<Project> project = project_of(options);
  if (!project) return fail(project.error());
  const std::vector<Problem> problems = validate(*project);
  for (const Problem& problem : problems) print(error_of(*project, problem));
  if (!problems.empty())
    return fail(project->file.string(),
                std::to_string(problems.size()) + (problems.size() == 1 ? " problem" : " problems"),
                problems.front().kind);
  const Result<FrameSource> source = FrameSource::open(resolved(*project, project->footage.video));
  if (!source) return fail(project->file.string() + ": footage.video", source.error().text(), source.error().kind);
  for (const Warning& warning : warnings_of(source->info())) print_warning(warning);
  if (const Result<void> output = check_output(*project, source->info()); !output) return fail(output.error());
  const Result<Scene> scene = open_scene(*project, shape_of(source->info()));
  if (!scene) return fail(scene.error());
  for (const Warning& warning : scene->warnings) print_warning(warning);
  print_paths(*project, *scene);
  std::printf("%s: nothing is wrong; frames %d to %d, %zu %s\n", project->file.c_str(), scene->first_frame,
              scene->last_frame, scene->intruders.size(), scene->intruders.size() == 1 ? "intruder" : "intruders");
  return {};
}

}  // namespace

std::function<Result<void>()> add_check_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("check", "list what is wrong with a project");
  const auto options = std::make_shared<ProjectOptions>();
  add_project_options(*command, *options);
  return [options] { return check(*options); };
}

}  // namespace sigs::cli
