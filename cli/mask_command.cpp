// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "base/numbered_files.h"
#include "base/paths.h"
#include "cli/mask_outputs.h"
#include "cli/options.h"
#include "cli/process.h"
#include "cli/progress.h"
#include "export/export_project.h"
#include "occlusion/detect.h"
#include "project/validate.h"
#include "scene/opened_project.h"
#include "scene/scene_parts.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kMaskFooter =
    "Examples:\n"
    "  sigs mask flight.mp4\n"
    "  sigs mask flight.mp4 --out own_body.png --confidence sure.png --stages steps\n"
    "  sigs mask encounter.json --out own_body.png --frames 600 --set own_body.soft_edge_px=3\n"
    "  sigs mask flight.mp4 --method paper --every 2 --out own_body.png --force\n"
    "\n"
    "A project's own settings stand where an option is not given.";

struct MaskOptions {
  ProjectOptions project;  // its file may be a video too
  MaskPaths paths;         // mask empty: named after the video
  OptionSettings settings;
  bool force = false;
  std::string progress = "auto";
};

// A video alone is a project with nothing else in it, at the place where the program was started.
Result<Project> read(const ProjectOptions& options) {
  if (is_project_file(options.file)) return project_of(options);
  Project project;
  project.footage.video = options.file.string();
  if (const Result<void> set = set_all(project, options.settings); !set) return fail(set.error());
  return project;
}

// The detection needs neither calibration nor intruders; errors in them are ignored here.
bool concerns_detection(const Problem& problem) {
  return problem.field.starts_with("own_body.") || problem.field == "footage.video" ||
         problem.field == "footage.first_frame" || problem.field == "footage.last_frame";
}

Error error_in(const Project& project, const Problem& problem) {
  if (!project.file.empty()) return error_of(project, problem);
  if (problem.field == "footage.video") return {project.footage.video, "no such file", problem.kind};
  return {problem.field, problem.what, ErrorKind::usage};
}

Result<Project> project_of(const MaskOptions& options) {
  Result<Project> project = read(options.project);
  if (!project) return project;
  if (const Result<void> set = set_option_settings(*project, options.settings); !set) return fail(set.error());
  for (const Problem& problem : validate(*project))
    if (concerns_detection(problem)) return fail(error_in(*project, problem));
  return project;
}

Result<FrameSource> footage_of(const Project& project) {
  Result<FrameSource> source = open_footage(project);
  if (!source && !project.file.empty())
    return fail(project.file.string() + ": footage.video", source.error().text(), source.error().kind);
  if (source)
    for (const Warning& warning : warnings_of(source->info())) print_warning(warning);
  return source;
}

fs::path default_mask(const fs::path& video) {
  // Of images the folder that they are in: "images/%06d.png" and "images/" give "images".
  const bool is_pattern = is_number_pattern(video) && video.has_parent_path();
  const fs::path named = is_pattern || !video.has_filename() ? video.parent_path() : video;
  return named.stem().string() + ".own-body.png";
}

Result<MaskOutputs> reserved(const MaskOptions& options, const Project& project, const fs::path& video) {
  MaskPaths paths = options.paths;
  if (paths.mask.empty()) paths.mask = default_mask(video);
  return MaskOutputs::reserved(std::move(paths), {video, project.file}, options.force);
}

Result<OwnBody> found_in(FrameSource& footage, const FrameRange& range, const Project& project,
                         const MaskOptions& options) {
  OwnBodySettings settings = project.own_body;
  settings.frames = std::min(settings.frames, range.last - range.first + 1);
  Progress progress(progress_style(options.progress));
  const DetectionControl control{.progress = [&](int done, int total) { progress.update(done, total); },
                                 .cancel = &interrupt_flag(),
                                 .stages = options.paths.stages.empty() ? KeepStages::no : KeepStages::yes};
  Result<OwnBody> found = detect_own_body(footage, range.first, settings, control);
  progress.end();
  return found;
}

