// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "camera/rig_calibration.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "ego_motion/clock_sync.h"
#include "ego_motion/project_motion.h"
#include "project/json.h"
#include "project/project.h"
#include "telemetry/track.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRigFooter =
    "Examples:\n"
    "  sigs rig calibration camchain.yaml\n"
    "  sigs rig sync rig.json --into";
constexpr const char* kRigCalibrationFooter =
    "Examples:\n"
    "  sigs rig calibration camchain.yaml\n"
    "  sigs rig calibration stereo.yml --unit 0.001 --into rig.json";
constexpr const char* kRigSyncFooter =
    "Examples:\n"
    "  sigs rig sync rig.json\n"
    "  sigs rig sync rig.json --by sound --into";

struct RigCalibrationOptions {
  fs::path file;
  fs::path into;  // the project; empty: none
  std::string size;
  double unit_m = 1;
};

Result<Project> rig_project_of(const fs::path& file) {
  Result<Project> project = whole_project_of({.file = file, .settings = {}, .camera = {}});
  if (!project) return fail(project.error());
  if (project->cameras.size() < 2)
    return fail(file.string() + ": cameras", "has fewer than two cameras; a rig is needed", ErrorKind::bad_project);
  return project;
}

std::string attitude_text(const glm::dquat& rotation) {
  const Attitude attitude = attitude_of(rotation);
  const auto rounded_deg = [](double angle_rad) { return std::round(1000 * deg_of_rad(angle_rad)) / 1000 + 0.0; };
  return fmt::format("{:8.3f} {:8.3f} {:8.3f}", rounded_deg(attitude.roll_rad), rounded_deg(attitude.pitch_rad),
                     rounded_deg(attitude.yaw_rad));
}

void print_rig(const RigCalibration& rig) {
  std::printf("%s, %zu cameras; in the axes of %s: X along its optical axis, Y right, Z down\n", rig.format.c_str(),
              rig.cameras.size(), rig.cameras[0].name.c_str());
  std::printf("%-12s %-12s %-27s %-27s %s\n", "camera", "image", "position_m", "roll pitch yaw, deg", "clock_s");
  for (const CalibratedCamera& camera : rig.cameras) {
    const glm::dvec3& place_m = camera.first_from_camera.translation_m;
    const std::string line =
        fmt::format("{:<12} {:<12} {:8.4f} {:8.4f} {:8.4f}   {}   {}", camera.name,
                    fmt::format("{}x{}", camera.camera.size_px.width, camera.camera.size_px.height), place_m.x,
                    place_m.y, place_m.z, attitude_text(camera.first_from_camera.rotation),
                    camera.clock_offset_s ? fmt::format("{:.6f}", *camera.clock_offset_s) : "-");
    std::printf("%s\n", line.c_str());
  }
}

// The project's camera that each of the file's is: by names where all are the same, else by order.
Result<std::vector<std::size_t>> matched(const RigCalibration& rig, const Project& project, const fs::path& file) {
  std::vector<std::size_t> by_name;
  std::vector<std::size_t> by_order;
  for (const CalibratedCamera& camera : rig.cameras) {
    by_order.push_back(by_order.size());
    for (std::size_t i = 0; i < project.cameras.size(); ++i)
      if (project.cameras[i].name == camera.name) by_name.push_back(i);
  }
  if (by_name.size() == rig.cameras.size()) return by_name;
  if (rig.cameras.size() == project.cameras.size()) return by_order;
  return fail(
      file.filename().string(),
      fmt::format("has {} cameras, the project {}; with other names than the project's the numbers must be equal",
                  rig.cameras.size(), project.cameras.size()));
}

