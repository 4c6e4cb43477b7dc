// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.h"
#include "cli/options.h"
#include "cli/process.h"
#include "ego_motion/project_motion.h"
#include "export/export_project.h"
#include "frame/compose_frame.h"
#include "project/project.h"
#include "project/validate.h"
#include "scene/opened_project.h"
#include "scene/plausibility.h"
#include "scene/scene.h"
#include "scene/visibility.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

// Two lines an intruder. The condition is that of spline/trajectory.h.
void print_intruders(const Project& project, const Scene& scene, const std::vector<Visibility>& visibilities) {
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const IntruderSettings& intruder = project.intruders[i];
    std::printf("intruders[%zu] \"%s\": %s", i, intruder.name.c_str(),
                count_text(std::ssize(intruder.trajectory.waypoints), "waypoint").c_str());
    if (const std::optional<double> condition = path_condition(project, i, scene))
      std::printf(", condition %.4g", *condition);
    std::printf("\nintruders[%zu] \"%s\": %s\n", i, intruder.name.c_str(), text_of(visibilities[i]).c_str());
  }
}

// The log by whose attitude the camera turns; empty: none.
std::filesystem::path log_of(const Project& project) {
  const TrackSettings& track = project.camera.track;
  const bool turns = !track.file.empty() && track.attitude != TrackAttitudeChoice::none;
  return turns ? resolved(project, track.file) : std::filesystem::path();
}

// What only opening shows, of one camera: how well it sees each intruder.
Result<std::vector<Visibility>> check_opened(const Project& seen) {
  Result<FrameSource> source = open_footage(seen);
  if (!source) return fail(footage_error(seen, source.error()));
  std::vector<Warning> warnings = warnings_of(source->info());
  for (Warning& warning : codec_warnings_of(seen, source->info())) warnings.push_back(std::move(warning));
  for (Problem& mistake : footage_mistakes(source->info().path, log_of(seen)))
    warnings.push_back({seen.file.string() + ": " + mistake.field, std::move(mistake.what)});
  if (const Result<void> output = check_output(seen, source->info()); !output) return fail(output.error());
  SceneFiles files;
  const Result<Scene> scene = open_valid_scene(seen, footage_shape(seen, source->info()), files);
  if (!scene) return fail(scene.error());
  if (scene->is_thermal) {
    const Result<Frame> frame = source->read(scene->first_frame);
    if (!frame) return fail(frame.error());
    if (const Result<void> heat = check_spectrum(*scene, *frame, scene->first_frame); !heat)
      return fail(composing_error(seen, heat.error()));
  }
  const std::vector<Visibility> visibilities = estimated_visibilities(*scene, std::numeric_limits<int>::max());
  for (Warning& warning : warnings_of(seen, *scene, visibilities)) warnings.push_back(std::move(warning));
  if (scene->horizon_is_known)
    if (const auto level = level_contradiction(seen_horizons(*source, *scene, &interrupt_flag()), seen, *scene))
      warnings.insert(warnings.begin(), {seen.file.string() + ": " + level->field, level->what});
  for (const Warning& warning : warnings) print_warning(warning);
  print_intruders(seen, *scene, visibilities);
  std::printf("%s: %s; frames %d to %d, %s\n", seen.file.c_str(),
              warnings.empty() ? "nothing is wrong" : ("no errors, " + count_text(warnings.size(), "warning")).c_str(),
              scene->first_frame, scene->last_frame, count_text(scene->intruders.size(), "intruder").c_str());
  return visibilities;
}

// What can be seen without opening anything; then what only opening shows.
Result<void> check(const ProjectOptions& options) {
  const Result<Project> project = whole_project_of(options);
  if (!project) return fail(project.error());
  const std::vector<Problem> problems = validate(*project);
  for (const Problem& problem : problems) std::printf("%s\n", error_of(*project, problem).text().c_str());
  if (!problems.empty())
    return fail(project->file.string(), count_text(problems.size(), "problem"), problems.front().kind);
  std::vector<bool> is_seen(project->intruders.size(), false);
  for (const Project& seen : seen_by_each(*project)) {
    if (!options.camera.empty() && seen.rig_view->name != options.camera) continue;
    if (seen.rig_view) std::printf("camera \"%s\":\n", seen.rig_view->name.c_str());
    const Result<std::vector<Visibility>> visibilities = check_opened(seen);
    if (!visibilities) return fail(visibilities.error());
    for (std::size_t i = 0; i < is_seen.size(); ++i) is_seen[i] = is_seen[i] || (*visibilities)[i].visible > 0;
  }
  if (project->cameras.empty() || !options.camera.empty()) return {};
  for (std::size_t i = 0; i < is_seen.size(); ++i)
    if (!is_seen[i]) print_warning(visible_in_no_camera(*project, i));
  return {};
}

}  // namespace

Command add_check_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("check", "list what is wrong with a project");
  const auto options = std::make_shared<ProjectOptions>();
  add_project_options(*command, *options);
  return [options] { return check(*options); };
}

}  // namespace sigs::cli