Result<void> write(MaskOutputs& out, const OwnBody& found, FrameSource& footage, int first_frame) {
  cv::Mat image;
  if (out.has_stages()) {
    const Result<Frame> middle = footage.read(first_frame + found.frames_passed / 2);
    if (!middle) return fail(middle.error());
    image = bgr_of(*middle);
  }
  const Result<std::vector<fs::path>> written = out.write(found, image);
  if (!written) return fail(written.error());
  for (const fs::path& path : *written) std::printf("%s\n", path.c_str());
  return {};
}

void print_summary(const OwnBody& found, const Project& project) {
  for (const Warning& warning : found.warnings) print_warning(warning);
  if (found.share > 0)
    std::fprintf(stderr, "own body: %.1f %% of the image, %d frames used\n", 100 * found.share, found.frames_used);
  else
    std::fprintf(stderr, "own body: none found, %d frames used; the mask is black\n", found.frames_used);
  if (found.converged)
    std::fprintf(stderr, "converged after %d of at most %d frames; the last check changed %.2g %% of the mask\n",
                 found.frames_passed, project.own_body.frames, 100 * found.last_change);
}

// Where the result may well be wrong and has to be inspected.
void warn_of_doubtful_mask(const OwnBody& found, const VideoInfo& footage, int first_frame) {
  constexpr double kRounding_s = 0.05;  // 9.95 is printed as 10.0
  const auto first = static_cast<std::size_t>(first_frame);
  const auto steps = static_cast<std::size_t>(found.frames_passed - 1);
  const double from_first_to_last_s = footage.times_s[first + steps] - footage.times_s[first];
  const double passed_s = from_first_to_last_s * (1 + 1 / static_cast<double>(steps));  // the last one is shown too
  if (passed_s < kEnoughFootage_s - kRounding_s) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "only %.1f s of footage were looked through, parts of the world may be masked; look at the mask, or "
                  "take 10 s or more",
                  passed_s);
    print_warning({footage.path.string(), text});
  }
  if (found.share > kLargeShare)
    print_warning({footage.path.string(), "more than half of the image is masked; look whether all of it is the UAV"});
}

Result<void> run(const MaskOptions& options) {
  const Result<Project> project = project_of(options);
  if (!project) return fail(project.error());
  Result<FrameSource> footage = footage_of(*project);
  if (!footage) return fail(footage.error());
  const Result<FrameRange, Problem> range = scene_range(project->footage, shape_of(footage->info()));
  if (!range) return fail(error_in(*project, range.error()));
  defer_interrupts();
  Result<MaskOutputs> out = reserved(options, *project, footage->info().path);
  if (!out) return fail(out.error());
  const Result<OwnBody> found = found_in(*footage, *range, *project, options);
  if (!found) return fail(found.error());
  if (const Result<void> written = write(*out, *found, *footage, range->first); !written) return written;
  print_summary(*found, *project);
  warn_of_doubtful_mask(*found, footage->info(), range->first);
  return {};
}

}  // namespace

Command add_mask_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("mask", "find which pixels of a video show the UAV's own body");
  const auto options = std::make_shared<MaskOptions>();
  command->add_option("FILE", options->project.file, "a video, or a project (json): its footage, range and settings")
      ->required()
      ->check(not_empty());
  add_set_option(*command, options->project);
  const auto add_path = [command](const char* name, fs::path& path, const char* value, const char* help) {
    command->add_option(name, path, help)->option_text(value)->check(output_path());
  };
  add_path("--out", options->paths.mask, "FILE",
           "the mask, a PNG; without it VIDEO.own-body.png in the current folder");
  for (const SettingOption& option : {SettingOption{"--frames", "own_body.frames", "N",
                                                    "how many frames are looked through; all where there are fewer"},
                                      SettingOption{"--every", "own_body.every", "K", "use each K-th of them alone"},
                                      SettingOption{"--method", "own_body.method", "NAME", "stable or paper"}})
    add_setting_option(*command, option, options->settings);
  add_path("--confidence", options->paths.confidence, "FILE", "write how sure each pixel is too: a 16-bit PNG");
  add_path("--stages", options->paths.stages, "DIR", "write the image of every step into this folder");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kMaskFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
