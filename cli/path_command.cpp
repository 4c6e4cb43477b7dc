// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/process.h"
#include "geo/geo_path.h"
#include "geo/recorded_path.h"
#include "geo/utc_time.h"
#include "project/project.h"
#include "project/validate.h"
#include "scene/camera_track.h"
#include "scene/geo_paths.h"
#include "scene/opened_project.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

constexpr const char* kPathFooter =
    "Examples:\n"
    "  sigs path flight.gpx\n"
    "  sigs path trace_full_3c6444.json --out flight.kml\n"
    "  sigs path aircraft.json --name DLH400 --out flight.czml --force\n"
    "  sigs path aircraft.json --name DLH400 --into encounter.json --intruder 0\n"
    "  sigs path encounter.json --out encounter.kml";

struct IntoProject {
  std::filesystem::path project;  // is rewritten
  int intruder = 0;               // index; one more than there are: a copy of the last one is added
  TrafficSettings traffic;
};

struct PathOptions {
  std::filesystem::path file;
  std::filesystem::path out;  // empty: nothing is written
  std::string name;           // empty: all paths
  IntoProject into;           // its project empty: none
  bool force = false;
};

using RecordedPaths = std::vector<RecordedPath>;

// "2026-05-01T12:00:00Z to 2026-05-01T12:10:00Z (10:00)"
std::string time_span_text(const RecordedPath& path) {
  if (!path.has_times) return "no times";
  const double first_s = path.points.front().time_s;
  const double last_s = path.points.back().time_s;
  const std::string length = clock_text(last_s - first_s);
  if (path.utc) return fmt::format("{} to {} ({})", utc_text(first_s), utc_text(last_s), length);
  return fmt::format("{} to {} s ({})", number_text(first_s, 3), number_text(last_s, 3), length);
}

std::string name_text(const RecordedPath& path) {
  if (path.icao24.empty() || path.icao24 == path.name) return fmt::format("\"{}\"", path.name);
  return fmt::format("\"{}\" ({})", path.name, path.icao24);
}

std::string height_text(const RecordedPath& path, const PathExtent& extent) {
  if (path.height == HeightReference::unknown) return "no heights";
  return fmt::format("height {} to {} m {}", number_text(extent.low_m, 1), number_text(extent.high_m, 1),
                     name_of(path.height));
}

// One line, so that a long list can be searched.
void print_path(const RecordedPath& path) {
  const PathExtent extent = extent_of(path.points);
  std::printf("%s: %s, %s, %s, latitude %s to %s, longitude %s to %s\n", name_text(path).c_str(),
              count_text(std::ssize(path.points), "point").c_str(), time_span_text(path).c_str(),
              height_text(path, extent).c_str(), number_text(extent.south_deg, 6).c_str(),
              number_text(extent.north_deg, 6).c_str(), number_text(extent.west_deg, 6).c_str(),
              number_text(extent.east_deg, 6).c_str());
  for (const Warning& warning : path.warnings) print_warning(warning);
}

bool is_called(const RecordedPath& path, const std::string& name) {
  return lower_case(path.name) == lower_case(name) || (!path.icao24.empty() && path.icao24 == lower_case(name));
}

// Those asked for. Error usage where there is none of that name.
Result<RecordedPaths> chosen_paths(RecordedPaths paths, const PathOptions& options) {
  if (options.name.empty()) return paths;
  constexpr std::size_t kMaxNamed = 10;
  std::vector<std::string> others;
  RecordedPaths chosen;
  for (RecordedPath& path : paths) {
    if (is_called(path, options.name))
      chosen.push_back(std::move(path));
    else if (others.size() < kMaxNamed)
      others.push_back(name_text(path));
  }
  if (!chosen.empty()) return chosen;
  if (paths.size() > others.size()) others.emplace_back("...");
  return fail("--name " + line_text(options.name),
              fmt::format("no such path in {}; there are {}", options.file.string(), listed(others)), ErrorKind::usage);
}

// Colours that differ on maps and aerial images.
std::array<std::uint8_t, 3> color_number(std::size_t index) {
  constexpr std::array<std::array<std::uint8_t, 3>, 6> kColors{
      {{255, 220, 0}, {0, 220, 255}, {255, 90, 60}, {120, 255, 90}, {255, 110, 255}, {255, 255, 255}}};
  return kColors[index % kColors.size()];
}

std::vector<GeoPath> geo_paths_of(const RecordedPaths& paths) {
  std::vector<GeoPath> all;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const RecordedPath& path = paths[i];
    std::string description = fmt::format("Heights: {}.", name_of(path.height));
    if (!path.icao24.empty()) description = fmt::format("ICAO address {}. {}", path.icao24, description);
    all.push_back({.name = path.name,
                   .description = std::move(description),
                   .color_rgb = color_number(i),
                   .points = path.points,
                   .has_times = path.has_times,
                   .utc = path.utc});
  }
  return all;
}