// Mounts and clocks of a project by a calibration, whose first camera stays as the project has it.
void take(const RigCalibration& rig, const std::vector<std::size_t>& places, const std::string& calibration,
          Project& project) {
  const Pose<frame::Body, frame::Camera> of_first = body_from_camera(project.cameras[places[0]].mount);
  const Pose<frame::Body, frame::FirstCamera> body_from_first{of_first.rotation, of_first.translation_m};
  const ClockSettings clock_of_first = project.cameras[places[0]].clock;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    RigCamera& camera = project.cameras[places[i]];
    if (camera.footage.calibration.empty()) camera.footage.calibration = calibration + "#" + rig.cameras[i].name;
    if (i == 0) continue;
    const Pose<frame::Body, frame::Camera> pose = body_from_first * rig.cameras[i].first_from_camera;
    const Attitude attitude = attitude_of(pose.rotation);
    camera.mount = {.position_m = pose.translation_m,
                    .roll_deg = deg_of_rad(attitude.roll_rad),
                    .pitch_deg = deg_of_rad(attitude.pitch_rad),
                    .yaw_deg = deg_of_rad(attitude.yaw_rad)};
    if (rig.cameras[i].clock_offset_s) {
      camera.clock = clock_of_first;
      camera.clock.offset_s += *rig.cameras[i].clock_offset_s;
    }
  }
}

Result<void> run_rig_calibration(const RigCalibrationOptions& options) {
  const Result<std::optional<cv::Size>> size = size_of_option(options.size);
  if (!size) return fail(size.error());
  const Result<RigCalibration> rig =
      read_rig_calibration(options.file, {.size_px = *size, .opencv_unit_m = options.unit_m});
  if (!rig) return fail(rig.error());
  for (const Warning& warning : rig->warnings) print_warning(warning);
  print_rig(*rig);
  if (options.into.empty()) return {};
  Result<Project> project = rig_project_of(options.into);
  if (!project) return fail(project.error());
  const Result<std::vector<std::size_t>> places = matched(*rig, *project, options.file);
  if (!places) return fail(places.error());
  take(*rig, *places, path_beside(options.file, options.into), *project);
  if (rig->cameras[1].clock_offset_s)
    std::fprintf(stderr,
                 "clocks are those that stamped the images of the calibration; footage whose times do not count from "
                 "the same stamp needs `sigs rig sync`\n");
  if (const Result<void> saved = rewrite_project(*project, options.into); !saved) return saved;
  std::printf("%s\n", options.into.c_str());
  return {};
}

struct RigSyncOptions {
  fs::path project;
  bool into = false;
  bool finds_mounts = false;
  std::vector<std::string> by;
  double max_offset_s = 3600;
  std::string progress = "auto";
};

constexpr std::pair<std::string_view, ClockSource> kSourceWords[] = {{"turns", ClockSource::turns},
                                                                     {"sound", ClockSource::sound},
                                                                     {"log", ClockSource::log},
                                                                     {"timecode", ClockSource::time_code},
                                                                     {"creation-time", ClockSource::creation_time}};

Result<std::vector<ClockSource>> sources_of(const std::vector<std::string>& words) {
  std::vector<ClockSource> sources;
  for (const std::string& word : words) {
    const auto known = std::ranges::find(kSourceWords, word, &std::pair<std::string_view, ClockSource>::first);
    if (known == std::end(kSourceWords))
      return fail("--by " + word, "expected turns, sound, log, timecode or creation-time", ErrorKind::usage);
    sources.push_back(known->second);
  }
  return sources;
}

// What is known of one camera of the project.
struct KnownCamera {
  std::string name;
  fs::path video;
  std::optional<EgoMotion> motion;
  std::optional<Track> log;
  std::string why_no_motion;

  [[nodiscard]] CameraRecording recording() const {
    return {.video = video, .motion = motion ? &*motion : nullptr, .log = log ? &*log : nullptr};
  }
};

bool wants(const std::vector<ClockSource>& sources, ClockSource source) {
  return sources.empty() || std::find(sources.begin(), sources.end(), source) != sources.end();
}

