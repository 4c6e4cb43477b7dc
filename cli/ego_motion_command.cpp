// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image_codecs.h"
#include "base/paths.h"
#include "base/pose.h"
#include "base/text.h"
#include "camera/camera.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "ego_motion/ego_motion.h"
#include "ego_motion/project_motion.h"
#include "scene/opened_project.h"
#include "telemetry/track.h"
#include "telemetry/track_csv.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEgoMotionFooter =
    "Examples:\n"
    "  sigs ego-motion flight.mp4 --calibration gopro.xml --out attitude.csv\n"
    "  sigs ego-motion flight.mp4 --calibration gopro.xml --mask own_body.png --telemetry flight.mp4 \\\n"
    "    --readout-ms 20 --out attitude.csv --plot attitude.png\n"
    "  sigs ego-motion --into encounter.json";

struct EgoMotionOptions {
  fs::path video;
  fs::path calibration;
  fs::path mask;       // empty: none
  fs::path telemetry;  // likewise
  SequenceTiming timing;
  fs::path csv;
  fs::path plot;  // empty: none
  fs::path into;  // the project to follow the attitudes; empty: none
  double max_unknown_percent = 100 * kMaxUnknownShare;
  std::optional<double> readout_ms;
  bool force = false;
  std::string progress = "auto";

  [[nodiscard]] std::vector<CommandOutput> outputs() const { return {{"--out", csv}, {"--plot", plot}}; }
};

// With a project it names footage, calibration and the rest; without one they are asked for.
Result<void> check_inputs(const EgoMotionOptions& options) {
  const bool has_project = !options.into.empty();
  const auto said = [&](const char* name, bool is_given, bool is_needed) -> Result<void> {
    if (has_project && is_given) return fail(name, "is named by the project of --into; leave it out", ErrorKind::usage);
    if (!has_project && is_needed && !is_given) return fail(name, "is required", ErrorKind::usage);
    return {};
  };
  for (const Result<void>& one :
       {said("VIDEO", !options.video.empty(), true), said("--calibration", !options.calibration.empty(), true),
        said("--mask", !options.mask.empty(), false), said("--telemetry", !options.telemetry.empty(), false),
        said("--frame-rate", options.timing.frame_rate_hz > 0, false),
        said("--timestamps", !options.timing.times_file.empty(), false),
        said("--readout-ms", options.readout_ms.has_value(), false)})
    if (!one) return one;
  if (!has_project && options.csv.empty()) return fail("--out", "is required", ErrorKind::usage);
  return {};
}

// What is found, and the same with what the log of the flight knows besides.
struct Estimated {
  EgoMotion motion;
  Track track;
};

Result<Estimated> estimated(const EgoMotionOptions& options, const EgoMotionControl& control) {
  Result<FrameSource> footage =
      FrameSource::open(options.video, &interrupt_flag(), Quantisers::leave_out, options.timing);
  if (!footage) return fail(footage.error());
  for (const Warning& warning : footage->info().warnings) print_warning(warning);
  const Result<Camera> camera = read_calibration(options.calibration, footage->info().size_px);
  if (!camera) return fail(camera.error());
  for (const Warning& warning : camera->warnings) print_warning(warning);
  const Result<cv::Mat> mask = options.mask.empty() ? Result<cv::Mat>(cv::Mat())  // none is asked for
                                                    : read_image_file(options.mask, cv::IMREAD_GRAYSCALE);
  if (!mask) return fail(mask.error());
  std::optional<Track> log;
  if (!options.telemetry.empty()) {
    Result<Track> read = read_track(options.telemetry, &interrupt_flag());
    if (!read) return fail(read.error());
    for (const Warning& warning : read->warnings) print_warning(warning);
    log = std::move(*read);
  }
  EgoMotionSettings settings;
  if (options.readout_ms) settings.readout_s = *options.readout_ms / 1000;
  Result<EgoMotion> motion = estimate_ego_motion(*footage, *camera, *mask, log ? &*log : nullptr, settings, control);
  if (!motion) return fail(motion.error());
  if (const Result<void> known = check_known(*motion, options.video.string(), options.max_unknown_percent / 100);
      !known)
    return fail(known.error().where, known.error().what + "; --max-unknown allows more", known.error().kind);
  Track track = track_of(*motion, options.video);
  if (log) add_log(track, *log, *motion);
  if (options.readout_ms) track.readout_s = *options.readout_ms / 1000;
  return Estimated{*std::move(motion), std::move(track)};
}

