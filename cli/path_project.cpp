// SPDX-License-Identifier: MIT
#include "cli/path_project.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "base/input_file.h"
#include "base/json.h"
#include "base/text.h"
#include "cli/options.h"
#include "cli/process.h"
#include "project/json.h"
#include "project/project.h"
#include "project/validate.h"
#include "scene/camera_track.h"
#include "scene/opened_project.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

Result<Project> with_warnings_printed(Result<ReadProject> read) {
  if (!read) return fail(read.error());
  for (const Warning& warning : read->warnings) print_warning(warning);
  return read->project.cameras.empty() ? std::move(read->project) : seen_by(read->project, 0);
}

// Whether a text is meant to be a project, be it broken: an object with a member that projects or recipes have, or,
// where it is not JSON, one that begins as projects do.
bool is_meant_as_project(const std::string& text) {
  constexpr const char* kSpace = " \t\r\n";
  const std::string_view begin = without_bom(text);
  const std::size_t brace = begin.find_first_not_of(kSpace);
  if (brace == std::string_view::npos || begin[brace] != '{') return false;
  if (const Result<Json> json = parsed_json(text, "", ErrorKind::bad_project)) {
    const auto has = [&](const char* key) { return json->contains(key); };
    return has("sigs") || has("sigs_dataset") || has("footage") || has("intruders");
  }
  const std::size_t key = begin.find_first_not_of(kSpace, brace + 1);
  return key != std::string_view::npos && begin.substr(key).starts_with("\"sigs\"");
}

// What of a scene a recorded path needs: the footage's times, the camera's log and the place on the Earth. Models and
// calibration may be missing still.
Result<Scene> scene_for_traffic(const Project& project) {
  const Result<FrameSource> source = open_footage(project, &interrupt_flag());
  if (!source) return fail(error_of(project, {"footage.video", source.error().text(), source.error().kind}));
  const auto failed = [&](const Problem& problem) { return fail(error_of(project, problem)); };
  Scene scene = bare_scene(project, footage_shape(project, source->info()));
  const Result<FrameRange, Problem> range = scene_range(project.footage, scene.footage);
  if (!range) return failed(range.error());
  scene.first_frame = range->first;
  scene.last_frame = range->last;
  SceneFiles files;
  Result<CameraFlight, Problem> flight = camera_flight(project, scene.footage, *range, files);
  if (!flight) return failed(flight.error());
  set_camera_motion(scene, *std::move(flight));
  for (const Warning& warning : scene.warnings) print_warning(warning);
  return scene;
}

}  // namespace

Result<std::optional<Project>> project_in(const fs::path& file) {
  const Result<std::string> text = read_text(file, kProjectLimit_bytes);
  if (!text || !is_meant_as_project(*text)) return std::nullopt;
  Result<Project> project = with_warnings_printed(parse_project(*text, file));
  if (!project) return fail(project.error());
  return std::move(*project);
}

Result<std::vector<GeoPath>> paths_of_project(const Project& project) {
  const Result<OpenedProject> opened = open_project(project, &interrupt_flag());
  if (!opened) return fail(opened.error());
  for (const Warning& warning : opened->warnings) print_warning(warning);
  if (!opened->scene.earth)
    return fail(project.file.string() + ": geo",
                "does not say where on the Earth the world lies; set geo.latitude_deg, geo.longitude_deg, geo.height_m "
                "and geo.heading_deg, or give the camera a log with positions",
                ErrorKind::bad_project);
  return geo_paths_of(opened->scene);
}

Result<void> write_into_project(const RecordedPath& path, const IntoProject& into) {
  Result<Project> project = with_warnings_printed(read_project(into.project));
  if (!project) return fail(project.error());
  const auto count = static_cast<int>(project->intruders.size());
  const std::string where = fmt::format("--intruder {}", into.intruder);
  if (count == 0)
    return fail(into.project.string() + ": intruders", "is empty; give it an intruder with a model first",
                ErrorKind::bad_project);
  if (into.intruder < 0 || into.intruder > count)
    return fail(where,
                fmt::format("the project has {}, 0 to {}; {} adds one like the last", count_text(count, "intruder"),
                            count - 1, count),
                ErrorKind::usage);
  const Result<Scene> scene = scene_for_traffic(*project);
  if (!scene) return fail(scene.error());
  Result<std::vector<WaypointSettings>> waypoints = traffic_waypoints(path, *scene, into.traffic);
  if (!waypoints) return fail(waypoints.error());
  if (into.intruder == count) {
    const IntruderSettings last = project->intruders.back();
    project->intruders.push_back(last);
    if (!path.name.empty()) project->intruders.back().name = path.name;
  }
  const std::size_t written = waypoints->size();
  take_traffic(*project, static_cast<std::size_t>(into.intruder), *std::move(waypoints), *scene);
  defer_interrupts();
  if (const Result<void> saved = rewrite_project(*project, into.project); !saved) return saved;
  std::printf("%s: intruders[%d] flies by %s\n", into.project.c_str(), into.intruder,
              count_text(static_cast<std::ptrdiff_t>(written), "waypoint").c_str());
  return {};
}

}  // namespace sigs::cli
