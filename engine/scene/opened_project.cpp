// SPDX-License-Identifier: MIT
#include "scene/opened_project.h"

#include <string>
#include <utility>

#include "export/export_project.h"
#include "project/validate.h"
#include "scene/visibility_estimate.h"

namespace sigs {

Result<void> check_interrupt(const std::atomic<bool>* cancel) {
  if (cancel != nullptr && cancel->load()) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
  return {};
}

Result<OpenedProject> open_project(const Project& project, const std::atomic<bool>* cancel) {
  if (const std::vector<Problem> problems = validate(project); !problems.empty())
    return fail(error_of(project, problems.front()));
  Result<FrameSource> source = FrameSource::open(resolved(project, project.footage.video), cancel);
  if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
  if (!source) return fail(project.file.string() + ": footage.video", source.error().text(), source.error().kind);
  Result<Scene> scene = open_scene(project, shape_of(source->info()));
  if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
  if (!scene) return fail(scene.error());
  std::vector<Warning> warnings = warnings_of(source->info());
  for (Warning& warning : warnings_of(project, *scene, estimated_visibilities(*scene, kVisibilitySampleFrames)))
    warnings.push_back(std::move(warning));
  return OpenedProject{std::move(*source), std::move(*scene), std::move(warnings)};
}

std::vector<Warning> warnings_of(const Project& project, const Scene& scene,
                                 const std::vector<Visibility>& visibilities) {
  std::vector<Warning> warnings = scene.warnings;
  const auto add = [&](const Problem& issue) {
    warnings.push_back({project.file.string() + ": " + issue.field, issue.what});
  };
  for (const Problem& issue : scene.issues) add(issue);
  for (std::size_t i = 0; i < visibilities.size(); ++i)
    if (const std::optional<Problem> never = never_visible(visibilities[i], scene.intruders[i].name, i)) add(*never);
  return warnings;
}

Result<FrameRange> range_in(const Scene& scene, const std::optional<FrameRange>& asked_for) {
  const FrameRange range = asked_for.value_or(FrameRange{scene.first_frame, scene.last_frame});
  const std::string held =
      "the project has frames " + std::to_string(scene.first_frame) + " to " + std::to_string(scene.last_frame);
  if (range.first > range.last || range.first < scene.first_frame || range.last > scene.last_frame)
    return fail("frames " + std::to_string(range.first) + "-" + std::to_string(range.last), held, ErrorKind::usage);
  return range;
}

FootageTruth footage_truth(const VideoInfo& footage, const FrameRange& range) {
  return {.video = footage.path.filename().string(),
          .size_px = footage.size_px,
          .first_frame = range.first,
          .last_frame = range.last,
          .frame_rate_num = footage.frame_rate_num,
          .frame_rate_den = footage.frame_rate_den};
}

}  // namespace sigs