Result<KnownCamera> known_camera(Project seen, const std::vector<ClockSource>& sources,
                                 const EgoMotionControl& control) {
  KnownCamera camera{.name = seen.rig_view->name,
                     .video = resolved(seen, seen.footage.video),
                     .motion = {},
                     .log = {},
                     .why_no_motion = {}};
  if (wants(sources, ClockSource::turns)) {
    seen.camera.track = {};  // a log's gyroscope turns about the axes of one of the cameras at most
    Result<ProjectMotion> found = estimated_project_motion(seen, control);
    if (!found && found.error().kind == ErrorKind::interrupted) return fail(found.error());
    if (found)
      camera.motion = std::move(found->motion);
    else
      camera.why_no_motion = found.error().text();
  }
  if (wants(sources, ClockSource::log) && carries_telemetry(camera.video))
    if (Result<Track> log = read_track(camera.video, &interrupt_flag())) camera.log = *std::move(log);
  return camera;
}

bool is_default(const MountSettings& mount) {
  return mount.roll_deg == 0 && mount.pitch_deg == 0 && mount.yaw_deg == 0;
}

// The findings, with the mounts of the project and, where they do not explain the turns or say nothing, without.
Result<std::vector<ClockFinding>> findings_of(const KnownCamera& first, const KnownCamera& second,
                                              const Project& project, std::size_t index,
                                              const std::vector<ClockSource>& sources, const RigSyncOptions& options) {
  const MountSettings& mount_of_first = project.cameras[0].mount;
  const MountSettings& mount_of_second = project.cameras[index].mount;
  TurnSyncSettings settings{.first_from_second = {}, .max_offset_s = options.max_offset_s};
  const bool says_nothing = is_default(mount_of_first) && is_default(mount_of_second);
  if (!options.finds_mounts && !says_nothing)
    settings.first_from_second =
        glm::conjugate(body_from_camera(mount_of_first).rotation) * body_from_camera(mount_of_second).rotation;
  const StepControl control{.cancel = &interrupt_flag(), .progress = {}};
  Result<std::vector<ClockFinding>> found =
      found_clocks(first.recording(), second.recording(), sources, settings, control);
  if (!found) return fail(found.error());
  for (ClockFinding& finding : *found) {
    if (finding.source != ClockSource::turns) continue;
    if (!first.why_no_motion.empty()) finding.text = first.why_no_motion;
    if (!second.why_no_motion.empty()) finding.text = second.why_no_motion;
    if (finding.turns && !settings.first_from_second)
      finding.text +=
          fmt::format("; mount against {}, roll pitch yaw:{} +- {:.2f} deg", first.name,
                      attitude_text(finding.turns->first_from_second), deg_of_rad(finding.turns->rotation_sd_rad));
  }
  return found;
}

void print_findings(const std::string& camera, const std::vector<ClockFinding>& findings,
                    const std::optional<std::size_t>& best) {
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const ClockFinding& finding = findings[i];
    const std::string line =
        finding.clock ? fmt::format("{:<12} {:<14} {:13.4f} {:9.4f} {:>9} {} {}", camera, name_of(finding.source),
                                    finding.clock->offset_s, finding.clock->sd_s,
                                    finding.clock->drift == 0 ? "-" : fmt::format("{:.1f}", 1e6 * finding.clock->drift),
                                    best == i ? "*" : " ", finding.text)
                      : fmt::format("{:<12} {:<14} {:>13} {:>9} {:>9}   {}", camera, name_of(finding.source), "-", "-",
                                    "-", finding.text);
    std::printf("%s\n", line.c_str());
  }
}

// Findings that contradict the best one by more than three of their deviations.
void warn_of_contradictions(const std::string& camera, const std::vector<ClockFinding>& findings, std::size_t best) {
  const ClockOffset& chosen = *findings[best].clock;
  for (const ClockFinding& other : findings) {
    if (!other.clock || &other == &findings[best]) continue;
    const double apart_s = other.clock->first_time_s(chosen.middle_s) - chosen.first_time_s(chosen.middle_s);
    if (std::abs(apart_s) > 3 * std::hypot(other.clock->sd_s, chosen.sd_s))
      print_warning({camera, fmt::format("{} and {} differ by {:.3f} s; clocks set apart, or another flight?",
                                         name_of(findings[best].source), name_of(other.source), apart_s)});
  }
}