void print_summary(const EgoMotion& motion) {
  for (const Warning& warning : motion.warnings) print_warning(warning);
  double largest_rad = 0;
  int lost = 0;
  const int unknown = unknown_frames(motion);
  for (const EgoFrame& frame : motion.frames) {
    for (int axis = 0; axis < 3; ++axis) largest_rad = std::max(largest_rad, frame.sd_rad[axis]);
    lost += frame.is_lost ? 1 : 0;
  }
  std::fprintf(stderr,
               "%s, %d of them lost, %d not known against frame 0; largest standard deviation since frame 0: %s deg\n",
               count_text(static_cast<std::int64_t>(motion.frames.size()), "frame").c_str(), lost, unknown,
               short_number_text(deg_of_rad(largest_rad)).c_str());
  if (motion.level_sd_rad)
    std::fprintf(stderr, "horizon seen: roll and pitch are absolute to %s deg\n",
                 fixed_text(deg_of_rad(*motion.level_sd_rad), 2).c_str());
  else
    std::fprintf(stderr,
                 "no horizon seen: roll and pitch are against frame 0; what they were there, "
                 "camera.attitude_deg states\n");
  if (motion.gyro)
    std::fprintf(
        stderr, "gyroscope: offset of the log %s s (+- %s), drift %s, correlation %s, images turn %s times as fast%s\n",
        fixed_text(motion.gyro->offset_s, 4).c_str(), fixed_text(motion.gyro->offset_sd_s, 4).c_str(),
        short_number_text(motion.gyro->drift).c_str(), fixed_text(motion.gyro->correlation, 4).c_str(),
        fixed_text(motion.gyro->slope, 3).c_str(), motion.gyro->is_fused ? "" : "; not used");
}

// What a project is estimated from, and becomes.
Result<Estimated> estimated_for(Project& project, const EgoMotionOptions& options, const EgoMotionControl& control) {
  Result<ProjectMotion> found = estimated_project_motion(project, control, options.max_unknown_percent / 100);
  if (!found) return fail(found.error());
  for (const Warning& warning : found->warnings) print_warning(warning);
  found->found.file = path_beside(options.csv, options.into);
  follow_attitudes(project, found->found);
  return Estimated{std::move(found->motion), std::move(found->track)};
}

Result<void> estimate_and_write(const EgoMotionOptions& options) {
  std::optional<Project> project;
  if (!options.into.empty()) {
    Result<Project> read = project_of({.file = options.into, .settings = {}});
    if (!read) return fail(read.error());
    if (const Result<void> valid = check_valid(*read); !valid) return fail(valid.error());
    project = *std::move(read);
  }
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> free = files.reserve(options.outputs()); !free) return free;
  Progress progress(options.progress);
  const EgoMotionControl control{.progress = progress.counter(), .cancel = &interrupt_flag()};
  const Result<Estimated> found = project ? estimated_for(*project, options, control) : estimated(options, control);
  progress.end();
  if (!found) return fail(found.error());
  const Result<void> written =
      files.write_and_commit({{options.csv, [&] { return track_csv_text(found->track); }},
                              {options.plot, [&] { return png_bytes(attitude_plot(found->motion)); }}});
  if (!written) return written;
  if (project)
    if (const Result<void> saved = rewrite_project(*project, options.into); !saved) return saved;
  print_written(files.final_paths());
  if (project) std::printf("%s\n", options.into.c_str());
  print_summary(found->motion);
  return {};
}

Result<void> run(EgoMotionOptions options) {
  if (const Result<void> given = check_inputs(options); !given) return given;
  if (options.csv.empty()) options.csv = options.into.parent_path() / (options.into.stem().string() + ".attitude.csv");
  if (const Result<void> named =
          check_outputs(options.outputs(), {options.video, options.calibration, options.mask, options.telemetry,
                                            options.timing.times_file, options.into});
      !named)
    return named;
  return estimate_and_write(options);
}

}  // namespace

Command add_ego_motion_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("ego-motion", "estimate the camera's attitude from its footage");
  const auto options = std::make_shared<EgoMotionOptions>();
  command->add_option("VIDEO", options->video, "the footage; with --into the project names it")->check(not_empty());
  add_input(*command, "--calibration", options->calibration, "the camera's calibration");
  add_input(*command, "--mask", options->mask, "the own body's mask: 8-bit grey, white where the own body is");
  add_input(*command, "--telemetry", options->telemetry, "a log with the camera's rates, or the video that has it");
  add_timing_options(*command, options->timing);
  add_range(*command, "--readout-ms", options->readout_ms, "MS", 0, 1000,
            "rolling shutter, first row to last; milliseconds");
  add_input(*command, "--into", options->into,
            "estimate from what this project names, and make it follow the attitudes (camera.track)", "PROJECT");
  add_range(*command, "--max-unknown", options->max_unknown_percent, "PERCENT", 0, 100,
            "fail if the rotation since frame 0 is not known in more of the frames, percent (50)");
  add_output(*command, "--out", options->csv, "the attitudes, as CSV; with --into beside the project by default");
  add_output(*command, "--plot", options->plot, "draw roll, pitch and yaw with their deviations; a PNG");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kEgoMotionFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
