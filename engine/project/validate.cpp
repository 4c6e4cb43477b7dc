// SPDX-License-Identifier: MIT
#include "project/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/text.h"
#include "project/fields.h"
#include "project/places.h"
#include "project/project.h"

namespace sigs {

namespace {

using Problems = std::vector<Problem>;

void check_number(const Field& field, double number, Problems& problems) {
  if (!std::isfinite(number)) {
    problems.push_back({field.key, "is not a finite number"});
  } else if (number < field.minimum || number > field.maximum) {
    problems.push_back(
        {field.key, fmt::format("is {}; it must lie between {:g} and {:g}", number, field.minimum, field.maximum)});
  }
}

void check_range(const Field& field, Problems& problems) {
  if (const auto* const number = std::get_if<double*>(&field.value)) check_number(field, **number, problems);
  if (const auto* const number = std::get_if<int*>(&field.value)) check_number(field, **number, problems);
  if (const auto* const number = std::get_if<std::optional<double>*>(&field.value); number && **number)
    check_number(field, ***number, problems);
  if (const auto* const number = std::get_if<std::optional<int>*>(&field.value); number && **number)
    check_number(field, ***number, problems);
  if (const auto* const vector = std::get_if<glm::dvec3*>(&field.value))
    for (int i = 0; i < 3; ++i) check_number(field, (**vector)[i], problems);
}

void check_text(const Project& project, const Field& field, Problems& problems) {
  const auto* const value = std::get_if<std::string*>(&field.value);
  if (value == nullptr) return;
  const std::string& text = **value;
  if (text.empty()) {
    // Intruders are put into real images, also those of a rig.
    const bool has_no_footage = field.key.starts_with("cameras[") && field.key.ends_with("].footage.video");
    if (has_no_footage)
      problems.push_back(
          {field.key, "is missing: a camera without footage of its own has nothing to put intruders into"});
    else if (field.required)
      problems.push_back({field.key, "is missing: " + std::string(field.help)});
    return;
  }
  std::error_code code;
  std::filesystem::path path = resolved(project, text);
  // Of one camera of a rig (rig.yaml#cam1; camera/camera.h) the file.
  if (const std::size_t at = text.rfind('#');
      at != std::string::npos && field.key.ends_with("footage.calibration") && !std::filesystem::exists(path, code))
    path = resolved(project, text.substr(0, at));
  const bool is_sequence =
      field.key.ends_with("footage.video") && is_number_pattern(path);  // opening it shows what is there
  if (field.is_path && !is_sequence && !std::filesystem::exists(path, code))
    problems.push_back({field.key, "no such file: " + path.lexically_normal().string(), ErrorKind::cannot_read});
}

void check_name(const Project& project, Problems& problems) {
  if (project.name.empty()) return;  // a required field, reported as such
  if (const std::string wrong = file_name_error(project.name); !wrong.empty()) problems.push_back({"name", wrong});
}

bool is_axis(std::string_view text) {
  constexpr std::array<std::string_view, 6> kAxes{"+x", "-x", "+y", "-y", "+z", "-z"};
  return std::find(kAxes.begin(), kAxes.end(), text) != kAxes.end();
}

void check_axes(const ModelSettings& model, const std::string& key, Problems& problems) {
  for (const auto& [name, axis] : {std::pair{".forward", model.forward}, std::pair{".up", model.up}})
    if (!is_axis(axis))
      problems.push_back({key + name, fmt::format("is \"{}\"; it must be one of +x -x +y -y +z -z", axis)});
  if (is_axis(model.forward) && is_axis(model.up) && model.forward[1] == model.up[1])
    problems.push_back({key + ".up", "lies along forward; up must be another axis"});
}

void check_waypoints(const TrajectoryPlan& plan, const std::string& key, Problems& problems) {
  if (plan.waypoints.empty()) problems.push_back({key, "is empty; an intruder needs at least one waypoint"});
  std::optional<double> last_frame;
  std::size_t last_index = 0;
  for (std::size_t i = 0; i < plan.waypoints.size(); ++i) {
    const std::optional<double>& frame = plan.waypoints[i].frame;
    if (!frame) continue;
    if (last_frame && *frame <= *last_frame)
      problems.push_back(
          {fmt::format("{}[{}].frame", key, i),
           fmt::format("is {:g}, not after waypoints[{}], which has {:g}", *frame, last_index, *last_frame)});
    last_frame = frame;
    last_index = i;
  }
}

// A place on the Earth can be told only where the project states where the world is.
void check_places(const Project& project, Problems& problems) {
  const GeoSettings& geo = project.geo;
  if (geo.latitude_deg.has_value() != geo.longitude_deg.has_value())
    problems.push_back({geo.latitude_deg ? "geo.longitude_deg" : "geo.latitude_deg",
                        "is missing: latitude and longitude belong together; give both or neither"});
  if (stated_frame(geo)) return;
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const std::vector<WaypointSettings>& waypoints = project.intruders[i].trajectory.waypoints;
    const auto placed = std::find_if(waypoints.begin(), waypoints.end(),
                                     [](const WaypointSettings& waypoint) { return waypoint.place.has_value(); });
    if (placed == waypoints.end()) continue;
    problems.push_back(
        {fmt::format("intruders[{}].trajectory.waypoints[{}].latitude_deg", i, placed - waypoints.begin()),
         "is a place on the Earth, which needs geo.latitude_deg, geo.longitude_deg, geo.height_m and "
         "geo.heading_deg: where the world's origin is and where its X axis points"});
    return;
  }
}

// The camera turns by one file; two would have to agree.
void check_track(const CameraSettings& camera, Problems& problems) {
  const bool has_two =
      !camera.attitude_file.empty() && !camera.track.file.empty() && camera.track.attitude != TrackAttitudeChoice::none;
  if (has_two)
    problems.push_back({"camera.attitude_file",
                        "is named beside camera.track.file; leave one out, or set camera.track.attitude to none"});
}

//   prefix  of the footage's keys: "", or that of a camera of a rig
void check_frames(const FootageSettings& footage, const std::string& prefix, Problems& problems) {
  if (footage.last_frame && *footage.last_frame < footage.first_frame)
    problems.push_back({prefix + "footage.last_frame", "lies before footage.first_frame"});
}

// Packets are copied as they are.
void check_crop(const FootageSettings& footage, VideoCodec codec, Problems& problems) {
  if (codec == VideoCodec::source && footage.crop != CropSettings())
    problems.push_back({"export.video.codec",
                        "source copies packets, which have the footage's whole image; with "
                        "footage.crop use another codec"});
}

// Names that tell the cameras apart, also in file names; one clock for all.
void check_cameras(const std::vector<RigCamera>& cameras, Problems& problems) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string prefix = fmt::format("cameras[{}].", i);
    const std::string& name = cameras[i].name;
    if (const std::string wrong = name.empty() ? "" : file_name_error(name); !wrong.empty())
      problems.push_back({prefix + "name", wrong});
    const auto has_name = [&](const RigCamera& other) { return other.name == name; };
    if (!name.empty() &&
        std::find_if(cameras.begin(), cameras.end(), has_name) != cameras.begin() + static_cast<std::ptrdiff_t>(i))
      problems.push_back({prefix + "name", "is that of a camera before; each has a name of its own"});
    check_frames(cameras[i].footage, prefix, problems);
  }
  if (!cameras.empty() && !(cameras.front().clock == ClockSettings()))
    problems.push_back({"cameras[0].clock.offset_s",
                        "is the clock of the first camera, which is that of the rig: offset and drift must be 0"});
}