Result<void> run_rig_sync(const RigSyncOptions& options) {
  const Result<std::vector<ClockSource>> sources = sources_of(options.by);
  if (!sources) return fail(sources.error());
  Result<Project> project = rig_project_of(options.project);
  if (!project) return fail(project.error());
  defer_interrupts();
  std::vector<KnownCamera> cameras;
  const int count = static_cast<int>(project->cameras.size());
  Progress progress(options.progress);
  for (int i = 0; i < count; ++i) {
    const EgoMotionControl control{
        .progress = [&, i](int done, int total) { progress.update(i * total + done, count * total); },
        .cancel = &interrupt_flag()};
    Result<KnownCamera> camera = known_camera(seen_by(*project, static_cast<std::size_t>(i)), *sources, control);
    if (!camera) return fail(camera.error());
    cameras.push_back(*std::move(camera));
  }
  progress.end();
  std::printf("clocks against %s: its time = offset_s + (1 + drift) * the camera's; * is the most exact\n",
              cameras[0].name.c_str());
  std::printf("%-12s %-14s %13s %9s %9s\n", "camera", "by", "offset_s", "+- s", "ppm");
  bool all_found = true;
  for (std::size_t i = 1; i < cameras.size(); ++i) {
    const Result<std::vector<ClockFinding>> findings =
        findings_of(cameras[0], cameras[i], *project, i, *sources, options);
    if (!findings) return fail(findings.error());
    const std::optional<std::size_t> best = best_of(*findings);
    print_findings(cameras[i].name, *findings, best);
    all_found = all_found && best.has_value();
    if (!best) continue;
    warn_of_contradictions(cameras[i].name, *findings, *best);
    const ClockOffset& clock = *(*findings)[*best].clock;
    project->cameras[i].clock = {.offset_s = clock.offset_s, .drift_ppm = 1e6 * clock.drift};
  }
  if (!all_found)
    return fail(options.project.string(),
                "the clock of a camera was not found; the table says why. Nothing was written");
  if (!options.into) return {};
  project->cameras[0].clock = {};
  if (const Result<void> saved = rewrite_project(*project, options.project); !saved) return saved;
  std::printf("%s\n", options.project.c_str());
  return {};
}

Command add_rig_calibration(CLI::App& rig) {
  auto options = std::make_shared<RigCalibrationOptions>();
  CLI::App* const command = rig.add_subcommand("calibration", "say how a rig's cameras lie by its calibration");
  add_subject(*command, "FILE", options->file, "Kalibr's camchain.yaml, or OpenCV's stereo file");
  add_input(*command, "--into", options->into, "put mounts and clocks into this project, which is rewritten",
            "PROJECT");
  add_value(*command, "--size", options->size, "WxH", "of the images, for a file that states none");
  add_number(*command, "--unit", options->unit_m, "M", 1e-6, 1e3, "metres of one unit of T in OpenCV's stereo files");
  command->footer(kRigCalibrationFooter);
  return [options] { return run_rig_calibration(*options); };
}

Command add_rig_sync(CLI::App& rig) {
  auto options = std::make_shared<RigSyncOptions>();
  CLI::App* const command = rig.add_subcommand("sync", "find how the clocks of a rig's cameras belong together");
  add_subject(*command, "PROJECT", options->project, "a project with several cameras");
  add_value(*command, "--by", options->by, "SOURCE",
            "turns, sound, log, timecode, creation-time; several with commas; all")
      ->delimiter(',');
  command->add_flag("--find-mounts", options->finds_mounts,
                    "find by the turns how the cameras lie, in place of the project's mounts");
  add_number(*command, "--max-offset", options->max_offset_s, "S", 0.1, 1e6, "larger offsets are not looked at");
  command->add_flag("--into", options->into, "put the clocks into the project, which is rewritten");
  add_progress_option(*command, options->progress);
  command->footer(kRigSyncFooter);
  return [options] { return run_rig_sync(*options); };
}

}  // namespace

Command add_rig_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("rig", "calibrate and synchronise several cameras of one aircraft");
  command->footer(kRigFooter);
  return add_below(*command, {add_rig_calibration, add_rig_sync});
}

}  // namespace sigs::cli