std::string table_of(const RecordedPaths& paths) {
  std::string text = "name,icao24,time_s,utc,latitude_deg,longitude_deg,height_m\n";
  for (const RecordedPath& path : paths) {
    const std::string begin = csv_field(path.name) + ',' + csv_field(path.icao24) + ',';
    for (const TimedPlace& point : path.points)
      text += fmt::format("{}{},{},{},{},{}\n", begin, number_text(point.time_s, 6),
                          path.utc ? utc_text(point.time_s) : "", number_text(point.place.latitude_deg, 9),
                          number_text(point.place.longitude_deg, 9), number_text(point.place.height_m, 4));
  }
  return text;
}

// As KML or CZML, by the output's extension.
std::string globe_text(const std::vector<GeoPath>& paths, const PathOptions& options) {
  const std::string title = options.file.filename().string();
  return lower_extension(options.out) == ".kml" ? kml_text(paths, title) : czml_text(paths, title);
}

// The contents of the output, by its extension. Error usage.
Result<std::string> converted(const RecordedPaths& paths, const PathOptions& options) {
  const std::string extension = lower_extension(options.out);
  if (extension == ".kml" || extension == ".czml") return globe_text(geo_paths_of(paths), options);
  if (extension == ".csv") return table_of(paths);
  return fail("--out " + options.out.string(), "expected a name that ends with .kml, .czml or .csv", ErrorKind::usage);
}

Result<void> write(const std::string& text, const PathOptions& options) {
  if (const Result<void> kept = check_inputs_not_overwritten(std::vector{options.out}, std::vector{options.file});
      !kept)
    return kept;
  defer_interrupts();
  if (const Result<void> written = write_text(options.out, text, options.force); !written) return written;
  std::printf("%s\n", options.out.c_str());
  return {};
}

// The paths of a project's camera and intruders (scene/geo_paths.h). Its footage and log are opened. Warnings are
// printed. Error bad_project: the project has no place on the Earth.
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

// What of a scene a recorded path needs: the footage's times, the camera's log and the place on the Earth. Models and
// calibration may be missing still.
Result<Scene> scene_for_traffic(const Project& project) {
  const Result<FrameSource> source = open_footage(project, &interrupt_flag());
  if (!source) return fail(footage_error(project, source.error()));
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

// Writes a recorded path into a project as the waypoints of an intruder, and prints what was written.
Result<void> write_into_project(const RecordedPath& path, const IntoProject& into) {
  Result<Project> project = first_camera_of(read_project(into.project));
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

// The encounter of a project on the globe.
Result<void> run_on_project(const Project& project, const PathOptions& options) {
  const std::string extension = lower_extension(options.out);
  if (extension != ".kml" && extension != ".czml")
    return fail(options.file.string(), "is a project; its paths are written with --out FILE.kml or FILE.czml",
                ErrorKind::usage);
  const Result<std::vector<GeoPath>> paths = paths_of_project(project);
  if (!paths) return fail(paths.error());
  return write(globe_text(*paths, options), options);
}

Result<void> run(const PathOptions& options) {
  const Result<std::optional<Project>> project = project_in(options.file);
  if (!project) return fail(project.error());
  if (*project) return run_on_project(**project, options);
  if (!options.out.empty())
    if (const Result<std::string> empty = converted({}, options); !empty) return fail(empty.error());
  Result<RecordedPaths> all = read_recorded_paths(options.file);
  if (!all) return fail(all.error());
  const Result<RecordedPaths> paths = chosen_paths(std::move(*all), options);
  if (!paths) return fail(paths.error());
  for (const RecordedPath& path : *paths) print_path(path);
  if (!options.into.project.empty()) {
    if (paths->size() != 1) return fail("--into", "needs one path; choose it with --name", ErrorKind::usage);
    if (const Result<void> put = write_into_project(paths->front(), options.into); !put) return put;
  }
  if (options.out.empty()) return {};
  const Result<std::string> text = converted(*paths, options);
  if (!text) return fail(text.error());
  return write(*text, options);
}

}  // namespace

Command add_path_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("path", "list the recorded paths in a file, or convert them");
  const auto options = std::make_shared<PathOptions>();
  add_subject(*command, "FILE", options->file,
              "recorded paths: GPX, KML, JSON or CSV of ADS-B receivers and the OpenSky Network; or a project");
  add_output(*command, "--out", options->out, "write the paths into this file, which ends with .kml, .czml or .csv");
  add_value(*command, "--name", options->name, "NAME", "only paths of this name or ICAO address");
  add_input(*command, "--into", options->into.project, "make the path the flight of an intruder of this project",
            "PROJECT");
  add_value(*command, "--intruder", options->into.intruder, "N",
            "which intruder, from 0; one more adds one like the last")
      ->needs("--into");
  add_value(*command, "--at-frame", options->into.traffic.at_frame, "FRAME",
            "the frame at which the path begins; without it both must know UTC")
      ->needs("--into");
  add_value(*command, "--tolerance-m", options->into.traffic.tolerance_m, "M",
            "how far off the recorded points the flight may pass (2)")
      ->check(CLI::Range(0.0, 1e6))
      ->needs("--into");
  add_value(*command, "--height-offset-m", options->into.traffic.height_offset_m, "M",
            "added to the path's heights, to bring them to the ellipsoid (0)")
      ->check(CLI::Range(-1e5, 1e5))
      ->needs("--into");
  command->add_flag("--force", options->force, "overwrite what is there");
  command->footer(kPathFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