void check_output(const ExportSettings& output, Problems& problems) {
  const ContainerChoice container = output.container;
  if (output.codec == VideoCodec::ffv1 && container == ContainerChoice::mp4)
    problems.push_back({"export.video.container", "mp4 cannot hold ffv1; use mkv or avi"});
  const bool is_hevc = output.codec == VideoCodec::hevc;
  if ((is_hevc || output.codec == VideoCodec::av1) && container == ContainerChoice::avi)
    problems.push_back(
        {"export.video.container", fmt::format("avi cannot hold {}; use mp4 or mkv", is_hevc ? "hevc" : "av1")});
  if ((is_hevc || output.codec == VideoCodec::h264) && output.crf > 51)
    problems.push_back({"export.video.crf", fmt::format("is {}; of h264 and hevc 51 is the worst", output.crf)});
  if (writes_images(output.codec) && container != ContainerChoice::automatic)
    problems.push_back(
        {"export.video.container", "png, tiff and jpeg write numbered images, not a container; use auto"});
  if (output.codec == VideoCodec::source && container != ContainerChoice::automatic)
    problems.push_back({"export.video.container", "source keeps the footage's container; use auto"});
  if (container == ContainerChoice::y4m && output.codec != VideoCodec::raw)
    problems.push_back({"export.video.container", "y4m holds uncompressed video alone; use the codec raw"});
  const bool holds_raw =
      container == ContainerChoice::automatic || container == ContainerChoice::nut || container == ContainerChoice::y4m;
  if (output.codec == VideoCodec::raw && !holds_raw)
    problems.push_back({"export.video.container", "raw goes into nut or y4m; use one of them or auto"});
}

bool is_twice(const std::vector<std::string>& list, const std::string& text) {
  return std::count(list.begin(), list.end(), text) > 1;
}

// The names of a list are known, each once.
//   kind  what they name, for messages
void check_names(const std::vector<std::string>& names, std::span<const std::string_view> known, const char* key,
                 const char* kind, Problems& problems) {
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      problems.push_back({key, fmt::format("knows no {} \"{}\"; there are {}", kind, name, listed(known))});
    if (is_twice(names, name)) return problems.push_back({key, fmt::format("has \"{}\" twice; leave one out", name)});
  }
}

void check_categories(const Project& project, Problems& problems) {
  const std::vector<std::string>& categories = project.output.categories;
  for (const std::string& category : categories)
    if (category.empty() || is_twice(categories, category))
      return problems.push_back(
          {"export.categories", fmt::format("has \"{}\" twice or empty; leave one out", category)});
  if (categories.empty()) return;
  for (std::size_t i = 0; i < project.intruders.size(); ++i)
    if (std::find(categories.begin(), categories.end(), project.intruders[i].category) == categories.end())
      problems.push_back(
          {fmt::format("intruders[{}].category", i),
           fmt::format("is \"{}\", which export.categories does not have", project.intruders[i].category)});
}

}  // namespace

std::vector<Problem> validate(const Project& project) {
  Problems problems;
  Project copy = project;
  for (const Field& field : fields_of(copy)) {
    check_range(field, problems);
    check_text(project, field, problems);
  }
  check_name(project, problems);
  check_frames(project.footage, "", problems);
  check_cameras(project.cameras, problems);
  check_crop(project.footage, project.output.codec, problems);
  for (const RigCamera& camera : project.cameras) check_crop(camera.footage, project.output.codec, problems);
  check_output(project.output, problems);
  check_names(project.output.labels, kLabelNames, "export.labels", "format", problems);
  check_names(project.output.rig, kRigTableNames, "export.rig", "table", problems);
  check_names(project.output.encounter, kWellClearNames, "export.encounter", "volume", problems);
  check_places(project, problems);
  check_track(project.camera, problems);
  check_categories(project, problems);
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const std::string key = fmt::format("intruders[{}]", i);
    check_axes(project.intruders[i].model, key + ".model", problems);
    check_waypoints(project.intruders[i].trajectory, key + ".trajectory.waypoints", problems);
  }
  return problems;
}

Error error_of(const Project& project, const Problem& problem) {
  return {project.file.string() + ": " + field_in_file(project, problem.field), problem.what, problem.kind};
}

}  // namespace sigs
